//! Order of the Taylor steps.
//!
//! A step of order p costs about p^2 and reaches `h = radius * tolerance^(1/p)`. Work per unit of time, `p^2 / h`, is
//! least near `p = ln(1/tolerance) / 2`; measured optima on mechanical systems lie somewhat above it.

/// Slope and offset of the measured optimum in `ln(1/tolerance)`.
const SLOPE: f64 = 0.75;
const OFFSET: f64 = 5.0;

/// The order for a local tolerance below 1.
pub(crate) fn order(tolerance: f64) -> usize {
    (SLOPE * -libm::log(tolerance) + OFFSET).ceil() as usize
}

/// Step that makes the last term as small as the tolerance, in units of the radius.
pub(crate) fn reach(tolerance: f64, order: usize) -> f64 {
    libm::pow(tolerance, 1.0 / order as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_grows_with_the_digits() {
        assert_eq!(order(1e-6), 12);
        assert_eq!(order(1e-12), 21);
        assert_eq!(order(1e-16), 26);
    }
}
