//! Sentences of findings: several runs that differ in a value alone are one sentence.

use crate::figures::case_label;
use crate::fill::names::{in_degrees, quantity, quantity_to};
use crate::report::Text;
use crate::results::{Case, count, digits};
use tumble_drawing::Label;

/// Digits that are read.
const READ: usize = 6;

/// A finding: words that runs have in common, and the value that they may differ in.
#[derive(Clone)]
pub(super) struct Said {
    before: Text,
    value: Text,
    rank: Rank,
    /// Told only beside other runs of which the same is worth telling.
    is_slight: bool,
}

/// How much a finding says of the motion.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Leading,
    Usual,
    Trailing,
}

impl Said {
    /// `before` ends with its space; a full stop follows.
    pub(super) fn new(before: impl Into<Text>, value: Text) -> Self {
        Self { before: before.into(), value, rank: Rank::Usual, is_slight: false }
    }

    /// One that says more of the motion than the others.
    pub(super) fn leading(self) -> Self {
        Self { rank: Rank::Leading, ..self }
    }

    /// One that says less: any motion has it.
    pub(super) fn trailing(self) -> Self {
        Self { rank: Rank::Trailing, ..self }
    }

    /// One that is worth telling in some runs alone: in the others it is told beside those.
    pub(super) fn where_it_matters(self, matters: bool) -> Self {
        Self { is_slight: !matters, ..self }
    }

    /// Whether what it says is known: of some values no digit is.
    pub(super) fn is_known(&self) -> bool {
        !self.value.to_plain().contains(UNKNOWN)
    }

    fn has_words_of(&self, other: &Self) -> bool {
        self.before.to_plain() == other.before.to_plain()
    }
}

/// The findings of all runs: what leads, what only some of them have, the others, and what trails, in the order of the first run that has each.
pub(super) fn together(runs: &[(&Case, Vec<Said>)]) -> Vec<Text> {
    let mut found: Vec<Vec<(&Case, &Said)>> = vec![];
    for (case, said) in runs.iter().flat_map(|(case, all)| all.iter().map(move |said| (*case, said))) {
        let is_same = |same: &&mut Vec<(&Case, &Said)>| {
            same[0].1.has_words_of(said) && same.iter().all(|(other, _)| other.number != case.number)
        };
        match found.iter_mut().find(is_same) {
            Some(same) => same.push((case, said)),
            None => found.push(vec![(case, said)]),
        }
    }
    found.retain(|same| same.iter().any(|(_, said)| !said.is_slight));
    // What runs differ in comes first: a sweep is made for it.
    let tells_all =
        |same: &[(&Case, &Said)]| same.iter().filter(|(_, said)| !said.is_slight).count() == runs.len();
    found.sort_by_key(|same| (same[0].1.rank, tells_all(same)));
    found.iter().map(|same| sentence(same, runs.len())).collect()
}

/// What is different about a run, in a line: `T = 0.5 s`.
fn run_label(case: &Case) -> Label {
    let mut label = case_label(case);
    label.runs.iter_mut().for_each(|run| run.text = run.text.replace(" = ", "\u{a0}=\u{a0}"));
    label
}

/// One sentence for all runs of one finding.
fn sentence(same: &[(&Case, &Said)], runs: usize) -> Text {
    let first = same[0].1;
    let whole = |value: Text| first.before.clone().and(value);
    let is_one = same.iter().all(|(_, said)| said.value.to_plain() == first.value.to_plain());
    let said = match (is_one, same.len() == runs) {
        (true, true) => whole(first.value.clone()),
        (true, false) => {
            let labels = listed(same.iter().map(|(case, _)| run_label(case).into()), "; ");
            whole(first.value.clone()).and(" (").and(labels).and(")")
        }
        (false, _) => {
            let value =
                |(case, said): &(&Case, &Said)| said.value.clone().and(" (").and(run_label(case)).and(")");
            whole(listed(same.iter().map(value), "; "))
        }
    };
    said.and(".").capitalised()
}

fn listed(parts: impl Iterator<Item = Text>, between: &str) -> Text {
    parts.reduce(|all, next| all.and(between).and(next)).unwrap_or_default()
}

/// What holds of all numbers in findings.
pub(in crate::fill) const ALL_VERIFIED: &str = "Values are rounded to at most six digits, all of them verified; where fewer are, it is said how many. Zeros at the end are left out.";

/// What is said of a value without digits.
const UNKNOWN: &str = "(no digit is known)";

/// A value to its verified digits, at most so many as are read; where there are fewer, how many. What is less than its error is zero.
/// Radians are degrees too.
pub(in crate::fill) fn with_digits(value: f64, error: Option<f64>, unit: &str) -> Text {
    let Some(error) = error else { return quantity(value, unit).and(format!(" {UNKNOWN}")) };
    if error == 0.0 {
        return quantity(value, unit).and(in_degrees(value, READ, unit));
    }
    if value.abs() <= error {
        return quantity(0.0, unit);
    }
    let held = digits::digits(value, error);
    let known = held.clamp(1, READ);
    let shown = quantity_to(value, known, unit).and(in_degrees(value, known, unit));
    if held < READ { shown.and(format!(" ({})", count(held as u64, "digit"))) } else { shown }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radians_that_were_found_are_degrees_too() {
        let shown = |error: f64, unit: &str| with_digits(0.5, Some(error), unit).to_plain();
        assert_eq!(shown(0.0, "rad"), "0.5\u{a0}rad\u{a0}(28.65°)");
        assert_eq!(shown(1e-9, "rad"), "0.5\u{a0}rad\u{a0}(28.65°)");
        assert_eq!(shown(4e-3, "rad"), "0.5\u{a0}rad\u{a0}(29°) (2 digits)");
        assert_eq!(shown(1e-9, "rad/s"), "0.5\u{a0}rad/s");
    }
}
