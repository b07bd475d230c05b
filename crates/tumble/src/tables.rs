//! The motion as tables: `trajectory.csv`, `events.csv` and `balance.csv`.

use tumble_expr::Expr;
use tumble_report::results::{Case, CaseBalance, CaseError, is_angle, sample, unit};
use tumble_scene::Study;

use crate::output::{Folder, OutputError, Table};
use crate::pipeline::PipelineError;
use crate::sweep_tables::column;

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
    let mut observer = run.observe(&formulas).map_err(CaseError::from)?;
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

/// Writes `balance.csv` beside the other tables of the run.
pub(crate) fn write_balance(balance: &CaseBalance, case: &Case, folder: &Folder) -> Result<(), OutputError> {
    let mut table = Table::begin(folder, &format!("{}/balance.csv", case.folder()))?;
    let units = |name: &String| if name == "t" { "t [s]".to_owned() } else { format!("{name} [J]") };
    table.row(balance.columns.iter().map(units))?;
    for row in &balance.rows {
        table.numbers(row);
        table.end_row()?;
    }
    table.finish()
}
