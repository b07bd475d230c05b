//! Closed forms, or how the equations were integrated.

use super::math::Block;
use super::prose::Text;
use super::table::Table;

/// The third move: the solution.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Solve {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// Phases that have a closed form.
    pub phases: Vec<Phase>,
    /// How it was integrated, as name and value: accuracy asked, order, steps, rejected steps.
    pub method: Vec<(Text, Text)>,
    /// Events and phases, a table each, or for each case; long ones collapse.
    pub tables: Vec<Table>,
}

/// A stretch of time with a closed form.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Phase {
    /// Its name, for instance "flight".
    pub name: Text,
    /// From when to when, and in which mode; may be empty.
    pub span: Text,
    /// The closed form in symbols.
    pub symbols: Vec<Block>,
    /// The same with numbers.
    pub numbers: Vec<Block>,
}
