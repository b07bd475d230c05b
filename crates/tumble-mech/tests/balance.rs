//! Energy and momentum balances of runs: work and impulse of every load against closed forms, and residuals that
//! vanish.

use crate::common::{at, close, hinged_rod, run};
use tumble_expr::units::{KG, M, N, RAD, S};
use tumble_expr::{Exponent, Expr, Vector};
use tumble_mech::{
    Anchor, Body, Component, ContactLaw, Contribution, ContributionKind, Drag, DragPlace, Gravity, Load,
    Model, Place, Release, Run, RunBalance, Spring, Start, Surface, Torsion, time,
};
use tumble_ode::Side;

const G: f64 = 9.81;

/// The balance about a point that nothing is at, every part of which must close.
#[track_caller]
fn balanced(run: &Run, tolerance: f64) -> RunBalance {
    let balance = RunBalance::of(run, [0.3, -0.2]).expect("a balance");
    println!("{:#?}", balance.contributions);
    println!("energy {:?} {:e}", balance.energy, balance.energy.relative());
    for body in balance.bodies.iter().chain([&balance.total]) {
        println!("momentum {:?} {:e}", body, body.relative());
    }
    assert!(balance.energy.relative() < tolerance, "{:e}", balance.energy.relative());
    assert!(balance.relative() < tolerance, "{:e}", balance.relative());
    balance
}

#[track_caller]
fn contribution(balance: &RunBalance, load: &str, kind: ContributionKind) -> Contribution {
    let mut known = balance.contributions.iter().filter(|part| part.load == load && part.kind == kind);
    known
        .next()
        .unwrap_or_else(|| panic!("no contribution {load} {kind:?} in {:#?}", balance.contributions))
        .clone()
}

fn has(balance: &RunBalance, load: &str, kind: ContributionKind) -> bool {
    balance.contributions.iter().any(|part| part.load == load && part.kind == kind)
}

fn vertical() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model
}

fn here(x: f64, y: f64) -> Vector {
    Vector::planar(x * M, y * M)
}

#[test]
fn a_pendulum_keeps_its_energy_and_its_hinge_closes_the_momentum() {
    let (mut model, rod) = hinged_rod();
    model.starts.push(("rod".into(), Start::default().angle(2 * RAD)));
    let run = run(model, 20.0, 1e-12);
    let balance = balanced(&run, 2e-12);
    assert_eq!(balance.energy.change, 0.0);
    let [hinge, gravity] = [("hinge", ContributionKind::Work), ("gravity", ContributionKind::Conservative)];
    let (hinge, gravity) =
        (contribution(&balance, hinge.0, hinge.1), contribution(&balance, gravity.0, gravity.1));
    assert_eq!(hinge.work, 0.0);
    close(gravity.impulse[1], -G * 20.0, 1e-14);
    let v = rod.kinematics().velocity();
    let [vx, vy] = at(&run, 20.0, [v.x().clone(), v.y().clone()]);
    close(hinge.impulse[0], vx, 1e-11);
    close(hinge.impulse[1], vy + G * 20.0, 1e-13);
    // About the hinge its force has no moment.
    let about = RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    assert!(contribution(&about, "hinge", ContributionKind::Work).angular_impulse.abs() < 1e-13);
    let store = &balance.stores[0];
    close(store.start - store.end, gravity.work, 1e-11);
    let height = at(&run, 20.0, [rod.kinematics().position().y().clone()])[0];
    close(store.end, G * height, 1e-14);
}

#[test]
fn the_air_s_work_on_a_pendulum_is_what_its_energy_gains() {
    let (mut model, rod) = hinged_rod();
    let wind = 10 * M / S * (1 + (2 * Expr::pi() * time() / (2 * S)).cos());
    let motion = rod.kinematics();
    let u = wind * motion.angle().cos() - 1 * M * motion.omega();
    model.torque("air", &rod, 1 * M * (0.03 * KG / M * u.abs() * u));
    let run = run(model, 20.0, 1e-12);
    assert!(run.trajectory().work.flips > 5);
    let balance = balanced(&run, 1e-12);
    let energy = rod.kinetic_energy() + rod.potential_energy(&run.equations.model().gravity);
    let [before, after] = [0.0, 20.0].map(|t| at(&run, t, [energy.clone()])[0]);
    close(contribution(&balance, "air", ContributionKind::Work).work, after - before, 1e-12);
    assert!((after - before).abs() > 0.1);
}

/// A constant force at an offset that does not turn: `W = (F T)^2 / (2 M) + (y F T)^2 / (2 I)`; in a horizontal plane
/// the weight is not there.
#[test]
fn a_kick() {
    let mut model = Model::new();
    model.gravity = Gravity::Horizontal(G * M / (S * S));
    let ball = model.add(Body::shell("ball", 0.11 * M).mass(0.43 * KG));
    let place = Place::FromCentre(here(-0.09, 0.05));
    let kick = Load::force("kick", "ball", place, Vector::planar(200 * N, 0 * N));
    model.loads.push(kick.during(0.1 * S, 0.11 * S));
    let run = run(model, 1.0, 1e-9);
    let balance = balanced(&run, 1e-14);
    let (push, y, inertia) = (2.0, 0.05, 2.0 / 3.0 * 0.43 * 0.11 * 0.11);
    let kick = contribution(&balance, "kick", ContributionKind::Work);
    close(kick.work, push * push / 2.0 / 0.43 + y * y * push * push / (2.0 * inertia), 1e-14);
    close(kick.impulse[0], push, 1e-15);
    assert_eq!(kick.impulse[1], 0.0);
    close(kick.angular_impulse, -(y + 0.2) * push, 1e-15);
    assert_eq!((balance.contributions.len(), balance.stores.len()), (1, 0));
    close(balance.energy.end, at(&run, 1.0, [ball.kinetic_energy()])[0], 1e-15);
}

#[test]
fn a_rod_thrown_in_air() {
    let mut model = vertical();
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(0.5 * KG));
    let ends = [rod.at(&here(0.0, 0.0)), rod.at(&here(1.0, 0.0))];
    let on = DragPlace::Lines { lines: vec![ends], component: Component::Normal };
    model.interact(Drag { name: "air".into(), on, linear: None, quadratic: Some(0.2 * KG / (M * M)) });
    let start = Start::default().at([0 * M, 1 * M]).velocity([8 * M / S, 6 * M / S]).omega(6 / S);
    model.starts.push(("rod".into(), start));
    let run = run(model, 3.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    assert!(contribution(&balance, "air", ContributionKind::Work).work < -5.0);
}

/// A mass of 2 kg on a line, between a wall and its rest place at 1 m, started at 1.5 m.
fn oscillator(stiffness: Expr, damping: f64, wall: Vector) -> Model {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(2 * KG));
    model.interact(Spring {
        name: "spring".into(),
        ends: [Anchor::World(wall), Anchor::Material(ball.cm())],
        stiffness,
        rest_length: 1 * M,
        damping: damping * KG / S,
    });
    model.starts.push(("ball".into(), Start::default().at([1.5 * M, 0 * M])));
    model
}

/// What a damper takes is what the damped oscillation has lost.
#[test]
fn a_damper_s_loss() {
    let run = run(oscillator(8 * N / M, 0.8, here(0.0, 0.0)), 4.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    let (beta, t) = (0.2_f64, 4.0);
    let w = (4.0 - beta * beta).sqrt();
    let decay = 0.5 * (-beta * t).exp();
    let x = decay * ((w * t).cos() + beta / w * (w * t).sin());
    let v = -decay * 4.0 / w * (w * t).sin();
    let damper = contribution(&balance, "spring", ContributionKind::Work);
    close(damper.work, v * v + 4.0 * x * x - 1.0, 1e-12);
    let elastic = contribution(&balance, "spring", ContributionKind::Conservative);
    close(elastic.work, 1.0 - 4.0 * x * x, 1e-12);
    close(balance.stores[0].start, 1.0, 1e-15);
    close(balance.stores[0].end, 4.0 * x * x, 1e-12);
    assert_eq!(elastic.body, Some(0));
    assert!(!has(&balance, "spring", ContributionKind::Driven));
    // Impulses of both parts together are the momentum.
    close(damper.impulse[0] + elastic.impulse[0], 2.0 * v, 1e-12);
}

#[test]
fn an_anchor_that_is_shaken_does_work() {
    let shaken = Vector::planar(0.1 * M * (3 * time() / (1 * S)).sin(), 0 * M);
    let run = run(oscillator(8 * N / M, 0.0, shaken), 10.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    let (forced, t) = (0.4 / (4.0 - 9.0), 10.0_f64);
    let x = 0.5 * (2.0 * t).cos() - 1.5 * forced * (2.0 * t).sin() + forced * (3.0 * t).sin();
    let v = -(2.0 * t).sin() - 3.0 * forced * (2.0 * t).cos() + 3.0 * forced * (3.0 * t).cos();
    let stretched = x - 0.1 * (3.0 * t).sin();
    let driven = contribution(&balance, "spring", ContributionKind::Driven);
    close(driven.work, v * v + 4.0 * stretched * stretched - 1.0, 1e-12);
    assert!(driven.work.abs() > 1e-2 && driven.body.is_none());
    assert!(!has(&balance, "spring", ContributionKind::Work));
}

#[test]
fn a_torque_s_work_is_torque_times_angle() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG));
    model.torque("motor", &rod, 2 * N * M);
    let run = run(model, 30.0, 1e-12);
    let balance = balanced(&run, 1e-14);
    let motor = contribution(&balance, "motor", ContributionKind::Work);
    close(motor.work, 2.0 * 900.0, 1e-14);
    close(motor.angular_impulse, 60.0, 1e-15);
    assert_eq!(motor.impulse, [0.0; 2]);
}

#[test]
fn a_torsion_spring_with_a_damper() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    model.interact(Torsion {
        name: "wire".into(),
        body: rod.kinematics(),
        stiffness: 4 * N * M / RAD,
        rest_angle: 1 * RAD,
        damping: 0.4 * N * M * S / RAD,
    });
    model.starts.push(("rod".into(), Start::default().angle(10 * RAD)));
    let run = run(model, 10.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    let (beta, w, t) = (0.2_f64, 3.96_f64.sqrt(), 10.0);
    let twist = 9.0 * (-beta * t).exp() * ((w * t).cos() + beta / w * (w * t).sin());
    let rate = -9.0 * (-beta * t).exp() * 4.0 / w * (w * t).sin();
    let energy = 0.5 * rate * rate + 2.0 * twist * twist;
    close(contribution(&balance, "wire", ContributionKind::Work).work, energy - 162.0, 1e-12);
    close(balance.stores[0].start, 162.0, 1e-15);
}

/// The pivot alone does work, through its reaction, and it is what the energy gains.
#[test]
fn a_shaken_pivot_does_work() {
    let mut model = vertical();
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    let shaken = 0.2 * M * (3 * time() / (1 * S)).sin();
    model.pivot_at("table", &rod, [0 * M, 0 * M], [shaken, 0 * M]);
    model.starts.push(("rod".into(), Start::default().angle(1 * RAD)));
    let run = run(model, 10.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    let table = contribution(&balance, "table", ContributionKind::Work);
    close(table.work, balance.energy.end - balance.energy.start, 1e-12);
    assert!(table.work.abs() > 0.1);
}

#[test]
fn two_bodies_and_a_spring_keep_their_momentum() {
    let mut model = Model::new();
    let [a, b] = [("a", 2.0), ("b", 6.0)].map(|(name, mass)| model.add(Body::point(name).mass(mass * KG)));
    model.interact(Spring {
        name: "spring".into(),
        ends: [Anchor::Material(a.cm()), Anchor::Material(b.cm())],
        stiffness: 6 * N / M,
        rest_length: 1 * M,
        damping: 0.3 * KG / S,
    });
    let start = Start::default().at([0 * M, 0 * M]).velocity([1 * M / S, 2 * M / S]);
    model.starts.push(("a".into(), start));
    model.starts.push(("b".into(), Start::default().at([1.2 * M, 0.5 * M])));
    let run = run(model, 7.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    // Each body is pushed, both together are not.
    assert!(balance.bodies.iter().all(|body| body.momentum[0].change.abs() > 0.1));
    for axis in 0..2 {
        assert!(balance.total.momentum[axis].change.abs() < 1e-14);
    }
    assert!(balance.total.angular_momentum.change.abs() < 1e-13);
    // One store for the spring, not one a body.
    assert_eq!(balance.stores.len(), 1);
}

fn bouncing_rod(law: ContactLaw) -> Model {
    let mut model = vertical();
    let rod = model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG));
    let start = Start::default().at([0 * M, 2 * M]).velocity([2 * M / S, 0 * M / S]);
    model.starts.push((rod.name, start.angle(Expr::from(0.6)).omega(2 / S)));
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

fn rigid(e: f64) -> ContactLaw {
    ContactLaw::Rigid { restitution: Expr::from(e) }
}

/// An impact at one end takes `(1 - e^2) v_n^2 / (2 A)`, with A the end's response `1/m + x^2/I`.
#[test]
fn a_rod_loses_energy_by_impacts() {
    let run = run(bouncing_rod(rigid(0.7)), 5.0, 1e-12);
    let mut balance = balanced(&run, 1e-12);
    let hits: Vec<_> = run.contacts().into_iter().filter(|contact| contact.is_impact).collect();
    assert!(hits.len() > 10);
    for hit in &hits[..4] {
        let pair = &run.equations.pairs()[hit.pair];
        let event =
            run.trajectory().events.iter().position(|event| event.time == hit.start).expect("an event");
        let [before, _] = run
            .observe(&[pair.gap_rate(), pair.arm().x().clone()])
            .expect("formulas")
            .at_event(event)
            .expect("an event");
        let response = 1.0 / 0.5 + before[1] * before[1] / (0.5 / 12.0);
        let loss = (1.0 - 0.49) * before[0] * before[0] / (2.0 * response);
        let column = balance
            .contributions
            .iter()
            .position(|e| e.load == pair.name && e.kind == ContributionKind::Impact);
        let works = [Side::Before, Side::After].map(|side| {
            let at = balance.at(hit.start, side).expect("a balance").expect("in the run");
            assert!(at.energy_residual.abs() < 1e-11, "{at:?}");
            at.work[column.expect("a contribution")]
        });
        close(works[1] - works[0], -loss, 1e-12);
        assert!(loss > 0.1);
    }
    // It comes to lie, and then the floor carries it.
    let lost: f64 =
        balance.contributions.iter().filter(|e| e.kind == ContributionKind::Impact).map(|e| e.work).sum();
    close(lost, balance.energy.end - balance.energy.start, 1e-12);
    close(balance.energy.end, 0.5 * 0.5 * 4.0, 1e-13);
    let held = contribution(&balance, "floor.rod.from", ContributionKind::Work);
    assert!(held.work == 0.0 && held.impulse[1] > 1.0, "{held:?}");
}

#[test]
fn an_elastic_rod_loses_nothing() {
    let run = run(bouncing_rod(rigid(1.0)), 5.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    assert!(balance.energy.change.abs() < 1e-12);
    let up: f64 = balance
        .contributions
        .iter()
        .filter(|e| e.kind == ContributionKind::Impact)
        .map(|e| e.impulse[1])
        .sum();
    close(up, balance.bodies[0].momentum[1].end + 0.5 * G * 5.0, 1e-12);
}

/// A ball that comes to rest: each bounce, and what ends the last of them.
#[test]
fn a_ball_comes_to_rest() {
    for e in [0.0, 0.5] {
        let mut model = vertical();
        model.add(Body::ball("ball", 0.1 * M).mass(0.5 * KG));
        model.starts.push(("ball".into(), Start::default().at([0 * M, 1.1 * M])));
        model.surface(Surface::floor("floor", 0 * M, rigid(e)));
        let run = run(model, 3.0, 1e-12);
        let balance = balanced(&run, 1e-13);
        let pair = run.equations.pairs()[0].name.clone();
        close(contribution(&balance, &pair, ContributionKind::Impact).work, -0.5 * G, 1e-13);
        close(balance.energy.end, 0.5 * G * 0.1, 1e-14);
    }
}

/// The hinge of a rod that falls on the floor takes part in the impact, and does no work.
#[test]
fn an_impact_of_a_hinged_rod() {
    for e in [0.0, 0.5] {
        let mut model = vertical();
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(2 * KG));
        model.pivot_at("hinge", &rod, [0 * M, 0 * M], [0 * M, 0.5 * M]);
        model.surface(Surface::floor("floor", 0 * M, rigid(e)));
        let run = run(model, 5.0, 1e-12);
        let balance = balanced(&run, 1e-12);
        close(contribution(&balance, "floor.rod.to", ContributionKind::Impact).work, -2.0 * G * 0.25, 1e-12);
        let hinge = contribution(&balance, "hinge", ContributionKind::Impact);
        assert!(hinge.work.abs() < 1e-14 && hinge.impulse[0].abs() > 0.1, "{hinge:?}");
    }
}

/// 0.5 kg with 2 m/s onto a compliant surface, without gravity.
fn falling(law: ContactLaw, gravity: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(gravity * M / (S * S));
    model.add(Body::ball("ball", 0.1 * M).mass(0.5 * KG));
    let start = Start::default().at([0.7 * M, 0.15 * M]).velocity([1 * M / S, -2 * M / S]);
    model.starts.push(("ball".into(), start));
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

fn spring_floor(damping: f64, release: Release) -> ContactLaw {
    ContactLaw::Spring { stiffness: 1e4 * N / M, damping: damping * N * S / M, release }
}

#[test]
fn a_damped_floor_takes_energy_and_may_keep_some() {
    let half = 30.0;
    let w = (2e4_f64 - half * half).sqrt();
    for release in [Release::AtSurface, Release::AtZeroForce] {
        let run = run(falling(spring_floor(30.0, release), 0.0), 0.4, 1e-12);
        let balance = balanced(&run, 1e-12);
        let name = run.equations.pairs()[0].name.clone();
        let contact = run.contacts()[0].clone();
        let t = contact.end - contact.start;
        let depth = 2.0 / w * (-half * t).exp() * (w * t).sin();
        let speed = 2.0 * (-half * t).exp() * ((w * t).cos() - half / w * (w * t).sin());
        let kept = 5e3 * depth * depth;
        let damper = contribution(&balance, &name, ContributionKind::Work);
        close(damper.work, 0.25 * (speed * speed - 4.0) + kept, 1e-12);
        match release {
            Release::AtSurface => assert!(!has(&balance, &name, ContributionKind::Release)),
            Release::AtZeroForce => {
                close(contribution(&balance, &name, ContributionKind::Release).work, -kept, 1e-12);
                assert!(kept > 1e-2);
            }
        }
    }
}

#[test]
fn a_rod_on_a_springy_floor() {
    let run = run(bouncing_rod(spring_floor(0.0, Release::AtZeroForce)), 5.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    assert_eq!(balance.energy.change, 0.0);
    assert!(run.contacts().len() == 8 && has(&balance, "floor.rod.from", ContributionKind::Conservative));
}

/// In a transformed time; elastic, with damping, and several at a time.
#[test]
fn hertz_s_floor() {
    for damping in [0.0, 0.1] {
        let run = run(falling(hertz(damping), G), 5.0, 1e-12);
        assert!(
            run.contacts().len() > 5
                && run.trajectory().pieces.iter().any(|piece| piece.time_series.is_some())
        );
        let balance = balanced(&run, 1e-12);
        let name = run.equations.pairs()[0].name.clone();
        assert_eq!(has(&balance, &name, ContributionKind::Work), damping > 0.0);
        let lost = 0.25 * 5.0 + 0.5 * G * 0.15 - balance.energy.end;
        if damping > 0.0 {
            close(contribution(&balance, &name, ContributionKind::Work).work, -lost, 1e-12);
            assert!(lost > 0.1);
        } else {
            close(lost, 0.0, 1e-12);
        }
    }
    let run = run(bouncing_rod(hertz(0.05)), 5.0, 1e-12);
    balanced(&run, 1e-12);
}

/// A floor that moves does work on what rests on it: `W` is the gain of kinetic and potential energy.
#[test]
fn on_a_moving_floor() {
    let path = || 3.0 * M * (1 - (time() * (1.5 / S)).cos());
    let plate = || {
        let shape = tumble_mech::Shape::Box { centre: here(0.0, 0.0), width: 0.4 * M, height: 0.2 * M };
        Body::of_shape("box", shape).mass(2 * KG)
    };
    let mut model = vertical();
    model.add(plate());
    model.starts.push(("box".into(), Start::default().at([0 * M, 0.1 * M])));
    model.surface(Surface::floor("floor", path(), rigid(0.3)));
    let rigidly = run(model.clone(), 10.0, 1e-12);
    let balance = balanced(&rigidly, 1e-12);
    let work = |balance: &RunBalance| {
        let counted = balance.contributions.iter().filter(|part| part.counts());
        counted.map(|part| part.work).sum::<f64>()
    };
    let (height, speed) = (3.0 * (1.0 - 15.0_f64.cos()), 4.5 * 15.0_f64.sin());
    close(work(&balance), 2.0 * G * height + speed * speed, 1e-12);
    for law in [spring_floor(20.0, Release::AtSurface), spring_floor(0.0, Release::AtSurface)] {
        model.surfaces[0].law = law;
        let run = run(model.clone(), 2.0, 1e-12);
        let balance = balanced(&run, 1e-12);
        assert!(has(&balance, "floor.box.corner1", ContributionKind::Driven));
        assert!(work(&balance) > 10.0);
    }
}

/// Bounces on a floor that is shaken: each impact's work has the floor's part in it.
#[test]
fn impacts_on_a_moving_floor() {
    let mut model = falling(rigid(0.8), G);
    model.surfaces[0].through = Vector::planar(0 * M, 0.02 * M * (20 * time() / (1 * S)).sin());
    for law in [rigid(0.8), spring_floor(3.0, Release::AtZeroForce), hertz(0.05)] {
        model.surfaces[0].law = law;
        let run = run(model.clone(), 3.0, 1e-12);
        assert!(run.contacts().len() > 4);
        balanced(&run, 1e-12);
    }
}

fn hertz(damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: 1e6 * N / root, damping: damping * S / M }
}
