//! Bumps with their integrals.

use super::real::Real;

/// exp(-z^2) is below every rounding here from this z on.
const FAR: i64 = 14;

/// The error function.
pub(crate) fn erf(z: &Real) -> Real {
    if z.abs() >= Real::from(FAR) {
        return Real::from(z.sign());
    }
    // 2/sqrt(pi) exp(-z^2) sum of 2^n z^(2n+1)/(1 3 .. (2n+1)): no term is negative (Abramowitz and Stegun 7.1.6).
    let square = z.squared();
    let (mut term, mut sum) = (z.clone(), z.clone());
    for n in 1.. {
        term = term * &square * 2 / (2 * n + 1);
        sum = &sum + &term;
        if term.abs() <= sum.abs() * Real::read("1e-78") {
            break;
        }
    }
    sum * (-square).exp() * 2 / Real::pi().sqrt()
}

/// A bump of height one about zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Bump {
    /// exp(-z^2)
    Gaussian,
    /// 1/(1 + z^2)
    Lorentzian,
    /// 1/cosh^2 z
    Sech,
}

impl Bump {
    pub(crate) const ALL: [Self; 3] = [Self::Gaussian, Self::Lorentzian, Self::Sech];

    /// The formula of z.
    pub(crate) fn formula(self, z: &str) -> String {
        match self {
            Self::Gaussian => format!("exp(-({z})^2)"),
            Self::Lorentzian => format!("1/(1 + ({z})^2)"),
            Self::Sech => format!("1/cosh({z})^2"),
        }
    }

    /// Where it passes a height on its way up and down.
    pub(crate) fn passings(self, height: &Real) -> [Real; 2] {
        let z = match self {
            Self::Gaussian => (-height.ln()).sqrt(),
            Self::Lorentzian => (1 / height - 1).sqrt(),
            // 1/cosh^2 is 1 - tanh^2.
            Self::Sech => (1 - height).sqrt().atanh(),
        };
        [-&z, z]
    }

    /// An integral.
    pub(crate) fn area(self, z: &Real) -> Real {
        match self {
            Self::Gaussian => erf(z) * Real::pi().sqrt() / 2,
            Self::Lorentzian => z.atan(),
            Self::Sech => z.tanh(),
        }
    }

    /// An integral of that.
    pub(crate) fn second(self, z: &Real) -> Real {
        match self {
            Self::Gaussian => z * self.area(z) + (-z.squared()).exp() / 2,
            Self::Lorentzian => z * z.atan() - (z.squared() + 1).ln() / 2,
            // ln cosh z
            Self::Sech => z.abs() + ((z.abs() * -2).exp() + 1).ln() - Real::from(2).ln(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_function() {
        // Abramowitz and Stegun, table 7.1.
        let known =
            [("0.5", "0.5204998778130465"), ("2", "0.9953222650189527"), ("-1", "-0.8427007929497149")];
        for (z, erf_of_z) in known {
            assert_eq!(erf(&Real::read(z)).to_f64(), erf_of_z.parse::<f64>().expect("a number"));
        }
        let edge = Real::from(FAR);
        assert!((1 - erf(&(edge - Real::read("1e-9")))).abs() < Real::read("1e-70"));
    }

    #[test]
    fn integrals_have_their_slopes() {
        let (z, step) = (Real::read("0.8"), Real::read("1e-20"));
        let slope = |of: &dyn Fn(&Real) -> Real| (of(&(&z + &step)) - of(&(&z - &step))) / (&step * 2);
        let heights = [(-z.squared()).exp(), 1 / (z.squared() + 1), 1 / z.cosh().squared()];
        for (bump, height) in Bump::ALL.into_iter().zip(heights) {
            assert!((slope(&|z| bump.area(z)) - height).abs() < Real::read("1e-38"), "{bump:?}");
            assert!((slope(&|z| bump.second(z)) - bump.area(&z)).abs() < Real::read("1e-38"), "{bump:?}");
        }
    }
}
