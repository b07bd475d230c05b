//! Rods, boxes, polygons and disks that meet by edges and corners, against closed forms.

use crate::common::{close, disk, model, motion, place, plate, rigid, rod, run, start};
use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, BodyContact, Change, Friction, Happening, Run, RunBalance, Shape, Start, Surface};

const G: f64 = 9.81;

fn step(name: &str, corners: &[[f64; 2]], e: f64, friction: f64) -> Surface {
    let corners = corners.iter().map(|corner| place(*corner)).collect();
    let step = Surface::polygon(name, corners, rigid(e));
    if friction > 0.0 { step.with_friction(Friction::new(Expr::from(friction))) } else { step }
}

fn slides(happening: &Happening) -> bool {
    matches!(happening, Happening::Contact { change: Change::Slides, .. })
}

fn happened(run: &Run) -> Vec<(String, f64, bool)> {
    let contacts = run.contacts();
    contacts.iter().map(|c| (run.equations.pairs()[c.pair].name.clone(), c.start, c.is_impact)).collect()
}

/// Bodies without weight of which two meet once.
fn of_one_hit(bodies: Vec<(Body, Start)>, restitution: f64, until: f64) -> Run {
    let mut model = model(0.0, bodies);
    model.contact(BodyContact::of_all("hit", Expr::from(restitution)));
    let run = run(model, until, 1e-12);
    let hits = happened(&run);
    assert_eq!(hits.len(), 1, "{hits:?}");
    run
}

/// A ball flies against the side of a free box, above its centre: 1/m_eff = 1/m + 1/M + h^2/I.
#[test]
fn a_ball_against_the_face_of_a_box() {
    let (e, h, m, mass) = (0.6, 0.15, 0.5, 2.0);
    let bodies = vec![
        (disk("ball", 0.1, m), start([-1.0, h], 0.0, [2.0, 0.0], 0.0)),
        (plate("box", [0.4, 0.6], mass), start([0.0; 2], 0.0, [0.0; 2], 0.0)),
    ];
    let run = of_one_hit(bodies, e, 1.0);
    close(happened(&run)[0].1, 0.35, 1e-14);
    let inertia = mass * (0.16 + 0.36) / 12.0;
    let push = (1.0 + e) * 2.0 / (1.0 / m + 1.0 / mass + h * h / inertia);
    let [ball, plate] = [0, 1].map(|body| motion(&run, body, 0.9));
    close(ball[3], 2.0 - push / m, 1e-13);
    close(ball[4], 0.0, 1e-15);
    close(plate[3], push / mass, 1e-13);
    close(plate[5], -h * push / inertia, 1e-13);
}

/// The corner of a free box, turned by 45 degrees, strikes the side of another off its centre: the impulse is across the side, and each is
/// turned by its lever, `1/m_eff = 1/m + a^2/I + 1/M + h^2/J`.
#[test]
fn a_corner_against_a_face() {
    let (e, h, m, mass) = (0.3, 0.12, 0.5, 2.0);
    let tilt = std::f64::consts::FRAC_PI_4 + 0.2;
    // From the centre of the small box to its right-most corner.
    let reach = 0.1 * 2.0_f64.sqrt();
    let arm = [reach * 0.2_f64.cos(), reach * 0.2_f64.sin()];
    let place = [-0.2 - 0.5 - arm[0], h - arm[1]];
    let bodies = vec![
        (plate("small", [0.2, 0.2], m), start(place, tilt, [2.0, 0.0], 0.0)),
        (plate("large", [0.4, 0.6], mass), start([0.0; 2], 0.0, [0.0; 2], 0.0)),
    ];
    let run = of_one_hit(bodies, e, 0.3);
    close(happened(&run)[0].1, 0.25, 1e-13);
    let [own, other] = [m * 0.08 / 12.0, mass * 0.52 / 12.0];
    let push = (1.0 + e) * 2.0 / (1.0 / m + arm[1] * arm[1] / own + 1.0 / mass + h * h / other);
    let [small, large] = [0, 1].map(|body| motion(&run, body, 0.28));
    close(small[3], 2.0 - push / m, 1e-13);
    close(small[5], arm[1] * push / own, 1e-12);
    close(large[3], push / mass, 1e-13);
    close(large[5], -h * push / other, 1e-13);
}

/// Which way a corner on a corner pushes is not determined; a little beside it one edge's normal counts, or the other's.
#[test]
fn a_corner_on_a_corner_is_refused() {
    let falls = |offset: f64| {
        let tilt = std::f64::consts::FRAC_PI_4;
        let bodies = vec![(plate("box", [0.2, 0.2], 1.0), start([offset, 0.5], tilt, [0.0; 2], 0.0))];
        let mut model = model(G, bodies);
        model.surface(step("step", &[[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]], 0.5, 0.0));
        let accuracy = tumble_ode::Accuracy::new(1e-10).expect("an accuracy");
        model.simulate_to(&[], 0.4 * S, accuracy).map_err(|error| error.to_string())
    };
    let refused = falls(0.0).map(|_| ()).expect_err("a corner on a corner");
    assert!(refused.contains("a corner on a corner"), "{refused}");
    // On the top it is thrown up and not along it; on the slanting side it is thrown to the right.
    let [top, side] = [-1e-6, 1e-6].map(|offset| motion(&falls(offset).expect("a motion"), 0, 0.35));
    close(top[3], 0.0, 1e-15);
    assert!(side[3] > 0.1, "{}", side[3]);
}

/// A ball flies against the corner of a free box: the impulse goes through the ball's centre.
#[test]
fn a_ball_against_the_corner_of_a_box() {
    let (e, m, mass, r) = (1.0, 0.5, 2.0, 0.1);
    // The ball's centre is 6 cm above the box's top, 8 cm left of its corner when they touch.
    let bodies = vec![
        (disk("ball", r, m), start([-1.0, 0.36], 0.0, [2.0, 0.0], 0.0)),
        (plate("box", [0.4, 0.6], mass), start([0.0; 2], 0.0, [0.0; 2], 0.0)),
    ];
    let run = of_one_hit(bodies, e, 1.0);
    close(happened(&run)[0].1, (1.0 - 0.28) / 2.0, 1e-14);
    let n = [-0.8, 0.6];
    let inertia = mass * (0.16 + 0.36) / 12.0;
    // From the box's centre to its upper left corner.
    let arm = [-0.2, 0.3];
    let lever = arm[0] * n[1] - arm[1] * n[0];
    let push = (1.0 + e) * 2.0 * 0.8 / (1.0 / m + 1.0 / mass + lever * lever / inertia);
    let [ball, plate] = [0, 1].map(|body| motion(&run, body, 0.9));
    close(ball[3], 2.0 + push * n[0] / m, 1e-13);
    close(ball[4], push * n[1] / m, 1e-13);
    close(plate[3], -push * n[0] / mass, 1e-13);
    close(plate[5], -lever * push / inertia, 1e-13);
    close(ball[5], 0.0, 1e-15);
}

/// Two boxes stand on a floor, one on the other, and do not move.
#[test]
fn a_stack_stays() {
    for (width, offset) in [(0.4, 0.0), (0.3, 0.02), (0.4, 0.1), (0.6, 0.0)] {
        let bodies = vec![
            (plate("lower", [0.4, 0.2], 1.0), start([0.0, 0.1], 0.0, [0.0; 2], 0.0)),
            (plate("upper", [width, 0.2], 1.0), start([offset, 0.3], 0.0, [0.0; 2], 0.0)),
        ];
        let mut model = model(G, bodies);
        let friction = || Friction::new(Expr::from(0.5));
        model.contact(BodyContact::of_all("hit", Expr::from(0.5)).with_friction(friction()));
        model.surface(Surface::floor("floor", 0 * M, rigid(0.5)).with_friction(friction()));
        let run = run(model, 2.0, 1e-12);
        for body in 0..2 {
            let moved = motion(&run, body, 1.9);
            assert_eq!([moved[3], moved[4], moved[5]], [0.0; 3], "{width} {offset} {body}");
        }
    }
}

/// A thin rod rocks on a drum without slipping. At the angle a the contact is R a off its middle, so the middle is at
/// `R (cos a, ..)`; energy: `(L^2/12 + R^2 a^2) a'^2/2 + g R (cos a + a sin a)` is kept.
#[test]
fn a_rod_rocks_on_a_drum() {
    let (length, radius, first) = (1.0, 0.2, 0.3);
    let at_angle = |a: f64| [radius * (-a.sin() + a * a.cos()), radius * (a.cos() + a * a.sin())];
    let bodies = vec![(rod("rod", length, 0.0, 1.0), start(at_angle(first), first, [0.0; 2], 0.0))];
    let mut model = model(G, bodies);
    let drum = Surface::circle("drum", [0 * M, 0 * M], radius * M, rigid(0.0));
    model.surface(drum.with_friction(Friction::new(Expr::from(5))));
    let run = run(model, 3.0, 1e-12);
    let inertia = length * length / 12.0;
    let height = |a: f64| G * radius * (a.cos() + a * a.sin());
    for time in [0.1, 0.5, 1.0, 2.0, 2.9] {
        let [x, y, a, _, _, omega] = motion(&run, 0, time);
        let expected = at_angle(a);
        close(x, expected[0], 1e-11);
        close(y, expected[1], 1e-11);
        let energy = 0.5 * (inertia + radius * radius * a * a) * omega * omega + height(a);
        close(energy, height(first), 1e-11);
    }
}

/// Small swings of it: omega^2 = g R/(L^2/12).
#[test]
fn small_swings_of_a_rod_on_a_drum() {
    let (length, radius, first): (f64, f64, f64) = (1.0, 0.2, 1e-4);
    let place = [radius * (-first.sin() + first * first.cos()), radius * (first.cos() + first * first.sin())];
    let bodies = vec![(rod("rod", length, 0.0, 1.0), start(place, first, [0.0; 2], 0.0))];
    let mut model = model(G, bodies);
    let drum = Surface::circle("drum", [0 * M, 0 * M], radius * M, rigid(0.0));
    model.surface(drum.with_friction(Friction::new(Expr::one())));
    let run = run(model, 3.0, 1e-12);
    let rate = (12.0 * G * radius).sqrt() / length;
    for time in [0.5, 1.0, 2.5] {
        assert!((motion(&run, 0, time)[2] / first - (rate * time).cos()).abs() < 1e-7);
    }
}

/// A box slides over the joint of two boards: on boards of one friction it is slowed down by `mu g`; with different friction what each of
/// them bears would matter, and is not determined.
#[test]
fn a_box_slides_across_two_boards() {
    let boards = |frictions: [f64; 2]| {
        let bodies = vec![(plate("box", [0.4, 0.2], 1.0), start([0.0, 0.1], 0.0, [1.0, 0.0], 0.0))];
        let mut model = model(G, bodies);
        model.surface(step("left", &[[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]], 0.0, frictions[0]));
        model.surface(step("right", &[[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0]], 0.0, frictions[1]));
        model
    };
    let run = run(boards([0.2, 0.2]), 0.3, 1e-12);
    close(motion(&run, 0, 0.25)[3], 1.0 - 0.2 * G * 0.25, 1e-13);
    let accuracy = tumble_ode::Accuracy::new(1e-9).expect("an accuracy");
    let refused =
        boards([0.1, 0.3]).simulate_to(&[], 0.3 * S, accuracy).map(|_| ()).expect_err("not determined");
    assert!(refused.to_string().contains("slide with different friction"), "{refused}");
}

/// A disk rolls to the edge of a step, then about its corner: it goes on at r from it, and while it does not slip
/// `3/4 r^2 w^2 + g r cos(phi)` is kept.
#[test]
fn a_disk_rolls_over_the_corner_of_a_step() {
    let (r, v) = (0.1, 0.3);
    let bodies = vec![(disk("disk", r, 1.0), start([-0.3, r], 0.0, [v, 0.0], -v / r))];
    let mut model = model(G, bodies);
    model.surface(step("step", &[[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]], 0.0, 2.0));
    let run = run(model, 1.3, 1e-12);
    let told = happened(&run);
    assert_eq!(told.len(), 2, "{told:?}");
    close(told[1].1, 1.0, 1e-10);
    for time in [1.05, 1.1, 1.15, 1.19] {
        let [x, y, _, _, _, omega] = motion(&run, 0, time);
        close(x.hypot(y), r, 1e-13);
        let phi = x.atan2(y);
        let kept = |omega: f64, phi: f64| 0.75 * r * r * omega * omega + G * r * phi.cos();
        close(kept(omega, phi), kept(v / r, 0.0), 1e-11);
    }
    // It breaks away where sin(phi)/3 is as much as friction can be, 2 (cos(phi) - r w^2/g).
    let slides = run.events().find(|event| event.record.happened.iter().any(slides)).expect("it slips");
    let [x, y, _, _, _, omega] = motion(&run, 0, slides.time);
    close((x / r) / 3.0, 2.0 * (y / r - r * omega * omega / G), 1e-11);
}

/// Faster than sqrt(g r) it flies off at the corner.
#[test]
fn a_fast_disk_flies_off_a_step() {
    let (r, v) = (0.1, 1.2);
    let bodies = vec![(disk("disk", r, 1.0), start([-0.3, r], 0.0, [v, 0.0], -v / r))];
    let mut model = model(G, bodies);
    model.surface(step("step", &[[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]], 0.0, 2.0));
    let run = run(model, 0.5, 1e-12);
    let [x, y, _, vx, _, omega] = motion(&run, 0, 0.45);
    close(x, -0.3 + v * 0.45, 1e-12);
    close(y, r - 0.5 * G * 0.2 * 0.2, 1e-10);
    close(vx, v, 1e-13);
    close(omega, -v / r, 1e-13);
}

/// A block slides off a step without friction: until its middle is over the corner it goes on, then it tips.
#[test]
fn a_block_slides_off_a_step() {
    let (v, half) = (0.5, 0.1);
    let bodies = vec![(plate("block", [2.0 * half, 0.1], 1.0), start([-0.25, 0.05], 0.0, [v, 0.0], 0.0))];
    let mut model = model(G, bodies);
    model.surface(step("step", &[[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]], 0.0, 0.0));
    let run = run(model, 0.8, 1e-12);
    let [x, y, angle, vx, ..] = motion(&run, 0, 0.4999);
    close(x, -0.25 + v * 0.4999, 1e-13);
    close(y, 0.05, 1e-15);
    close(angle, 0.0, 1e-15);
    close(vx, v, 1e-15);
    let [_, y, angle, ..] = motion(&run, 0, 0.6);
    assert!(angle < 0.0 && y < 0.05, "{angle} {y}");
    let balance = RunBalance::of(&run, [0.0; 2]).expect("finite");
    assert!(balance.relative() < 1e-11, "{:e}", balance.relative());
}

/// A triangle flies into the inner corner between a floor and a step, upright or leaning: what it meets there is the floor and the side of the
/// step, as if that were a wall.
#[test]
fn the_inner_corner_of_a_step_is_that_of_a_wall() {
    let corner = |angle: f64| place([0.2 * angle.cos(), 0.2 * angle.sin()]);
    let corners: Vec<_> =
        (0..3).map(|index| corner(std::f64::consts::TAU * f64::from(index) / 3.0)).collect();
    let end = |wall: Surface, angle: f64, velocity: [f64; 2], omega: f64, friction: f64| {
        let triangle = Shape::Polygon { corners: corners.clone() };
        let triangle = Body::of_shape("triangle", triangle).mass(1.0 * KG);
        let mut model = model(G, vec![(triangle, start([-0.4, 0.3], angle, velocity, omega))]);
        let floor = Surface::new("floor", [0 * M, 0 * M], [0, 1].map(Expr::from), rigid(0.0));
        for surface in [floor, wall] {
            model.surface(surface.with_friction(Friction::new(Expr::from(friction))));
        }
        let run = run(model, 0.6, 1e-12);
        let met = |name: &str| happened(&run).iter().filter(|(pair, ..)| pair.starts_with(name)).count();
        assert!(met("floor") > 1 && met("wall") > 0, "{:?}", happened(&run));
        motion(&run, 0, 0.6)
    };
    // Beside the corner of the step the first switched without end, and the second was refused as a corner on a corner.
    let cases = [(0.0, 1.25, [2.73, -0.81], 1.7, 0.47), (0.2, 1.37, [2.85, -0.45], -3.5, 0.25)];
    for (lean, angle, velocity, omega, friction) in cases {
        let plane = Surface::new("wall", [0 * M, 0 * M], [Expr::from(-0.5), Expr::from(lean)], rigid(0.0));
        let corners = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.5], [lean, 0.5]];
        let [plane, step] =
            [plane, step("wall", &corners, 0.0, 0.0)].map(|wall| end(wall, angle, velocity, omega, friction));
        plane.iter().zip(step).for_each(|(known, found)| close(found, *known, 1e-11));
    }
}
