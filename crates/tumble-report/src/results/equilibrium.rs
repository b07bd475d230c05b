//! The pose of equilibrium near the start, in words, as data and as a table.

use crate::report::{Column, PrintedTable, Text};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use tumble_mech::{Equilibrium, Growth, SmallMotions, Stability};

use crate::fill::quantity_to;

/// Digits that are shown.
const SHOWN: usize = 6;
/// Of the largest number of a kind; less is rounding.
const NOTHING: f64 = 1e-10;
/// Smaller numbers are written with a power of ten.
const SMALL: f64 = 1e-4;
/// More lines are counted, not said.
const MOST_LINES: usize = 20;

/// A body's place, or what holds it, with the unit of each number.
struct Row<'a> {
    /// Whose name it has.
    of: &'static str,
    name: &'a str,
    what: [&'static str; 3],
    values: [f64; 3],
    units: [&'static str; 3],
}

fn rows(found: &Equilibrium) -> Vec<Row<'_>> {
    let poses = found.poses.iter().map(|pose| Row {
        of: "body",
        name: &pose.body,
        what: ["x", "y", "angle"],
        values: [pose.at[0], pose.at[1], pose.angle],
        units: ["m", "m", "rad"],
    });
    let reactions = found.reactions.iter().map(|reaction| Row {
        of: "name",
        name: &reaction.name,
        what: ["fx", "fy", "torque"],
        values: [reaction.force[0], reaction.force[1], reaction.couple],
        units: ["N", "N", "N m"],
    });
    poses.chain(reactions).collect()
}

/// The numbers of a row, with nothing in the place of rounding.
fn cleared(row: &Row<'_>, rows: &[Row<'_>]) -> [f64; 3] {
    let alike = rows.iter().filter(|other| other.of == row.of).flat_map(|other| other.values);
    let largest = alike.map(f64::abs).fold(0.0, f64::max);
    row.values.map(|value| if value.abs() <= NOTHING * largest { 0.0 } else { value })
}

/// What becomes of small motions: `stable, swings at 3.83601 rad/s`.
fn small_motions(found: &SmallMotions) -> String {
    let SmallMotions { frequencies, growing, neutral } = found;
    let list = |values: Vec<String>| match values.len() {
        0..=MOST_LINES => values.join(", "),
        more => format!("{}, and {} more", values[..MOST_LINES].join(", "), more - MOST_LINES),
    };
    let mut parts = vec![found.stability().word().to_owned()];
    if !growing.is_empty() {
        let growth = |Growth { rate, frequency }: &Growth| match *frequency {
            0.0 => short(*rate),
            swings => format!("{} (swinging at {} rad/s)", short(*rate), short(swings)),
        };
        parts.push(format!("grows at {} 1/s", list(growing.iter().map(growth).collect())));
    }
    if !frequencies.is_empty() {
        parts.push(format!("swings at {} rad/s", list(frequencies.iter().map(|f| short(*f)).collect())));
    }
    if *neutral > 0 && found.stability() != Stability::Fixed {
        parts.push(format!("nothing pulls back in {neutral} of its ways to move"));
    }
    parts.join(", ")
}

/// The shortest number that is the same to the digits that are shown.
fn short(value: f64) -> String {
    let rounded = format!("{value:.*e}", SHOWN - 1).parse().unwrap_or(value);
    if rounded != 0.0 && rounded.abs() < SMALL { format!("{rounded:e}") } else { format!("{rounded}") }
}

/// Lines for a terminal.
pub(crate) fn lines(found: &Equilibrium) -> Vec<String> {
    let rows = rows(found);
    let line = |row: &Row<'_>| {
        let parts = row.what.iter().zip(cleared(row, &rows)).zip(row.units);
        let parts = parts.filter(|((what, value), _)| **what != "torque" || *value != 0.0);
        let parts: Vec<String> =
            parts.map(|((what, value), unit)| format!("{what} = {} {unit}", short(value))).collect();
        format!("    {}: {}", row.name, parts.join(", "))
    };
    let mut lines = vec![format!("  equilibrium: {}", small_motions(&found.small_motions))];
    lines.extend(rows.iter().take(MOST_LINES).map(line));
    if rows.len() > MOST_LINES {
        lines.push(format!("    and {} more", rows.len() - MOST_LINES));
    }
    lines
}

/// Tables for the report.
pub(crate) fn tables(found: &Equilibrium) -> Vec<PrintedTable> {
    let rows = rows(found);
    let table = |caption: &str, of: &str, head: &str, heads: [&str; 3]| {
        let columns = std::iter::once(Column::words(head)).chain(heads.map(Column::numbers)).collect();
        let own = rows.iter().filter(|row| row.of == of);
        own.fold(PrintedTable::new(caption, columns), |table, row| {
            let cells = cleared(row, &rows).map(|value| quantity_to(value, SHOWN, ""));
            table.row(std::iter::once(Text::from(row.name.to_owned())).chain(cells).collect())
        })
    };
    let mut poses = table(
        "The bodies are in equilibrium here, near the start.",
        "body",
        "Body",
        ["x (m)", "y (m)", "angle (rad)"],
    );
    poses.notes.push(format!("Small motions about it: {}.", small_motions(&found.small_motions)).into());
    let reactions = table(
        "These forces and torques hold them there.",
        "name",
        "Joint or contact",
        ["along x (N)", "along y (N)", "torque (N m)"],
    );
    if reactions.rows.is_empty() { vec![poses] } else { vec![poses, reactions] }
}

/// As `summary.json` has it, SI units.
#[derive(Serialize)]
pub struct Summary<'a> {
    stability: &'static str,
    frequencies: &'a [f64],
    growing: Vec<Growing>,
    neutral: usize,
    poses: Vec<Row<'a>>,
    reactions: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Growing {
    rate: f64,
    frequency: f64,
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry(self.of, self.name)?;
        let mut numbers = self.what.iter().zip(self.values);
        numbers.try_for_each(|(what, value)| map.serialize_entry(what, &value))?;
        map.end()
    }
}

impl<'a> Summary<'a> {
    /// What is told of an equilibrium.
    pub fn of(found: &'a Equilibrium) -> Self {
        let growing = |growth: &Growth| Growing { rate: growth.rate, frequency: growth.frequency };
        let (poses, reactions) = rows(found).into_iter().partition(|row| row.of == "body");
        Self {
            stability: found.small_motions.stability().word(),
            frequencies: &found.small_motions.frequencies,
            growing: found.small_motions.growing.iter().map(growing).collect(),
            neutral: found.small_motions.neutral,
            poses,
            reactions,
        }
    }
}
