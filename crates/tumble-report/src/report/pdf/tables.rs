//! Tables as Typst.

use super::inline::{lead, paragraphs, text};
use crate::report::prose::Text;
use crate::report::table::{Align, Table};

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
    if kept.is_empty() {
        return String::new();
    }
    let align = |i: &usize| if table.columns[*i].align == Align::Right { "right, " } else { "left, " };
    let align: String = kept.iter().map(align).collect();
    let head: String = kept.iter().map(|i| cell(Some(&table.columns[*i].heading))).collect();
    let line = |row: &Vec<Text>| kept.iter().map(|i| cell(row.get(*i))).collect::<String>() + "\n";
    let body: String = table.rows.iter().map(line).collect();
    format!("#rows([{}], ({align}), ({head}),\n{body})\n", text(&table.caption))
}

fn cell(content: Option<&Text>) -> String {
    format!("[{}], ", content.map(text).unwrap_or_default())
}
