//! `[table.NAME]`: a function that was measured, from a file beside the scene.

use std::sync::Arc;

use tumble_expr::language::Measured;
use tumble_expr::{Interpolation, Outside, Table as Values, TableError};

use super::each;
use crate::code::Code;
use crate::csv_text::{Column, Sheet};
use crate::diagnostic::{Diagnostic, SourceText};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::files::{MAX_FILE_BYTES, is_inside};
use crate::keys::{Keys, Takes, must};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[table.NAME]", &[&[
    must("file", Takes::Text, "\"gust.csv\"", "a CSV file in the scene's folder or below it"),
    must("columns", Takes::Pair(&Takes::Text), "[\"t [s]\", \"w [m/s]\"]",
        "headers of the variable and of the value: `[\"t [s]\", \"w [m/s]\"]`"),
    must("interpolation", Takes::Word(&BETWEEN), "\"linear\"",
        "`\"constant\"`: each value holds up to the next; `\"linear\"`; `\"cubic\"`: the natural spline"),
    must("outside", Takes::Word(&BEYOND), "\"hold\"",
        "before the first and after the last value: `\"hold\"` the nearest, `\"zero\"`, or `\"refuse\"` the \
         motion"),
]]);

const BETWEEN: [&str; 3] = ["constant", "linear", "cubic"];
const BEYOND: [&str; 3] = ["hold", "zero", "refuse"];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, table);
}

/// What holds between and outside the measured values is the user's to say: there are no defaults.
fn table(draft: &mut Draft, field: &Field, table: &mut Table) {
    let claimed = draft.names.claim("a table", field.key, field.key_span.clone());
    let claimed = draft.noted(claimed);
    draft.remember(format!("`{}`", field.key), &field.key_span);
    let sheet = draft.required(table, "file").and_then(|field| sheet(draft, &field));
    let columns = draft.required(table, "columns");
    let columns = columns.and_then(|field| columns_of(draft, &field, sheet.as_ref()?));
    let interpolation = draft.required(table, "interpolation");
    let interpolation = interpolation.and_then(|field| between(draft, &field));
    let outside = draft.required(table, "outside").and_then(|field| beyond(draft, &field));
    let all = (claimed, sheet, columns, interpolation, outside);
    let measured = match all {
        (Some(()), Some(sheet), Some(columns), Some(interpolation), Some(outside)) => {
            measured(draft, field.key, &sheet, columns, (interpolation, outside))
        }
        _ => None,
    };
    match measured {
        Some(measured) => draft.names.define_measured(&measured),
        None => draft.names.break_name(field.key),
    }
}

fn between(draft: &mut Draft, field: &Field) -> Option<Interpolation> {
    Some(match draft.choice(field, &BETWEEN)? {
        "constant" => Interpolation::Constant,
        "linear" => Interpolation::Linear,
        _ => Interpolation::Cubic,
    })
}

fn beyond(draft: &mut Draft, field: &Field) -> Option<Outside> {
    Some(match draft.choice(field, &BEYOND)? {
        "hold" => Outside::Hold,
        "zero" => Outside::Zero,
        _ => Outside::Refuse,
    })
}

/// The file's header and rows.
fn sheet(draft: &mut Draft, field: &Field) -> Option<Sheet> {
    let name = draft.words(field)?;
    let text = text(draft, field, &name)?;
    match Sheet::parse(&name, text) {
        Ok(sheet) => Some(sheet),
        Err(mistake) => {
            draft.note(mistake.at(field.span.clone()));
            None
        }
    }
}

fn text(draft: &mut Draft, field: &Field, name: &str) -> Option<String> {
    let mistake = |code, message: String| Diagnostic::new(code, field.span.clone(), message);
    if !is_inside(name) {
        let message = format!("\"{name}\" leads out of the scene's folder");
        let help = "put the file beside the scene, or in a folder there, and write its path with `/`: \"data/gust.csv\"";
        draft.note(mistake(Code::FilePath, message).label("not in the scene's folder").help(help));
        return None;
    }
    let problem = match draft.files.get(name) {
        Some(Ok(bytes)) if bytes.len() > MAX_FILE_BYTES => {
            mistake(Code::TooLarge, format!("\"{name}\" has more than {MAX_FILE_BYTES} bytes"))
        }
        Some(Ok(bytes)) => match String::from_utf8(bytes.clone()) {
            Ok(text) => return Some(text),
            Err(error) => {
                let good = &bytes[..error.utf8_error().valid_up_to()];
                let line = good.iter().filter(|byte| **byte == b'\n').count() + 1;
                mistake(Code::Encoding, format!("\"{name}\" is no text in UTF-8: see its line {line}"))
                    .help("save the file as CSV in UTF-8")
            }
        },
        Some(Err(error)) => mistake(Code::FileRead, format!("\"{name}\" cannot be read: {error}"))
            .help("the path is counted from the scene's folder"),
        None => mistake(Code::FileRead, format!("\"{name}\" cannot be read")),
    };
    draft.note(problem);
    None
}

/// The columns of the variable and of the value.
fn columns_of(draft: &mut Draft, field: &Field, sheet: &Sheet) -> Option<[Column; 2]> {
    let columns = draft.pair(field, "[variable, value]")?;
    let [x, y] = columns.each_ref().map(|field| {
        let name = draft.words(field)?;
        let column = sheet.column(&name).map_err(|mistake| mistake.at(field.span.clone()));
        draft.noted(column)
    });
    Some([x?, y?])
}

fn measured(
    draft: &mut Draft,
    name: &str,
    sheet: &Sheet,
    [x, y]: [Column; 2],
    (interpolation, outside): (Interpolation, Outside),
) -> Option<Measured> {
    let rows = match sheet.rows([&x, &y]) {
        Ok(rows) => rows,
        Err(mistake) => return in_file(draft, sheet, mistake),
    };
    match Values::new(name, [x.dimension, y.dimension], &rows, interpolation, outside) {
        Ok(table) => Some(Measured { table: Arc::new(table), variable: x.name }),
        Err(error) => {
            let mistake = out_of_order(sheet, &x, &error);
            in_file(draft, sheet, mistake)
        }
    }
}

fn out_of_order(sheet: &Sheet, x: &Column, error: &TableError) -> Diagnostic {
    match error {
        TableError::TooShort(rows) => {
            let message = format!("a table has two rows or more below its header, and this has {rows}");
            Diagnostic::new(Code::FileTable, 0..0, message).nowhere()
        }
        TableError::Order { row, .. } => {
            let message = format!("`{}` does not increase in line {}", x.cell, sheet.line(*row));
            Diagnostic::new(Code::Cell, sheet.cell(*row, x.index), message)
                .label("not after the row above")
                .help("sort the rows by the variable, and leave out rows that repeat one")
        }
        TableError::NotFinite { row } => {
            let message = format!("line {} holds a number that is not finite", sheet.line(*row));
            Diagnostic::new(Code::Cell, sheet.cell(*row, x.index), message)
        }
    }
}

/// A mistake in the file itself, which is shown as the scene is.
fn in_file(draft: &mut Draft, sheet: &Sheet, mistake: Diagnostic) -> Option<Measured> {
    draft.sources.push(SourceText { name: sheet.name.clone(), text: sheet.text.clone() });
    draft.note(mistake.within(draft.sources.len() - 1));
    None
}
