//! How far a Taylor expansion reaches, read from many of its coefficients.
//!
//! With S the scale of a series, `(S / |c_k|)^(1/k)` tends to the radius of convergence along the coefficients that
//! matter. Reading only the last two fails where series have gaps (a pendulum released at a right angle has only every
//! fourth coefficient), so the smallest value over the upper half of the orders is taken. Coefficients that are zero
//! say nothing.

use tumble_expr::Row;

/// Radius of one series of that scale, infinite where all the coefficients read are zero; a scale of zero stands for the
/// series' own size.
pub(crate) fn of_series(series: &[f64], scale: f64) -> f64 {
    if scale == 0.0 {
        return of_own_size(series, f64::INFINITY);
    }
    let scale = logarithm(scale);
    let reach = |k: usize| (scale - logarithm(series[k])) / k as f64;
    libm::exp2(upper(series, 0).filter(|k| series[*k] != 0.0).map(reach).fold(f64::INFINITY, f64::min))
}

/// Radius of a series measured against itself; `most` where it is not less than that.
///
/// `(|c_j| / |c_k|)^(1/(k-j))` estimates the radius for each pair; of the lower orders j the one that gives most is the
/// one that is not small by accident (by symmetry, or because it is nothing but rounding).
///
/// One with coefficients beyond the range of numbers tells nothing, and limits nothing: what it misses is seen when the step
/// is looked at as a whole.
pub(crate) fn of_own_size(series: &[f64], most: f64) -> f64 {
    if !series.iter().all(|c| c.is_finite()) {
        return most;
    }
    let Some(first) = series.iter().position(|c| *c != 0.0) else { return most };
    let middle = ((series.len() - 1) / 2).max(first);
    let lower = |k: usize| (first..=middle.min(k - 1)).filter(|j| series[*j] != 0.0);
    let sizes: Row = series.iter().map(|c| logarithm(*c)).collect();
    let pair = |j: usize, k: usize| (sizes[j] - sizes[k]) / (k - j) as f64;
    let limit = if most.is_finite() { logarithm(most) } else { f64::INFINITY };
    let least = upper(series, first).filter(|k| series[*k] != 0.0).fold(limit, |least, k| {
        // The first that gives no less than is known already is enough.
        let mut largest = f64::NEG_INFINITY;
        for j in lower(k) {
            largest = pair(j, k).max(largest);
            if largest >= least {
                return least;
            }
        }
        largest
    });
    if least < limit { libm::exp2(least) } else { most }
}

/// The binary logarithm of a size, from its exponent and, between powers of two, in a straight line: off by less than 0.09, which
/// the root of an order above ten makes a percent.
fn logarithm(value: f64) -> f64 {
    const EXPONENT_BITS: f64 = (1_u64 << (f64::MANTISSA_DIGITS - 1)) as f64;
    const BIAS: f64 = (f64::MAX_EXP - 1) as f64;
    value.abs().to_bits() as f64 / EXPONENT_BITS - BIAS
}

/// The orders read: the upper half, and beyond the lowest that is not zero.
fn upper(series: &[f64], first: usize) -> std::ops::RangeInclusive<usize> {
    let last = series.len() - 1;
    last.div_ceil(2).max(first + 1)..=last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_geometric_series_has_its_radius() {
        let series: Vec<f64> = (0..20).map(|k| 3.0 * 0.5_f64.powi(k)).collect();
        assert!((of_series(&series, 3.0) - 2.0).abs() < 1e-12);
        assert!((of_series(&series, 0.0) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn gaps_do_not_hide_the_radius() {
        let gap = |k: i32| if k % 4 == 2 { 0.5_f64.powi(k) } else { 0.0 };
        for length in 18..24 {
            let series: Vec<f64> = (0..length).map(gap).collect();
            assert!((of_series(&series, 1.0) - 2.0).abs() < 1e-12, "{length} coefficients");
        }
    }

    #[test]
    fn a_low_order_that_is_small_by_accident_does_not_matter() {
        let mut series: Vec<f64> = (0..20).map(|k| 1e-17 * 0.5_f64.powi(k)).collect();
        series[0] = 1e-200;
        series[1] = 0.0;
        assert!((of_own_size(&series, f64::INFINITY) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_to_read_is_infinite() {
        assert_eq!(of_series(&[1.0, 2.0, 0.0, 0.0, 0.0, 0.0], 1.0), f64::INFINITY);
        assert_eq!(of_series(&[0.0; 6], 0.0), f64::INFINITY);
    }
}
