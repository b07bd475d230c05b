//! Vertical lines at events, with their labels in rows above the frame.

use crate::axes::Axes;
use crate::curves::Mark;
use crate::rect::Rect;
use crate::svg::{Element, line};
use crate::text::{Label, PlacedText, TextAnchor};
use crate::theme::{GAP, GREY, HAIRLINE, LEADING, MARGIN, SMALL};

/// Rows of mark labels above the frame, at most.
const ROWS: usize = 2;
/// Distance between mark labels in one row.
const SPACING: f64 = 8.0;
/// Marks closer than this many pixels to the last are not drawn.
const MERGE: f64 = 0.5;
/// Dashes of the lines of marks.
const DASHES: &str = "3 3";

/// Marks with the rows in which their labels stand.
pub(crate) struct MarkRows {
    marks: Vec<PlacedMark>,
}

struct PlacedMark {
    x: f64,
    label: Label,
    row: Option<usize>,
}

impl MarkRows {
    pub(crate) fn new(marks: &[Mark], axes: &Axes, page: f64) -> Self {
        let mut visible: Vec<_> = marks.iter().filter(|m| axes.x.range.contains(m.at)).collect();
        visible.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut placed: Vec<PlacedMark> = Vec::new();
        let mut row_ends = [f64::NEG_INFINITY; ROWS];
        for mark in visible {
            let x = axes.x.pixel(mark.at);
            if placed.last().is_some_and(|last| x - last.x < MERGE) {
                continue;
            }
            let row = row_for(&mut row_ends, page, x, mark.label.width(SMALL));
            placed.push(PlacedMark { x, label: mark.label.clone(), row });
        }
        Self { marks: placed }
    }

    pub(crate) fn height(&self) -> f64 {
        let labelled = self.marks.iter().filter(|mark| !mark.label.is_empty());
        let rows = labelled.filter_map(|mark| mark.row).max().map_or(0, |row| row + 1);
        rows as f64 * SMALL * LEADING
    }

    /// Lines on the page, which labels keep clear of.
    pub(crate) fn lines(&self, area: &Rect) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.marks.iter().map(|mark| [[mark.x, area.bottom()], [mark.x, area.y]])
    }

    pub(crate) fn draw(&self, area: &Rect) -> Element {
        let style = Element::new("g").stroked(GREY, HAIRLINE).dashed(DASHES);
        let lines = self.lines(area).map(|[bottom, top]| line(bottom, top));
        let labels = self.marks.iter().filter_map(|mark| mark.text(area.y));
        Element::new("g").child(style.children(lines)).children(labels)
    }
}

impl PlacedMark {
    fn text(&self, top: f64) -> Option<Element> {
        let baseline = top - GAP - self.row? as f64 * SMALL * LEADING;
        let text = PlacedText::new(&self.label, [self.x, baseline], SMALL, TextAnchor::Middle);
        (!self.label.is_empty()).then(|| text.element())
    }
}

/// The first row with room for a label `width` pixels wide centred at `x`, which then takes it, on a page of some width.
fn row_for(row_ends: &mut [f64], page: f64, x: f64, width: f64) -> Option<usize> {
    let row = row_ends.iter().position(|end| x - width / 2.0 >= *end)?;
    let fits = x - width / 2.0 >= MARGIN / 2.0 && x + width / 2.0 <= page - MARGIN / 2.0;
    row_ends[row] = x + width / 2.0 + SPACING;
    fits.then_some(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowded_marks_keep_their_labels_apart() {
        let mut ends = [f64::NEG_INFINITY; ROWS];
        let rows: Vec<_> = (0..4).map(|i| row_for(&mut ends, 600.0, 100.0 + f64::from(i), 30.0)).collect();
        assert_eq!(rows, [Some(0), Some(1), None, None]);
    }
}
