//! Bodies that nothing couples: each moves as it would alone, and what reads several of them is known as well.

use std::ops::ControlFlow;

use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, At, Body, ContactLaw, Event, Extreme, Gravity, Model, Run, RunBalance, RunError, Start, Surface,
    Trust,
};
use tumble_ode::{Accuracy, Direction, Reason, Side};

/// Heights that balls are dropped from, m.
const HEIGHTS: [f64; 4] = [1.0, 0.7, 1.3, 0.7];
const GRAVITY: f64 = 10.0;

/// Balls over a floor, those of these numbers.
fn balls(numbers: &[usize]) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(GRAVITY * M / (S * S));
    for &number in numbers {
        let name = format!("ball{number}");
        model.add(Body::point(&name).mass(1 * KG));
        let at = [number as f64 * M, HEIGHTS[number] * M];
        model.starts.push((name, Start::default().at(at).velocity([0.5 * M / S, 0 * M / S])));
    }
    model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: 0.5.into() }));
    model
}

fn trusted(model: &Model, until: f64) -> (Run, Trust) {
    let go = |_| ControlFlow::Continue(());
    Run::trusted(model, &model.parameters, until, Accuracy::DEFAULT, go).expect("a motion")
}

fn height(number: usize) -> Expr {
    Body::point(format!("ball{number}")).kinematics().position().y().clone()
}

/// Height of a ball at a time before its third bounce.
fn known(number: usize, time: f64) -> f64 {
    let fall = (2.0 * HEIGHTS[number] / GRAVITY).sqrt();
    let flight = |since: f64, up: f64| up * since - GRAVITY / 2.0 * since * since;
    match time {
        early if early < fall => HEIGHTS[number] - GRAVITY / 2.0 * early * early,
        mid if mid < 2.0 * fall => flight(mid - fall, GRAVITY * fall / 2.0),
        late => flight(late - 2.0 * fall, GRAVITY * fall / 4.0),
    }
}

#[test]
fn each_moves_as_it_would_alone() {
    let (together, _) = trusted(&balls(&[0, 1, 2, 3]), 1.0);
    assert_eq!(together.tracks().len(), 4);
    for number in 0..4 {
        let (alone, _) = trusted(&balls(&[number]), 1.0);
        let of =
            |run: &Run, time: f64| run.observe(&[height(number)]).expect("a height").at(time, Side::Before);
        for time in [0.3, 0.5, 0.75, 1.0] {
            assert_eq!(of(&together, time), of(&alone, time), "ball {number} at {time} s");
        }
        let name = format!("floor.ball{number}");
        let own = |run: &Run| -> Vec<f64> {
            let names = |event: &tumble_ode::Occurrence<_>| run.equations.names_of(&event.record).join(" ");
            run.events().filter(|event| names(event).contains(&name)).map(|event| event.time).collect()
        };
        assert_eq!(own(&together), own(&alone), "ball {number}");
    }
}

#[test]
fn what_reads_several_is_known_as_well() {
    let (run, trust) = trusted(&balls(&[0, 1, 2]), 0.8);
    let difference = height(0) - height(1) * height(2) / (1 * M);
    let exact = |time: f64| known(0, time) - known(1, time) * known(2, time);
    for time in [0.1, 0.4, 0.55, 0.8] {
        let at = At { time, side: Side::Before, off: 0.0 };
        let found = run.observe(std::slice::from_ref(&difference)).expect("a formula").at(time, Side::Before);
        let off = (found.expect("within")[0] - exact(time)).abs();
        let stated = trust.error_at(&run, &difference, at).expect("a formula").expect("known");
        assert!(off <= stated && stated < 1e-13, "at {time} s: off by {off}, stated {stated}");
    }
    // Where the first has bounced and the second has not yet come down as far.
    let peak = run.extreme(&(height(2) - height(1)), Extreme::Greatest, [0.0, 0.8]).expect("a motion");
    let peak = peak.expect("a greatest value");
    let fine = (0..=800_000).map(|step| 1e-6 * f64::from(step)).map(|time| known(2, time) - known(1, time));
    let most = fine.fold(f64::NEG_INFINITY, f64::max);
    assert!((peak.value - most).abs() < 1e-5 && peak.value >= most - 1e-14, "{peak:?}, {most}");
}

#[test]
fn an_event_of_one_ends_all() {
    let mut model = balls(&[0, 1, 2]);
    let below = height(1) - 0.2 * M;
    let action = Action::Stop;
    model.events.push(Event { name: "low".into(), when: below, direction: Direction::Falling, action });
    let (run, trust) = trusted(&model, 5.0);
    let end = (2.0 * 0.5 / GRAVITY).sqrt();
    assert!((run.end().expect("a motion") - end).abs() < 1e-15 && run.tracks().len() == 3);
    assert!(run.tracks().all(|track| track.end() == run.end()));
    assert!(trust.horizon.is_none() && trust.event_error(&run, run.end().expect("an end")).is_some());
    let at = At { time: run.end().expect("an end"), side: Side::Before, off: 0.0 };
    let stated = trust.error_at(&run, &height(2), at).expect("a formula").expect("known");
    assert!(stated < 1e-13, "{stated}");
}

#[test]
fn the_balance_of_all_is_that_of_each() {
    let all = RunBalance::of(&trusted(&balls(&[0, 1, 2]), 1.0).0, [0.0; 2]).expect("a balance");
    assert!(all.relative() < 1e-14 && all.bodies.len() == 3);
    let mut energy = 0.0;
    for number in 0..3 {
        let one = RunBalance::of(&trusted(&balls(&[number]), 1.0).0, [0.0; 2]).expect("a balance");
        energy += one.energy.end;
        assert_eq!(all.bodies[number], one.bodies[0]);
    }
    assert!((all.energy.end - energy).abs() < 1e-14);
}

/// What is compiled of one serves all that are like it, and messages name the one that they are about.
#[test]
fn refusals_name_their_body() {
    let mut model = balls(&[0, 1]);
    for number in 0..2 {
        let name = format!("ball{number}");
        let y = height(number) / (1 * M);
        // Nothing to be done where the first falls; the other comes to where there is no force.
        let force = (y - 0.1).log() * 1e-3 * KG * M / (S * S);
        let place = tumble_mech::Place::FromCentre(Vector::planar(0 * M, 0 * M));
        let load = tumble_mech::Load::force(
            format!("pull{number}"),
            name,
            place,
            Vector::planar(force, 0 * KG * M / (S * S)),
        );
        model.loads.push(load);
    }
    model.starts[0].1 = Start::default().at([0 * M, 100 * M]);
    match model.simulate(&[], 1 * S) {
        Err(RunError::Refused { refusal, partial }) => {
            let text = refusal.to_string();
            assert!(text.contains("ball1") && !text.contains("ball0"), "{text}");
            assert!(!matches!(refusal.reason, Reason::Interrupted));
            assert!(partial.tracks().all(|track| track.end() <= Some(refusal.time)));
        }
        other => panic!("{other:?}"),
    }
}
