//! The peer: Dormand and Prince's eighth-order method with dense output off and no events, from another crate.

use ode_solvers::dop_shared::OutputType;
use ode_solvers::dop853::Dop853;
use ode_solvers::{SVector, System};

use crate::problems::Problem;

/// How finely tolerances are tried, from 1e-4 to 1e-15.
const TOLERANCES_A_DECADE: u32 = 8;

type State = SVector<f64, 6>;

#[derive(Clone, Copy)]
struct Rates(fn(&[f64; 6]) -> [f64; 6]);

impl System<f64, State> for Rates {
    fn system(&self, _: f64, y: &State, dy: &mut State) {
        let rates = (self.0)(y.as_ref());
        dy.iter_mut().zip(rates).for_each(|(slot, rate)| *slot = rate);
    }
}

/// The loosest tolerance at which the peer's error is no larger than `error`, or, where it never is, that of its best; with
/// the error there.
pub(crate) fn tolerance(problem: &Problem, error: f64) -> (f64, f64) {
    let mut best = (f64::NAN, f64::INFINITY);
    for exponent in 4 * TOLERANCES_A_DECADE..=15 * TOLERANCES_A_DECADE {
        let tolerance = 10.0_f64.powf(-f64::from(exponent) / f64::from(TOLERANCES_A_DECADE));
        let found = solve(problem, tolerance);
        if found < best.1 {
            best = (tolerance, found);
        }
        if found <= error {
            break;
        }
    }
    best
}

/// The peer's error at a tolerance.
pub(crate) fn solve(problem: &Problem, tolerance: f64) -> f64 {
    let until = problem.until();
    let start = State::from(problem.start);
    // The code's own defaults, but the steps' ends instead of interpolated output.
    let (safety, beta, least, most) = (0.9, 0.0, 0.333, 6.0);
    let mut stepper = Dop853::from_param(
        Rates(problem.rates),
        0.0,
        until,
        until,
        start,
        tolerance,
        tolerance,
        safety,
        beta,
        least,
        most,
        until,
        0.0,
        1_000_000,
        1000,
        OutputType::Sparse,
    );
    match stepper.integrate() {
        Ok(_) => {
            let last = stepper.y_out().last().copied().unwrap_or(start);
            let states: Vec<f64> = problem.order.iter().map(|index| last[*index]).collect();
            problem.peer_error(&states)
        }
        Err(_) => f64::INFINITY,
    }
}
