//! Bodies that meet and stick together for good, against closed forms: what is captured turns about the common centre of mass.

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Body, BodyContact, Equations, Friction, Gravity, Happening, Model, Run, Shape, Start, Surface,
};

fn disk(name: &str, radius: f64, mass: f64) -> Body {
    Body::of_shape(name, Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: radius * M })
        .mass(mass * KG)
}

fn add(model: &mut Model, body: Body, place: [f64; 2], velocity: [f64; 2], omega: f64) {
    let start =
        Start::default().at(place.map(|x| x * M)).velocity(velocity.map(|v| v * M / S)).omega(omega / S);
    model.starts.push((body.name.clone(), start));
    model.add(body);
}

/// x, y, vx, vy, omega of each body at a time.
fn states(run: &Run, time: f64) -> Vec<[f64; 5]> {
    let bodies = run.equations.model().bodies.iter();
    let state = |body: &Body| {
        let own = body.kinematics();
        let (c, v) = (own.position(), own.velocity());
        at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), own.omega()])
    };
    bodies.map(state).collect()
}

/// Momentum, moment of momentum about the origin, and energy of motion; `bodies` are mass and moment of inertia.
fn stocks(states: &[[f64; 5]], bodies: &[[f64; 2]]) -> [f64; 4] {
    let own = states.iter().zip(bodies).map(|([x, y, vx, vy, w], [m, i])| {
        [m * vx, m * vy, m * (x * vy - y * vx) + i * w, 0.5 * m * (vx * vx + vy * vy) + 0.5 * i * w * w]
    });
    own.fold([0.0; 4], |sum, own| [0, 1, 2, 3].map(|which| sum[which] + own[which]))
}

/// Two equal disks of which one flies past the centre of the other by b. They touch with `2 R` between the centres and go on as one body
/// with `I = 2 (m R^2/2) + 2 m R^2 = 3 m R^2` and the moment of momentum `m v b/2` about the common centre: `omega = v b/(6 R^2)`.
#[test]
fn two_disks_off_the_centre() {
    let (r, m, v, b) = (0.1, 0.7, 3.0, 0.13);
    let mut model = Model::new();
    add(&mut model, disk("a", r, m), [0.0, 0.0], [0.0, 0.0], 0.0);
    add(&mut model, disk("b", r, m), [1.0, b], [-v, 0.0], 0.0);
    model.contact(BodyContact::capturing("hits"));
    let run = run(model, 2.0, 1e-13);
    let meet = (1.0 - (4.0 * r * r - b * b).sqrt()) / v;
    let contacts = run.contacts();
    assert_eq!(contacts.len(), 1);
    close(contacts[0].start, meet, 1e-14);
    let omega = v * b / (6.0 * r * r);
    let (inertia, after) = (0.5 * m * r * r, states(&run, 2.0));
    for state in &after {
        close(state[4], omega, 1e-12);
    }
    let centre = |axis: usize| 0.5 * (after[0][axis] + after[1][axis]);
    close(centre(2), -0.5 * v, 1e-12);
    close(centre(3), 0.0, 1e-12);
    // As far from each other as when they met, and turned by omega since then.
    let (dx, dy) = (after[1][0] - after[0][0], after[1][1] - after[0][1]);
    close(dx.hypot(dy), 2.0 * r, 1e-12);
    let turned = omega * (2.0 - meet) + (b / (2.0 * r)).asin();
    close(dx, 2.0 * r * turned.cos(), 1e-10);
    close(dy, 2.0 * r * turned.sin(), 1e-10);
    let bodies = [[m, inertia]; 2];
    let ([px, py, l, before], [qx, qy, k, then]) =
        (stocks(&states(&run, 0.0), &bodies), stocks(&after, &bodies));
    [(px, qx), (py, qy), (l, k)].into_iter().for_each(|(before, after)| close(after, before, 1e-12));
    // m v^2/2 less what the common motion has.
    let left = 0.25 * m * v * v + 0.5 * 3.0 * m * r * r * omega * omega;
    close(then, left, 1e-12);
    assert!(then < before);
}

/// A disk that flies at a rod at rest, across it, and is captured at the distance d from its middle.
#[test]
fn a_rod_captures_a_disk() {
    let (length, big, r, m, v, d) = (1.0, 2.0, 0.05, 0.3, 4.0, 0.31);
    let mut model = Model::new();
    let rod = Body::of_shape(
        "rod",
        Shape::Rod {
            from: Vector::planar(-0.5 * length * M, 0 * M),
            to: Vector::planar(0.5 * length * M, 0 * M),
            end_radius: 0 * M,
        },
    );
    add(&mut model, rod.mass(big * KG), [0.0, 0.0], [0.0, 0.0], 0.0);
    add(&mut model, disk("disk", r, m), [d, 1.0], [0.0, -v], 7.0);
    model.contact(BodyContact::capturing("hits"));
    let run = run(model, 1.0, 1e-13);
    let after = states(&run, 1.0);
    let spin = 0.5 * m * r * r * 7.0;
    // About the common centre, which is m/(M + m) of the way from the rod's middle to the disk's, at (d, r).
    let share = m / (big + m);
    let reduced = big * share;
    let inertia = big * length * length / 12.0 + 0.5 * m * r * r + reduced * (d * d + r * r);
    let omega = (spin - reduced * d * v) / inertia;
    close(after[0][4], omega, 1e-12);
    close(after[1][4], omega, 1e-12);
    close(share * after[1][3] + (1.0 - share) * after[0][3], -share * v, 1e-12);
    close(share * after[1][2] + (1.0 - share) * after[0][2], 0.0, 1e-12);
}

/// A third disk meets what two have become, and all three go on as one.
#[test]
fn what_was_captured_captures() {
    let (r, m) = (0.1, 1.0);
    let mut model = Model::new();
    add(&mut model, disk("a", r, m), [0.0, 0.0], [1.0, 0.0], 0.0);
    add(&mut model, disk("b", r, m), [0.6, 0.03], [0.0, 0.0], 0.0);
    add(&mut model, disk("c", r, m), [0.6, -1.0], [0.0, 1.0], 0.0);
    model.contact(BodyContact::capturing("hits"));
    let run = run(model, 4.0, 1e-13);
    assert_eq!(run.contacts().len(), 2);
    let bodies = [[m, 0.5 * m * r * r]; 3];
    let [before, after] = [0.0, 4.0].map(|time| states(&run, time));
    let (was, is) = (stocks(&before, &bodies), stocks(&after, &bodies));
    (0..3).for_each(|which| close(is[which], was[which], 1e-11));
    after.iter().for_each(|state| close(state[4], after[0][4], 1e-11));
    // What is rigid: the velocities differ by omega times the way from one to the other.
    for other in &after[1..] {
        close(other[2] - after[0][2], -after[0][4] * (other[1] - after[0][1]), 1e-10);
        close(other[3] - after[0][3], after[0][4] * (other[0] - after[0][0]), 1e-10);
    }
}

/// Three that meet a fourth at the same instant, and a floor that answers to what they are then: nothing is left of the motion.
#[test]
fn several_at_one_instant() {
    let (r, m) = (0.1, 1.0);
    let mut model = Model::new();
    add(&mut model, disk("a", r, m), [0.0, 0.0], [0.0, 0.0], 0.0);
    add(&mut model, disk("b", r, m), [1.0, 0.0], [-1.0, 0.0], 0.0);
    add(&mut model, disk("c", r, m), [-1.0, 0.0], [1.0, 0.0], 0.0);
    add(&mut model, disk("d", r, m), [0.0, 1.0], [0.0, -1.0], 0.0);
    model.contact(BodyContact::capturing("hits"));
    model.surface(Surface::floor("floor", -r * M, rigid(0.0)));
    let run = run(model, 2.0, 1e-13);
    states(&run, 2.0).iter().for_each(|state| state[2..].iter().for_each(|rate| close(*rate, 0.0, 1e-12)));
    let made = |event: &&tumble_ode::Occurrence<tumble_mech::Record>| {
        event.record.happened.iter().filter(|one| matches!(one, Happening::Joint { holds: true, .. })).count()
    };
    let events: Vec<_> = run.events().filter(|event| made(event) > 0).collect();
    assert_eq!(events.iter().map(made).sum::<usize>(), 3);
    assert!(events.iter().all(|event| (event.time - 0.8).abs() < 1e-14));
    // Four go down with a quarter of the speed of one, and the floor stops them.
    let floor = events.iter().flat_map(|event| &event.record.impulses);
    let floor: Vec<f64> = floor
        .filter(|one| matches!(one.source, tumble_mech::Source::Pair(0)))
        .map(|one| one.impulse[1])
        .collect();
    assert_eq!(floor.len(), 1);
    close(floor[0], m, 1e-12);
}

/// Those that touch at the start are captured there.
#[test]
fn what_touches_at_the_start_is_captured() {
    let mut model = Model::new();
    add(&mut model, disk("a", 0.1, 1.0), [0.0, 0.0], [0.0, 0.0], 0.0);
    add(&mut model, disk("b", 0.1, 1.0), [0.2, 0.0], [0.0, 1.0], 0.0);
    model.contact(BodyContact::capturing("hits"));
    let run = run(model, 1.0, 1e-13);
    let after = states(&run, 1.0);
    // Moment of momentum m v R about the common centre, I = 3 m R^2.
    close(after[0][4], 1.0 / 0.3, 1e-12);
    close(after[0][3] + after[1][3], 1.0, 1e-12);
}

#[test]
fn what_cannot_be_captured_is_refused() {
    let mistake = |contact: BodyContact| {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(9.81 * M / (S * S));
        add(&mut model, disk("a", 0.1, 1.0), [0.0, 0.0], [0.0, 0.0], 0.0);
        add(&mut model, disk("b", 0.1, 1.0), [1.0, 0.0], [0.0, 1.0], 0.0);
        model.surface(Surface::floor("floor", -1 * M, rigid(0.0)));
        model.contact(contact);
        Equations::new(model).map(drop).expect_err("a mistake").to_string()
    };
    let all = || BodyContact::capturing("hits");
    let said = mistake(BodyContact { restitution: Some(Expr::from(0.5)), ..all() });
    assert!(said.contains("`hits` captures, and says how bodies rebound"), "{said}");
    let said = mistake(all().with_friction(Friction::new(0.5)));
    assert!(said.contains("`hits` captures, and says how bodies rebound"), "{said}");
    let said = mistake(BodyContact { between: Some(vec!["floor".into(), "a".into()]), ..all() });
    assert!(said.contains("`floor` is a surface"), "{said}");
}
