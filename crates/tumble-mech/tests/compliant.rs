//! Compliant surfaces: contact times and what comes back, in closed form.

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Exponent, Expr, Vector};
use tumble_mech::{Body, ContactLaw, Gravity, Model, Release, Run, Shape, Start, Surface};

const MASS: f64 = 0.5;
const SPEED: f64 = 2.0;

/// A ball of 0.1 m and 0.5 kg a little above the floor, coming down; it touches with 2 m/s.
fn falling(law: ContactLaw, gravity: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(gravity * M / (S * S));
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(MASS * KG));
    let above = 0.05;
    let speed = (SPEED * SPEED - 2.0 * gravity * above).sqrt();
    let start = Start::default().at([0 * M, (0.1 + above) * M]).velocity([0 * M / S, -speed * M / S]);
    model.starts.push((ball.name, start));
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

/// Contact time and speed afterwards.
fn contact(model: Model) -> (f64, f64, Run) {
    let run = run(model, 0.4, 1e-13);
    let contacts = run.contacts();
    let first = &contacts[0];
    let ball = run.equations.model().bodies[0].kinematics();
    let [speed] = at(&run, first.end, [ball.velocity().y().clone()]);
    (first.end - first.start, speed, run.clone())
}

fn spring(stiffness: f64, damping: f64, release: Release) -> ContactLaw {
    ContactLaw::Spring { stiffness: stiffness * N / M, damping: damping * N * S / M, release }
}

#[test]
fn a_spring_with_gravity() {
    for stiffness in [1e3, 1e5, 1e7] {
        let (time, speed, _) = contact(falling(spring(stiffness, 0.0, Release::AtZeroForce), 9.81));
        let w = (stiffness / MASS).sqrt();
        close(time * w, 2.0 * (std::f64::consts::PI - (SPEED * w / 9.81).atan()), 1e-11);
        close(speed, SPEED, 1e-12);
    }
}

#[test]
fn a_damped_spring_lets_go_at_the_surface_or_at_zero_force() {
    let (stiffness, damping) = (1e4, 30.0);
    let half = damping / (2.0 * MASS);
    let w = (stiffness / MASS - half * half).sqrt();
    let (time, speed, _) = contact(falling(spring(stiffness, damping, Release::AtSurface), 0.0));
    close(time, std::f64::consts::PI / w, 1e-13);
    close(speed, SPEED * (-half * time).exp(), 1e-12);
    let (time, speed, run) = contact(falling(spring(stiffness, damping, Release::AtZeroForce), 0.0));
    // k d + c d' = 0 along d = (v / w) exp(-h t) sin(w t)
    let expected = (damping * w).atan2(half * damping - stiffness) / w;
    close(time, expected, 1e-13);
    let d_rate = |t: f64| SPEED * (-half * t).exp() * ((w * t).cos() - half / w * (w * t).sin());
    close(speed, -d_rate(time), 1e-12);
    // Let go inside, it leaves with that speed and is seen no more.
    assert_eq!(run.contacts().len(), 1);
    assert!(run.trajectory().modes.len() == 3, "{:?}", run.trajectory().modes);
}

fn hertz(stiffness: f64, damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: stiffness * N / root, damping: damping * S / M }
}

/// `T = (4/5) B(2/5, 1/2) d / v` with the largest depth `d = (5 m v^2 / (4 k))^(2/5)`.
#[test]
fn hertz_s_contact_time() {
    for stiffness in [1e4, 1e6, 1e9] {
        let (time, speed, run) = contact(falling(hertz(stiffness, 0.0), 0.0));
        let depth = (5.0 * MASS * SPEED * SPEED / (4.0 * stiffness)).powf(0.4);
        let expected = 2.943_275_184_324_704_7 * depth / SPEED;
        assert!((time / expected - 1.0).abs() < 1e-12, "{time} is not {expected}");
        close(speed, SPEED, 1e-13);
        println!("{:?}", run.trajectory().work);
    }
}

/// Put down on the floor, a ball of mass m sinks in by `D = (5 m g/(2 k))^(2/3)` and is back after `(2/3) B(1/3, 1/2) sqrt(2 D/g)`.
#[test]
fn put_down_on_hertz_s_floor() {
    let gravity = 9.81;
    for stiffness in [1e4, 1e6, 1e9] {
        let mut model = falling(hertz(stiffness, 0.0), gravity);
        model.starts[0].1 = Start::default().at([0 * M, 0.1 * M]);
        let depth = (2.5 * MASS * gravity / stiffness).powf(2.0 / 3.0);
        let period = 2.804_364_210_650_908_3 * (2.0 * depth / gravity).sqrt();
        let run = run(model, 1.1 * period, 1e-13);
        let ball = run.equations.model().bodies[0].kinematics();
        let [y, speed] = at(&run, 0.5 * period, [ball.position().y().clone(), ball.velocity().y().clone()]);
        close((0.1 - y) / depth, 1.0, 1e-11);
        close(speed * period / depth, 0.0, 1e-9);
        let [back] = at(&run, period, [ball.position().y().clone()]);
        close((0.1 - back) / depth, 0.0, 1e-11);
        assert_eq!(run.contacts()[0].start, 0.0);
    }
}

/// Points without extent, one at the origin and one beside it, whose gaps are made of no lengths but their own: each swings as a ball does.
#[test]
fn points_put_down_at_the_origin() {
    let (gravity, stiffness) = (9.81, 1e6);
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(gravity * M / (S * S));
    for (name, x) in [("a", 0.0), ("b", 1.0)] {
        model.add(Body::of_shape(name, Shape::Point { at: Vector::planar(0 * M, 0 * M) }).mass(MASS * KG));
        model.starts.push((name.to_owned(), Start::default().at([x * M, 0 * M])));
    }
    model.surface(Surface::floor("floor", 0 * M, hertz(stiffness, 0.0)));
    let depth = (2.5 * MASS * gravity / stiffness).powf(2.0 / 3.0);
    let period = 2.804_364_210_650_908_3 * (2.0 * depth / gravity).sqrt();
    let run = run(model, 3.6 * period, 1e-13);
    for body in 0..2 {
        let y = run.equations.model().bodies[body].kinematics().position().y().clone();
        for turns in [0.5, 1.5, 2.5] {
            close(-at(&run, turns * period, [y.clone()])[0] / depth, 1.0, 1e-10);
        }
        close(-at(&run, 3.0 * period, [y])[0] / depth, 0.0, 1e-10);
    }
}

/// A rod of mass M that comes down flat with the speed v strikes with both ends at once: `(1/2) M v^2 = 2 (2/5) k D^(5/2)`, and it is in for
/// `(4/5) B(2/5, 1/2) D/v`. It does not begin to turn.
#[test]
fn flat_on_hertz_s_floor() {
    let stiffness = 1e6;
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(MASS * KG));
    model
        .starts
        .push((rod.name, Start::default().at([0 * M, 0.1 * M]).velocity([0 * M / S, -SPEED * M / S])));
    model.surface(Surface::floor("floor", 0 * M, hertz(stiffness, 0.0)));
    let run = run(model, 0.2, 1e-13);
    let depth = (5.0 * MASS * SPEED * SPEED / (8.0 * stiffness)).powf(0.4);
    let contacts = run.contacts();
    assert_eq!(contacts.len(), 2);
    for contact in &contacts {
        let lasts = 2.943_275_184_324_704_7 * depth / SPEED;
        assert!(((contact.end - contact.start) / lasts - 1.0).abs() < 1e-11, "{contact:?}");
    }
    let rod = run.equations.model().bodies[0].kinematics();
    let after = [rod.velocity().y().clone(), rod.angle(), rod.omega()];
    let [speed, angle, omega] = at(&run, 0.2, after);
    close(speed, SPEED, 1e-12);
    close(angle, 0.0, 1e-12);
    close(omega, 0.0, 1e-10);
}

/// Nearly flat, it turns in proportion to how aslant it was, however little that is: that both ends begin at one instant is not taken for equal
/// depths.
#[test]
fn nearly_flat_on_hertz_s_floor() {
    let turned = |aslant: f64| {
        let mut model = Model::new();
        let rod = model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(MASS * KG));
        let start = Start::default().at([0 * M, 0.1 * M]).velocity([0 * M / S, -SPEED * M / S]);
        model.starts.push((rod.name, start.angle(Expr::from(aslant))));
        model.surface(Surface::floor("floor", 0 * M, hertz(1e6, 0.0)));
        let run = run(model, 0.2, 1e-13);
        let rod = run.equations.model().bodies[0].kinematics();
        at(&run, 0.2, [rod.angle()])[0] / aslant
    };
    let much = turned(1e-7);
    assert!(much.abs() > 10.0, "{much}");
    for (aslant, off) in [(1e-9, 1e-5), (1e-11, 1e-3), (1e-13, 0.1)] {
        let little = turned(aslant);
        assert!((little / much - 1.0).abs() < off, "{little} is not {much}");
    }
}

/// Energy returns after any number of bounces on Hertz's floor, and is lost with damping.
#[test]
fn hertz_with_gravity_keeps_the_energy() {
    let energy_after = |damping: f64| {
        let run = run(falling(hertz(1e6, damping), 9.81), 5.0, 1e-12);
        assert!(run.contacts().len() > 5);
        let body = &run.equations.model().bodies[0];
        let energy = body.kinetic_energy() + body.potential_energy(&run.equations.model().gravity);
        let contacts = run.contacts();
        let flying = contacts.windows(2).map(|pair| 0.5 * (pair[0].end + pair[1].start));
        flying.map(|t| at(&run, t, [energy.clone()])[0]).collect::<Vec<f64>>()
    };
    let kept = energy_after(0.0);
    for energy in &kept {
        close(*energy, MASS * SPEED * SPEED / 2.0 + MASS * 9.81 * 0.1, 1e-11);
    }
    let lost = energy_after(0.1);
    assert!(lost.windows(2).all(|pair| pair[1] < pair[0]), "{lost:?}");
}

/// A thousand seconds of a rod on a spring floor.
#[test]
fn a_rod_on_a_spring_keeps_its_energy() {
    let mut model = falling(spring(1e4, 0.0, Release::AtZeroForce), 9.81);
    model.bodies[0] = Body::rod("ball", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(MASS * KG);
    model.starts[0].1 = Start::default().at([0 * M, 2 * M]).angle(Expr::from(0.6)).omega(2 / S);
    let run = run(model, 1000.0, 1e-13);
    let body = run.equations.model().bodies[0].clone();
    let energy = body.kinetic_energy() + body.potential_energy(&run.equations.model().gravity);
    let end = run.contacts().iter().rev().map(|contact| contact.end).find(|end| *end < 999.0).expect("many");
    let [before, after] = [0.0, end + 1e-6].map(|t| at(&run, t, [energy.clone()])[0]);
    println!("{} contacts, drift {:e}", run.contacts().len(), (after - before) / before);
    assert!(((after - before) / before).abs() < 1e-11);
}
