//! Tables of numbers in CSV: a header that states units, and rows.

use csv::{ReaderBuilder, StringRecord, Trim};
use tumble_expr::Dimension;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::printable::printable;
use crate::suggest;
use crate::unit_text::unit;

/// A table may have this many rows.
pub(crate) const MAX_ROWS: usize = 2_000_000;

/// A file as cells.
pub(crate) struct Sheet {
    pub(crate) name: String,
    pub(crate) text: String,
    header: StringRecord,
    rows: Vec<StringRecord>,
}

/// A column: its header cell, and what stands in it.
pub(crate) struct Column {
    pub(crate) index: usize,
    /// The header's cell, `w [m/s]`.
    pub(crate) cell: String,
    /// The cell without its unit.
    pub(crate) name: String,
    pub(crate) dimension: Dimension,
    /// SI units in one of its unit.
    size: f64,
}

/// A mistake whose place in the scene is not known here.
pub(crate) struct Unplaced(Diagnostic);

impl Unplaced {
    fn new(code: Code, message: String, label: &str, help: String) -> Self {
        // Names of columns may have any character, and the help is one line.
        Self(Diagnostic::new(code, 0..0, message).label(label).help(printable(&help)))
    }

    pub(crate) fn at(mut self, span: Span) -> Diagnostic {
        if let Some(label) = self.0.labels.first_mut() {
            label.span = span;
        }
        self.0
    }
}

impl Sheet {
    /// Reads the cells; lines that begin with `#` are comments.
    pub(crate) fn parse(name: &str, text: String) -> Result<Self, Unplaced> {
        let bad = |message: String, help: &str| {
            Err(Unplaced::new(
                Code::FileTable,
                format!("\"{name}\" {message}"),
                "not a table",
                help.to_owned(),
            ))
        };
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        let mut reader =
            ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text.as_bytes());
        let mut rows = vec![];
        let header = match reader.headers() {
            Ok(header) => header.clone(),
            Err(error) => return bad(format!("is not CSV: {error}"), "separate the cells by commas"),
        };
        if header.len() < 2 {
            let help = "the first line names the columns, separated by commas: `t [s], w [m/s]`";
            return bad("has no header of two columns or more".to_owned(), help);
        }
        for row in reader.records() {
            match row {
                Ok(row) => rows.push(row),
                Err(error) => return bad(uneven(&error), "every line has as many cells as the header"),
            }
            if rows.len() > MAX_ROWS {
                return bad(format!("has more than {MAX_ROWS} rows"), "take fewer of them");
            }
        }
        Ok(Self { name: name.to_owned(), header, rows, text })
    }

    /// The column under a cell of the header.
    pub(crate) fn column(&self, cell: &str) -> Result<Column, Unplaced> {
        let Some(index) = self.header.iter().position(|known| known == cell.trim()) else {
            let message = format!("\"{}\" has no column \"{cell}\"", self.name);
            let help = suggest::name(cell, "columns", self.header.iter());
            return Err(Unplaced::new(Code::UnknownColumn, message, "unknown column", help));
        };
        let cell = cell.trim();
        let Some((name, written)) = cell.strip_suffix(']').and_then(|cell| cell.rsplit_once('[')) else {
            let message = format!("the column \"{cell}\" does not state its unit");
            let help = format!(
                "write the unit into the header of \"{}\", such as `{cell} [s]`, or `{cell} [1]` for a pure number",
                self.name
            );
            return Err(Unplaced::new(Code::ColumnUnit, message, "which unit?", help));
        };
        let (dimension, size) = stated(written.trim()).ok_or_else(|| {
            let message = format!("`{written}` in the header of \"{}\" is not a unit", self.name);
            let help = "units are written as in formulas, without spaces: `[m/s]`, `[kg*m^2]`, `[deg]`";
            Unplaced::new(Code::ColumnUnit, message, "unknown unit", help.to_owned())
        })?;
        Ok(Column { index, cell: cell.to_owned(), name: name.trim().to_owned(), dimension, size })
    }

    /// The numbers of two columns, SI units.
    pub(crate) fn rows(&self, columns: [&Column; 2]) -> Result<Vec<[f64; 2]>, Diagnostic> {
        let row = |(at, row): (usize, &StringRecord)| {
            let [x, y] = columns.map(|column| self.number(at + 1, row, column));
            Ok([x?, y?])
        };
        self.rows.iter().enumerate().map(row).collect()
    }

    fn number(&self, at: usize, row: &StringRecord, column: &Column) -> Result<f64, Diagnostic> {
        let cell = row.get(column.index).unwrap_or_default();
        match cell.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(in_si(number, column.size)),
            _ => {
                let message = format!(
                    "line {}: `{cell}` in the column \"{}\" is not a number",
                    self.line(at),
                    column.cell
                );
                let mistake = Diagnostic::new(Code::Cell, self.cell(at, column.index), message);
                Err(mistake
                    .label("not a finite number")
                    .help("write numbers such as `-1.5` or `2e-3`, with a decimal point"))
            }
        }
    }

    /// The line of a row, both counted from 1.
    pub(crate) fn line(&self, row: usize) -> u64 {
        self.rows.get(row - 1).and_then(StringRecord::position).map_or(0, csv::Position::line)
    }

    /// Where a cell stands in the text; its whole line where quotes stand in it.
    pub(crate) fn cell(&self, row: usize, column: usize) -> Span {
        let begin = self.rows.get(row - 1).and_then(StringRecord::position).map_or(0, |p| p.byte() as usize);
        let begin = begin.min(self.text.len());
        let line = self.text.get(begin..).and_then(|rest| rest.lines().next()).unwrap_or_default();
        let before: usize = line.split(',').take(column).map(|cell| cell.len() + 1).sum();
        match line.split(',').nth(column) {
            Some(cell) if !line.contains('"') && !cell.trim().is_empty() => {
                let start = begin + before + (cell.len() - cell.trim_start().len());
                start..start + cell.trim().len()
            }
            _ => begin..begin + line.len(),
        }
    }
}

fn uneven(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("has {len} cells in line {line}, and {expected_len} in its header")
        }
        _ => format!("is not CSV: {error}"),
    }
}

/// What a unit measures, and how many SI units it is.
fn stated(unit_text: &str) -> Option<(Dimension, f64)> {
    if unit_text == "1" {
        return Some((Dimension::NONE, 1.0));
    }
    let (one, size) = unit(unit_text)?;
    Some((one.dimension().ok()?, size))
}

/// Dividing by a whole number, where there is one, rounds once only.
fn in_si(number: f64, size: f64) -> f64 {
    let parts = (1.0 / size).round();
    if parts > 1.0 && 1.0 / parts == size { number / parts } else { number * size }
}
