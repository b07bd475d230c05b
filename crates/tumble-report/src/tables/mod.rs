//! Tables of runs, cell by cell: what takes the cells decides where they go.
//!
//! A run has `trajectory.csv`, `events.csv` and `balance.csv` in its folder, a sweep `runs.csv` and `events.csv` beside them.

use std::borrow::Cow;

use tumble_scene::Study;

use crate::results::{Case, CaseError, Finished, folder};

mod run;
mod sweep;

pub use run::{balance, events, trajectory};
pub use sweep::SweepTables;

/// The tables of a run.
pub const OF_RUN: [&str; 3] = [TRAJECTORY, EVENTS, BALANCE];
/// The motion.
pub const TRAJECTORY: &str = "trajectory.csv";
/// What happened, of a run or of all runs of a sweep.
pub const EVENTS: &str = "events.csv";
/// Energies and works.
pub const BALANCE: &str = "balance.csv";
/// The runs of a sweep.
pub const RUNS: &str = "runs.csv";

/// The last column of what is told by time: whether digits are verified then.
const VERIFIED: &str = "verified";

/// What a cell of text is put in quotes for: a reader would take it for the end of the cell, or of the row.
const SPECIAL: [char; 4] = [',', '"', '\n', '\r'];

/// What takes the cells of a table, row by row.
pub trait TableWriter {
    /// Why it cannot.
    type Error: From<CaseError>;

    /// Takes a cell of the row at hand.
    fn text(&mut self, cell: &str);

    /// Takes cells of the row at hand.
    fn numbers(&mut self, values: &[f64]);

    /// Ends the row at hand.
    fn end_row(&mut self) -> Result<(), Self::Error>;

    /// Takes a row of text.
    fn row(&mut self, cells: impl IntoIterator<Item = String>) -> Result<(), Self::Error> {
        cells.into_iter().for_each(|cell| self.text(&cell));
        self.end_row()
    }
}

/// A cell of text as CSV has it (RFC 4180).
fn quoted(cell: &str) -> Cow<'_, str> {
    match cell.contains(SPECIAL) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")).into(),
        false => cell.into(),
    }
}

/// A cell of the last column.
fn verified(is_verified: bool) -> &'static str {
    if is_verified { "1" } else { "0" }
}

/// The header of a column; a pure number is in units of 1.
fn column(name: &str, unit: &str) -> String {
    format!("{name} [{}]", if unit.is_empty() { "1" } else { unit })
}

/// Rows that are held as CSV (RFC 4180): they end in a line feed, and numbers are the shortest decimals that read back as the same.
#[derive(Default)]
pub struct Held {
    /// The rows; within one each cell ends in a comma.
    pub text: String,
    digits: zmij::Buffer,
}

impl TableWriter for Held {
    type Error = CaseError;

    fn text(&mut self, cell: &str) {
        self.text.push_str(&quoted(cell));
        self.text.push(',');
    }

    fn numbers(&mut self, values: &[f64]) {
        for value in values {
            self.text.push_str(self.digits.format(*value));
            self.text.push(',');
        }
    }

    fn end_row(&mut self) -> Result<(), CaseError> {
        self.text.pop();
        self.text.push('\n');
        Ok(())
    }
}

/// All tables of these runs, each behind its path.
pub fn all(study: &Study, cases: &[Case]) -> Result<Vec<(String, String)>, CaseError> {
    let mut tables = vec![];
    for case in cases {
        let mut held = [Held::default(), Held::default(), Held::default()];
        let [motion, happened, energies] = &mut held;
        trajectory(study, case, motion)?;
        events(case, happened)?;
        balance(case, energies)?;
        let paths = OF_RUN.map(|name| format!("{}/{name}", folder(case.number)));
        tables
            .extend(paths.into_iter().zip(held.map(|table| table.text)).filter(|(_, text)| !text.is_empty()));
    }
    if !study.sweep.is_empty() {
        tables.extend(of_sweep(study, cases)?);
    }
    Ok(tables)
}

fn of_sweep(study: &Study, cases: &[Case]) -> Result<[(String, String); 2], CaseError> {
    let mut sweep = SweepTables::begin(study, Held::default(), Held::default())?;
    cases.iter().try_for_each(|case| sweep.add(&Finished::of(case)))?;
    let [runs, events] = sweep.end();
    Ok([(RUNS.to_owned(), runs.text), (EVENTS.to_owned(), events.text)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::motions_in;

    #[test]
    fn cells_are_quoted_where_a_reader_would_be_misled() {
        let mut table = Held::default();
        table.text("a, \"b\"\n");
        table.numbers(&[0.1 + 0.2, 1e300, f64::NAN]);
        let _ = table.end_row();
        assert_eq!(table.text, "\"a, \"\"b\"\"\n\",0.30000000000000004,1e+300,NaN\n");
    }

    /// A rod that stands on its tip falls in a direction that nobody knows.
    #[test]
    fn tables_say_where_digits_end() {
        let scene = r#"
            version = 1
            [world]
            gravity = "9.81 m/s^2"
            [body.rod]
            rod = { from = [0, 0], to = [0, "1 m"] }
            mass = "1 kg"
            points = { foot = [0, 0] }
            start = { angle = "1e-9 rad" }
            [pin.hinge]
            between = ["rod.foot", { world = [0, 0] }]
            [run]
            until = "30 s"
        "#;
        let (study, cases) = motions_in("rod", scene.as_bytes(), &tumble_scene::NoFiles);
        let end = cases[0].verified_until();
        assert!((5.0..25.0).contains(&end), "{end} s");
        for row in motion_of(&study, &cases).lines().skip(1) {
            let cells: Vec<&str> = row.split(',').collect();
            let time: f64 = cells[0].parse().expect("a time");
            assert_eq!(cells.last(), Some(&verified(time <= end)), "{time} s");
        }
    }

    /// Of balls in a row the first reaches the second, and the third is too far away.
    #[test]
    fn couples_that_may_all_meet_have_columns_where_they_do() {
        let balls: String = (0..3)
            .map(|index| {
                let (x, speed) = (index * index, if index == 0 { 2 } else { 0 });
                format!(
                    "[body.b{index}]\nball = {{ radius = \"10 cm\" }}\nmass = \"1 kg\"\n\
                     start = {{ at = [\"{x} m\", 0], velocity = [\"{speed} m/s\", 0] }}\n"
                )
            })
            .collect();
        let header = |between: &str| {
            let scene = format!(
                "version = 1\n[world]\ngravity = \"0 m/s^2\"\n{balls}[contact.hit]\nbetween = {between}\nrigid = {{ restitution = 0.5 }}\n\
                 [run]\nuntil = \"1 s\""
            );
            let (study, cases) = motions_in("balls", scene.as_bytes(), &tumble_scene::NoFiles);
            motion_of(&study, &cases).lines().next().expect("a header").to_owned()
        };
        let has = |header: &str, couple: &str| header.contains(&format!("hit.{couple}.gap"));
        let all = header("\"all\"");
        let found = ["b0.b1", "b0.b2", "b1.b2"].map(|couple| has(&all, couple));
        assert_eq!(found, [true, false, false], "{all}");
        assert!(has(&header("[\"b1\", \"b2\"]"), "b1.b2"), "who is named has its columns");
    }

    fn motion_of(study: &Study, cases: &[Case]) -> String {
        let tables = all(study, cases).expect("tables");
        tables.into_iter().find(|(path, _)| path.ends_with(TRAJECTORY)).expect("a motion").1
    }
}
