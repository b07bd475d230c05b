//! The page of the book that lists mistakes, written from the rows of the tests.

use std::fmt::Write;
use std::path::Path;

use tumble_scene::read_in;

use crate::beside::Beside;
use crate::rows::Row;

const HEAD: &str = "# Mistakes and what is said of them

This page is written by the tests of the scene language: each row is a slip in a scene that has no other mistake, with
what the program says of it. `tumble explain CODE` says more of a code.
";

/// The page; `UPDATE_BOOK=1` writes it.
pub(crate) fn same_page(scene: &str, chapters: &[(&str, &[Row])]) {
    let page =
        chapters.iter().fold(HEAD.to_owned(), |page, (title, rows)| page + &chapter(scene, title, rows));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/mistakes.md");
    if std::env::var_os("UPDATE_BOOK").is_some() {
        std::fs::write(&path, &page).expect("the page can be written");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(written == page, "docs/mistakes.md is stale: run these tests with UPDATE_BOOK=1");
}

fn chapter(scene: &str, title: &str, rows: &[Row]) -> String {
    let mut text = format!("\n## {title}\n\n| code | written | message | cure |\n|---|---|---|---|\n");
    for (old, new, ..) in rows {
        let changed = scene.replace(old, new);
        let mistakes = read_in("scene.toml", &changed, &[], &Beside).expect_err(new);
        for mistake in &mistakes.list {
            let labels = mistake.labels.iter().map(|label| label.text.as_str()).find(|text| !text.is_empty());
            let cure = mistake.help.as_deref().or(labels).unwrap_or_default();
            let written = written(old, new);
            let code = mistake.code;
            // A string takes every line.
            writeln!(text, "| {code} | {written} | {} | {} |", cell(&mistake.message), cell(cure))
                .unwrap_or(());
        }
    }
    text
}

/// What is new in the scene, without the header that it was put before.
fn written(old: &str, new: &str) -> String {
    match new.strip_suffix(old).unwrap_or(new).trim() {
        "" => format!("nothing in the place of ``{}``", cell(old.trim())),
        new => format!("`` {} ``", cell(new)),
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " / ")
}
