//! Elliptic functions by the arithmetic-geometric mean (Abramowitz and Stegun, Handbook of Mathematical Functions, 16.4, 17.6).

use super::real::Real;

/// Steps of the mean: each doubles the digits, so that these are enough for moduli up to 1 - 1e-60.
const STEPS: usize = 12;

/// The functions of one modulus k, from 0 to 1.
#[derive(Clone, Debug)]
pub(crate) struct Elliptic {
    modulus: Real,
    /// a, b and c of each step of the mean.
    means: Vec<[Real; 3]>,
}

/// sn, cn and dn at one argument, and the amplitude.
#[derive(Clone, Debug)]
pub(crate) struct Values {
    pub(crate) amplitude: Real,
    pub(crate) sn: Real,
    pub(crate) cn: Real,
    pub(crate) dn: Real,
}

impl Elliptic {
    /// The functions of the modulus k; `complement` is the square root of 1 - k^2, which loses digits if it is computed
    /// from k.
    pub(crate) fn new(modulus: Real, complement: Real) -> Self {
        let mut means = vec![[Real::from(1), complement, modulus.clone()]];
        for step in 0..STEPS {
            let [a, b, _] = &means[step];
            means.push([(a + b) / 2, (a * b).sqrt(), (a - b) / 2]);
        }
        Self { modulus, means }
    }

    fn mean(&self) -> &Real {
        &self.means[STEPS][0]
    }

    /// A quarter of the period.
    pub(crate) fn quarter(&self) -> Real {
        Real::pi() / 2 / self.mean()
    }

    /// The functions at u.
    pub(crate) fn at(&self, u: &Real) -> Values {
        let mut amplitude = Real::from(2).power(STEPS as i64) * self.mean() * u;
        for [a, _, c] in self.means[1..].iter().rev() {
            amplitude = (&amplitude + (c / a * amplitude.sin()).asin()) / 2;
        }
        let [sn, cn] = [amplitude.sin(), amplitude.cos()];
        let complement = &self.means[0][1];
        let dn = (complement.squared() + (&self.modulus * &cn).squared()).sqrt();
        Values { amplitude, sn, cn, dn }
    }

    /// The argument that has an amplitude: the incomplete integral of the first kind.
    pub(crate) fn argument(&self, amplitude: &Real) -> Real {
        let mut turned = amplitude.clone();
        for [a, b, _] in &self.means[..STEPS] {
            let half_turns = (&turned / Real::pi()).round();
            let rest = &turned - &half_turns * Real::pi();
            // tan(next - turned) = b/a tan(turned), on the same branch.
            let next = (b / a * rest.sin()).atan2(&rest.cos());
            turned = &turned + next + half_turns * Real::pi();
        }
        turned / Real::from(2).power(STEPS as i64) / self.mean()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(modulus: &str) -> Elliptic {
        let modulus = Real::read(modulus);
        let complement = (1 - modulus.squared()).sqrt();
        Elliptic::new(modulus, complement)
    }

    #[test]
    fn known_values() {
        // Abramowitz and Stegun, table 17.1: K for m = 1/2.
        let half = Real::read("0.5").sqrt();
        let found = Elliptic::new(half.clone(), half).quarter();
        let known = Real::read("1.85407467730137191843385034719526005");
        assert!((found - known).abs() < Real::read("1e-34"));
        // Without a modulus they are circular, near 1 hyperbolic.
        let circular = Elliptic::new(Real::zero(), Real::from(1)).at(&Real::read("0.3"));
        assert!((circular.sn - Real::read("0.3").sin()).abs() < Real::read("1e-70"));
        let steep = Elliptic::new(Real::from(1), Real::read("1e-40")).at(&Real::read("0.3"));
        assert!((steep.sn - Real::read("0.3").tanh()).abs() < Real::read("1e-70"));
    }

    #[test]
    fn amplitudes_and_arguments_are_inverse() {
        for modulus in ["0.1", "0.9", "0.99999999"] {
            let functions = of(modulus);
            for u in ["-7.3", "-0.4", "0.2", "3", "11"] {
                let u = Real::read(u);
                let back = functions.argument(&functions.at(&u).amplitude);
                assert!((back - &u).abs() < Real::read("1e-60"), "{modulus} {u:?}");
            }
        }
    }

    #[test]
    fn derivatives_are_right() {
        let functions = of("0.8");
        let (u, step) = (Real::read("1.7"), Real::read("1e-20"));
        let [before, after] = [&u - &step, &u + &step].map(|u| functions.at(&u));
        let here = functions.at(&u);
        let slope = (after.sn - before.sn) / (step * 2);
        assert!((slope - here.cn * here.dn).abs() < Real::read("1e-35"));
    }
}
