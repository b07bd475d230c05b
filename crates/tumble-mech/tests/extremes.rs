//! Greatest and least values along a motion, against closed forms.

use crate::common::{bouncing_rod, close, hinged_rod, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Binary, Expr, Vector};
use tumble_mech::{Action, Body, Event, Extreme, Gravity, Model, PeakKind, Run, Start, time};
use tumble_ode::{Direction, Side};

const WHOLE: [f64; 2] = [0.0, f64::INFINITY];

#[track_caller]
fn peak(run: &Run, formula: &Expr, which: Extreme, between: [f64; 2]) -> (f64, f64) {
    let found = run.extreme(formula, which, between).map_err(|error| error.to_string());
    let peak = found.expect("no refusal").expect("a value");
    (peak.time, peak.value)
}

/// A stone thrown up at 3 m/s with g = 10 m/s^2.
fn stone() -> (Run, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(10 * M / (S * S));
    let stone = model.add(Body::point("stone").mass(1 * KG));
    model.starts.push(("stone".into(), Start::default().velocity([4 * M / S, 3 * M / S])));
    (run(model, 1.0, 1e-9), stone)
}

#[test]
fn the_top_of_a_throw() {
    let (run, stone) = stone();
    let motion = stone.kinematics();
    let (time, height) = peak(&run, motion.position().y(), Extreme::Greatest, WHOLE);
    close(time, 0.3, 1e-15);
    close(height, 0.45, 1e-15);
    // A window without the top has its extreme at its edge.
    assert_eq!(peak(&run, motion.position().y(), Extreme::Greatest, [0.5, 0.8]).0, 0.5);
    assert_eq!(peak(&run, motion.position().y(), Extreme::Least, [0.1, 0.6]).0, 0.6);
    // Nothing of the motion is there.
    assert_eq!(run.extreme(motion.position().y(), Extreme::Least, [2.0, 3.0]).ok(), Some(None));
}

#[test]
fn the_least_speed_of_a_throw() {
    let (run, stone) = stone();
    let (time, speed) = peak(&run, &stone.kinematics().velocity().norm(), Extreme::Least, WHOLE);
    close(time, 0.3, 1e-14);
    close(speed, 4.0, 1e-15);
}

/// A formula with kinks, a jump, and a value that is narrow beside the step: a free flight is one step.
#[test]
fn formulas_that_are_not_smooth() {
    let (run, stone) = stone();
    let y = stone.kinematics().position().y().clone();
    let kinked = -(&y - Expr::from(0.4) * M).abs();
    let (at, value) = peak(&run, &kinked, Extreme::Greatest, WHOLE);
    close(at, 0.2, 1e-12);
    close(value, 0.0, 1e-12);
    // 3 s of a ramp that drops back to zero: its upper end is come as near to as can be told.
    let window = Expr::pulse(&time(), &(0 * S), &(0.7 * S));
    let (at, value) = peak(&run, &(window * time()), Extreme::Greatest, WHOLE);
    close(at, 0.7, 1e-12);
    close(value, 0.7, 1e-12);
    let oscillation = (200 * time() / S).sin();
    let (at, value) = peak(&run, &oscillation, Extreme::Least, WHOLE);
    close(value, -1.0, 1e-14);
    close(at, 1.5 * std::f64::consts::PI / 200.0, 1e-9);
}

/// A flight of 10 s at 1 m/s is one step; no place of it that is looked at by chance is near the peak.
#[test]
fn narrow_peaks_are_found() {
    let mut model = Model::new();
    let stone = model.add(Body::point("stone").mass(1 * KG));
    model.starts.push(("stone".into(), Start::default().velocity([1 * M / S, 0 * M / S])));
    let run = run(model, 10.0, 1e-9);
    let x = stone.kinematics().position().x().clone();
    for width in [1e-2, 3e-5, 1e-9] {
        let of_place = (-((&x - Expr::from(3.3) * M) / (Expr::from(width) * M)).powi(2)).exp();
        let of_time = (-((time() - Expr::from(3.3) * S) / (Expr::from(width) * S)).powi(2)).exp();
        for formula in [of_place, of_time] {
            let (at, value) = peak(&run, &formula, Extreme::Greatest, WHOLE);
            close(at, 3.3, 4e-16);
            close(value, 1.0, (1e-15 / width).powi(2).max(1e-15));
            let (_, least) = peak(&run, &-formula, Extreme::Least, WHOLE);
            assert_eq!(least, -value);
        }
    }
}

/// The peak is where two slopes meet, 1 mm wide, and not where either of them is zero.
#[test]
fn a_narrow_peak_at_a_kink() {
    let (run, _) = stone();
    let steep = (-((time() - Expr::from(0.123_456) * S) / (Expr::from(1e-3) * S)).abs()).exp();
    let (at, value) = peak(&run, &steep, Extreme::Greatest, WHOLE);
    close(at, 0.123_456, 1e-12);
    close(value, 1.0, 1e-9);
}

/// Of equal peaks the first counts, and flat stretches count from where they begin.
#[test]
fn the_first_of_several() {
    let (run, _) = stone();
    let wave = (Expr::from(20.0) * time() / S).sin();
    let (at, _) = peak(&run, &wave, Extreme::Greatest, WHOLE);
    close(at, std::f64::consts::FRAC_PI_2 / 20.0, 1e-9);
    let capped = Expr::binary(Binary::Min, time() / S, Expr::from(0.3));
    close(peak(&run, &capped, Extreme::Greatest, WHOLE).0, 0.3, 1e-12);
    assert_eq!(peak(&run, &Expr::from(7), Extreme::Least, [0.25, 0.5]), (0.25, 7.0));
}

/// What moves the time of an extreme: the bend at a turn, nothing at an edge, the jump at a kink.
#[test]
fn the_kind_of_an_extreme() {
    let (run, stone) = stone();
    let y = stone.kinematics().position().y().clone();
    let kind = |formula: &Expr, window| {
        let found = run.extreme(formula, Extreme::Greatest, window).ok().flatten();
        found.expect("a value").kind
    };
    assert_eq!(kind(&y, WHOLE), PeakKind::Turn { bend: -10.0 });
    assert_eq!(kind(&y, [0.4, 0.8]), PeakKind::Edge);
    assert_eq!(kind(&-(&y - Expr::from(0.4) * M).abs(), WHOLE), PeakKind::Kink);
}

#[test]
fn the_pivot_force_of_a_pendulum() {
    let (mut model, rod) = hinged_rod();
    model.starts.push(("rod".into(), Start::default().angle(Expr::pi() / 2)));
    let run = run(model, 3.0, 1e-12);
    // Falling from the horizontal, omega^2 = 3 g/L at the bottom.
    let (_, fastest) = peak(&run, &rod.kinematics().omega(), Extreme::Greatest, WHOLE);
    close(fastest, (3.0_f64 * 9.81).sqrt(), 1e-12);
    let (_, slowest) = peak(&run, &rod.kinematics().omega(), Extreme::Least, WHOLE);
    close(slowest, -(3.0_f64 * 9.81).sqrt(), 1e-12);
    // At the bottom the centre has the acceleration omega^2 L/2 upwards.
    let [_, ay] = rod.kinematics().acceleration_symbols();
    let (_, lift) = peak(&run, &ay.into(), Extreme::Greatest, WHOLE);
    close(lift, 1.5 * 9.81, 1e-11);
}

/// What an impact reverses is greatest just before it, in the phase that ends there.
#[test]
fn both_sides_of_an_impact_count() {
    let run = run(bouncing_rod(rigid(0.5)), 1.0, 1e-12);
    let body = &run.equations.model().bodies[0];
    let vy = body.kinematics().velocity().y().clone();
    let first = run.contacts()[0].start;
    let found = run.extreme(&vy, Extreme::Least, [0.0, first + 1e-3]).ok().flatten().expect("a value");
    assert_eq!((found.time, found.side), (first, Side::Before));
    close(found.value, -9.81 * first, 1e-12);
}

/// A run that ends with an impact ends after it.
#[test]
fn the_end_is_after_what_happens_there() {
    let mut model = bouncing_rod(rigid(0.5));
    let when = model.pairs()[0].gap_rate().clone();
    let action = Action::Stop;
    model.events.push(Event { name: "up".into(), when, direction: Direction::Rising, action });
    let run = run(model, 1.0, 1e-12);
    let contact = run.contacts()[0].clone();
    assert_eq!(run.trajectory().end(), Some(contact.start));
    let rate = run.equations.pairs()[contact.pair].gap_rate();
    let mut observer = run.observe(&[rate]).expect("a formula of the motion");
    let mut at = |side| observer.at(contact.start, side).expect("within the motion")[0];
    close(at(Side::After), -0.5 * at(Side::Before), 1e-12);
}

#[test]
fn a_length_that_stays_zero_and_one_without_a_value() {
    let mut model = Model::new();
    let stone = model.add(Body::point("stone").mass(1 * KG));
    let run = run(model, 1.0, 1e-9);
    let velocity: Vector = stone.kinematics().velocity();
    assert_eq!(peak(&run, &velocity.norm(), Extreme::Greatest, WHOLE), (0.0, 0.0));
    let none = (time() / S - 2).sqrt();
    assert!(run.extreme(&none, Extreme::Greatest, WHOLE).is_err());
}
