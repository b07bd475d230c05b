//! From a study to its report: runs, what they came to, figures, and the report as data, from which page and Markdown are written.
//!
//! [`results`] makes the runs and answers what a scene asks of them, [`figures`] draws what it asks to see, [`tables`]
//! lists numbers, [`of`] fills a [`Report`](report::Report). No file is read or written here, no thread begun and no time asked for: it is the same in
//! a browser.

pub mod figures;
pub mod report;
pub mod results;
pub mod site;
pub mod tables;

mod fill;
#[cfg(test)]
#[path = "tests/scenes.rs"]
mod scenes;

pub use fill::{animation, of};
