//! The runs of a sweep as tables: `runs.csv`, a row a run, and `events.csv`, a row for each event of every run.

use tumble_scene::{Check, Question, Study, Swept};

use super::{TableWriter, VERIFIED, column, verified};
use crate::results::{Finished, Happened, is_angle, unit};

/// Both tables, while the runs are made.
#[derive(Debug)]
pub struct SweepTables<T> {
    runs: T,
    events: T,
    /// Places of what is swept among the parameters; `None` is the accuracy.
    swept: Vec<Option<usize>>,
}

impl<T: TableWriter> SweepTables<T> {
    /// Begins them, for a study in which something is swept.
    pub fn begin(study: &Study, mut runs: T, mut events: T) -> Result<Self, T::Error> {
        runs.row(run_columns(study))?;
        let swept = study.sweep.iter().map(|axis| place(study, &axis.of)).collect();
        let of_event = ["t [s]", "what", VERIFIED].map(str::to_owned);
        events.row(which(study).into_iter().chain(of_event))?;
        Ok(Self { runs, events, swept })
    }

    /// Adds a run; they come in order.
    pub fn add(&mut self, run: &Finished) -> Result<(), T::Error> {
        self.add_run(run)?;
        run.events.iter().try_for_each(|event| self.add_event(run, event))
    }

    fn add_run(&mut self, run: &Finished) -> Result<(), T::Error> {
        let table = &mut self.runs;
        table.text(&run.folder());
        table.text(&run.label);
        table.numbers(&run.inputs);
        for find in &run.finds {
            let value = if find.spread.is_some() { f64::NAN } else { find.value };
            numbers(table, [find.at, value, find.error.unwrap_or(f64::NAN)]);
        }
        for check in &run.checks {
            numbers(table, [check.found, check.error.unwrap_or(f64::NAN)]);
            table.text(check.status());
        }
        numbers(table, [run.end]);
        run.states.iter().for_each(|(_, value)| numbers(table, [*value]));
        table.numbers(&[run.accuracy.value()]);
        numbers(table, [run.held.as_ref().map_or(f64::NAN, |held| held.reached)]);
        numbers(table, [run.held.as_ref().map_or(f64::NAN, |held| held.verified_until().min(run.end))]);
        table.text(&run.work.steps.to_string());
        table.text(&run.events.len().to_string());
        match &run.refusal {
            None => table.text("complete"),
            Some(refusal) => table.text(&format!("incomplete: {refusal}")),
        }
        table.end_row()
    }

    fn add_event(&mut self, run: &Finished, event: &Happened) -> Result<(), T::Error> {
        let table = &mut self.events;
        table.text(&run.folder());
        for place in &self.swept {
            table.numbers(&[place.map_or(run.accuracy.value(), |place| run.inputs[place])]);
        }
        table.numbers(&[event.time]);
        table.text(&event.what.join(", "));
        table.text(verified(event.is_verified));
        table.end_row()
    }

    /// Both of them, with all rows.
    pub fn end(self) -> [T; 2] {
        [self.runs, self.events]
    }
}

/// Cells of which those are empty that have no number.
fn numbers<const N: usize>(table: &mut impl TableWriter, values: [f64; N]) {
    for value in values {
        match value.is_finite() {
            true => table.numbers(&[value]),
            false => table.text(""),
        }
    }
}

fn place(study: &Study, swept: &Swept) -> Option<usize> {
    let Swept::Parameter(name) = swept else { return None };
    study.model.parameters.symbols().iter().position(|symbol| *symbol.name == **name)
}

/// Which run an event is of: its folder, and what is swept.
fn which(study: &Study) -> Vec<String> {
    let parameters = study.model.parameters.symbols();
    let name = |swept: &Swept| match place(study, swept) {
        Some(place) => parameter(study, &parameters[place]),
        None => "accuracy".to_owned(),
    };
    let swept = study.sweep.iter().map(|axis| name(&axis.of));
    std::iter::once("run".to_owned()).chain(swept).collect()
}

fn parameter(study: &Study, symbol: &tumble_expr::Symbol) -> String {
    column(&symbol.name, &unit(symbol.dimension, study.angles.contains(&*symbol.name)))
}

fn run_columns(study: &Study) -> Vec<String> {
    let find = |find: &Question| {
        let (name, unit) = (format!("find {}", find.name), &find.that.quantity.unit);
        [format!("{name} at [s]"), column(&name, unit), column(&format!("{name} error"), unit)]
    };
    let check = |check: &Check| {
        let (name, unit) = (format!("check {}", check.question.name), &check.question.that.quantity.unit);
        [column(&format!("{name} found"), unit), column(&format!("{name} error"), unit), name]
    };
    let states = study.equations().states(&study.equations().idle_mode());
    let end = states
        .iter()
        .map(|state| column(&format!("end {}", state.name), &unit(state.dimension, is_angle(state))));
    let first = ["run".to_owned(), "label".to_owned()];
    let last =
        ["accuracy", "error reached", "verified until [s]", "steps", "events", "state"].map(str::to_owned);
    let parameters = study.model.parameters.symbols();
    let parameters = parameters.iter().map(|symbol| parameter(study, symbol));
    let asked = study.finds.iter().flat_map(find).chain(study.checks.iter().flat_map(check));
    let ends = std::iter::once("end [s]".to_owned()).chain(end);
    first.into_iter().chain(parameters).chain(asked).chain(ends).chain(last).collect()
}
