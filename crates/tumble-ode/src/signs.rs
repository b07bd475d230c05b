//! Signs of series that are zero, or nearly, where they are read.

use crate::polynomial;
use crate::radius::of_own_size;

/// A coefficient below this part of the largest, each times its power of the reach, is rounding.
const SIGNIFICANT: f64 = 64.0 * f64::EPSILON;
/// Part of a series' terms below which its value is zero but for rounding.
const ZERO_PART: f64 = 1e-10;
/// How far back from the end of a step the sign of what is zero there is read.
const STEP_BACK: f64 = 1.0 / 1024.0;

/// Sign of a series at the end of a step, or just before where it is zero there.
pub(crate) fn sign_before(series: &[f64], length: f64) -> f64 {
    let terms = series.iter().rev().fold(0.0, |sum, c| sum * length + c.abs());
    let end = polynomial::value(series, length);
    if end.abs() > ZERO_PART * terms {
        end.signum()
    } else {
        sign(polynomial::value(series, length * (1.0 - STEP_BACK)))
    }
}

/// Of zero it is zero: what stays there is on neither side.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

/// Sign of a series at its start, or just after where it is zero there.
pub(crate) fn sign_after(series: &[f64]) -> f64 {
    let reach = of_own_size(&series[1..], 1.0);
    let terms = series.iter().rev().fold(0.0, |sum, c| sum * reach + c.abs());
    if series[0].abs() > ZERO_PART * terms { series[0].signum() } else { leading_sign(&series[1..]) }
}

/// Sign of the first coefficient that is more than rounding, on a stretch where the series is a few times its first term.
pub(crate) fn leading_sign(series: &[f64]) -> f64 {
    leading(series).map_or(0.0, |k| series[k].signum())
}

/// Index of that coefficient.
pub(crate) fn leading(series: &[f64]) -> Option<usize> {
    let first = series.iter().position(|c| *c != 0.0)?;
    let reach = of_own_size(series, 1.0);
    let term = |k: usize| (series[k] * libm::pow(reach, k as f64)).abs();
    let largest = (first..series.len()).map(term).fold(0.0, f64::max);
    (first..series.len()).find(|k| term(*k) > SIGNIFICANT * largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_term_that_matters_gives_the_sign() {
        assert_eq!(leading_sign(&[0.0, -2.0, 1.0]), -1.0);
        let noisy: Vec<f64> = [1e-17].into_iter().chain((1..12).map(|k| -0.5_f64.powi(k))).collect();
        assert_eq!(leading_sign(&noisy), -1.0);
        assert_eq!(leading_sign(&[0.0; 4]), 0.0);
    }

    #[test]
    fn before_and_after_a_zero() {
        // (1 - s)^2 comes down to zero from above at s = 1; (s - 1) from below.
        assert_eq!(sign_before(&[1.0, -2.0, 1.0], 1.0), 1.0);
        assert_eq!(sign_before(&[-1.0, 1.0], 1.0), -1.0);
        assert_eq!(sign_after(&[1e-17, 0.0, -3.0]), -1.0);
        assert_eq!(sign_after(&[2.0, -3.0]), 1.0);
        assert_eq!(sign_before(&[0.0, 0.0], 1.0), 0.0);
    }
}
