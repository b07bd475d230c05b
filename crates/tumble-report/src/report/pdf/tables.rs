//! Tables as Typst.

use super::inline::{lead, paragraphs, text};
use crate::report::prose::Text;
use crate::report::table::{Align, Table};

/// Columns that stand side by side; the others go on below, with the first column again.
const MOST_COLUMNS: usize = 8;

/// A table with the lines below it. Columns without any content are left out; without rows the lines stand alone.
pub(super) fn table(table: &Table) -> String {
    let notes = paragraphs(&table.notes);
    let alone = table.rows.is_empty() && !notes.is_empty();
    let lead = if alone { lead(&table.caption) } else { String::new() };
    [grid(table), lead, notes].concat()
}

fn grid(table: &Table) -> String {
    let filled = |i: &usize| table.rows.iter().any(|row| row.get(*i).is_some_and(|cell| !cell.is_empty()));
    let kept: Vec<usize> = (0..table.columns.len()).filter(filled).collect();
    match kept.split_first() {
        Some((first, rest)) if kept.len() > MOST_COLUMNS => {
            let parts = rest.chunks(MOST_COLUMNS - 1);
            parts.map(|part| part_of(table, &[&[*first], part].concat())).collect()
        }
        Some(_) => part_of(table, &kept),
        None => String::new(),
    }
}

/// Some columns of a table.
fn part_of(table: &Table, columns: &[usize]) -> String {
    let align = |i: &usize| if table.columns[*i].align == Align::Right { "right, " } else { "left, " };
    let align: String = columns.iter().map(align).collect();
    let head: String = columns.iter().map(|i| cell(Some(&table.columns[*i].heading))).collect();
    let line = |row: &Vec<Text>| columns.iter().map(|i| cell(row.get(*i))).collect::<String>() + "\n";
    let body: String = table.rows.iter().map(line).collect();
    format!("#rows([{}], ({align}), ({head}),\n{body})\n", text(&table.caption))
}

fn cell(content: Option<&Text>) -> String {
    format!("[{}], ", content.map(text).unwrap_or_default())
}
