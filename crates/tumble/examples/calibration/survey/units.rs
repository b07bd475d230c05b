//! The size of a problem and the units that it is written in.

use super::draw::Draw;
use super::real::Real;

/// Powers of length, time and mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measure(pub(crate) [i32; 3]);

/// A pure number, or an angle in radians.
pub(crate) const NUMBER: Measure = Measure([0, 0, 0]);
pub(crate) const LENGTH: Measure = Measure([1, 0, 0]);
pub(crate) const TIME: Measure = Measure([0, 1, 0]);
pub(crate) const MASS: Measure = Measure([0, 0, 1]);
pub(crate) const RATE: Measure = Measure([0, -1, 0]);
pub(crate) const SPEED: Measure = Measure([1, -1, 0]);
pub(crate) const ACCELERATION: Measure = Measure([1, -2, 0]);
pub(crate) const FORCE: Measure = Measure([1, -2, 1]);
pub(crate) const STIFFNESS: Measure = Measure([0, -2, 1]);
pub(crate) const DAMPING: Measure = Measure([0, -1, 1]);
/// Of Hunt and Crossley's damping.
pub(crate) const SLOWNESS: Measure = Measure([-1, 1, 0]);
pub(crate) const MOMENTUM: Measure = Measure([1, -1, 1]);
pub(crate) const ENERGY: Measure = Measure([2, -2, 1]);

/// Names of units of length, time and mass with their powers of ten in SI units.
type Word = (&'static str, i32);
const SI: [Word; 3] = [("m", 0), ("s", 0), ("kg", 0)];
const LENGTHS: [Word; 5] = [("m", 0), ("km", 3), ("cm", -2), ("mm", -3), ("um", -6)];
const TIMES: [Word; 3] = [("s", 0), ("ms", -3), ("us", -6)];
const MASSES: [Word; 4] = [("kg", 0), ("t", 3), ("g", -3), ("mg", -6)];

/// Share of the problems that people would call ordinary: metres, seconds and kilograms, and numbers near one.
const ORDINARY: f64 = 0.2;
/// Sizes of other problems, in SI units.
const SCALES: [f64; 2] = [1e-3, 1e6];

/// The size of a problem and the units that it is written in.
#[derive(Clone, Debug)]
pub(crate) struct Units {
    scales: [f64; 3],
    words: [Word; 3],
}

impl Units {
    pub(crate) fn random(draw: &mut Draw) -> Self {
        if draw.chance(ORDINARY) {
            return Self { scales: [1.0; 3], words: SI };
        }
        let scales = [0; 3].map(|_| draw.log_between(SCALES[0], SCALES[1]));
        Self { scales, words: [draw.pick(&LENGTHS), draw.pick(&TIMES), draw.pick(&MASSES)] }
    }

    /// What is one in the problem's own size, in SI units.
    pub(crate) fn size(&self, Measure(powers): Measure) -> f64 {
        self.scales.iter().zip(powers).map(|(scale, power)| scale.powi(power)).product()
    }

    /// A unit of the measure, and how many SI units it has.
    pub(crate) fn written(&self, measure: Measure) -> (String, Real) {
        written(&self.words, measure)
    }

    /// The SI unit of the measure.
    pub(crate) fn standard(measure: Measure) -> (String, Real) {
        written(&SI, measure)
    }
}

fn written(words: &[Word; 3], Measure(powers): Measure) -> (String, Real) {
    let with = |power: i32, word: &str| if power == 1 { word.to_owned() } else { format!("{word}^{power}") };
    let factors = || powers.into_iter().zip(words);
    let above: Vec<String> =
        factors().filter(|(power, _)| *power > 0).map(|(power, (word, _))| with(power, word)).collect();
    let below = factors().filter(|(power, _)| *power < 0).map(|(power, (word, _))| with(-power, word));
    let one = if above.is_empty() { "1".to_owned() } else { above.join("*") };
    let text = below.fold(one, |text, factor| format!("{text}/{factor}"));
    let ten = factors().map(|(power, (_, tens))| power * tens).sum::<i32>();
    (if text == "1" { String::new() } else { text }, Real::from(10).power(ten.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_chains() {
        assert_eq!(Units::standard(FORCE).0, "m*kg/s^2");
        assert_eq!(Units::standard(RATE).0, "1/s");
        assert_eq!(Units::standard(NUMBER).0, "");
        let units = Units { scales: [1.0; 3], words: [("mm", -3), ("ms", -3), ("t", 3)] };
        assert_eq!(units.written(SPEED), ("mm/ms".to_owned(), Real::from(1)));
        assert_eq!(units.written(STIFFNESS).1, Real::from(10).power(9));
    }
}
