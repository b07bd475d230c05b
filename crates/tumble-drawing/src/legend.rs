//! Legends: inside the diagram where it is empty, else in rows above it.

use crate::placing::Occupancy;
use crate::rect::Rect;
use crate::svg::{Element, line};
use crate::text::{Label, PlacedText, TextAnchor, middle_baseline};
use crate::theme::{GAP, LEADING, LineStyle, SMALL};

/// Length of the sample of a line.
const SAMPLE: f64 = 34.0;
/// Distance between columns.
const COLUMN_GAP: f64 = 22.0;
/// Distance between a legend inside a diagram and the frame.
const INSET: f64 = 12.0;
/// Largest part of the diagram's width and height that a legend inside it may take.
const LARGEST_PART: [f64; 2] = [0.5, 0.6];
/// Columns of places tried along the diagram for a legend inside it.
const TRIES: i32 = 12;
/// Height of one entry.
const ROW: f64 = SMALL * LEADING;

/// Samples and labels in a grid, filled row by row.
#[derive(Clone, Debug)]
pub struct Legend {
    entries: Vec<(Label, LineStyle)>,
    /// Width of each column.
    columns: Vec<f64>,
}

impl Legend {
    /// A legend in one column; `None` without entries.
    pub fn column(entries: Vec<(Label, LineStyle)>) -> Option<Self> {
        (!entries.is_empty()).then(|| Self { columns: column_widths(&entries, 1), entries })
    }

    /// The same legend in as many columns as `width` pixels hold; labels that
    /// are still too long are cut.
    pub fn spread(mut self, width: f64) -> Self {
        let count = self.entries.len();
        // As many rows for fewer columns: columns of equal length look better than a last row of one.
        let balanced = |most: usize| count.div_ceil(count.div_ceil(most));
        let choices = (1..=count).rev().map(|most| column_widths(&self.entries, balanced(most)));
        let fitting = choices.into_iter().find(|columns| total(columns) <= width);
        self.columns = fitting.unwrap_or_else(|| vec![width]);
        self
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [f64; 2] {
        let rows = self.entries.len().div_ceil(self.columns.len()) as f64;
        [total(&self.columns), rows * ROW]
    }

    /// A place inside the diagram's `area` that nothing drawn touches, corners first.
    pub(crate) fn free_place(&self, area: &Rect, drawn: &Occupancy) -> Option<Rect> {
        let [width, height] = self.size();
        if width > LARGEST_PART[0] * area.width || height > LARGEST_PART[1] * area.height {
            return None;
        }
        let inner = Rect::new(
            area.x + INSET,
            area.y + INSET,
            area.width - 2.0 * INSET - width,
            area.height - 2.0 * INSET - height,
        );
        let place = |part: [f64; 2]| {
            Rect::new(inner.x + part[0] * inner.width, inner.y + part[1] * inner.height, width, height)
        };
        parts().map(place).find(|place| drawn.is_free(&place.grown(GAP)))
    }

    /// Draws the legend with its top left corner at `at` (pixels).
    pub fn draw(&self, at: [f64; 2]) -> Element {
        let entry = |(i, (label, style)): (usize, &(Label, LineStyle))| {
            let (row, column) = (i / self.columns.len(), i % self.columns.len());
            let x: f64 = at[0] + self.columns[..column].iter().map(|width| width + COLUMN_GAP).sum::<f64>();
            let y = at[1] + (row as f64 + 0.5) * ROW;
            draw_entry([x, y], label, *style, self.columns[column])
        };
        Element::new("g").children(self.entries.iter().enumerate().map(entry))
    }
}

fn draw_entry([x, y]: [f64; 2], label: &Label, style: LineStyle, width: f64) -> Element {
    let sample = styled(line([x, y], [x + SAMPLE, y]), style);
    let text_x = x + SAMPLE + GAP;
    // Rounding must not cut the widest label of a column.
    let label = label.fitted(SMALL, width - SAMPLE - GAP + 0.5);
    let text = PlacedText::new(&label, [text_x, middle_baseline(y, SMALL)], SMALL, TextAnchor::Start);
    Element::new("g").child(sample).child(text.element())
}

/// Widths of the columns if entries fill `count` of them row by row.
fn column_widths(entries: &[(Label, LineStyle)], count: usize) -> Vec<f64> {
    let width = |(label, _): &(Label, LineStyle)| SAMPLE + GAP + label.width(SMALL);
    let column = |i| entries.iter().skip(i).step_by(count).map(width).fold(0.0, f64::max);
    (0..count).map(column).collect()
}

/// Width of columns with the gaps between them.
fn total(columns: &[f64]) -> f64 {
    columns.iter().sum::<f64>() + COLUMN_GAP * (columns.len() as f64 - 1.0)
}

/// Stroke attributes of a curve.
pub fn styled(element: Element, style: LineStyle) -> Element {
    element.stroked(style.colour, style.thickness).attr("stroke-linejoin", "round").dashed(style.dashes)
}

/// Places as parts of the free width and height: corners, then along the
/// upper and lower edge, then the middle.
fn parts() -> impl Iterator<Item = [f64; 2]> {
    let corners = [[1.0, 0.0], [0.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let along = |y| (1..TRIES).map(move |i| [f64::from(i) / f64::from(TRIES), y]);
    corners.into_iter().chain([0.0, 1.0, 0.5].into_iter().flat_map(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend(n: usize) -> Legend {
        let entries = (0..n).map(|i| (Label::plain("series"), LineStyle::of(i))).collect();
        Legend::column(entries).expect("entries")
    }

    #[test]
    fn corners_with_data_are_avoided() {
        let area = Rect::new(0.0, 0.0, 600.0, 300.0);
        let mut drawn = Occupancy::new(area);
        drawn.add_line(vec![[0.0, 300.0], [600.0, 0.0]]);
        let place = legend(3).free_place(&area, &drawn).expect("a free corner");
        assert!(place.x < 100.0 && place.y < 100.0);
    }

    #[test]
    fn a_full_diagram_has_no_place() {
        let area = Rect::new(0.0, 0.0, 600.0, 300.0);
        let mut drawn = Occupancy::new(area);
        drawn.add_box(area);
        assert!(legend(3).free_place(&area, &drawn).is_none());
    }

    #[test]
    fn twenty_entries_spread_over_the_width() {
        let legend = legend(20).spread(560.0);
        assert!(legend.size()[0] <= 560.0);
        assert!(legend.size()[1] <= 6.0 * ROW);
        assert_eq!(legend.entries.len(), 20);
    }
}
