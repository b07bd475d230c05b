//! Polynomials on [0, 1] in Bernstein form, whose coefficients enclose the values.
//!
//! The polynomial lies between its least and largest coefficient, and has at most as many roots in (0, 1) as its
//! coefficients have changes of sign, and as many but for an even number (Descartes' rule).

use smallvec::SmallVec;

/// Coefficients of one polynomial that is needed for a moment: up to this degree, which no step but an exact one exceeds, they
/// stand on the stack.
pub type Row = SmallVec<[f64; 40]>;

/// Halvings until a polynomial is said to come to zero.
const HALVINGS: u32 = 3;

/// Coefficients b_0 .. b_n; b_0 and b_n are the values at 0 and 1.
#[derive(Clone, Debug)]
pub struct Bernstein(pub Row);

impl Bernstein {
    /// From coefficients of powers, lowest first: `b_i = sum over k <= i of C(i,k) / C(n,k) a_k`.
    pub fn new(powers: impl IntoIterator<Item = f64>) -> Self {
        // In place: repeated sums of a_k / C(n,k) are the binomial sums.
        let mut coefficients: Row = powers.into_iter().collect();
        let b = &mut coefficients[..];
        let n = b.len() - 1;
        let mut choose = 1.0;
        for (k, a) in b.iter_mut().enumerate().skip(1) {
            choose *= (n + 1 - k) as f64 / k as f64;
            *a /= choose;
        }
        for level in 1..=n {
            let mut before = b[level - 1];
            for sum in &mut b[level..] {
                let own = *sum;
                *sum += before;
                before = own;
            }
        }
        Self(coefficients)
    }

    /// Changes of sign among the coefficients that are larger than `noise`.
    pub fn sign_changes(&self, noise: f64) -> usize {
        let mut signs = self.0.iter().filter(|b| b.abs() > noise).map(|b| *b > 0.0);
        let Some(mut before) = signs.next() else { return 0 };
        signs.filter(|sign| std::mem::replace(&mut before, *sign) != *sign).count()
    }

    /// The halves on [0, 1/2] and [1/2, 1], each stretched to [0, 1], by de Casteljau's averages.
    pub fn halves(&self) -> (Self, Self) {
        let (mut left, mut right) = (self.clone(), self.clone());
        let (low, high) = (&mut left.0[..], &mut right.0[..]);
        for (level, low) in low.iter_mut().enumerate() {
            *low = high[0];
            for i in 0..high.len() - 1 - level {
                high[i] = 0.5 * (high[i] + high[i + 1]);
            }
        }
        (left, right)
    }

    /// A lower bound of the polynomial's size; 0 where it may have a zero.
    pub fn least(&self) -> f64 {
        self.least_within(HALVINGS)
    }

    fn least_within(&self, halvings: u32) -> f64 {
        let first = self.0.first().copied().unwrap_or(0.0);
        if self.0.iter().all(|b| b * first > 0.0) {
            return self.0.iter().fold(f64::INFINITY, |least, b| least.min(b.abs()));
        }
        let last = self.0.last().copied().unwrap_or(0.0);
        if halvings == 0 || first * last <= 0.0 {
            return 0.0;
        }
        let (left, right) = self.halves();
        match left.least_within(halvings - 1) {
            0.0 => 0.0,
            left => left.min(right.least_within(halvings - 1)),
        }
    }

    /// The polynomial over `1 - x`, where it is zero at 1: what is not zero there but for rounding is left out.
    pub fn without_end(&self) -> Self {
        let n = self.0.len() - 1;
        Self(self.0[..n].iter().enumerate().map(|(i, b)| b * n as f64 / (n - i) as f64).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_values_and_halves_agree() {
        let value = |p: &[f64], x: f64| p.iter().rev().fold(0.0, |sum, c| sum * x + c);
        let p = [1.0, -3.0, 0.5, 2.0, -0.25];
        let b = Bernstein::new(p);
        assert_eq!(b.0[0], 1.0);
        assert!((b.0[4] - value(&p, 1.0)).abs() < 1e-15);
        let (left, right) = b.halves();
        assert!((left.0[4] - value(&p, 0.5)).abs() < 1e-15);
        assert_eq!(left.0[4], right.0[0]);
        assert_eq!(b.sign_changes(0.0), 2);
    }

    #[test]
    fn the_least_size_is_a_lower_bound() {
        // (x - 1/2)^2 + 1/100, and the same with a zero.
        let least = |rest: f64| Bernstein::new([0.25 + rest, -1.0, 1.0]).least();
        assert!((0.005..=0.01 + 1e-15).contains(&least(0.01)), "{}", least(0.01));
        assert_eq!((least(0.0), least(-0.01)), (0.0, 0.0));
        assert_eq!(Bernstein::new([-1.0, 2.0]).least(), 0.0);
        // (1 - x)(2 + x)
        assert_eq!(Bernstein::new([2.0, -1.0, -1.0]).without_end().0[..], [2.0, 3.0]);
    }
}
