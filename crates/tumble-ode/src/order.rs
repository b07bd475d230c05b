//! Order of the Taylor steps.
//!
//! A step of order p costs about p^2, and as much again whatever the order, and reaches `h = radius * tolerance^(1/p)`. By p^2
//! alone work per unit of time would be least near `p = ln(1/tolerance) / 2`; measured optima on mechanical systems lie well
//! above it, and beyond them fewer steps are less to keep and to compare.

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
        assert_eq!(order(1e-6), 16);
        assert_eq!(order(1e-12), 26);
        assert_eq!(order(1e-16), 33);
    }
}
