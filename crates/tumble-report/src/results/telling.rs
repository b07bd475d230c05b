//! Which runs of a long sweep are shown one by one.

use crate::results::Case;

/// As many runs are shown in full; of more, those that tell something.
pub const FAMILY: usize = 10;
/// More are not read.
const MOST_TOLD: usize = 6;

/// The runs that are shown one by one: all of a short sweep; of a long one the first and the last, those that have failed, and those
/// in which an answer is greatest or least; where nothing is asked for, one of the middle.
pub fn telling(cases: &[Case]) -> Vec<&Case> {
    if cases.len() <= FAMILY {
        return cases.iter().collect();
    }
    let last = cases.len() - 1;
    let mut told = vec![0, last];
    let candidates: Vec<usize> = failed(cases).into_iter().chain(extremes(cases)).collect();
    let middle = candidates.is_empty().then_some(last / 2);
    for index in candidates.into_iter().chain(middle) {
        if told.len() < MOST_TOLD && !told.contains(&index) {
            told.push(index);
        }
    }
    told.sort_unstable();
    told.into_iter().map(|index| &cases[index]).collect()
}

/// The first run that was refused, and the first of which a claim does not hold.
fn failed(cases: &[Case]) -> Vec<usize> {
    let refused = cases.iter().position(|case| case.refusal.is_some());
    let refuted = cases.iter().position(|case| case.checks.iter().any(|check| !check.holds));
    refused.into_iter().chain(refuted).collect()
}

/// The runs in which each answer is greatest, then those in which it is least.
fn extremes(cases: &[Case]) -> Vec<usize> {
    let answers = |find: usize| {
        let value = move |case: &Case| case.finds.get(find).map_or(f64::NAN, |find| find.value);
        cases.iter().map(value).enumerate().filter(|(_, value)| value.is_finite())
    };
    let finds = || 0..cases[0].finds.len();
    let greatest = finds().filter_map(|find| answers(find).max_by(|a, b| a.1.total_cmp(&b.1)));
    let least = finds().filter_map(|find| answers(find).min_by(|a, b| a.1.total_cmp(&b.1)));
    greatest.chain(least).map(|(index, _)| index).collect()
}
