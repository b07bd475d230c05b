//! Polynomials by their coefficients, lowest order first.

use smallvec::smallvec;
use tumble_expr::Row;

/// Value at `s`, by Horner's rule.
pub(crate) fn value(coefficients: &[f64], s: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Value at `s` less the value at 0.
pub(crate) fn increment(coefficients: &[f64], s: f64) -> f64 {
    value(coefficients.get(1..).unwrap_or_default(), s) * s
}

/// The sum of the sizes of what it changes by up to `s`.
pub(crate) fn change(coefficients: &[f64], s: f64) -> f64 {
    coefficients.iter().skip(1).rev().fold(0.0, |sum, c| (sum + c.abs()) * s)
}

/// The polynomial from another point on.
pub(crate) fn shifted(coefficients: &[f64], by: f64) -> Row {
    shifted_up_to(coefficients, by, coefficients.len())
}

/// So many of its lowest coefficients: Horner's rule with `s + by`, in which no coefficient waits for another.
pub(crate) fn shifted_up_to(coefficients: &[f64], by: f64, most: usize) -> Row {
    let mut shifted: Row = smallvec![0.0; most];
    let p = &mut shifted[..];
    for (known, c) in coefficients.iter().rev().enumerate() {
        for k in (1..=known.min(most - 1)).rev() {
            p[k] = p[k - 1] + by * p[k];
        }
        p[0] = c + by * p[0];
    }
    shifted
}

/// Coefficients of the derivative.
pub(crate) fn derivative(coefficients: &[f64]) -> Row {
    coefficients.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect()
}

/// Derivative at `s`.
pub(crate) fn slope(coefficients: &[f64], s: f64) -> f64 {
    let terms = coefficients.iter().enumerate().skip(1).rev();
    terms.fold(0.0, |sum, (k, c)| sum * s + k as f64 * c)
}

/// Value and derivative at `s`, and the sum of the sizes of the derivative's terms: what its rounding error is relative to.
///
/// In two chains, of even and of odd powers, that do not wait for each other.
pub(crate) fn look(coefficients: &[f64], s: f64) -> [f64; 3] {
    let square = s * s;
    let (mut even, mut odd) = ([0.0; 3], [0.0; 3]);
    let add = |[value, slope, size]: &mut [f64; 3], k: usize, c: f64, power: f64, before: f64| {
        let term = k as f64 * c * before;
        *value += c * power;
        *slope += term;
        *size += term.abs();
    };
    // Powers of even orders and of those after them, and the powers before these.
    let (mut power, mut before) = (1.0, 0.0);
    for (pair, cs) in coefficients.chunks(2).enumerate() {
        add(&mut even, 2 * pair, cs[0], power, before);
        if let Some(c) = cs.get(1) {
            add(&mut odd, 2 * pair + 1, *c, power * s, power);
        }
        before = power * s;
        power *= square;
    }
    std::array::from_fn(|i| even[i] + odd[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_increment_and_slope() {
        let p = [1.0, -2.0, 0.5, 3.0];
        assert_eq!(value(&p, 2.0), 23.0);
        assert_eq!(increment(&p, 2.0), 22.0);
        assert_eq!(shifted(&p, 2.0)[..], [23.0, 36.0, 18.5, 3.0]);
        assert_eq!(slope(&p, 2.0), -2.0 + 2.0 + 36.0);
        assert_eq!(look(&p, -2.0), [value(&p, -2.0), slope(&p, -2.0), 2.0 + 2.0 + 36.0]);
        assert_eq!(look(&p[..3], 2.0), [value(&p[..3], 2.0), 0.0, 4.0]);
        assert_eq!((value(&[], 2.0), increment(&[], 2.0), slope(&[7.0], 2.0)), (0.0, 0.0, 0.0));
    }
}
