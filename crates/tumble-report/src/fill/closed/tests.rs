//! Closed forms are what the motion does.

use std::path::Path;

use tumble_expr::{Expr, Substitution, Symbol, units};
use tumble_notation::Math;
use tumble_ode::Side;
use tumble_scene::Study;

use super::{line, solved, span};
use crate::fill::names::Names;
use crate::results::Case;
use crate::scenes;

/// Instants of each stretch.
const INSTANTS: usize = 7;
/// Runs of a scene that are looked at.
const RUNS: usize = 3;
/// What rounding of a polynomial in time and of the steps may be off by, of a coordinate's size in the stretch.
const ROUNDING: f64 = 1e-12;

/// The first runs of every scene.
fn each_run(mut look: impl FnMut(&Path, &Study, &Case)) {
    for scene in scenes::all() {
        let (study, cases) = scenes::motions_of(&scene);
        cases.iter().take(RUNS).for_each(|case| look(&scene, &study, case));
    }
}

#[test]
fn closed_forms_are_what_the_motion_does() {
    let (mut runs, mut values) = (0, 0);
    each_run(|scene, study, case| {
        let study = study.with(&case.parameters);
        let stretches = solved(&study, &case.run);
        runs += usize::from(!stretches.is_empty());
        for (index, stretch) in stretches.iter().enumerate() {
            let begins = study.number(&stretch.begins).expect("a time");
            let next = stretches.get(index + 1).map(|next| study.number(&next.begins).expect("a time"));
            // The last one is left by an event, or goes on to the end.
            let left = case.run.events().map(|event| event.time).find(|time| *time > begins);
            let ends = next.or(left).unwrap_or_else(|| case.run.end().expect("an end"));
            for (coordinate, motion) in stretch.coordinates.iter().zip(&stretch.motions) {
                let pairs =
                    [(&coordinate.position, &motion.position), (&coordinate.velocity, &motion.velocity)];
                for (symbol, formula) in pairs {
                    let state = Expr::from(symbol.clone());
                    let mut observer = case.run.observe(std::slice::from_ref(&state)).expect("a state");
                    let compared: Vec<[f64; 2]> = (1..INSTANTS)
                        .map(|instant| {
                            let elapsed = (ends - begins) * instant as f64 / INSTANTS as f64;
                            let mut then = Substitution::default();
                            then.insert(stretch.elapsed.clone(), Expr::from(elapsed) * units::S);
                            let closed = study.number(&then.apply(formula)).expect("a number");
                            [
                                observer.at(begins + elapsed, Side::After).expect("a time of the run")[0],
                                closed,
                            ]
                        })
                        .collect();
                    let size = compared.iter().map(|pair| pair[0].abs()).fold(1.0, f64::max);
                    for [found, closed] in compared {
                        let name = &symbol.name;
                        assert!(
                            (found - closed).abs() <= ROUNDING * size,
                            "{}, {}: {name} is {found}, its closed form {closed}",
                            scene.display(),
                            case.label
                        );
                        values += 1;
                    }
                }
            }
        }
    });
    assert!(runs >= 5 && values > 200, "{runs} runs have closed forms, {values} values");
}

#[test]
fn spans_end_where_something_happens_and_nowhere_else() {
    let spans = |name: &str| {
        let (study, cases) = scenes::motions_called(name);
        let study = study.with(&cases[0].parameters);
        let solved = solved(&study, &cases[0].run);
        let text = |stretch| span(&study, stretch).expect("a span").to_plain().replace('\u{a0}', " ");
        solved.iter().map(text).collect::<Vec<_>>()
    };
    // The kick ends at a time that the scene says, and nothing comes after it.
    assert_eq!(spans("04-kicked-ball"), ["from t = 0 s to 0.01 s", "from t = 0.01 s on"]);
    assert_eq!(spans("03-bouncing-rod"), ["from t = 0 s to the next event"]);
    // An event that changes nothing, the apex, ends nothing.
    assert_eq!(spans("02-thrown-rod"), [""]);
}

/// What is told with the numbers of one run is what that run does, everywhere between the instants that it is told for.
#[test]
fn phases_with_numbers_are_what_the_motion_does() {
    let (mut phases, mut values) = (0, 0);
    each_run(|scene, _, case| {
        for stretch in super::numeric::stretches(&case.run, usize::MAX) {
            phases += 1;
            let first = stretch.pieces[0];
            let states = case.run.equations.states(&case.run.trajectory().modes[first.mode]);
            let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
            let mut observer = case.run.observe(&formulas).expect("states");
            for instant in 1..INSTANTS {
                let elapsed = (stretch.until - first.start) * instant as f64 / INSTANTS as f64;
                let found = observer.at(first.start + elapsed, Side::After).expect("a time of the run");
                for (row, found) in first.states.iter().zip(found) {
                    let told = super::numeric::without_rounding(row, stretch.length());
                    let told = told.iter().rev().fold(0.0, |sum, part| sum * elapsed + part);
                    let size = found.abs().max(1.0);
                    assert!((told - found).abs() <= ROUNDING * size, "{}: {told} {found}", scene.display());
                    values += 1;
                }
            }
        }
    });
    assert!(phases > 20 && values > 1000, "{phases} {values}");
}

#[test]
fn an_angle_that_stays_is_told_in_degrees_too_and_a_rate_is_not() {
    let (study, cases) = crate::scenes::motions_called("17-block-on-a-slope");
    let study = study.with(&cases[0].parameters);
    let names = Names::of(&study).expect("names");
    let kinematics = study.model.bodies[0].kinematics();
    let shown = |symbol: &Symbol, powers: &[f64]| line(&names, symbol, powers, &Math::symbol("t")).text;
    let [angle, rate] = [kinematics.angle_symbol(), kinematics.omega_symbol()];
    assert_eq!(shown(&angle, &[std::f64::consts::FRAC_PI_2]), "θ = 1.5708 rad\u{a0}(90°)");
    assert_eq!(shown(&angle, &[0.0]), "θ = 0");
    assert!(!shown(&angle, &[0.1, 2.0]).contains('°') && !shown(&rate, &[2.0]).contains('°'));
}
