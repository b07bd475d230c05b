//! Tables as HTML.

use super::inline::tagged;
use super::page::Page;
use crate::report::markup::Markup;
use crate::report::parts::CheckRow;
use crate::report::prose::Text;
use crate::report::rows;
use crate::report::table::{Align, Column, PrintedTable, WIDE};
use tumble_drawing::svg::escape;

/// Rows of a long table that are shown at first.
const FOLD: usize = 20;
/// Rows of a table that stay together on paper.
const KEPT: usize = 8;
/// Rows of a long table on paper, where a file has them all.
const PRINTED: usize = 300;
/// Signs of a row, its columns set apart, that a third or a half of the paper's width holds.
const THIRD: usize = 52;
const HALF: usize = 80;
/// What sets two columns apart, in signs.
const GAP: usize = 3;

/// Columns from which on the cells of a row stand below each other where the page is narrow; on paper, more than [`WIDE`].
const STACKED: usize = 3;

/// A table of the report.
pub(super) fn table(table: &PrintedTable) -> String {
    let grid = grid(table, &cells(table));
    // What is a list of its own, and not beside others.
    let is_listed = table.is_upright || table.file.is_some();
    let is_long = table.rows.len() > if is_listed { KEPT } else { FOLD };
    let grid = if is_long { long(table, &grid) } else { grid };
    let notes = table.notes.iter().cloned().chain(table.all_rows());
    let notes: String = notes.map(|note| tagged("p", "note", &Page::text(&note))).collect();
    if notes.is_empty() { grid } else { tagged("div", "", &(grid + &notes)) }
}

fn cells(table: &PrintedTable) -> Vec<Vec<String>> {
    let cell = |row: &Vec<Text>, i: usize| row.get(i).map(Page::text).unwrap_or_default();
    let cells = |row: &Vec<Text>| (0..table.columns.len()).map(|i| cell(row, i)).collect();
    table.rows.iter().map(cells).collect()
}

/// A long table: on the screen it folds, on paper all rows stand, in columns beside each other where they are short; what would fill
/// pages and is in a file says so.
fn long(table: &PrintedTable, grid: &str) -> String {
    let filed = table.file.as_ref().filter(|_| table.rows.len() > PRINTED);
    let class = if filed.is_some() { "long filed" } else { "long" };
    let said = filed.map(|file| {
        let words = format!("These are the first {FOLD} of {} rows; all are in {file}.", table.rows.len());
        tagged("p", "note paper", &escape(&words))
    });
    // The table's own would stand above the first of the columns alone.
    let above = tagged("p", "caption paper", &Page::text(&table.caption));
    format!(
        "<div class=\"{class}\" style=\"--beside:{}\">\n{above}{grid}{}</div>\n",
        beside(table),
        said.unwrap_or_default()
    )
}

/// How many rows of a table stand beside each other on paper. Of ten rows one may be longer and run over.
fn beside(table: &PrintedTable) -> usize {
    let mut lengths: Vec<usize> = table.rows.iter().map(|row| row.iter().map(length).sum()).collect();
    lengths.sort_unstable();
    match lengths.get(lengths.len() * 9 / 10) {
        Some(..=THIRD) => 3,
        Some(..=HALF) => 2,
        _ => 1,
    }
}

/// The length of a cell and of what sets it apart from the next, in signs.
fn length(cell: &Text) -> usize {
    cell.to_plain().chars().count() + GAP
}

/// A table with finished cells; columns without any content are left out.
fn grid(table: &PrintedTable, rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let (columns, stacked, kept) = (&table.columns, table.stacked, table.filled());
    let head: String = kept.iter().map(|i| heading(&columns[*i])).collect();
    let names = stacked || kept.len() > STACKED;
    let lines = rows.iter().enumerate();
    let body: String = lines.map(|(n, row)| line(columns, &kept, row, (n >= FOLD, names))).collect();
    let long = if rows.len() > FOLD { " data-long" } else { "" };
    let many = if rows.len() > KEPT { " many" } else { "" };
    let class = match kept.len() {
        0..=STACKED if !stacked => "table",
        ..=WIDE => "table stack",
        _ => "table stack wide",
    };
    format!(
        "<div class=\"{class}{many}\"{long}>\n<table>\n{}<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n",
        tagged("caption", "", &Page::text(&table.caption))
    )
}

fn heading(column: &Column) -> String {
    format!("<th scope=\"col\"{}>{}</th>", class(column.align), Page::text(&column.heading))
}

fn class(align: Align) -> &'static str {
    match align {
        Align::Left => "",
        Align::Right => " class=\"number\"",
    }
}

fn line(columns: &[Column], kept: &[usize], row: &[String], (more, names): (bool, bool)) -> String {
    let cell = |(n, i): (usize, &usize)| {
        let (content, class) = (&row[*i], class(columns[*i].align));
        // What is a name has none of its column.
        let is_named = names && !content.is_empty() && (n > 0 || !class.is_empty());
        let head = if is_named { Page::text(&columns[*i].heading) } else { String::new() };
        let head = if head.is_empty() { head } else { format!("<span class=\"head\">{head} </span>") };
        match n {
            0 => format!("<th scope=\"row\"{class}>{head}{content}</th>"),
            _ => format!("<td{class}>{head}{content}</td>"),
        }
    };
    let cells: String = kept.iter().enumerate().map(cell).collect();
    let class = if more { " class=\"more\"" } else { "" };
    format!("<tr{class}>{cells}</tr>\n")
}

/// Checks with their results, as signs and words.
pub(super) fn checks(checks: &[CheckRow]) -> String {
    let table = PrintedTable { stacked: true, ..rows::checks(checks) };
    let mut cells = cells(&table);
    for (row, check) in cells.iter_mut().zip(checks) {
        let (class, sign, result) = match (check.passed, check.is_of_other_values) {
            (true, _) => ("passed", "✓", rows::PASSED[usize::from(check.is_sure)]),
            (false, true) => ("note", "–", rows::OF_OTHER_VALUES),
            (false, false) => ("failed", "✗", "failed"),
        };
        row[rows::RESULT] = format!("<span class=\"{class}\">{sign}\u{a0}{result}</span>");
    }
    grid(&table, &cells)
}
