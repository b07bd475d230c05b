//! Bodies that stay on rigid surfaces: sliding rods, ladders, boxes, lift-off, pivots, grooves; against closed forms.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::common::{at, close, integral, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, ContactLaw, Gravity, Load, Model, Part, Place, Run, Shape, Start, Surface, time};

const G: f64 = 9.81;

fn rigid(e: f64) -> ContactLaw {
    ContactLaw::Rigid { restitution: Expr::from(e) }
}

/// One body in gravity that starts at rest, its centre of mass there.
fn world(body: Body, [x, y]: [f64; 2], angle: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), Start::default().at([x * M, y * M]).angle(Expr::from(angle))));
    model.add(body);
    model
}

fn floor(height: f64, e: f64) -> Surface {
    Surface::floor("floor", height * M, rigid(e))
}

fn wall(x: f64, towards: f64, e: f64) -> Surface {
    Surface::new("wall", [x * M, 0 * M], [Expr::from(towards), Expr::zero()], rigid(e))
}

/// 1 m, centre at the origin, along x.
fn rod(mass: f64) -> Body {
    Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(mass * KG)
}

fn plate(width: f64, height: f64, mass: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape("box", Shape::Box { centre, width: width * M, height: height * M }).mass(mass * KG)
}

/// Force of a pair along its normal, N.
#[track_caller]
fn force(run: &Run, time: f64, pair: &str) -> f64 {
    let pair = run.equations.pairs().iter().find(|known| known.name == pair).expect("a pair of that name");
    at(run, time, [pair.force_symbol().into()])[0]
}

/// x, y, vx, vy, angle, omega of the first body.
fn state(run: &Run, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    let formulas = [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.angle(), body.omega()];
    at(run, time, formulas)
}

fn energy(run: &Run, time: f64) -> f64 {
    let model = run.equations.model();
    let body = &model.bodies[0];
    at(run, time, [body.kinetic_energy() + body.potential_energy(&model.gravity)])[0]
}

/// Pairs of lasting contacts, each with its start and end.
fn lasting(run: &Run) -> Vec<(String, f64, f64)> {
    let contacts = run.contacts().into_iter().filter(|contact| !contact.is_impact);
    contacts.map(|c| (run.equations.pairs()[c.pair].name.clone(), c.start, c.end)).collect()
}

/// Time in which a rod of 1 m on a smooth floor sinks from rest at `from` to `to`, by its energy
/// `w^2 = 12 g (sin from - sin a) / (3 cos^2 a + 1)`; with `a = from - u^2` and `u = n sinh v`, where n^2 is twice the
/// cosine at the start, the integrand is smooth even for a start close to upright.
fn sinking(from: f64, to: f64) -> f64 {
    let near = (2.0 * from.cos()).sqrt();
    let slowness = |v: f64| {
        let u = near * v.sinh();
        let (angle, half) = (from - u * u, 0.5 * u * u);
        // sin(from) - sin(angle), over u^2.
        let drop = (from - half).cos() * if half == 0.0 { 1.0 } else { half.sin() / half };
        2.0 * near * v.cosh() * ((3.0 * angle.cos().powi(2) + 1.0) / (12.0 * G * drop)).sqrt()
    };
    integral(slowness, 0.0, ((from - to).sqrt() / near).asinh())
}

#[test]
fn a_rod_sinks_on_a_smooth_floor() {
    for (start, height) in [(1.0_f64, 0.0), (1.3, 1.0 / 3.0), (0.2, -7.7)] {
        let mut model = world(rod(2.0), [0.3, height + 0.5 * start.sin()], start);
        model.starts[0].1 = model.starts[0].1.clone().velocity([1.5 * M / S, 0 * M / S]);
        model.surface(floor(height, 0.0));
        let flat = sinking(start, 0.0);
        let run = run(model, flat + 1.0, 1e-13);
        for part in [0.9, 0.5, 0.1] {
            let angle = start * part;
            let when = sinking(start, angle);
            let [x, y, vx, _, found, omega] = state(&run, when);
            close(found, angle, 2e-14 / height.abs().max(0.1));
            close(y, height + 0.5 * angle.sin(), 1e-14);
            close(vx, 1.5, 0.0);
            close(x, 0.3 + 1.5 * when, 1e-14);
            let squared = 12.0 * G * (start.sin() - angle.sin()) / (3.0 * angle.cos().powi(2) + 1.0);
            close(omega, -squared.sqrt(), 1e-13);
            let expected = 2.0 * (G - 0.5 * angle.sin() * squared) / (1.0 + 3.0 * angle.cos().powi(2));
            close(force(&run, when, "floor.rod.from"), expected, 1e-12);
        }
        let contacts = lasting(&run);
        assert_eq!(contacts[0].0, "floor.rod.from");
        assert_eq!(contacts[0].1, 0.0);
        let hit = run.contacts().iter().find(|c| c.pair == 1).expect("it falls flat").start;
        close(hit, flat, 1e-14);
        let [_, y, vx, vy, angle, omega] = state(&run, flat + 1.0);
        close(y, height, 1e-14);
        for small in [vy, angle, omega] {
            assert!(small.abs() < 1e-14, "{small}");
        }
        close(vx, 1.5, 0.0);
        close(force(&run, flat + 0.5, "floor.rod.from"), G, 1e-12);
        close(force(&run, flat + 0.5, "floor.rod.to"), G, 1e-12);
    }
}

/// The upper end leaves the wall where it has come down by a third; from there on the rod moves along evenly.
#[test]
fn a_ladder_leaves_the_wall() {
    for start in [1.2_f64, 0.7] {
        let mut model = world(rod(3.0), [0.5 * start.cos(), 0.5 * start.sin()], PI - start);
        model.surface(floor(0.0, 0.0));
        model.surface(wall(0.0, 1.0, 0.0));
        let run = run(model, 1.0, 1e-13);
        let contacts = lasting(&run);
        let (_, begins, leaves) = contacts.iter().find(|c| c.0 == "wall.rod.to").expect("it leans").clone();
        assert_eq!(begins, 0.0);
        let slope = |t: f64| PI - state(&run, t)[4];
        close(slope(leaves).sin(), 2.0 / 3.0 * start.sin(), 1e-12);
        for part in [0.0, 0.3, 0.9] {
            let t = part * leaves;
            let (s, c) = slope(t).sin_cos();
            let s0 = start.sin();
            close(force(&run, t, "wall.rod.to"), 3.0 * 0.75 * G * c * (3.0 * s - 2.0 * s0), 1e-11);
            let below = 3.0 * G * (1.0 - 0.75 * c * c - 1.5 * s * (s0 - s));
            close(force(&run, t, "floor.rod.from"), below, 1e-11);
        }
        let [.., vx, _, _, _] = state(&run, leaves);
        close(vx, (G * start.sin()).sqrt() / 3.0 * start.sin(), 1e-12);
        let landed = run.contacts().iter().find(|c| c.start > leaves).expect("it lands").start;
        close(state(&run, landed - 1e-9)[2], vx, 1e-13);
        close(energy(&run, landed - 1e-9), energy(&run, 0.0), 1e-12);
    }
}

/// `a = g sin(slope)`, both corners carry half of the weight across; nothing creeps into or off the slope.
#[test]
fn a_box_slides_down_a_slope() {
    let slope = 0.3_f64;
    let (sin, cos) = slope.sin_cos();
    let mut model = world(plate(0.4, 0.2, 2.0), [0.1 * sin, 1.0 / 3.0 + 0.1 * cos], -slope);
    model.surface(Surface::sloping("slope", [0 * M, 1.0 / 3.0 * M], &Expr::from(-slope), rigid(0.0)));
    let run = run(model, 100.0, 1e-13);
    let across = |t: f64| {
        let [x, y, vx, vy, angle, omega] = state(&run, t);
        [sin * x + cos * (y - 1.0 / 3.0) - 0.1, sin * vx + cos * vy, angle + slope, omega]
    };
    for t in [0.0, 0.1, 1.0, 10.0, 50.0, 100.0] {
        let far = 0.5 * G * sin * t * t;
        for (creep, scale) in across(t).into_iter().zip([far, G * sin * t, 1.0, 1.0]) {
            assert!(creep.abs() <= 1e-14 * scale.max(1.0), "{creep:e} at {t} s");
        }
        let [x, y, ..] = state(&run, t);
        close(cos * (x - 0.1 * sin) - sin * (y - 1.0 / 3.0 - 0.1 * cos), far, 1e-14);
        for corner in ["slope.box.corner1", "slope.box.corner2"] {
            close(force(&run, t, corner), G * cos, 1e-13);
        }
    }
    assert_eq!(lasting(&run).len(), 2);
    println!("{:?}", run.trajectory().work);
}

#[test]
fn a_box_at_rest_stays() {
    for height in [0.0, 1.0 / 3.0, -1e3] {
        let mut model = world(plate(0.4, 0.2, 2.0), [0.0, height + 0.1], 0.0);
        model.surface(floor(height, 0.5));
        let run = run(model, 1000.0, 1e-13);
        let [x, y, vx, vy, angle, omega] = state(&run, 1000.0);
        assert!([x, vx, vy, angle, omega].iter().all(|v| *v == 0.0), "{:?}", state(&run, 1000.0));
        close(y, height + 0.1, 2e-16);
        assert_eq!(lasting(&run).len(), 2);
        assert!(run.trajectory().events.len() <= 2, "{:?}", run.trajectory().events);
    }
}

/// Floor and wall meet; the box is pushed into the corner, or not, or drawn out of it.
#[test]
fn a_box_in_a_corner() {
    for push in [0.0, -5.0, 5.0] {
        let mut model = world(plate(0.4, 0.2, 2.0), [0.2, 0.1], 0.0);
        model.surface(floor(0.0, 0.0));
        model.surface(wall(0.0, 1.0, 0.0));
        let centre = model.bodies[0].cm();
        model.force("push", &centre, Vector::planar(push * N, 0 * N));
        let run = run(model, 10.0, 1e-12);
        let [x, y, vx, vy, angle, omega] = state(&run, 10.0);
        let a = push.max(0.0) / 2.0;
        close(x, 0.2 + 50.0 * a, 1e-14);
        close(vx, 10.0 * a, 1e-14);
        close(y, 0.1, 1e-14);
        assert!([vy, angle, omega].iter().all(|v| v.abs() < 1e-14), "{vy} {angle} {omega}");
        let total = |surface: &str| {
            let pairs = run.equations.pairs().iter().filter(|pair| pair.name.starts_with(surface));
            pairs.map(|pair| force(&run, 5.0, &pair.name)).sum::<f64>()
        };
        close(total("floor"), 2.0 * G, 1e-13);
        close(total("wall"), (-push).max(0.0), 1e-13);
        let pairs = run.equations.pairs();
        let torque: f64 = pairs
            .iter()
            .map(|pair| {
                let [x, y] = at(&run, 5.0, [pair.arm().x().clone(), pair.arm().y().clone()]);
                let f = force(&run, 5.0, &pair.name);
                if pair.name.starts_with("floor") { x * f } else { -y * f }
            })
            .sum();
        assert!(torque.abs() < 1e-13, "{torque}");
    }
}

/// A body on three feet in a line: the forces are undetermined, the idle foot is named, and the body slides on.
#[test]
fn three_feet_in_a_line() {
    let foot = |x: f64| Part {
        shape: Shape::Disk { centre: Vector::planar(x * M, 0 * M), radius: 0.1 * M },
        mass: 1 * KG,
    };
    let mut model =
        world(Body::from_parts("body", [-1.0, 0.0, 2.0].map(foot).to_vec()), [1.0 / 3.0, 0.1], 0.0);
    model.starts[0].1 = model.starts[0].1.clone().velocity([1 * M / S, 0 * M / S]);
    model.surface(floor(0.0, 0.0));
    let run = run(model, 100.0, 1e-12);
    let mode = &run.trajectory().modes[run.trajectory().pieces[0].mode];
    let idle: Vec<_> = mode
        .contacts
        .iter()
        .filter(|(_, contact_mode)| *contact_mode == tumble_mech::ContactMode::Idle)
        .collect();
    assert_eq!((mode.contacts.len(), idle.len()), (3, 1));
    let feet = ["floor.body.part1.rim", "floor.body.part2.rim", "floor.body.part3.rim"];
    let forces = feet.map(|foot| force(&run, 50.0, foot));
    close(forces.iter().sum(), 3.0 * G, 1e-13);
    close(-forces[0] + 2.0 * forces[2], G, 1e-13);
    assert!(forces.iter().all(|force| *force >= 0.0), "{forces:?}");
    let [x, y, vx, vy, angle, omega] = state(&run, 100.0);
    close(x, 100.0 + 1.0 / 3.0, 1e-14);
    close(y, 0.1, 1e-14);
    assert!([vx - 1.0, vy, angle, omega].iter().all(|v| v.abs() < 1e-14), "{vx} {vy} {angle} {omega}");
}

/// More than the weight lifts at once, less does not; a force that grows lifts when it is the weight.
#[test]
fn lift_off() {
    let lifted = |force: Expr, window: Option<[f64; 2]>| {
        let mut model = world(plate(0.4, 0.2, 2.0), [0.0, 0.1], 0.0);
        model.surface(floor(0.0, 0.0));
        let place = Place::Material(model.bodies[0].cm());
        let load = Load::force("pull", "box", place, Vector::planar(0 * N, force));
        model.loads.push(match window {
            None => load,
            Some([from, to]) => load.during(from * S, to * S),
        });
        run(model, 3.0, 1e-12)
    };
    for (part, leaves) in [(0.999_999, false), (1.0, false), (1.000_001, true), (1.5, true)] {
        let run = lifted(part * 2.0 * G * N, Some([1.0, 1.5]));
        let contacts = lasting(&run);
        let mut ends = contacts.iter().filter(|contact| contact.1 == 0.0).map(|contact| contact.2);
        assert!(ends.all(|end| end == if leaves { 1.0 } else { 3.0 }), "{part}: {contacts:?}");
        if leaves {
            let a = (part - 1.0) * G;
            let (top, up) = (0.125 * a, 0.5 * a);
            close(state(&run, 1.5)[1], 0.1 + top, 1e-14);
            let lands = 1.5 + (up + (up * up + 2.0 * G * top).sqrt()) / G;
            close(contacts.last().expect("it comes down again").1, lands, 1e-13);
        }
    }
    let run = lifted(time() * 7.0 * N / S, None);
    let leaves = 2.0 * G / 7.0;
    for contact in lasting(&run) {
        close(contact.2, leaves, 1e-14);
    }
    // m y'' = k t - m g
    let after: f64 = 3.0 - leaves;
    close(state(&run, 3.0)[1], 0.1 + 7.0 / 2.0 * after.powi(3) / 6.0, 1e-13);
}

/// From level it falls about its pivot until its free end is on the floor, half a length below.
#[test]
fn a_hinged_rod_falls_on_the_floor() {
    for e in [0.0, 0.5] {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(G * M / (S * S));
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(2 * KG));
        model.pivot_at("hinge", &rod, [0 * M, 0 * M], [0 * M, 0.5 * M]);
        model.surface(floor(0.0, e));
        let run = run(model, 5.0, 1e-13);
        let hit = run.contacts()[0].start;
        // (I/2) w^2 = m g (L/4), I = m L^2 / 3
        let before = -(1.5 * G).sqrt();
        let event = run.trajectory().events.iter().position(|event| event.time == hit).expect("an event");
        let [angle, omega] = run.trajectory().events[event].before[..] else { panic!("two states") };
        close(angle, -PI / 6.0, 1e-14);
        close(omega, before, 1e-13);
        close(run.trajectory().events[event].after[1], -e * before, 1e-13);
        let impulses = &run.trajectory().events[event].record.impulses;
        let expected = (1.0 + e) * (2.0 / 3.0) * -before / angle.cos();
        let [floor, hinge] = &impulses[..] else { panic!("{impulses:?}") };
        let names = [floor, hinge].map(|impulse| run.equations.source_name(impulse.source));
        assert_eq!(names, ["floor.rod.to", "hinge"]);
        close(floor.impulse[0], 0.0, 1e-15);
        close(floor.impulse[1], expected, 1e-13);
        // Together they are the change of momentum, and of angular momentum about the centre.
        let change = -(1.0 + e) * before * 2.0 * 0.5;
        close(hinge.impulse[0], -change * angle.sin(), 1e-13);
        close(hinge.impulse[1], change * angle.cos() - expected, 1e-13);
        let about = |i: &tumble_mech::Impulse| i.arm[0] * i.impulse[1] - i.arm[1] * i.impulse[0];
        close(about(floor) + about(hinge), -(1.0 + e) * before * 2.0 / 12.0, 1e-13);
        let [.., angle, omega] = state(&run, 5.0);
        close(angle, -PI / 6.0, 1e-14);
        assert!(omega.abs() < 1e-15);
        close(force(&run, 5.0, "floor.rod.to"), G, 1e-13);
    }
}

/// An elevator presses with `m (g + a)`; as it starts and stops smoothly the body stays on it.
#[test]
fn on_an_elevator() {
    let mut model = world(plate(0.4, 0.2, 2.0), [0.0, 0.1], 0.0);
    let path = 3.0 * M * (1 - (time() * (1.5 / S)).cos());
    model.surface(Surface::floor("floor", path, rigid(0.3)));
    let run = run(model, 20.0, 1e-13);
    for t in [0.0_f64, 0.7, 3.3, 12.0, 19.0] {
        let (height, a) = (3.0 * (1.0 - (1.5 * t).cos()), 6.75 * (1.5 * t).cos());
        close(state(&run, t)[1], 0.1 + height, 1e-14);
        close(force(&run, t, "floor.box.corner1"), G + a, 1e-11);
        close(force(&run, t, "floor.box.corner2"), G + a, 1e-11);
    }
    assert_eq!(lasting(&run).len(), 2);
}

/// Upright it stands; a little off, it topples in the time that its energy says.
#[test]
fn a_rod_topples_from_upright() {
    let toppled = |start: f64, until: f64| {
        let mut model = world(rod(1.0), [0.0, 0.5 * start.sin()], start);
        model.surface(floor(0.0, 0.0));
        run(model, until, 1e-13)
    };
    for off in [1e-2, 1e-6] {
        let start = FRAC_PI_2 - off;
        let run = toppled(start, 5.0);
        let hit = run.contacts().iter().find(|c| c.pair == 1).expect("it falls").start;
        // The rounding of the start grows with exp(sqrt(6 g) t).
        close(hit, sinking(start, 0.0), 1e-14 / off);
        let [x, y, ..] = state(&run, 5.0);
        assert!(x.abs() < 1e-15 && y.abs() < 1e-15, "{x} {y}");
    }
    let run = toppled(FRAC_PI_2, 0.5);
    close(state(&run, 0.5)[4], FRAC_PI_2, 1e-12);
    close(force(&run, 0.25, "floor.rod.from"), G, 1e-12);
}

/// A disk in a groove: each side carries `m g sin(other) / sin(both)`.
#[test]
fn in_a_groove() {
    for [left, right] in [[FRAC_PI_4, FRAC_PI_4], [0.3, 1.1], [1e-3, 1.5]] {
        let middle = 0.5 * (PI - left - right);
        let far = 0.1 / middle.sin();
        let up = middle + right;
        let disk = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: 0.1 * M };
        let disk = Body::of_shape("disk", disk).mass(2 * KG);
        let mut model = world(disk, [far * up.cos(), far * up.sin()], 0.0);
        let slope =
            |name: &str, angle: f64| Surface::sloping(name, [0 * M, 0 * M], &Expr::from(angle), rigid(0.4));
        model.surface(slope("left", -left));
        model.surface(slope("right", right));
        let run = run(model, 100.0, 1e-13);
        let [x, y, vx, vy, ..] = state(&run, 100.0);
        close(x, far * up.cos(), 1e-14);
        close(y, far * up.sin(), 1e-14);
        assert!(vx.abs() < 1e-15 && vy.abs() < 1e-15);
        let both = (left + right).sin();
        close(force(&run, 50.0, "left.disk.rim"), 2.0 * G * right.sin() / both, 1e-13);
        close(force(&run, 50.0, "right.disk.rim"), 2.0 * G * left.sin() / both, 1e-13);
    }
}

/// One end rests and the other comes down: with any restitution the energy shrinks and the rod comes to lie flat.
#[test]
fn a_resting_rod_is_hit_at_its_other_end() {
    for e in [0.0, 0.3, 0.6] {
        let start = 0.4_f64;
        let mut model = world(rod(1.0), [0.0, 0.5 * start.sin()], start);
        model.surface(floor(0.0, e));
        let run = run(model, 10.0, 1e-12);
        let times: Vec<f64> = run.trajectory().events.iter().map(|event| event.time).collect();
        let energies: Vec<f64> = times.windows(2).map(|t| energy(&run, 0.5 * (t[0] + t[1]))).collect();
        assert!(energies.windows(2).all(|e| e[1] <= e[0] + 1e-13), "{energies:?}");
        let [x, y, vx, vy, angle, omega] = state(&run, 10.0);
        assert!(
            [x, y, vx, vy, angle, omega].iter().all(|v| v.abs() < 1e-14),
            "e = {e}: {:?}",
            state(&run, 10.0)
        );
        close(force(&run, 9.0, "floor.rod.to"), 0.5 * G, 1e-12);
    }
}
