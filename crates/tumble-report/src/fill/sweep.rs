//! What a report says of a sweep as a whole.

use tumble_drawing::{CurveFigure, Label, Range};
use tumble_scene::{Question, Study};

use super::findings::with_digits;
use super::names::{in_degrees, quantity, quantity_to};
use crate::figures::{captions, case_label, finds};
use crate::report::{Chart, Column, Picture, Text};
use crate::results::{Case, Equal, FAMILY, FindResult, Located, Optimum, Runs, Survey, count, digits};

/// Digits of numbers in tables and captions.
const DIGITS: usize = 5;
/// Digits that are read; more are not shown.
const READ: usize = 6;

/// Every answer over what is swept.
pub(super) fn curves(study: &Study, survey: &Survey) -> Vec<Chart> {
    let caption = |name: &str, figure: &CurveFigure| {
        let mut own = survey.located.iter().filter(|located| format!("find.{}", located.find) == name);
        let made = own.any(|located| located.place.made > 0);
        captions::answers(figure, made)
    };
    let plot = |(name, figure): (String, CurveFigure)| {
        let caption = caption(&name, &figure);
        Chart::new(figure, caption).stored(format!("{name}.svg"))
    };
    finds::curves(study, survey).into_iter().map(plot).collect()
}

/// Every answer over the two parameters that are swept.
pub(super) fn maps(study: &Study, survey: &Survey) -> Vec<Picture> {
    let picture = |(name, figure): (String, tumble_drawing::MapFigure)| {
        let bounds = Range::of(figure.cells.iter().copied()).unwrap_or_default();
        let [x, y, z] = [&figure.x, &figure.y, &figure.z].map(|axis| axis.title().to_plain());
        let [least, greatest] =
            [bounds.low, bounds.high].map(|value| Label::number(value, DIGITS).to_plain());
        let words = format!("{z} over {x} and {y}: from {least} to {greatest}.");
        Picture::new(figure.svg().described(words), captions::MAP).stored(format!("{name}.svg"))
    };
    finds::maps(study, survey).into_iter().map(picture).collect()
}

/// Where every answer is greatest and least.
pub(super) fn findings(study: &Study, runs: Runs<'_>) -> Vec<Text> {
    let of = |(index, question): (usize, &Question)| {
        let own = runs.survey.located.iter().filter(|located| located.index == index);
        let parts: Vec<Text> = own.map(|located| located_words(study, located)).collect();
        let parts = if parts.is_empty() { among(index, runs).into_iter().collect() } else { parts };
        let head = Text::from(finds::called(study, question)).capitalised().and(" is ");
        let joined = parts.into_iter().reduce(|all, part| all.and("; ").and(part));
        joined.map(|parts| head.and(parts).and("."))
    };
    study.finds.iter().enumerate().filter_map(of).collect()
}

/// `largest, 178.2° (6 digits), at T = 2.013 s (4 digits; 11 more runs were made to find it)`
fn located_words(study: &Study, located: &Located) -> Text {
    let Located { unit, parameter, parameter_unit, place, .. } = located;
    let value = with_digits(place.best.value, Some(place.best.error).filter(|e| e.is_finite()), unit);
    let name = finds::swept(study, parameter);
    // What is greatest may itself be the least of a run.
    let which = if located.word() == "least" { "smallest, " } else { "largest, " };
    let words = Text::from(which).and(value);
    if let Some(Equal { runs, first, last }) = place.equal {
        let runs =
            words.and(format!(", in {runs} runs, the first with ")).and(name.clone()).and("\u{a0}=\u{a0}");
        let first = runs.and(quantity(first, parameter_unit)).and(", the last with ");
        return first.and(name).and("\u{a0}=\u{a0}").and(quantity(last, parameter_unit));
    }
    let words = words.and(", at ").and(name).and("\u{a0}=\u{a0}");
    words.and(place_words(place, parameter_unit))
}

fn place_words(place: &Optimum, unit: &str) -> Text {
    let at = place.best.at;
    let Some([low, high]) = place.between else {
        return quantity(at, unit).and(", at an end of the sweep");
    };
    if place.made == 0 {
        let beside = Text::from(" (beside it in the sweep: ").and(quantity(low, unit)).and(" and ");
        return quantity(at, unit).and(beside).and(quantity(high, unit)).and(")");
    }
    let held = digits::digits(at, (at - low).max(high - at));
    let were = if place.made == 1 { "was" } else { "were" };
    let made = count(place.made as u64, "more run");
    let more = format!("; {made} {were} made between the best of the sweep and its neighbours)");
    let digits = format!(" ({}", count(held as u64, "digit"));
    quantity_to(at, held.clamp(1, READ), unit).and(digits).and(more)
}

/// The run of the greatest and that of the least answer, where the sweep has no neighbours to look between.
fn among(index: usize, runs: Runs<'_>) -> Option<Text> {
    let known = || {
        let answers = runs.cases.iter().filter_map(|case| Some((case, case.finds.get(index)?)));
        answers.filter(|(_, find)| find.open().is_none() && find.is_reached())
    };
    let by = |a: &(&Case, &FindResult), b: &(&Case, &FindResult)| a.1.value.total_cmp(&b.1.value);
    let (least, greatest) = (known().min_by(by)?, known().max_by(by)?);
    let error = |find: &FindResult| find.error.unwrap_or(f64::INFINITY);
    if greatest.1.value - least.1.value <= error(greatest.1) + error(least.1) {
        let value = with_digits(greatest.1.value, greatest.1.error, &greatest.1.unit);
        return Some(value.and(" in all runs"));
    }
    let of = |what: &str, (case, find): (&Case, &FindResult)| {
        let value = with_digits(find.value, find.error, &find.unit);
        Text::from(what).and(value).and(" with ").and(case_label(case))
    };
    Some(of("largest, ", greatest).and("; ").and(of("smallest, ", least)))
}

/// Which runs are shown, where they are not all.
pub(super) fn which_are_shown(cases: &[Case], told: &[&Case]) -> Option<Text> {
    let words = format!(
        "This sweep has {} runs. Shown one by one are {}: the first and the last, and those in which an answer is greatest \
         or least or something has failed.",
        cases.len(),
        told.len()
    );
    (told.len() < cases.len()).then(|| words.into())
}

/// Where the runs are that a table leaves out.
pub(super) fn others_are_in_files(cases: &[Case], told: &[&Case]) -> Option<Text> {
    let others = cases.len() - told.len();
    (others > 0)
        .then(|| format!("The other {others} runs stand in runs.csv, their events in events.csv.").into())
}

/// The heading of an answer's column.
pub(super) fn find_column(study: &Study, question: &Question) -> Column {
    Column::numbers(in_unit(finds::called(study, question).into(), &question.that.quantity.unit))
}

/// A heading with the unit of what stands below it.
pub(super) fn in_unit(heading: Text, unit: &str) -> Text {
    if unit.is_empty() { heading } else { heading.and(" (").and(Label::unit(unit)).and(")") }
}

/// An answer to its verified digits.
pub(super) fn find_cell(find: &FindResult) -> Text {
    match (find.open(), find.error) {
        _ if !find.is_reached() => find.status().into(),
        (Some(open), _) => open.into(),
        (None, None) => quantity(find.value, "").and(" (no digit is known)"),
        (None, Some(error)) => {
            let known = digits::digits(find.value, error).clamp(1, READ);
            quantity_to(find.value, known, "").and(in_degrees(find.value, known, &find.unit))
        }
    }
}

/// Whether a sweep is shown by bands.
pub(super) fn is_long(cases: &[Case]) -> bool {
    cases.len() > FAMILY
}
