//! Closed forms where there are any, and how the rest was integrated.

use std::collections::BTreeSet;

use crate::report::{Column, Phase, PrintedTable, Solve, Text};
use tumble_mech::{Divergence, Horizon};
use tumble_scene::Study;

use super::names::{Names, quantity};
use super::{closed, events, sweep};
use crate::figures::case_label;
use crate::results::digits::Held;
use crate::results::{Case, CaseError, telling};

/// Runs of a sweep beyond these have no closed forms of their own.
const MOST_RUNS: usize = 6;

pub(super) fn of(study: &Study, names: &Names, cases: &[Case]) -> Result<Solve, CaseError> {
    let told = telling(cases);
    let phases = phases_of_runs(study, names, &told)?;
    let is_exact = |case: &Case| case.run.work().exact_steps == case.run.work().steps;
    let rests = cases.iter().map(|case| Ok(case.run.rest()? == Some(0.0)));
    let rest = rests.collect::<Result<Vec<bool>, CaseError>>()?.into_iter().all(|rests| rests);
    let intro = match (phases.is_empty(), cases.iter().all(is_exact)) {
        _ if rest => "Nothing moves: every velocity stays zero, and every acceleration.",
        (false, true) => {
            "Between the events all accelerations are constant or polynomials in time: the motion is known in closed form, and the steps of the \
             method are exact."
        }
        (false, false) => "The following phases are known in closed form; the rest is integrated.",
        (true, true) => {
            "In every mode of the motion the accelerations are constant or polynomials in time: each step is exact."
        }
        (true, false) => "No closed form was found: the equations are integrated.",
    };
    let mut how = how(&told);
    how.notes.extend(sweep::others_are_in_files(cases, &told));
    let how = std::iter::once(how);
    Ok(Solve {
        intro: vec![intro.into()],
        phases,
        method: method(&told),
        tables: how
            .chain(
                told.iter()
                    .filter(|case| case.run.events().next().is_some())
                    .map(|case| events::of(study, case)),
            )
            .collect(),
    })
}

/// The closed forms of all runs, each once: what is the same in several is told of them together.
fn phases_of_runs(study: &Study, names: &Names, told: &[&Case]) -> Result<Vec<Phase>, CaseError> {
    let mut found: Vec<(Vec<&str>, Phase)> = vec![];
    for case in told.iter().take(MOST_RUNS) {
        for phase in closed::phases(&study.with(&case.parameters), names, case, told.len() == 1)? {
            match found.iter_mut().find(|(_, known)| *known == phase) {
                Some((labels, _)) => labels.push(&case.label),
                None => found.push((vec![&case.label], phase)),
            }
        }
    }
    let mut phases: Vec<Phase> = vec![];
    for (labels, phase) in found {
        let runs = if labels.len() == told.len() { "all runs".to_owned() } else { labels.join("; ") };
        let name = if told.len() > 1 { Text::from(format!("{runs}: ")) } else { Text::default() };
        // What other runs have said in symbols they do not say again.
        let is_said = phases.iter().any(|known| known.symbols == phase.symbols);
        let mut symbols = if is_said { vec![] } else { phase.symbols };
        symbols.retain(|block| !block.lines.is_empty());
        let name = name.and(phase.name).capitalised();
        phases.push(Phase { name, symbols, ..phase });
    }
    Ok(phases)
}

/// What is not in the table of runs.
fn method(cases: &[&Case]) -> Vec<(Text, Text)> {
    let mut rows = vec![("Method".into(), "Taylor series, each step checked against the equations".into())];
    for case in cases {
        let horizon = case.trust.as_ref().and_then(|trust| trust.horizon.as_ref());
        let ends = |horizon: &Horizon| match horizon.reason {
            Divergence::Events { .. } => {
                let from = Text::from("from ").and(quantity(horizon.time, "s"));
                from.and(" on other events happen in the check run, or in another order")
            }
            _ => horizon.reason.to_string().into(),
        };
        let why = || of_run("Verified digits end because", cases, case);
        rows.extend(horizon.map(|horizon| (why(), ends(horizon))));
        let stopped = |reason: String| (of_run("Stopped", cases, case), reason.into());
        rows.extend(case.refusal.as_ref().map(|refusal| stopped(refusal.to_string())));
    }
    rows
}

/// How the runs were solved, a row each.
fn how(cases: &[&Case]) -> PrintedTable {
    let columns = [
        Column::words("Run"),
        Column::numbers("Accuracy requested"),
        Column::numbers("Order"),
        Column::numbers("Steps"),
        Column::numbers("Exact steps"),
        Column::numbers("Repeated"),
        Column::numbers("Modes"),
        Column::numbers("Points along lines"),
        Column::words("Verified by a check run"),
    ];
    // What no run has is no column.
    let some = |of: &dyn Fn(&Case) -> u64, nothing: u64, case: &Case| match cases
        .iter()
        .all(|case| of(case) <= nothing)
    {
        true => Text::default(),
        false => of(case).to_string().into(),
    };
    let row = |case: &&Case| {
        let held = case.trust.as_ref().map(|trust| Held::of(trust).words());
        let points = case.run.quadrature.as_ref().map(|found| found.nodes.to_string());
        vec![
            case_label(case).into(),
            quantity(case.accuracy.value(), ""),
            case.run.order().to_string().into(),
            case.run.work().steps.to_string().into(),
            some(&|case| case.run.work().exact_steps, 0, case),
            some(&|case| case.run.work().rejected, 0, case),
            some(&lasting_modes, 1, case),
            points.unwrap_or_default().into(),
            held.unwrap_or_default().into(),
        ]
    };
    let table = PrintedTable::new("The equations were solved in this way.", columns.into());
    let table = cases.iter().map(row).fold(table, PrintedTable::row);
    PrintedTable { notes: vec![explained(&table)], ..table }
}

/// How many different sets of equations hold for longer than an instant.
fn lasting_modes(case: &Case) -> u64 {
    let pieces = case.run.trajectory().pieces.iter().filter(|piece| piece.start < piece.end);
    pieces.map(|piece| piece.mode).collect::<BTreeSet<_>>().len() as u64
}

/// What the columns mean that are there.
fn explained(table: &PrintedTable) -> Text {
    let meanings = [
        ("Order", "The order is that of the Taylor series."),
        ("Exact steps", "In exact steps the motion is a polynomial in time."),
        ("Repeated", "Repeated steps were tried again, shorter."),
        (
            "Modes",
            "A mode is a set of equations, by what touches, slides or acts; those of an instant are not counted.",
        ),
        ("Points along lines", "At points along lines the air is summed."),
    ];
    let is_there = |name: &str| table.filled().iter().any(|i| table.columns[*i].heading.to_plain() == name);
    let said = meanings.iter().filter(|(name, _)| is_there(name)).map(|(_, meaning)| *meaning);
    said.collect::<Vec<_>>().join(" ").into()
}

/// What is told of one run, with its label where there are several.
fn of_run(what: &str, cases: &[&Case], case: &Case) -> Text {
    if cases.len() > 1 { labelled(what, case) } else { what.into() }
}

fn labelled(what: &str, case: &Case) -> Text {
    if case.label.is_empty() { what.into() } else { Text::from(format!("{what}, ")).and(case_label(case)) }
}
