//! Tables of text.

use super::prose::Text;

/// On which side the cells of a column stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Align {
    /// Words.
    #[default]
    Left,
    /// Numbers.
    Right,
}

/// The head of a column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// What stands in it, with the unit.
    pub heading: Text,
    /// Where its cells stand.
    pub align: Align,
}

impl Column {
    /// A column of words.
    pub fn words(heading: impl Into<Text>) -> Self {
        Self { heading: heading.into(), align: Align::Left }
    }

    /// A column of numbers.
    pub fn numbers(heading: impl Into<Text>) -> Self {
        Self { heading: heading.into(), align: Align::Right }
    }
}

/// A table; the first cell of a row names it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PrintedTable {
    /// What the table shows.
    pub caption: Text,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its rows; cells that lack are empty, cells beyond the columns are left out.
    pub rows: Vec<Vec<Text>>,
    /// Whether its cells are long: where the page is narrow they stand below each other.
    pub stacked: bool,
    /// The file among the results in which all rows are, if there is one: then paper need not show hundreds.
    pub file: Option<String>,
    /// Whether rows stand for several of that file.
    pub is_cut: bool,
    /// Lines below it.
    pub notes: Vec<Text>,
}

impl PrintedTable {
    /// A table without rows.
    pub fn new(caption: impl Into<Text>, columns: Vec<Column>) -> Self {
        Self { caption: caption.into(), columns, ..Self::default() }
    }

    /// With one more row.
    pub fn row(mut self, cells: Vec<Text>) -> Self {
        self.rows.push(cells);
        self
    }

    /// The columns with any content: others are left out.
    pub(super) fn filled(&self) -> Vec<usize> {
        let has_content =
            |i: &usize| self.rows.iter().any(|row| row.get(*i).is_some_and(|cell| !cell.is_empty()));
        (0..self.columns.len()).filter(has_content).collect()
    }

    /// Where the rows are that it leaves out.
    pub(crate) fn all_rows(&self) -> Option<Text> {
        self.file.as_ref().filter(|_| self.is_cut).map(|file| format!("All rows are in {file}.").into())
    }
}
