//! The report of a study: one page that follows a textbook's four moves.
//!
//! A [`Report`] is plain data: words, mathematics that somebody else wrote,
//! drawings, samples. [`Report::html`] is a page that needs nothing but a
//! browser, [`Report::markdown`] the same as text with links to figures.
//! Every text is shown as it is; none is ever run.
//!
//! ```
//! use tumble_report::report::Report;
//!
//! let mut report = Report { title: "A thrown rod".to_owned(), ..Report::default() };
//! report.analyze.findings.push("It lands after 1.2 s.".into());
//! let page = report.html();
//! assert!(page.contains("It lands after 1.2 s."));
//! ```

pub(crate) mod html;
pub mod json;
pub mod live;
mod markdown;
mod markup;
mod math;
mod parts;
mod picture;
mod play;
mod prose;
mod rows;
mod table;
mod walk;

pub use math::{Block, Definition, Typeset};
pub use parts::{
    Analyze, BalancePart, BodyModel, BodyRow, CheckRow, ForceRow, Identify, ModeEquations, ModelPart, Phase,
    QuantityRow, RunAnalysis, Solve,
};
pub(crate) use picture::END_OF_DIGITS;
pub use picture::{Chart, Picture};
pub use play::Lab;
pub use prose::{Inline, Text};
pub use table::{Align, Column, PrintedTable};

use crate::site::Ways;

/// A study from the picture at its start to what was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Title of the page.
    pub title: String,
    /// Language of the texts as HTML names it, for instance `en`; empty if unknown.
    pub language: String,
    /// Path of the lesson that belongs to it, relative to the report; none where there is none.
    pub lesson: Option<String>,
    /// The site that it stands in; none where it stands alone.
    pub ways: Option<Ways>,
    /// What was found, in a line below the title; may be empty.
    pub lead: Text,
    /// Paragraphs below it.
    pub intro: Vec<Text>,
    /// Where the numbers come from, as name and value: program, version, scene, hash.
    pub meta: Vec<(Text, Text)>,
    /// What a page that plays runs; none where it does not play.
    pub lab: Option<Lab>,
    /// What is given and what is sought.
    pub identify: Identify,
    /// Forces, laws, equations.
    pub model: ModelPart,
    /// Closed forms, or how the equations were integrated.
    pub solve: Solve,
    /// Curves, motion, balance, checks, findings.
    pub analyze: Analyze,
}

/// What the link to a lesson says.
const LESSON: &str = "The lesson that goes with this scene";

impl Report {
    /// The page as one HTML file.
    pub fn html(&self) -> String {
        html::page(self)
    }

    /// The report as Markdown with LaTeX between dollar signs, and links to figure files.
    pub fn markdown(&self) -> String {
        markdown::document(self)
    }

    /// What [`Report::markdown`] says in formulas: forces, laws, equations of motion and closed forms.
    pub fn equations(&self) -> String {
        markdown::equations(self)
    }
}
