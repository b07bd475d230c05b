//! Gauss-Legendre quadrature on [-1, 1].

/// Newton steps for a root of a Legendre polynomial: from the usual guess, five reach rounding.
const NEWTON_STEPS: usize = 8;

/// Nodes with weights of the rule of `n` nodes, exact for polynomials of degree 2n - 1.
pub(crate) fn rule(n: usize) -> Vec<(f64, f64)> {
    (0..n).rev().map(|index| node(n, index)).collect()
}

fn node(n: usize, index: usize) -> (f64, f64) {
    let mut x = libm::cos(std::f64::consts::PI * (index as f64 + 0.75) / (n as f64 + 0.5));
    for _ in 0..NEWTON_STEPS {
        let (value, slope) = legendre(n, x);
        x -= value / slope;
    }
    let (_, slope) = legendre(n, x);
    // The middle node is zero but for rounding.
    let x = if 2 * index + 1 == n { 0.0 } else { x };
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// Legendre polynomial and its derivative, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut here) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
    }
    (here, n as f64 * (x * here - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for n in [2, 3, 8, 16, 32] {
            let rule = rule(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = if degree % 2 == 1 { 0.0 } else { 2.0 / (degree as f64 + 1.0) };
                assert!((sum - exact).abs() < 1e-14, "{n} nodes, degree {degree}: {sum}");
            }
        }
    }
}
