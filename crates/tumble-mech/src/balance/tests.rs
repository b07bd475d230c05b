//! Balances in time, through changes of parameters, and beside the motion.

use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Exponent, Expr, Vector};
use tumble_ode::{Accuracy, Direction, Side};

use crate::balance::lines::Lines;
use crate::balance::quadrature::Quadrature;
use crate::{
    Action, Anchor, Body, ContactLaw, Contribution, ContributionKind, Event, Gravity, Model, Run, RunBalance,
    Spring, Start, Surface, time,
};

const G: f64 = 9.81;

fn run(model: Model, until: f64, accuracy: f64) -> Run {
    let accuracy = Accuracy::new(accuracy).expect("an accuracy that can be asked for");
    model.simulate_to(&[], until * S, accuracy).map_err(|error| error.to_string()).expect("a motion")
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found:?} is not {expected:?}");
}

/// The balance about a point that nothing is at, every part of which must close.
#[track_caller]
fn balanced(run: &Run, tolerance: f64) -> RunBalance {
    let balance = RunBalance::of(run, [0.3, -0.2]).expect("a balance");
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

/// Far from the origin a spring's force is a difference of large numbers: its power is no smaller than what rounding makes of that,
/// and is not looked at more closely.
#[test]
fn sums_of_rounding_errors_are_not_refined() {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(1 * KG));
    let rest = 1e6 * M;
    let pull = -(&ball.kinematics().position().components()[0] - &rest) * (1 * N / M);
    model.force("spring", &ball.cm(), Vector::planar(pull, 0 * N));
    model.starts.push((ball.name, Start::default().at([rest - 1e-6 * M, 0 * M])));
    let run = run(model, 1.0, 1e-9);
    let piece = &run.trajectory().pieces[0];
    let mode = &run.trajectory().modes[piece.mode];
    let lines = Lines::new(&run.equations, &[], mode, &run.inputs, &here(0.0, 0.0));
    let mut lines = lines.expect("lines that compile");
    let mut samples = 0;
    let mut along = lines.along(piece);
    let mut sample = |s: f64| {
        samples += 1;
        along(s)
    };
    let found = Quadrature::new().integrate([0.0, piece.length], &mut sample, &mut |_, _| ());
    found.expect("finite powers");
    assert!(samples < 100, "{samples}");
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

fn bouncing_rod(law: ContactLaw) -> Model {
    let mut model = vertical();
    let rod = model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG));
    let start = Start::default().at([0 * M, 2 * M]).velocity([2 * M / S, 0 * M / S]);
    model.starts.push((rod.name, start.angle(Expr::from(0.6)).omega(2 / S)));
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

fn hertz(damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: 1e6 * N / root, damping: damping * S / M }
}

fn rigid(e: f64) -> ContactLaw {
    ContactLaw::Rigid { restitution: Expr::from(e) }
}

/// A damper fastened the other way round, and a spring without rest length.
#[test]
fn a_spring_s_ends_in_either_order() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG));
    let tip = rod.at(&here(1.0, 0.0));
    for (name, rest_length, damping) in [("a", 0.7, 0.3), ("b", 0.0, 0.0), ("c", 0.0, 0.4)] {
        let ends = [Anchor::Material(tip.clone()), Anchor::World(here(2.0, 1.5))];
        let (rest_length, damping) = (rest_length * M, damping * KG / S);
        model.interact(Spring { name: name.into(), ends, stiffness: 5 * N / M, rest_length, damping });
    }
    let run = run(model, 3.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    for name in ["a", "b", "c"] {
        let store = balance.stores.iter().find(|store| store.load == name).expect("a store");
        close(
            contribution(&balance, name, ContributionKind::Conservative).work,
            store.start - store.end,
            1e-11,
        );
        assert_eq!(has(&balance, name, ContributionKind::Work), name != "b");
    }
}

/// A stiffness that is a formula of the time changes the energy of the spring with no body moving.
#[test]
fn a_softening_spring() {
    let age = 1 + time() / (1 * S);
    let run = run(oscillator(8 * N / M / (&age * &age), 0.0, here(0.0, 0.0)), 2.5, 1e-12);
    let balance = balanced(&run, 1e-12);
    let driven = contribution(&balance, "spring", ContributionKind::Driven).work;
    close(driven, balance.energy.end - balance.energy.start, 1e-12);
    assert!(driven < -0.5);
}

/// A stiffness that depends on the motion has no potential: all of it is work.
#[test]
fn a_spring_that_depends_on_the_motion_is_work() {
    let place = Expr::symbol("ball.x", tumble_expr::Dimension::LENGTH);
    let run = run(oscillator(4 * N / M * (1 + place / (1 * M)), 0.0, here(0.0, 0.0)), 5.0, 1e-12);
    let balance = balanced(&run, 1e-12);
    assert!(balance.stores.is_empty() && has(&balance, "spring", ContributionKind::Work));
}

#[test]
fn a_parameter_that_jumps_changes_what_is_stored() {
    let mut model = Model::new();
    let k = model.parameters.set("k", 8 * N / M).expect("typed");
    let with = oscillator(k, 0.0, here(0.0, 0.0));
    let parameters = model.parameters;
    model = Model { parameters, ..with };
    // x = 1 + cos(2 t) / 2 m passes 1.25 m at pi / 6 s.
    model.events.push(Event {
        name: "stiffer".into(),
        when: model.bodies[0].kinematics().position().x() - 1.25 * M,
        direction: Direction::Falling,
        action: Action::Set(vec![("k".into(), 18 * N / M)]),
    });
    let run = run(model, 0.8, 1e-12);
    let balance = balanced(&run, 1e-12);
    let jump = contribution(&balance, "spring", ContributionKind::ParameterJump);
    close(jump.work, 10.0 * 0.0625 / 2.0, 1e-13);
    close(balance.energy.change, jump.work, 0.0);
}

/// A mass that jumps takes momentum and energy with it, under the event's name.
#[test]
fn a_mass_that_jumps() {
    let mut model = vertical();
    let mass = model.parameters.set("m", 2 * KG).expect("typed");
    let ball = model.add(Body::point("ball").mass(mass));
    model.starts.push(("ball".into(), Start::default().at([0 * M, 5 * M]).velocity([3 * M / S, 0 * M / S])));
    model.events.push(Event {
        name: "splits".into(),
        when: ball.kinematics().position().y() - 4 * M,
        direction: Direction::Falling,
        action: Action::Set(vec![("m".into(), 0.5 * KG)]),
    });
    let run = run(model, 0.9, 1e-12);
    let balance = balanced(&run, 1e-13);
    let jump = contribution(&balance, "splits", ContributionKind::ParameterJump);
    close(jump.work, -0.75 * (9.0 + 2.0 * G), 1e-13);
    close(jump.impulse[0], -4.5, 1e-14);
    close(contribution(&balance, "gravity", ContributionKind::ParameterJump).work, -1.5 * G * 4.0, 1e-13);
}

/// One exact step turns the rod many times; its pivot's force turns with it.
#[test]
fn a_long_exact_step_is_resolved() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG));
    model.pivot_at("axle", &rod, [0 * M, 0 * M], [0 * M, 0 * M]);
    model.torque("motor", &rod, 2 * N * M);
    let run = run(model, 10.0, 1e-12);
    assert_eq!(run.trajectory().pieces.len(), 1);
    balanced(&run, 1e-13);
}

/// At any time, in any mode, the balance closes, and it rises to what it is at the end.
#[test]
fn the_course_in_time() {
    let run = run(falling(hertz(0.1), G), 3.0, 1e-12);
    let mut balance = balanced(&run, 1e-12);
    let columns = balance.columns();
    assert_eq!(columns[..4], ["t", "kinetic", "potential", "energy"]);
    assert!(columns.contains(&"work of gravity on ball (potential)".to_owned()), "{columns:?}");
    let inside = run.contacts().into_iter().map(|contact| 0.3 * contact.start + 0.7 * contact.end);
    let inside: Vec<f64> = inside.chain((0..=30).map(|i| 0.1 * f64::from(i))).collect();
    for t in inside {
        let at = balance.at(t, Side::After).expect("a balance").expect("in the run");
        assert!(at.energy_residual.abs() < 1e-11 && at.angular_momentum_residual.abs() < 1e-11, "{at:?}");
        assert!(at.momentum_residual.iter().all(|residual| residual.abs() < 1e-11), "{at:?}");
        let row = balance.row(t, Side::After).expect("a balance").expect("in the run");
        assert_eq!(row.len(), columns.len());
        close(row[1] + row[2], row[3], 1e-15);
        assert_eq!(row.last(), Some(&at.energy_residual));
    }
    let start = balance.at(0.0, Side::Before).expect("a balance").expect("in the run");
    assert!(start.work.iter().all(|work| *work == 0.0));
    let end = balance.at(3.0, Side::After).expect("a balance").expect("in the run");
    for (work, contribution) in end.work.iter().zip(&balance.contributions) {
        assert_eq!(*work, contribution.work);
    }
    let before = balance.at(3.0, Side::Before).expect("a balance").expect("in the run");
    for (work, contribution) in before.work.iter().zip(&balance.contributions) {
        close(*work, contribution.work, 1e-14);
    }
    assert!(balance.at(-0.1, Side::After).expect("a balance").is_none());
    assert!(balance.at(3.1, Side::After).expect("a balance").is_none());
}

/// The balance changes nothing of the motion, and is the same when found again.
#[test]
fn the_motion_does_not_know_of_its_balance() {
    let bits = |run: &Run| -> Vec<u64> {
        let pieces = run.trajectory().pieces.iter();
        pieces.flat_map(|piece| piece.states.all().to_vec()).map(f64::to_bits).collect()
    };
    let with = run(bouncing_rod(hertz(0.05)), 3.0, 1e-12);
    let before = bits(&with);
    let contributions = balanced(&with, 1e-11).contributions;
    assert_eq!(before, bits(&with));
    assert_eq!(before, bits(&run(bouncing_rod(hertz(0.05)), 3.0, 1e-12)));
    assert_eq!(contributions, balanced(&with, 1e-11).contributions);
}

/// The balance of a run that was cut short by an event closes too.
#[test]
fn a_run_that_stops() {
    let mut model = falling(rigid(0.8), G);
    model.events.push(Event {
        name: "hit".into(),
        when: model.bodies[0].kinematics().position().y() - 0.1 * M,
        direction: Direction::Falling,
        action: Action::Stop,
    });
    let run = run(model, 3.0, 1e-12);
    assert!(run.trajectory().end() < Some(1.0));
    balanced(&run, 1e-13);
}
