//! Polynomials on [0, 1] in Bernstein form, whose coefficients enclose the values.
//!
//! The polynomial lies between its least and largest coefficient, and has at most as many roots in (0, 1) as its
//! coefficients have changes of sign, and as many but for an even number (Descartes' rule).

/// Coefficients b_0 .. b_n; b_0 and b_n are the values at 0 and 1.
#[derive(Clone, Debug)]
pub(crate) struct Bernstein(pub(crate) Vec<f64>);

impl Bernstein {
    /// From coefficients of powers, lowest first: `b_i = sum over k <= i of C(i,k) / C(n,k) a_k`.
    pub(crate) fn new(powers: &[f64]) -> Self {
        let n = powers.len() - 1;
        // In place: repeated sums of a_k / C(n,k) are the binomial sums.
        let mut b: Vec<f64> = powers.to_vec();
        let mut choose = 1.0;
        for (k, a) in b.iter_mut().enumerate().skip(1) {
            choose *= (n + 1 - k) as f64 / k as f64;
            *a /= choose;
        }
        for level in 1..=n {
            for i in (level..=n).rev() {
                b[i] += b[i - 1];
            }
        }
        Self(b)
    }

    /// Changes of sign among the coefficients that are larger than `noise`.
    pub(crate) fn sign_changes(&self, noise: f64) -> usize {
        let signs: Vec<bool> = self.0.iter().filter(|b| b.abs() > noise).map(|b| *b > 0.0).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// The halves on [0, 1/2] and [1/2, 1], each stretched to [0, 1], by de Casteljau's averages.
    pub(crate) fn halves(&self) -> (Self, Self) {
        let mut right = self.0.clone();
        let mut left = Vec::with_capacity(right.len());
        let n = right.len();
        for level in 0..n {
            left.push(right[0]);
            for i in 0..n - 1 - level {
                right[i] = 0.5 * (right[i] + right[i + 1]);
            }
        }
        (Self(left), Self(right))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::value;

    #[test]
    fn ends_are_values_and_halves_agree() {
        let p = [1.0, -3.0, 0.5, 2.0, -0.25];
        let b = Bernstein::new(&p);
        assert_eq!(b.0[0], 1.0);
        assert!((b.0[4] - value(&p, 1.0)).abs() < 1e-15);
        let (left, right) = b.halves();
        assert!((left.0[4] - value(&p, 0.5)).abs() < 1e-15);
        assert_eq!(left.0[4], right.0[0]);
        assert_eq!(b.sign_changes(0.0), 2);
    }
}
