//! Tables of text.

use super::prose::Text;

/// More columns do not stand beside each other on paper.
pub(super) const WIDE: usize = 8;
/// So many rows do, as columns.
const UPRIGHT: usize = 6;

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
    /// Whether its rows are what others have as columns.
    pub is_upright: bool,
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
    pub(crate) fn filled(&self) -> Vec<usize> {
        let has_content =
            |i: &usize| self.rows.iter().any(|row| row.get(*i).is_some_and(|cell| !cell.is_empty()));
        (0..self.columns.len()).filter(has_content).collect()
    }

    /// With a row for each of its columns, where these are too many to stand beside each other and its rows are few.
    #[must_use]
    pub fn upright(self) -> Self {
        let kept = self.filled();
        if kept.len() <= WIDE || self.rows.len() > UPRIGHT {
            return self;
        }
        let cell = |row: &Vec<Text>, column: usize| row.get(column).cloned().unwrap_or_default();
        let heads = self.rows.iter().map(|row| Column::numbers(cell(row, 0)));
        let columns = [Column::words("")].into_iter().chain(heads).collect();
        let row = |column: &usize| {
            let cells = self.rows.iter().map(|row| cell(row, *column));
            [self.columns[*column].heading.clone()].into_iter().chain(cells).collect()
        };
        let rows = kept.iter().skip(1).map(row).collect();
        Self { columns, rows, is_upright: true, ..self }
    }

    /// Where the rows are that it leaves out.
    pub(crate) fn all_rows(&self) -> Option<Text> {
        self.file.as_ref().filter(|_| self.is_cut).map(|file| format!("All rows are in {file}.").into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_columns_of_few_rows_become_rows() {
        let table = |columns: usize, rows: usize| {
            let heads = (0..columns).map(|column| Column::numbers(format!("h{column}"))).collect();
            let cells = |row: usize| (0..columns).map(|column| format!("{row}.{column}").into()).collect();
            (0..rows).map(cells).fold(PrintedTable::new("A table", heads), PrintedTable::row)
        };
        let found = table(9, 2).upright();
        let heads: Vec<String> = found.columns.iter().map(|column| column.heading.to_plain()).collect();
        assert_eq!(heads, ["", "0.0", "1.0"]);
        assert_eq!(found.rows.len(), 8);
        assert!(found.is_upright);
        assert_eq!(found.rows[7].iter().map(Text::to_plain).collect::<Vec<_>>(), ["h8", "0.8", "1.8"]);
        for other in [table(8, 2), table(9, 7)] {
            assert_eq!(other.clone().upright(), other);
        }
    }
}
