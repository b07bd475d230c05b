//! Values of formulas along a motion, and the units of columns.

use tumble_expr::{Dimension, Expr, Symbol};
use tumble_mech::Run;
use tumble_ode::Side;
use tumble_scene::Study;

use crate::results::CaseError;

/// Samples of a run whose scene does not say how many.
const DEFAULT_SAMPLES: usize = 1000;

/// A row of a table of the motion.
pub struct SampleRow {
    /// s
    pub time: f64,
    /// Counts the phases between events, from 0.
    pub phase: usize,
    /// SI units.
    pub values: Vec<f64>,
}

/// More events than so many for each time have no rows of their own: bodies that rattle in a pile have ten thousand.
const CROWDED: usize = 2;

/// Values of formulas at equal time steps, at the end, and on both sides of each event, if these are not very many.
pub fn sample(study: &Study, run: &Run, formulas: &[Expr]) -> Result<Vec<SampleRow>, CaseError> {
    rows(run, formulas, &times(study, run)?)
}

/// The same from one time to another, s, in as many steps as a whole run has by default.
pub fn sample_between(
    run: &Run,
    formulas: &[Expr],
    [from, to]: [f64; 2],
) -> Result<Vec<SampleRow>, CaseError> {
    let end = run.end().unwrap_or(0.0);
    let (from, to) = (from.clamp(0.0, end), to.clamp(0.0, end));
    let step = (to - from) / DEFAULT_SAMPLES as f64;
    let inner = (0..DEFAULT_SAMPLES).map(|index| from + index as f64 * step);
    let times: Vec<f64> = inner.chain([to]).collect();
    Ok(rows(run, formulas, &times)?.into_iter().filter(|row| row.time >= from).collect())
}

/// Values at these times, in order, and on both sides of each event up to the last of them, if these are not very many.
fn rows(run: &Run, formulas: &[Expr], times: &[f64]) -> Result<Vec<SampleRow>, CaseError> {
    let mut observer = run.observe(formulas)?;
    let events: Vec<f64> = run.events().map(|event| event.time).collect();
    let have_rows = events.len() <= CROWDED * times.len().max(DEFAULT_SAMPLES);
    let mut rows = vec![];
    let mut next_event = 0;
    for &time in times {
        while events.get(next_event).is_some_and(|event| *event <= time) {
            if have_rows && let Some([before, after]) = observer.at_event(next_event) {
                let time = events[next_event];
                rows.push(SampleRow { time, phase: next_event, values: before });
                rows.push(SampleRow { time, phase: next_event + 1, values: after });
            }
            next_event += 1;
        }
        let is_event = have_rows && next_event > 0 && events[next_event - 1] == time;
        if let Some(values) = observer.at(time, Side::After).filter(|_| !is_event) {
            rows.push(SampleRow { time, phase: next_event, values });
        }
    }
    Ok(rows)
}

/// The ends of equal parts of a run, from its start on, s.
pub fn equal_times(run: &Run, parts: usize) -> impl Iterator<Item = f64> {
    let end = run.end().unwrap_or(0.0);
    (0..=parts).map(move |index| (end * index as f64 / parts as f64).min(end))
}

/// Equal steps from the start, and the end.
fn times(study: &Study, run: &Run) -> Result<Vec<f64>, CaseError> {
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

/// Whether a state is an angle or its rate.
pub fn is_angle(state: &Symbol) -> bool {
    state.name.ends_with(".angle") || state.name.ends_with(".omega")
}

/// A column's unit.
pub fn unit(dimension: Dimension, angle: bool) -> String {
    if angle {
        return "rad".to_owned() + dimension.to_string().strip_prefix('1').unwrap_or_default();
    }
    let named = NAMED.iter().find(|(known, _)| *known == dimension);
    named.map_or_else(|| dimension.to_string(), |(_, unit)| (*unit).to_owned())
}

/// Units that nobody reads in base units. That of energies and torques is left to these: both have one dimension.
const NAMED: [(Dimension, &str); 3] =
    [(Dimension::FORCE, "N"), (Dimension::new(0, 1, -2), "N/m"), (Dimension::new(2, 1, -3), "W")];
