//! Curves, motion, balance, checks, findings.

use super::picture::{Chart, Picture};
use super::prose::Text;
use super::table::Table;
use tumble_drawing::Animation;
use tumble_drawing::text::Label;

/// The fourth move: what the solution says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Analyze {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// The motion, for every case.
    pub animation: Option<Animation>,
    /// Curves of all cases together.
    pub plots: Vec<Chart>,
    /// Paths and stroboscopic pictures of all cases together.
    pub pictures: Vec<Picture>,
    /// What differs between the cases of a sweep, and what became of it.
    pub comparison: Option<Table>,
    /// What belongs to single cases; one case is shown without its name.
    pub cases: Vec<RunAnalysis>,
    /// Checks that concern no single case.
    pub checks: Vec<Check>,
    /// What was found, one item each.
    pub findings: Vec<Text>,
}

/// One case of a sweep, or the only run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunAnalysis {
    /// What sets it apart, for instance `T = 2 s`.
    pub name: Label,
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// Its curves.
    pub plots: Vec<Chart>,
    /// Its paths and stroboscopic pictures.
    pub pictures: Vec<Picture>,
    /// Energy, momentum and their residuals.
    pub balance: Option<BalancePart>,
    /// Other tables.
    pub tables: Vec<Table>,
    /// Its checks.
    pub checks: Vec<Check>,
}

/// What flowed in and out, and what is left unexplained.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BalancePart {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// The balances, with their residuals.
    pub tables: Vec<Table>,
    /// Energies over time, residuals over time.
    pub plots: Vec<Chart>,
}

/// A number that was compared with another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Check {
    /// What was checked.
    pub what: Text,
    /// The value it should have, with its origin.
    pub expected: Text,
    /// The value it has.
    pub found: Text,
    /// How far they may differ.
    pub within: Text,
    /// Whether they agree.
    pub passed: bool,
}
