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
        (self.real > self.ulp).then_some(self.stated / self.real)
    }
}

/// Holds an answer against the truth.
pub(crate) fn judge(asked: &Asked, answer: Answer) -> Judged {
    let verdict = match (answer.value, answer.stated) {
        (None, _) if answer.is_known => Verdict::Missed,
        (Some(value), Some(stated)) => Verdict::Stated(errors(value, stated, &asked.truth)),
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

fn errors(value: f64, stated: f64, truth: &Real) -> Errors {
    let real = (Real::of(value) - truth).abs().to_f64();
    Errors { stated, real, ulp: value.abs().next_up() - value.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: f64, stated: f64) -> Errors {
        errors(value, stated, &Real::read("0.1"))
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
