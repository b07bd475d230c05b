//! Tables as HTML.

use super::inline::{list, tagged, text};
use crate::report::analyze::Check;
use crate::report::identify::BodyRow;
use crate::report::prose::Text;
use crate::report::rows::quantity;
use crate::report::table::{Align, Column, Table};

/// Rows of a long table that are shown at first.
const FOLD: usize = 20;

/// A table of the report.
pub(super) fn table(table: &Table) -> String {
    let cell = |row: &Vec<Text>, i: usize| row.get(i).map(text).unwrap_or_default();
    let cells = |row: &Vec<Text>| (0..table.columns.len()).map(|i| cell(row, i)).collect();
    let rows: Vec<Vec<String>> = table.rows.iter().map(cells).collect();
    let grid = grid(&text(&table.caption), &table.columns, &rows);
    let notes: String = table.notes.iter().map(|note| tagged("p", "note", &text(note))).collect();
    grid + &notes
}

/// A table from finished cells. Columns without any content are left out.
fn grid(caption: &str, columns: &[Column], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let kept: Vec<usize> = (0..columns.len())
        .filter(|i| rows.iter().any(|row| row.get(*i).is_some_and(|c| !c.is_empty())))
        .collect();
    let head: String = kept.iter().map(|i| heading(&columns[*i])).collect();
    let body: String = rows.iter().enumerate().map(|(n, row)| line(columns, &kept, row, n >= FOLD)).collect();
    let long = if rows.len() > FOLD { " data-long" } else { "" };
    format!(
        "<div class=\"table\"{long}>\n<table>\n{}<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n",
        tagged("caption", "", caption)
    )
}

fn heading(column: &Column) -> String {
    format!("<th scope=\"col\"{}>{}</th>", class(column.align), text(&column.heading))
}

fn class(align: Align) -> &'static str {
    match align {
        Align::Left => "",
        Align::Right => " class=\"number\"",
    }
}

fn line(columns: &[Column], kept: &[usize], row: &[String], more: bool) -> String {
    let cell = |(n, i): (usize, &usize)| {
        let (content, class) = (&row[*i], class(columns[*i].align));
        if n == 0 {
            format!("<th scope=\"row\"{class}>{content}</th>")
        } else {
            format!("<td{class}>{content}</td>")
        }
    };
    let cells: String = kept.iter().enumerate().map(cell).collect();
    let class = if more { " class=\"more\"" } else { "" };
    format!("<tr{class}>{cells}</tr>\n")
}

/// The bodies with their properties.
pub(super) fn bodies(rows: &[BodyRow]) -> String {
    let columns = ["Body", "Property", "Symbol", "Value", "Computed by", "Remark"].map(Column::words);
    let body = |row: &BodyRow| {
        let shape = if row.shape.is_empty() {
            String::new()
        } else {
            format!("<br><small>{}</small>", text(&row.shape))
        };
        let name = format!("{}{shape}", text(&row.name));
        let lines = row.properties.iter().enumerate();
        let mut lines: Vec<Vec<String>> = lines
            .map(|(i, property)| {
                let name = if i == 0 {
                    name.clone()
                } else {
                    format!("<span class=\"again\">{}</span>", text(&row.name))
                };
                std::iter::once(name).chain(quantity(property).iter().map(text)).collect()
            })
            .collect();
        if lines.is_empty() {
            lines.push(vec![name, String::new(), String::new(), String::new(), String::new(), String::new()]);
        }
        lines
    };
    grid("Bodies", &columns, &rows.iter().flat_map(body).collect::<Vec<_>>())
}

/// Checks with their results, as signs and words.
pub(super) fn checks(checks: &[Check]) -> String {
    let columns = [
        Column::words("Check"),
        Column::words("Expected"),
        Column::words("Found"),
        Column::words("Within"),
        Column::words("Result"),
    ];
    let row = |check: &Check| {
        let result = if check.passed {
            "<span class=\"passed\">✓\u{a0}passed</span>"
        } else {
            "<span class=\"failed\">✗\u{a0}failed</span>"
        };
        vec![
            text(&check.what),
            text(&check.expected),
            text(&check.found),
            text(&check.within),
            result.to_owned(),
        ]
    };
    grid("Checks", &columns, &checks.iter().map(row).collect::<Vec<_>>())
}

/// Names and values.
pub(super) fn facts(facts: &[(Text, Text)]) -> String {
    let facts: String = facts
        .iter()
        .map(|(name, value)| format!("<div><dt>{}</dt><dd>{}</dd></div>\n", text(name), text(value)))
        .collect();
    tagged("dl", "facts", &facts)
}

/// A list below a heading of its own; nothing for no items.
pub(super) fn titled_list(title: &str, items: &[Text]) -> String {
    if items.is_empty() { String::new() } else { format!("<h3>{title}</h3>\n{}", list(items)) }
}
