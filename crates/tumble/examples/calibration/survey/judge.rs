//! A stated error held against the true one.

use super::measure::Answer;
use super::real::Real;
use super::setup::Asked;

/// A value with its verdict.
#[derive(Clone, Debug)]
pub(crate) struct Judged {
    pub(crate) name: String,
    pub(crate) what: String,
    pub(crate) truth: f64,
    pub(crate) value: f64,
    pub(crate) verdict: Verdict,
}

/// What can be said of a stated error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// Both errors are known.
    Stated(Errors),
    /// The value is there, and nothing is stated of it.
    Unknown,
    /// There is no value, though the motion is known to its end: something that happens was not found.
    Missed,
}

/// The error that is stated of a value and the true one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Errors {
    pub(crate) stated: f64,
    pub(crate) real: f64,
    /// Distance from the value to the next double.
    pub(crate) ulp: f64,
    /// The same for a value of its size, where it is truly zero: a true error below it is rounding.
    pub(crate) rounding: f64,
}

impl Errors {
    /// Whether the true error is larger than what is stated and the half ulp that any double is off.
    pub(crate) fn is_exceeded(&self) -> bool {
        self.real > self.stated + self.ulp / 2.0
    }

    /// How many times what is stated the true error is.
    pub(crate) fn excess(&self) -> f64 {
        self.real / (self.stated + self.ulp / 2.0)
    }

    /// How many times the true error what is stated is; `None` where the true one is rounding.
    pub(crate) fn ratio(&self) -> Option<f64> {
        (self.real > self.rounding).then_some(self.stated / self.real)
    }
}

/// Holds an answer against the truth.
pub(crate) fn judge(asked: &Asked, answer: Answer) -> Judged {
    let verdict = match (answer.value, answer.stated) {
        (None, _) if answer.is_known => Verdict::Missed,
        (Some(value), Some(stated)) => Verdict::Stated(errors(value, stated, asked)),
        _ => Verdict::Unknown,
    };
    Judged {
        name: asked.name.clone(),
        what: asked.what.clone(),
        truth: asked.truth.to_f64(),
        value: answer.value.unwrap_or(f64::NAN),
        verdict,
    }
}

fn errors(value: f64, stated: f64, Asked { truth, size, .. }: &Asked) -> Errors {
    let real = (Real::of(value) - truth).abs().to_f64();
    let ulp = |value: f64| value.next_up() - value;
    Errors { stated, real, ulp: ulp(value.abs()), rounding: ulp(value.abs().max(*size)) }
}

#[cfg(test)]
mod tests {
    use super::super::setup::Place;
    use super::*;

    fn asked(truth: &str, size: f64) -> Asked {
        let (name, what) = Default::default();
        Asked { name, place: Place::Find, what, truth: Real::read(truth), size }
    }

    fn of(value: f64, stated: f64) -> Errors {
        errors(value, stated, &asked("0.1", 0.0))
    }

    #[test]
    fn what_is_truly_zero_has_the_rounding_of_its_size() {
        let zero = |value: f64| errors(value, 1e-12, &asked("0", 1.0));
        assert_eq!(zero(1e-16).ratio(), None);
        assert!(zero(1e-15).ratio().is_some());
        assert!(errors(1e-16, 1e-17, &asked("0", 1.0)).is_exceeded());
    }

    #[test]
    fn half_an_ulp_is_granted() {
        // The nearest double has an error below half an ulp even if none is stated.
        assert!(!of(0.1, 0.0).is_exceeded());
        assert!(of(0.1_f64.next_up(), 0.0).is_exceeded());
        assert_eq!(of(0.1, 1e-3).ratio(), None);
    }

    #[test]
    fn ratios_compare_errors() {
        let far = of(0.1 + 1e-6, 1e-5);
        assert!((far.ratio().expect("no rounding") - 10.0).abs() < 1e-6);
        assert!((far.excess() - 0.1).abs() < 1e-6);
        assert!(!far.is_exceeded() && of(0.1 + 1e-6, 5e-7).is_exceeded());
    }
}
