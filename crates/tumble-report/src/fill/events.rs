//! The table of events of a run, in which impacts that follow each other ever faster are told once they have been seen.

use std::collections::HashSet;

use crate::figures::case_label;
use crate::report::{Column, PrintedTable, Text};
use crate::results::Case;
use crate::tables::EVENTS;
use tumble_drawing::Label;
use tumble_mech::Record;
use tumble_ode::Occurrence;
use tumble_scene::Study;

use super::names::quantity;
use super::words;

/// So many impacts of a Zeno sequence are told one by one: they show by how much each is sooner than the last.
const SHOWN: usize = 12;
/// Fewer rows than these are not worth a row that stands for them.
const LEAST_LEFT_OUT: usize = 6;

fn caption(case: &Case) -> Text {
    let words = Text::from("These events happened");
    if case.label.is_empty() { words.and(".") } else { words.and(" (").and(case_label(case)).and(").") }
}

/// A row an event.
pub(super) fn of(study: &Study, case: &Case) -> PrintedTable {
    let events: Vec<_> = case.run.events().collect();
    let told: Vec<String> = events.iter().map(|event| words::event(study, &case.run, event)).collect();
    let heading = Text::from(Label::symbol("t")).and(" (s)");
    let columns = vec![Column::numbers(heading), Column::words("What happens")];
    let mut table = PrintedTable {
        file: Some(format!("{}/{EVENTS}", case.folder())),
        ..PrintedTable::new(caption(case), columns)
    };
    let unverified = events.iter().position(|event| !case.is_verified(event.time)).filter(|first| *first > 0);
    let rows = |from: usize, to: usize| {
        let told = &told;
        let notice = move |index: usize| (Some(index) == unverified).then(not_verified);
        let events = &events;
        (from..to).flat_map(move |index| notice(index).into_iter().chain([row(events, told, index)]))
    };
    let mut next = 0;
    for [from, to] in accumulating(&events, &told) {
        table.rows.extend(rows(next, from));
        table.rows.extend(unverified.filter(|first| (from..to).contains(first)).map(|_| not_verified()));
        let words =
            format!("{} more of these, until {}", to - from, quantity(events[to - 1].time, "s").to_plain());
        table.rows.push(vec!["…".into(), words.into()]);
        table.is_cut = true;
        next = to;
    }
    table.rows.extend(rows(next, events.len()));
    table
}

/// A row before the first event that no check run confirms.
fn not_verified() -> Vec<Text> {
    vec!["".into(), "No digit of what follows is verified.".into()]
}

fn row(events: &[&Occurrence<Record>], told: &[String], index: usize) -> Vec<Text> {
    vec![quantity(events[index].time, ""), Text::from(told[index].clone()).capitalised()]
}

/// The impacts before the end of a Zeno sequence, each stretch without its first ones, of which nothing is said that is new.
fn accumulating(events: &[&Occurrence<Record>], told: &[String]) -> Vec<[usize; 2]> {
    let mut known: HashSet<&str> = HashSet::new();
    let is_end = |index: &usize| *index > 0 && events[*index].record.ends_zeno_sequence();
    // For each event the first of those before it that are told in words of earlier ones, since the last sequence has ended.
    let mut begins: Vec<usize> = vec![];
    for (index, words) in told.iter().enumerate() {
        let goes_on = begins.last().copied().unwrap_or(0);
        begins.push(if known.insert(words) || is_end(&index) { index + 1 } else { goes_on });
    }
    let stretch = |end: usize| [begins[end - 1] + SHOWN, end];
    let ends = (0..events.len()).filter(is_end).map(stretch);
    ends.filter(|[from, to]| *to >= from + LEAST_LEFT_OUT).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::motions_called;

    #[test]
    fn of_a_zeno_sequence_the_first_impacts_and_the_end_are_told() {
        let (study, cases) = motions_called("09-bouncing-ball");
        let table = of(&study, &cases[0]);
        let rows: Vec<[String; 2]> = table.rows.iter().map(|row| [0, 1].map(|i| row[i].to_plain())).collect();
        let cut = rows.iter().position(|[time, _]| time == "…").expect("a row for those left out");
        let left_out = cases[0].run.events().count() - (rows.len() - 1);
        assert_eq!(rows[cut][1], format!("{left_out} more of these, until 1.35526\u{a0}s"));
        // The time of each is read as another one, and the end of the sequence is there.
        assert!(rows[..cut].windows(2).all(|pair| pair[0][0] != pair[1][0]), "{rows:?}");
        assert!(rows[cut + 1][1].contains("become too low to be followed"), "{rows:?}");
        assert!(table.all_rows().is_some());
    }
}
