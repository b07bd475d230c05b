//! Counts over many problems.

use std::collections::HashSet;

use super::judge::{Errors, Judged, Verdict};
use super::{Fate, Report};

/// All problems of a survey.
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    pub(crate) reports: Vec<Report>,
}

/// What some of the problems came to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) problems: usize,
    pub(crate) refused: usize,
    pub(crate) broken: usize,
    /// Values with an error stated of them.
    pub(crate) stated: usize,
    pub(crate) unknown: usize,
    pub(crate) missed: usize,
    pub(crate) exceeded: usize,
    /// The largest true error in units of what is stated.
    pub(crate) worst: f64,
    /// Stated over true errors, where these are no rounding, in order.
    ratios: Vec<f64>,
}

/// A value whose true error is larger than what is stated, or that was missed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure<'a> {
    pub(crate) report: &'a Report,
    pub(crate) value: &'a Judged,
    /// True error in units of what is stated; infinite where a value was missed.
    pub(crate) factor: f64,
}

impl Tally {
    /// Counts reports.
    pub(crate) fn of<'a>(reports: impl Iterator<Item = &'a Report>) -> Self {
        let mut tally = Self::default();
        reports.for_each(|report| tally.add(report));
        tally.ratios.sort_by(f64::total_cmp);
        tally
    }

    fn add(&mut self, report: &Report) {
        self.problems += 1;
        match &report.fate {
            Fate::Answered(values) => values.iter().for_each(|value| self.add_value(value.verdict)),
            Fate::Refused(_) => self.refused += 1,
            Fate::Broken(_) => self.broken += 1,
        }
    }

    fn add_value(&mut self, verdict: Verdict) {
        match verdict {
            Verdict::Unknown => self.unknown += 1,
            Verdict::Missed => self.missed += 1,
            Verdict::Stated(errors) => self.add_errors(errors),
        }
    }

    fn add_errors(&mut self, errors: Errors) {
        self.stated += 1;
        self.exceeded += usize::from(errors.is_exceeded());
        if errors.is_exceeded() {
            self.worst = self.worst.max(errors.excess());
        }
        self.ratios.extend(errors.ratio());
    }

    /// The ratio that this part of all ratios does not exceed; not a number where there is none.
    pub(crate) fn ratio(&self, part: f64) -> f64 {
        let last = self.ratios.len().saturating_sub(1);
        self.ratios.get((part * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
    }

    /// Errors that are exceeded, and values that were missed, among all that can be judged.
    pub(crate) fn share_exceeded(&self) -> f64 {
        share(self.exceeded + self.missed, self.stated + self.missed)
    }

    /// Problems that were refused among all.
    pub(crate) fn share_refused(&self) -> f64 {
        share(self.refused + self.broken, self.problems)
    }
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

impl Survey {
    /// The failures, the worst first.
    fn failures(&self) -> Vec<Failure<'_>> {
        let values = self.reports.iter().flat_map(|report| match &report.fate {
            Fate::Answered(values) => values.iter().map(|value| (report, value)).collect(),
            _ => vec![],
        });
        let mut failures: Vec<Failure<'_>> = values.filter_map(failure).collect();
        failures.sort_by(|a, b| b.factor.total_cmp(&a.factor));
        failures
    }

    /// The worst of some failures of each problem, the worst first.
    pub(crate) fn worst(&self, counts: impl Fn(&Failure<'_>) -> bool) -> Vec<Failure<'_>> {
        let mut seen = HashSet::new();
        let key = |failure: &Failure<'_>| (failure.report.key.family, failure.report.key.index);
        self.failures().into_iter().filter(counts).filter(|failure| seen.insert(key(failure))).collect()
    }
}

fn failure<'a>((report, value): (&'a Report, &'a Judged)) -> Option<Failure<'a>> {
    let factor = match value.verdict {
        Verdict::Missed => f64::INFINITY,
        Verdict::Stated(errors) if errors.is_exceeded() => errors.excess(),
        _ => return None,
    };
    Some(Failure { report, value, factor })
}
