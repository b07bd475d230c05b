//! Labels at the ends of curves, instead of a legend: where they fit, nobody has to look to and fro.

use crate::rect::Rect;
use crate::scale::drawable;
use crate::svg::{Element, line};
use crate::text::{Label, PlacedText, TextAnchor, middle_baseline};
use crate::theme::{GAP, LEADING, LineStyle, SMALL};

use crate::legend::styled;

/// Most curves that are labelled so.
const MOST: usize = 7;
/// Length of the line from a curve to its label, in pixels.
const STUB: f64 = 16.0;
/// Widest label in pixels.
const WIDEST: f64 = 150.0;
/// How far a label may be moved from the end of its curve, in heights of the text.
const MOVED: f64 = 2.0;

/// A curve that wants a label: what it says, how the curve is drawn, and where it ends on the page.
pub(crate) struct End {
    pub(crate) label: Label,
    pub(crate) style: LineStyle,
    pub(crate) at: [f64; 2],
}

/// The room that labels need beside the frame, in pixels; none where they are too many or too wide.
pub(crate) fn room<'a>(labels: impl Iterator<Item = &'a Label>) -> Option<f64> {
    let widths: Vec<f64> = labels.map(|label| label.width(SMALL)).collect();
    let widest = widths.iter().copied().fold(0.0, f64::max);
    let fits = (2..=MOST).contains(&widths.len()) && widest <= WIDEST;
    fits.then_some(STUB + GAP + widest)
}

/// The labels drawn beside the frame; nothing if one would be far from its curve.
pub(crate) fn draw(ends: &[End], area: &Rect) -> Option<Element> {
    let at_edge = |end: &End| end.at.into_iter().all(drawable) && (end.at[0] - area.right()).abs() < 1.0;
    let heights = ends.iter().all(at_edge).then(|| apart(ends, area))?;
    let draw = |(end, y): (&End, f64)| {
        let from = [area.right(), end.at[1]];
        let to = [area.right() + STUB, y];
        let stub = styled(line(from, to), LineStyle { dashes: "", ..end.style });
        let at = [to[0] + GAP, middle_baseline(y, SMALL)];
        let text = PlacedText::new(&end.label, at, SMALL, TextAnchor::Start).element();
        Element::new("g").child(stub).child(text)
    };
    let near = ends.iter().zip(&heights).all(|(end, y)| (end.at[1] - y).abs() <= MOVED * SMALL);
    near.then(|| Element::new("g").children(ends.iter().zip(heights).map(draw)))
}

/// Heights of the labels in the order of the curves: none on another, all beside the frame.
fn apart(ends: &[End], area: &Rect) -> Vec<f64> {
    let step = SMALL * LEADING;
    let mut order: Vec<usize> = (0..ends.len()).collect();
    order.sort_by(|a, b| ends[*a].at[1].total_cmp(&ends[*b].at[1]));
    let mut heights = vec![0.0; ends.len()];
    let mut free = area.y;
    for index in &order {
        heights[*index] = ends[*index].at[1].max(free);
        free = heights[*index] + step;
    }
    let mut free = area.bottom();
    for index in order.iter().rev() {
        heights[*index] = heights[*index].min(free);
        free = heights[*index] - step;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(y: f64) -> End {
        End { label: Label::plain("a"), style: LineStyle::of(0), at: [100.0, y] }
    }

    #[test]
    fn labels_stand_apart_beside_the_frame() {
        let area = Rect::new(0.0, 0.0, 100.0, 200.0);
        let heights = apart(&[end(199.0), end(198.0), end(3.0), end(5.0)], &area);
        for (i, a) in heights.iter().enumerate() {
            assert!((area.y..=area.bottom()).contains(a), "{heights:?}");
            assert!(heights[..i].iter().all(|b| (a - b).abs() >= SMALL * LEADING - 1e-9), "{heights:?}");
        }
    }

    #[test]
    fn curves_that_end_within_the_frame_have_a_legend() {
        let area = Rect::new(0.0, 0.0, 100.0, 200.0);
        assert!(draw(&[end(20.0), end(100.0)], &area).is_some());
        assert!(draw(&[end(20.0), End { at: [50.0, 50.0], ..end(0.0) }], &area).is_none());
        let bundle: Vec<End> = (0..6).map(|_| end(100.0)).collect();
        assert!(draw(&bundle, &area).is_none(), "far from its curve");
    }
}
