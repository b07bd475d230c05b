//! Energy, momentum, and what changed them, as tables and a figure.

use tumble_mech::Balance as LedgerBalance;
use tumble_report::Label;
use tumble_report::report::{Books as Shown, Column, Plot, Table, Text};
use tumble_scene::Sheet;

use super::names::quantity;
use crate::book_figures::sheet;
use crate::books::Books;
use crate::case::Case;

const RESIDUAL: &str = "Residual of the energy";
/// What is less than this part of the largest of its kind in the run is zero but for rounding; a residual is told as it is.
const NOTHING: f64 = 1e-15;

pub(super) fn of(case: &Case) -> Option<Shown> {
    let books = case.books.as_ref()?;
    Some(Shown {
        intro: vec![
            "The energy changes by the work of the loads that have no potential, momentum by their impulses. \
             What is left is the residual: rounding, and what the integration left out."
                .into(),
        ],
        tables: vec![balances(books), entries(books)],
        plots: vec![
            Plot::over_time(sheet(books, "Energies", Sheet::Energies), "Energies"),
            Plot::over_time(sheet(books, RESIDUAL, Sheet::Residual), RESIDUAL),
        ],
    })
}

fn balances(books: &Books) -> Table {
    let columns = vec![
        Column::words("Balance"),
        Column::numbers("At the start"),
        Column::numbers("At the end"),
        Column::numbers("Accounted for"),
        Column::numbers("Residual"),
    ];
    let row = |name: &str, unit: &str, balance: &LedgerBalance| {
        let values = [balance.start, balance.end, balance.change].map(|value| seen(value, balance));
        let name = Text::from(format!("{name} (")).and(Label::unit(unit)).and(")");
        std::iter::once(name).chain(values).chain([quantity(balance.residual, "")]).collect()
    };
    let [x, y] = &books.total.momentum;
    Table::new("The books", columns)
        .row(row("Energy", "J", &books.energy))
        .row(row("Momentum, x", "N*s", x))
        .row(row("Momentum, y", "N*s", y))
        .row(row("Angular momentum about the origin", "N*m*s", &books.total.angular_momentum))
}

fn seen(value: f64, of: &LedgerBalance) -> Text {
    quantity(if value.abs() < NOTHING * of.scale { 0.0 } else { value }, "")
}

fn entries(books: &Books) -> Table {
    let with = |words: &str, unit: &str| Text::from(format!("{words} (")).and(Label::unit(unit)).and(")");
    let columns = vec![
        Column::words("Load"),
        Column::numbers(with("Work", "J")),
        Column::numbers(with("Impulse, x", "N*s")),
        Column::numbers(with("Impulse, y", "N*s")),
        Column::numbers(with("Angular impulse", "N*m*s")),
    ];
    let mut table = Table::new("What every load did", columns);
    for (name, entry) in &books.entries {
        let ([x, y], angular) = (&books.total.momentum, &books.total.angular_momentum);
        let cells = [
            seen(entry.work, &books.energy),
            seen(entry.impulse[0], x),
            seen(entry.impulse[1], y),
            seen(entry.angular_impulse, angular),
        ];
        table.rows.push(std::iter::once(Text::from(name.as_str())).chain(cells).collect());
    }
    if books.entries.iter().any(|(_, entry)| !entry.counts()) {
        table.notes.push("Work marked (potential) is already in the potential energy.".into());
    }
    table
}
