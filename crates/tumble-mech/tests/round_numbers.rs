//! Events of motions made of round numbers, which fall on the ends of steps and on each other.

use crate::common::run;
use proptest::prelude::*;
use proptest::sample::select;
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::{Action, Body, Event, Model, Run, Start, time};
use tumble_ode::{Direction, Side};

const LEVELS: [f64; 13] = [-1.0, -0.5, -0.25, -0.125, 0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 1.0, 2.0];
const TIMES: [f64; 8] = [0.125, 0.25, 0.375, 0.5, 0.75, 1.0, 1.25, 1.5];
/// Points of the grid on which signs are counted: a power of two, so that it meets all round times.
const GRID: usize = 4096;
/// What is nearer to zero is on neither side.
const NOTHING: f64 = 1e-11;

/// A turn that is nearer to zero, between points of the grid, is a touch.
const TOUCH: f64 = 1e-5;

/// One of some forces on a ball of 1 kg, in N.
fn force(kind: usize, body: &Body) -> Expr {
    let (t, motion) = (time() / S, body.kinematics());
    let (x, v) = (motion.position().x() / (1 * M), motion.velocity().x() / (1 * M / S));
    match kind {
        0 => Expr::zero(),
        1 => Expr::one(),
        2 => 2 * t,
        3 => t.sin(),
        4 => -Expr::one(),
        5 => (4 * t).cos(),
        6 => -4 * x,
        _ => -(v.abs() * v),
    }
}

/// A ball that three forces push one after the other, and what is watched: its position, its velocity and how far it is ahead of
/// a steady motion, each less a level.
fn motion(
    kinds: (usize, usize, usize),
    switches: (f64, f64),
    start: (f64, f64),
    levels: &[f64],
) -> (Model, [Expr; 3]) {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(1 * KG));
    let at = Start::default().at([start.0 * M, 0 * M]).velocity([start.1 * M / S, 0 * M / S]);
    model.starts.push(("ball".into(), at));
    let until = |end: f64, then: Expr, after: Expr| {
        Expr::select(Expr::compare(Relation::Less, time() / S, Expr::from(end)), then, after)
    };
    let (first, last) = (switches.0.min(switches.1), switches.0.max(switches.1));
    let late = until(last, force(kinds.1, &ball), force(kinds.2, &ball));
    let push = until(first, force(kinds.0, &ball), late) * N;
    model.force("push", &ball.cm(), Vector::planar(push, 0 * N));
    let motion = ball.kinematics();
    let (x, v) = (motion.position().x().clone(), motion.velocity().x().clone());
    let watched = [&x - levels[0] * M, (v - levels[1] * M / S) * S, &x - time() * M / S - levels[2] * M];
    for (index, when) in watched.iter().enumerate() {
        for (way, direction) in [("up", Direction::Rising), ("down", Direction::Falling)] {
            let (name, when) = (format!("{way}{index}"), when.clone());
            model.events.push(Event { name, when, direction, action: Action::Record });
        }
    }
    (model, watched)
}

/// How often an event happens.
fn count(run: &Run, name: &str) -> usize {
    let happening = run.equations.named(name).expect("an event");
    run.trajectory().events.iter().filter(|event| event.record.happened.contains(&happening)).count()
}

/// A step that ends as a velocity touches a level leaves it there by rounding alone.
#[test]
fn a_touch_where_a_step_ends_is_not_refused() {
    let (model, _) = motion((5, 5, 5), (1.0, 1.0), (0.625, 0.0), &[-1.0, 0.25, -1.0]);
    let found = run(model, 2.0, 1e-9);
    for index in 0..3 {
        let count = |way: &str| count(&found, &format!("{way}{index}"));
        assert!(index != 1 || count("up") == count("down"), "{:?}", found.trajectory().events);
    }
}

/// A step may end where a formula is zero exactly, by a time that rounding has moved across it.
#[test]
fn a_crossing_where_a_step_ends_is_counted_once() {
    for (switches, start, level) in [((0.25, 1.25), (0.75, 0.5), 0.75), ((0.25, 1.0), (0.375, -0.125), -0.25)]
    {
        let (model, _) = motion((1, 2, 5), switches, start, &[-1.0, -1.0, level]);
        let run = run(model, 2.0, 1e-9);
        let near = run.trajectory().events.iter().filter(|event| (event.time - 1.0).abs() < 1e-9);
        let names = near.flat_map(|event| run.equations.names_of(&event.record));
        assert_eq!(names.filter(|name| name.contains('2')).collect::<Vec<_>>(), ["up2"], "{start:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn no_event_of_round_numbers_is_missed(
        kinds in (0usize..8, 0usize..8, 0usize..8),
        switches in (select(TIMES.to_vec()), select(TIMES.to_vec())),
        start in (select(LEVELS.to_vec()), select(LEVELS.to_vec())),
        levels in prop::collection::vec(select(LEVELS.to_vec()), 3),
    ) {
        let (model, watched) = motion(kinds, switches, start, &levels);
        let run = run(model, 2.0, 1e-9);
        let mut observer = run.observe(&watched).expect("formulas of the motion");
        let grid: Vec<Vec<f64>> = (0..=GRID)
            .map(|i| observer.at(2.0 * i as f64 / GRID as f64, Side::After).expect("inside"))
            .collect();
        for index in 0..watched.len() {
            let column = grid.iter().map(|row| row[index]);
            // What stays at zero, turns there or ends there has not passed it, or only by rounding.
            let values: Vec<f64> = column.clone().collect();
            let near = |value: f64| value.abs() < NOTHING;
            let stays = values.windows(2).any(|pair| near(pair[0]) && near(pair[1]));
            let turns = |part: &[f64]| part[1].abs() < TOUCH && part[0] * part[2] > 0.0;
            prop_assume!(!stays && !values.windows(3).any(turns) && !near(values[GRID]));
            let signs: Vec<f64> = column.filter(|value| value.abs() > NOTHING).map(f64::signum).collect();
            for (way, to) in [("up", 1.0), ("down", -1.0)] {
                let expected = signs.windows(2).filter(|pair| pair[0] != pair[1] && pair[1] == to).count();
                let name = format!("{way}{index}");
                prop_assert_eq!(count(&run, &name), expected, "{} of {:?} {:?} {:?} {:?}", name, kinds, switches, start, levels);
            }
        }
    }
}
