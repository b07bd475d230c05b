//! Linkages that come to where their bars lie in one line, against the one coordinate that they have.

use crate::common::integral;
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Anchor, Body, Gravity, Happening, Joint, Model, Run, RunBalance, RunError, Start};
use tumble_ode::Accuracy;

/// m, and m/s^2.
const LENGTH: f64 = 0.3;
const APART: f64 = 0.5;
const G: f64 = 9.81;

fn named(body: &Body, point: &str) -> Anchor {
    Anchor::Material(body.named_point(point).expect("a named point"))
}

fn bar(name: &str, length: f64, mass: f64) -> Body {
    let bar = Body::rod(name, [0 * M, 0 * M], [length * M, 0 * M]).mass(mass * KG);
    bar.with_point("start", [0 * M, 0 * M]).with_point("end", [length * M, 0 * M])
}

/// Parallel cranks of these masses at an angle and a rate, with one coupler of 1 kg.
fn parallelogram(masses: &[f64], angle: f64, omega: f64) -> (Model, Vec<Body>) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let reach = APART * (masses.len() - 1) as f64;
    let mut coupler = Body::rod("coupler", [0 * M, 0 * M], [reach * M, 0 * M]).mass(1 * KG);
    for index in 0..masses.len() {
        coupler = coupler.with_point(format!("p{index}"), [APART * index as f64 * M, 0 * M]);
    }
    let (x, y) = (LENGTH * angle.cos(), LENGTH * angle.sin());
    let start = Start::default().at([(x + reach / 2.0) * M, y * M]).angle(Expr::from(0.0));
    model.starts.push(("coupler".into(), start.velocity([-y * omega * M / S, x * omega * M / S])));
    let mut cranks = vec![];
    for (index, mass) in masses.iter().enumerate() {
        let crank = model.add(bar(&format!("crank{index}"), LENGTH, *mass));
        model.pivot_at(format!("A{index}"), &crank, [0 * M, 0 * M], [APART * index as f64 * M, 0 * M]);
        let ends = [named(&crank, "end"), named(&coupler, &format!("p{index}"))];
        model.join(Joint { assemble: true, ..Joint::pin(format!("B{index}"), ends) });
        let start = Start::default().angle(Expr::from(angle)).omega(omega / S);
        model.starts.push((crank.name.clone(), start));
        cranks.push(crank);
    }
    model.add(coupler);
    (model, cranks)
}

fn run(model: &Model, until: f64) -> Result<Run, RunError> {
    model.simulate_to(&[], until * S, Accuracy::new(1e-12).expect("an accuracy"))
}

fn passed(run: &Run) -> Vec<f64> {
    let events = run.trajectory().events.iter();
    let singular = events.filter(|event| event.record.happened == [Happening::Singular]);
    singular.map(|event| event.time).collect()
}

/// Cranks of any masses turn as one pendulum does, `I theta'' = -m_1 g cos(theta)`, through all poses in which the bars are flat: the time
/// that it takes is an integral. With three of them one loop is redundant.
#[test]
fn parallelograms_turn_through_their_flat_poses() {
    let (angle, omega, until) = (1.7, 8.0, 2.0);
    for masses in [&[1.0, 1.0][..], &[1.0, 3.0], &[1.0, 1.0, 1.0], &[1.0, 3.0, 0.5]] {
        let (model, cranks) = parallelogram(masses, angle, omega);
        let found = run(&model, until).map_err(|error| error.to_string()).expect("a motion");
        let end = found.at(until).expect("within");
        let whole: f64 = masses.iter().sum();
        let inertia = (whole / 3.0 + 1.0) * LENGTH * LENGTH;
        let weight = (whole / 2.0 + 1.0) * LENGTH * G;
        let rate =
            |theta: f64| (omega * omega + 2.0 * weight / inertia * (f64::sin(angle) - theta.sin())).sqrt();
        let angles: Vec<f64> = cranks.iter().map(|crank| end.angle(crank).expect("finite")).collect();
        let turns = angles[0] / std::f64::consts::PI;
        let time = integral(|theta| 1.0 / rate(theta), angle, angles[0]);
        println!("{masses:?}: {:e} s off, {} passed, {turns} half turns", time - until, passed(&found).len());
        assert!((time - until).abs() < 1e-11, "{masses:?}: {:e}", time - until);
        assert!((end.omega(&cranks[0]).expect("finite") - rate(angles[0])).abs() < 1e-10);
        assert!(angles.iter().all(|other| (other - angles[0]).abs() < 1e-13));
        // All rows hold, those that are left out too.
        let coupler = &found.equations.model().bodies[masses.len()];
        for (index, crank) in cranks.iter().enumerate() {
            let place = |body: &Body, point: &str| body.named_point(point).expect("a point").position();
            let gap: Vector = place(crank, "end") - place(coupler, &format!("p{index}"));
            let [x, y] = end.values([gap.x().clone(), gap.y().clone()]).expect("finite");
            assert!(f64::hypot(x, y) < 1e-14, "{x:e} {y:e}");
        }
        // Each half turn has one flat pose, and each is told of, when it is.
        let flat = passed(&found);
        assert_eq!(flat.len(), turns.floor() as usize);
        for (index, at) in flat.iter().enumerate() {
            let pose = (index + 1) as f64 * std::f64::consts::PI;
            let expected = integral(|theta| 1.0 / rate(theta), angle, pose);
            assert!((at - expected).abs() < 1e-11, "{at} is not {expected}");
        }
    }
}

/// Two bars on the base of their own length: flat they may turn on with the base, or as a kite; with these velocities it is the kite.
/// Its energy stays.
#[test]
fn a_kite_turns_through_its_flat_pose() {
    let mut model = Model::new();
    let (short, long) = (0.3, 0.5);
    let crank = model.add(bar("crank", short, 1.0));
    let coupler = model.add(bar("coupler", long, 1.5));
    let rocker = model.add(bar("rocker", long, 2.0));
    model.pivot_at("A0", &crank, [0 * M, 0 * M], [0 * M, 0 * M]);
    model.pivot_at("B0", &rocker, [0 * M, 0 * M], [short * M, 0 * M]);
    model.join(Joint::pin("A", [named(&crank, "end"), named(&coupler, "start")]));
    let closing = Joint::pin("B", [named(&coupler, "end"), named(&rocker, "end")]);
    model.join(Joint { assemble: true, ..closing });
    for (body, angle, omega) in [("crank", 1.75, 6.0), ("coupler", 0.35, 0.0), ("rocker", 1.25, 0.0)] {
        model.starts.push((body.into(), Start::default().angle(Expr::from(angle)).omega(omega / S)));
    }
    let found = run(&model, 2.0).map_err(|error| error.to_string()).expect("a motion");
    println!("{:?}", passed(&found));
    assert_eq!(passed(&found).len(), 1);
    let bodies = [(&crank, 1.0, short), (&coupler, 1.5, long), (&rocker, 2.0, long)];
    let energy = |time: f64| -> f64 {
        let now = found.at(time).expect("within");
        let of = |(body, mass, length): &(&Body, f64, f64)| {
            let velocity = body.kinematics().velocity();
            let [x, y] = now.values([velocity.x().clone(), velocity.y().clone()]).expect("finite");
            let omega = now.omega(body).expect("finite");
            0.5 * mass * (x * x + y * y + length * length / 12.0 * omega * omega)
        };
        bodies.iter().map(of).sum()
    };
    assert!((energy(2.0) / energy(0.0) - 1.0).abs() < 1e-11, "{:e}", energy(2.0) / energy(0.0) - 1.0);
}

/// A start that says nothing of where the bars go on is refused, with its joints and what to do.
#[test]
fn a_flat_start_is_refused() {
    for masses in [&[1.0, 1.0][..], &[1.0, 1.0, 1.0]] {
        let (model, _) = parallelogram(masses, 0.0, 5.0);
        let refused = run(&model, 1.0).expect_err("flat").to_string();
        assert!(refused.contains("`B0`") && refused.contains("`B1`"), "{refused}");
        assert!(
            refused.contains("singular configuration") && refused.contains("Turn one of them"),
            "{refused}"
        );
    }
}

/// Where rows say nothing forces have no value; places and rates do, and so do forces a moment before and after.
#[test]
fn forces_have_no_value_at_the_instant() {
    let (model, cranks) = parallelogram(&[1.0, 1.0], -1.0, 9.0);
    let run = run(&model, 0.5).expect("a motion");
    let force: Expr = model.joints[0].multipliers()[0].clone().into();
    let motion = cranks[0].kinematics();
    let mut observer = run.observe(&[force, motion.alpha(), motion.omega()]).expect("formulas");
    let time = passed(&run)[0];
    let mut at = |time: f64| observer.at(time, tumble_ode::Side::Before).expect("within");
    let here = at(time);
    assert!(here[0].is_nan() && here[1].is_nan() && here[2].is_finite(), "{here:?}");
    for away in [-1e-3, 1e-3] {
        assert!(at(time + away).iter().all(|value| value.abs() < 1e4), "{:?}", at(time + away));
    }
}

/// Of two equal cranks each end bears half of the coupler, in all poses: what the pins have done to it over a time that holds the
/// instant is half of what it has gained, and what weight took from it.
#[test]
fn works_and_impulses_over_the_instant_are_those_of_the_pendulum() {
    /// N s: next to the instant forces are rounding errors of velocities divided by the square of the angle that is left.
    const OFF: f64 = 2e-9;
    let (angle, omega, until) = (-1.0_f64, 9.0, 0.25);
    let (model, cranks) = parallelogram(&[1.0, 1.0], angle, omega);
    let run = run(&model, until).expect("a motion");
    assert_eq!(passed(&run).len(), 1);
    let end = run.at(until).expect("within");
    let (turned, rate) = (end.angle(&cranks[0]).expect("finite"), end.omega(&cranks[0]).expect("finite"));
    let velocity = |angle: f64, rate: f64| [-LENGTH * rate * angle.sin(), LENGTH * rate * angle.cos()];
    let [before, after] = [velocity(angle, omega), velocity(turned, rate)];
    let raised = LENGTH * (turned.sin() - angle.sin());
    let impulse = [0.5 * (after[0] - before[0]), 0.5 * (after[1] - before[1] + G * until)];
    let work = 0.5 * (0.5 * LENGTH * LENGTH * (rate * rate - omega * omega) + G * raised);
    let balance = RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    println!("{:e}", balance.relative());
    assert!(balance.relative() < 1e-11, "{:e}", balance.relative());
    for pin in ["B0", "B1"] {
        let own = balance.contributions.iter().filter(|own| own.load == pin && own.body == Some(2));
        let [found] = &own.collect::<Vec<_>>()[..] else {
            panic!("one contribution of `{pin}` on the coupler")
        };
        println!("{pin}: {:?} {impulse:?}, {} {work}", found.impulse, found.work);
        assert!((found.work - work).abs() < 1e-10, "{} is not {work}", found.work);
        for (found, expected) in found.impulse.iter().zip(impulse) {
            assert!((found - expected).abs() < OFF, "{found} is not {expected}");
        }
    }
}

/// Points that are joined stay together at all times, also within the steps over flat poses, and the energy stays: a short one of
/// `cargo run --release -p tumble --example long_runs`.
#[test]
fn loops_stay_closed_as_they_turn() {
    /// Places within each step.
    const WITHIN: usize = 4;
    for (masses, off) in [(&[0.6, 0.6][..], 1e-13), (&[0.6, 0.6, 0.6], 1e-13)] {
        let (model, cranks) = parallelogram(masses, 1.7, 8.0);
        let run = run(&model, 10.0).expect("a motion");
        let bodies = &run.equations.model().bodies;
        let coupler = &bodies[masses.len()];
        let place = |body: &Body, point: &str| body.named_point(point).expect("a point").position();
        let gaps = cranks.iter().enumerate().flat_map(|(index, crank)| {
            let gap: Vector = place(crank, "end") - place(coupler, &format!("p{index}"));
            [gap.x().clone(), gap.y().clone()]
        });
        let energy = bodies.iter().map(|body| body.kinetic_energy() + body.potential_energy(&model.gravity));
        let energy = energy.reduce(|sum, own| sum + own).expect("bodies");
        let formulas: Vec<Expr> = [energy].into_iter().chain(gaps).collect();
        let mut observer = run.observe(&formulas).expect("formulas");
        let (mut first, mut closure, mut change) = (None, 0.0_f64, 0.0_f64);
        for piece in &run.trajectory().pieces {
            for at in 0..=WITHIN {
                let time = piece.start + (piece.end - piece.start) * at as f64 / WITHIN as f64;
                let values = observer.at(time, tumble_ode::Side::Before).expect("within");
                let start = *first.get_or_insert(values[0]);
                change = change.max((values[0] / start - 1.0).abs());
                values[1..].iter().for_each(|gap| closure = closure.max(gap.abs()));
            }
        }
        println!(
            "{masses:?}: {closure:e} m, {change:e}, {} passed, {} steps",
            passed(&run).len(),
            run.trajectory().pieces.len()
        );
        assert!(closure < off && change < 1e-10, "{masses:?}: {closure:e} m, {change:e}");
    }
}
