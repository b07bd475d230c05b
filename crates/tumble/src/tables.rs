//! The tables of runs as files of their folder.

use tumble_report::results::Case;
use tumble_report::tables::{self, BALANCE, EVENTS, RUNS, SweepTables, TRAJECTORY};
use tumble_scene::Study;

use crate::output::{Folder, OutputError, TableFile};
use crate::pipeline::PipelineError;

/// Writes the motion and its events.
pub(crate) fn write(study: &Study, case: &Case, folder: &Folder) -> Result<(), PipelineError> {
    one(case, TRAJECTORY, folder, |table| tables::trajectory(study, case, table))?;
    one(case, EVENTS, folder, |table| tables::events(case, table))
}

/// Writes the balance beside them.
pub(crate) fn write_balance(case: &Case, folder: &Folder) -> Result<(), PipelineError> {
    one(case, BALANCE, folder, |table| tables::balance(case, table))
}

fn one(
    case: &Case,
    name: &str,
    folder: &Folder,
    write: impl FnOnce(&mut TableFile<'_>) -> Result<(), PipelineError>,
) -> Result<(), PipelineError> {
    let mut table = TableFile::begin(folder, &format!("{}/{name}", case.folder()))?;
    write(&mut table)?;
    Ok(table.finish()?)
}

/// Begins the tables of a sweep; `None` where nothing is swept.
pub(crate) fn begin_sweep<'f>(
    study: &Study,
    folder: &'f Folder,
) -> Result<Option<SweepTables<TableFile<'f>>>, PipelineError> {
    if study.sweep.is_empty() {
        return Ok(None);
    }
    let [runs, events] = [RUNS, EVENTS].map(|name| TableFile::begin(folder, name));
    SweepTables::begin(study, runs?, events?).map(Some)
}

/// Ends them.
pub(crate) fn end_sweep(sweep: SweepTables<TableFile<'_>>) -> Result<(), OutputError> {
    sweep.end().into_iter().try_for_each(TableFile::finish)
}
