//! Where along a sweep answers are greatest and least, as programs read it.

use serde::Serialize;
use tumble_report::results::Located;

/// One of them.
#[derive(Serialize)]
pub(super) struct Entry<'a> {
    find: &'a str,
    which: &'static str,
    parameter: &'a str,
    parameter_unit: &'a str,
    /// In that unit.
    at: f64,
    /// Between which values it is; missing at an end of the sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
    /// How many runs of the sweep are as good but for their errors, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    equal_runs: Option<usize>,
    value: f64,
    /// `null` where no digit is known.
    error: f64,
    unit: &'a str,
    /// Runs that were made for it.
    more_runs: usize,
}

pub(super) fn entry(located: &Located) -> Entry<'_> {
    let place = &located.place;
    Entry {
        find: &located.find,
        which: located.word(),
        parameter: &located.parameter,
        parameter_unit: &located.parameter_unit,
        at: place.best.at,
        between: place.between,
        equal_runs: place.equal.map(|equal| equal.runs),
        value: place.best.value,
        error: place.best.error,
        unit: &located.unit,
        more_runs: place.made,
    }
}
