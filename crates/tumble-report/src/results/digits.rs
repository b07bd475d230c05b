//! How many digits of a value are verified.

use tumble_expr::Expr;
use tumble_mech::{At, Horizon, Trust};

use crate::results::case::Solution;
use crate::results::told::count;
use crate::results::{CaseError, FindResult};

/// Doubles have no more.
const MOST: f64 = 16.0;

/// Digits of a value that an error leaves.
pub(crate) fn digits(value: f64, error: f64) -> usize {
    let digits = (value / error).abs().log10();
    // No error at all, or nothing known of it.
    if digits.is_nan() { 0 } else { digits.clamp(0.0, MOST) as usize }
}

/// The error stated of a formula at an instant; `None` where nothing is known of it.
pub(crate) fn error(solution: Solution<'_>, formula: &Expr, at: At) -> Result<Option<f64>, CaseError> {
    let Some(trust) = solution.trust else { return Ok(None) };
    Ok(trust.error_at(solution.run, formula, at)?)
}

/// Whether something is known of a formula up to a time, s, or to the end of the motion if that is earlier.
pub(crate) fn are_known_to(solution: Solution<'_>, formula: &Expr, time: f64) -> Result<bool, CaseError> {
    let Some(trust) = solution.trust else { return Ok(true) };
    let end = solution.run.end().unwrap_or(0.0);
    Ok(trust.known_until(solution.run, formula)? >= time.min(end))
}

impl FindResult {
    /// How many digits are verified, or how near it is where none is: `11 digits`, `within 2e-13`, `no digit is known`.
    pub fn certainty(&self) -> String {
        let Some(error) = self.error else { return "no digit is known".to_owned() };
        match digits(self.value, error) {
            _ if error == 0.0 => "exact".to_owned(),
            0 => format!("within {error:.0e}"),
            held => count(held as u64, "digit"),
        }
    }
}

/// How far a motion can be trusted, as the check runs told.
#[derive(Clone, Debug)]
pub struct Held {
    /// Accuracy that was asked for.
    pub asked: f64,
    /// Accuracy that steps were held to in the end.
    pub used: f64,
    /// Largest error of a position, an angle or a rate, in units of its scale, up to the end or the horizon.
    pub reached: f64,
    /// Where the digits end, if they do before the motion does.
    pub horizon: Option<Horizon>,
}

impl Held {
    pub(crate) fn of(trust: &Trust) -> Self {
        let Trust { asked, used, reached, horizon, .. } = trust;
        Self { asked: *asked, used: *used, reached: *reached, horizon: horizon.clone() }
    }

    /// Time up to which digits are verified, s; infinite where that is the whole motion.
    pub fn verified_until(&self) -> f64 {
        self.horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time)
    }

    /// In a few words: `11 digits`, `7 digits of the 9 asked for`, `digits up to 12 s`.
    pub fn words(&self) -> String {
        if let Some(horizon) = &self.horizon {
            return format!("digits up to {:.4} s", horizon.time);
        }
        let (held, asked) = (digits(1.0, self.reached), digits(1.0, self.asked));
        match self.reached <= self.asked {
            true => format!("{held} digits"),
            false => format!("{held} digits of the {asked} asked for"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_before_the_error() {
        assert_eq!(digits(0.31634, 2e-13), 12);
        assert_eq!(digits(-120.0, 0.5), 2);
        assert_eq!(digits(1e-20, 1e-15), 0);
        assert_eq!(digits(1.0, 0.0), 16);
        assert_eq!(digits(1.0, f64::NAN), 0);
        assert_eq!(digits(0.0, 0.0), 0);
    }
}
