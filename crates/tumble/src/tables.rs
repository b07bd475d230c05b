//! The motion as tables: `trajectory.csv` and `events.csv`.

use tumble_expr::{Dimension, Expr, Symbol};
use tumble_mech::Run;
use tumble_ode::Side;
use tumble_scene::Study;

use crate::case::Case;
use crate::output::{Folder, Table};
use crate::pipeline::PipelineError;

/// Samples of a run whose scene does not say how many.
const DEFAULT_SAMPLES: usize = 1000;

/// A row of a table of the motion.
pub(crate) struct Row {
    /// s
    pub(crate) time: f64,
    /// Counts the phases between events, from 0.
    pub(crate) phase: usize,
    /// SI units.
    pub(crate) values: Vec<f64>,
}

/// Values of formulas at equal time steps, at the end, and on both sides of each event.
pub(crate) fn sample(study: &Study, run: &Run, formulas: &[Expr]) -> Result<Vec<Row>, PipelineError> {
    rows(run, formulas, &times(study, run)?)
}

/// The same from one time to another, s, in as many steps as a whole run has by default.
pub(crate) fn sample_between(
    run: &Run,
    formulas: &[Expr],
    [from, to]: [f64; 2],
) -> Result<Vec<Row>, PipelineError> {
    let end = run.end().unwrap_or(0.0);
    let (from, to) = (from.clamp(0.0, end), to.clamp(0.0, end));
    let step = (to - from) / DEFAULT_SAMPLES as f64;
    let inner = (0..DEFAULT_SAMPLES).map(|index| from + index as f64 * step);
    let times: Vec<f64> = inner.chain([to]).collect();
    Ok(rows(run, formulas, &times)?.into_iter().filter(|row| row.time >= from).collect())
}

/// Values at these times, in order, and on both sides of each event up to the last of them.
fn rows(run: &Run, formulas: &[Expr], times: &[f64]) -> Result<Vec<Row>, PipelineError> {
    let mut observer = run.observe(formulas)?;
    let events: Vec<f64> = run.events().map(|event| event.time).collect();
    let mut rows = vec![];
    let mut next_event = 0;
    for &time in times {
        while events.get(next_event).is_some_and(|event| *event <= time) {
            if let Some([before, after]) = observer.at_event(next_event) {
                let time = events[next_event];
                rows.push(Row { time, phase: next_event, values: before });
                rows.push(Row { time, phase: next_event + 1, values: after });
            }
            next_event += 1;
        }
        let is_event = next_event > 0 && events[next_event - 1] == time;
        if let Some(values) = observer.at(time, Side::After).filter(|_| !is_event) {
            rows.push(Row { time, phase: next_event, values });
        }
    }
    Ok(rows)
}

/// The ends of equal parts of a run, from its start on, s.
pub(crate) fn equal_times(run: &Run, parts: usize) -> impl Iterator<Item = f64> {
    let end = run.end().unwrap_or(0.0);
    (0..=parts).map(move |index| (end * index as f64 / parts as f64).min(end))
}

/// Equal steps from the start, and the end.
fn times(study: &Study, run: &Run) -> Result<Vec<f64>, PipelineError> {
    let end = run.end().unwrap_or(0.0);
    let every = match &study.output_every {
        Some(every) => study.number(every)?,
        None => study.number(&study.until)? / DEFAULT_SAMPLES as f64,
    };
    let count = (end / every).floor() as usize;
    let mut times: Vec<f64> =
        (0..=count).map(|index| index as f64 * every).filter(|time| *time <= end).collect();
    // A last step that is the end but for rounding is the end.
    while times.last().is_some_and(|last| end - last < 1e-9 * every) {
        times.pop();
    }
    times.push(end);
    Ok(times)
}

/// Writes the tables of one run.
pub(crate) fn write(study: &Study, case: &Case, folder: &Folder) -> Result<(), PipelineError> {
    trajectory(&study.with(&case.parameters), case, folder)?;
    events(case, folder)
}

fn trajectory(study: &Study, case: &Case, folder: &Folder) -> Result<(), PipelineError> {
    // The time is the first column.
    let shown = || study.quantities.iter().filter(|(name, _)| *name != "t");
    let formulas: Vec<Expr> = shown().map(|(_, quantity)| quantity.formula.clone()).collect();
    let mut table = Table::begin(folder, &format!("{}/trajectory.csv", case.folder()))?;
    let header = shown().map(|(name, quantity)| column(name, &quantity.unit));
    let first = ["t [s]".to_owned(), "phase".to_owned()];
    table.row(first.into_iter().chain(header))?;
    for row in sample(study, &case.run, &formulas)? {
        table.numbers(&[row.time]);
        table.text(&row.phase.to_string());
        table.numbers(&row.values);
        table.end_row()?;
    }
    Ok(table.finish()?)
}

/// A row an event: what happened, and every state just before and just after.
fn events(case: &Case, folder: &Folder) -> Result<(), PipelineError> {
    let run = &case.run;
    let mut table = Table::begin(folder, &format!("{}/events.csv", case.folder()))?;
    // What some modes have beyond the states of the bodies is the integrator's own.
    let states = run.equations.states(&run.equations.idle_mode());
    let columns = ["before", "after"].into_iter().flat_map(|side| {
        states
            .iter()
            .map(move |state| format!("{side} {} [{}]", state.name, unit(state.dimension, is_angle(state))))
    });
    let first = ["t [s]".to_owned(), "what".to_owned()];
    table.row(first.into_iter().chain(columns))?;
    let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
    let mut observer = run.observe(&formulas)?;
    for (index, event) in run.events().enumerate() {
        table.numbers(&[event.time]);
        table.text(&run.equations.names_of(&event.record).join(", "));
        for values in observer.at_event(index).into_iter().flatten() {
            table.numbers(&values);
        }
        table.end_row()?;
    }
    Ok(table.finish()?)
}

/// The header of a column; a pure number is in units of 1.
fn column(name: &str, unit: &str) -> String {
    format!("{name} [{}]", if unit.is_empty() { "1" } else { unit })
}

/// Whether a state is an angle or its rate.
pub(crate) fn is_angle(state: &Symbol) -> bool {
    state.name.ends_with(".angle") || state.name.ends_with(".omega")
}

/// A column's unit.
pub(crate) fn unit(dimension: Dimension, angle: bool) -> String {
    if angle {
        return "rad".to_owned() + dimension.to_string().strip_prefix('1').unwrap_or_default();
    }
    let named = NAMED.iter().find(|(known, _)| *known == dimension);
    named.map_or_else(|| dimension.to_string(), |(_, unit)| (*unit).to_owned())
}

/// Units that nobody reads in base units. That of energies and torques is left to these: both have one dimension.
const NAMED: [(Dimension, &str); 3] =
    [(Dimension::FORCE, "N"), (Dimension::new(0, 1, -2), "N/m"), (Dimension::new(2, 1, -3), "W")];
