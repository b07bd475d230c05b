//! The frame of a diagram: axes, ticks, their labels, and the plotting area.

use crate::font::Face;
use crate::rect::Rect;
use crate::scale::{Range, Scale};
use crate::svg::{Element, PathData};
use crate::text::{Label, PlacedText, TextAnchor, middle_baseline};
use crate::theme::{GAP, HAIRLINE, INK, LEADING, MARGIN, NORMAL, SMALL};
use crate::ticks::Ticks;

/// Length of labelled ticks in pixels.
const MAJOR_TICK: f64 = 6.0;
/// Length of the ticks between them.
const MINOR_TICK: f64 = 3.0;
/// Pixels that one labelled tick of a horizontal axis wants.
const X_SPACING: f64 = 90.0;
/// Pixels that one labelled tick of a vertical axis wants.
const Y_SPACING: f64 = 58.0;
/// Least distance between labels of neighbouring ticks, in pixels.
const LABEL_SPACING: f64 = 12.0;

/// Room for descenders and subscripts below a title, in em.
const TITLE_DEPTH: f64 = 0.55;
/// Height of a turned title with the room on both sides of it, in em.
const TITLE_ROOM: f64 = 1.4;

/// What an axis shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The quantity, for instance [`Label::symbol`]`("theta")`.
    pub label: Label,
    /// Its unit, for instance `m/s^2`; empty for a pure number.
    pub unit: String,
}

impl Axis {
    /// An axis with decimal ticks.
    pub fn new(label: Label, unit: &str) -> Self {
        Self { label, unit: unit.to_owned() }
    }

    /// The title, or where it is longer than the axis that of the symbol alone, which captions explain.
    fn title_within(&self, length: f64) -> Label {
        let whole = self.title();
        match symbol_of(&self.label).filter(|_| whole.width(NORMAL) > length) {
            Some(label) => Self { label, unit: self.unit.clone() }.title(),
            None => whole,
        }
    }

    /// The label with its unit in parentheses.
    pub fn title(&self) -> Label {
        if self.unit.is_empty() {
            return self.label.clone();
        }
        let space = if self.label.is_empty() { "" } else { WORD_SPACE };
        let open = self.label.clone().then(Label::plain(&format!("{space}(")));
        open.then(Label::unit(&self.unit)).then(Label::plain(")"))
    }
}

/// Where the symbol of a label such as `height y` begins.
fn symbol_of(label: &Label) -> Option<Label> {
    let begins = label.runs.iter().position(|run| run.face == Face::Italic)?;
    Some(Label { runs: label.runs[begins..].to_vec() })
}

/// The blank between a symbol and its unit, a third of an em: an italic letter leans into a narrower one.
const WORD_SPACE: &str = "\u{2004}";

/// Two axes, scaled and with their ticks chosen.
#[derive(Clone, Debug)]
pub struct Axes {
    /// The plotting area on the page.
    pub area: Rect,
    /// Values to pixels, to the right.
    pub x: Scale,
    /// Values to pixels, upwards.
    pub y: Scale,
    ticks: [Ticks; 2],
    titles: [Label; 2],
}

/// The room around a plotting area, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Left of the area: labels and title of the vertical axis.
    pub left: f64,
    /// Right of the area.
    pub right: f64,
    /// Above the area: the note of the vertical axis, if any.
    pub top: f64,
    /// Below the area: labels and title of the horizontal axis.
    pub bottom: f64,
}

impl Axes {
    /// Axes over the ranges `[x, y]` around a given plotting area.
    pub fn new(axes: [&Axis; 2], ranges: [Range; 2], area: Rect) -> Self {
        let x = Scale::new(ranges[0], area.x, area.right());
        let y = Scale::new(ranges[1], area.bottom(), area.y);
        let y_wanted = (area.height / Y_SPACING).round() as usize;
        let ticks = [horizontal_ticks(&x, area.width), Ticks::new(ranges[1], y_wanted)];
        Self { area, x, y, ticks, titles: [axes[0].title(), axes[1].title_within(area.height)] }
    }

    /// Axes in a picture `width` pixels wide, whose plotting area of the given
    /// `height` begins below `top`; the margins follow from the labels.
    pub fn fitted(axes: [&Axis; 2], ranges: [Range; 2], width: f64, top: f64, height: f64) -> Self {
        let draft = Self::new(axes, ranges, Rect::new(0.0, 0.0, width, height));
        let m = draft.margins();
        Self::new(axes, ranges, Rect::new(m.left, top + m.top, width - m.left - m.right, height))
    }

    /// The room that labels, titles and notes need.
    pub fn margins(&self) -> Margins {
        let [x, y] = &self.ticks;
        let half_label = x.major.last().map_or(0.0, |tick| tick.label.width(SMALL) / 2.0);
        let title = |label: &Label| if label.is_empty() { 0.0 } else { NORMAL * LEADING };
        let below = title(&self.titles[0]).max(if x.note.is_empty() { 0.0 } else { SMALL * LEADING });
        Margins {
            left: MARGIN + TITLE_ROOM * NORMAL + y.label_width(SMALL) + GAP,
            right: MARGIN.max(half_label + GAP),
            top: if y.note.is_empty() { 0.0 } else { SMALL * LEADING },
            bottom: GAP + SMALL * LEADING + below + MARGIN,
        }
    }

    /// Where the picture ends: right and bottom edge with the room there, in pixels.
    pub(crate) fn end(&self) -> [f64; 2] {
        let margins = self.margins();
        [self.area.right() + margins.right, self.area.bottom() + margins.bottom]
    }

    /// Frame, ticks and labels.
    pub fn draw(&self) -> Element {
        let strokes = Element::new("g").stroked(INK, HAIRLINE).attr("fill", "none");
        let ticks = self.tick_lines().fill("none");
        let strokes = strokes.child(self.area.element("rect")).child(ticks);
        Element::new("g").child(strokes).children(self.tick_labels()).children(self.title_texts())
    }

    /// All ticks as one path: there are many.
    fn tick_lines(&self) -> PathData {
        let lengths = |ticks: &Ticks| {
            let major = ticks.major.iter().map(|tick| (tick.value, MAJOR_TICK));
            major.chain(ticks.minor.iter().map(|value| (*value, MINOR_TICK))).collect::<Vec<_>>()
        };
        let Rect { x: left, y: top, .. } = self.area;
        let (right, bottom) = (self.area.right(), self.area.bottom());
        let mut path = PathData::default();
        for (value, length) in lengths(&self.ticks[0]) {
            let x = self.x.pixel(value);
            path.add_polyline(&[[x, bottom], [x, bottom - length]]);
            path.add_polyline(&[[x, top], [x, top + length]]);
        }
        for (value, length) in lengths(&self.ticks[1]) {
            let y = self.y.pixel(value);
            path.add_polyline(&[[left, y], [left + length, y]]);
            path.add_polyline(&[[right, y], [right - length, y]]);
        }
        path
    }

    fn tick_labels(&self) -> impl Iterator<Item = Element> {
        let below = self.area.bottom() + GAP + crate::font::ASCENT * SMALL;
        let x = self.ticks[0].major.iter().map(move |tick| {
            PlacedText::new(&tick.label, [self.x.pixel(tick.value), below], SMALL, TextAnchor::Middle)
        });
        let y = self.ticks[1].major.iter().map(|tick| {
            let at = [self.area.x - GAP, middle_baseline(self.y.pixel(tick.value), SMALL)];
            PlacedText::new(&tick.label, at, SMALL, TextAnchor::End)
        });
        x.chain(y).map(|text| text.element())
    }

    fn title_texts(&self) -> impl Iterator<Item = Element> {
        let [x, y] = self.area.centre();
        let below = self.area.bottom() + GAP + SMALL * LEADING + crate::font::ASCENT * NORMAL;
        // Turned text has its descenders and subscripts on the right.
        let left = self.area.x - GAP - self.ticks[1].label_width(SMALL) - TITLE_DEPTH * NORMAL;
        // Words that are longer than the axis are set smaller, as long as they are read.
        let upward = (NORMAL * self.area.height / self.titles[1].width(NORMAL)).clamp(SMALL, NORMAL);
        let texts = [
            PlacedText::new(&self.titles[0], [x, below], NORMAL, TextAnchor::Middle),
            PlacedText::new(&self.titles[1], [left, y], upward, TextAnchor::Middle).upward(),
            PlacedText::new(&self.ticks[0].note, [self.area.right(), below], SMALL, TextAnchor::End),
            PlacedText::new(&self.ticks[1].note, [self.area.x, self.area.y - GAP], SMALL, TextAnchor::Start),
        ];
        texts.into_iter().filter(|text| !text.is_empty()).map(|text| text.element())
    }
}

/// Ticks of a horizontal axis, fewer if their labels would run together.
fn horizontal_ticks(scale: &Scale, width: f64) -> Ticks {
    let wanted = (width / X_SPACING).round() as usize;
    let choices = (1..=wanted.max(1)).rev().map(|n| Ticks::new(scale.range, n));
    let mut fitting = choices.filter(|ticks| {
        let room = ticks.label_width(SMALL) + LABEL_SPACING;
        ticks.major.windows(2).all(|w| scale.pixel(w[1].value) - scale.pixel(w[0].value) >= room)
    });
    fitting.next().unwrap_or_else(|| Ticks::new(scale.range, 1))
}

/// A window on the page: what `children` draw outside `area` is cut off.
/// A nested drawing needs no identifiers, so several figures may share a page.
pub fn clipped(area: Rect, children: impl IntoIterator<Item = Element>) -> Element {
    let view = [area.x, area.y, area.width, area.height].map(crate::svg::number).join(" ");
    area.element("svg").attr("viewBox", view).attr("overflow", "hidden").children(children)
}

impl crate::outline::Plane for Axes {
    fn pixel(&self, point: [f64; 2]) -> [f64; 2] {
        [self.x.pixel(point[0]), self.y.pixel(point[1])]
    }

    fn density(&self) -> f64 {
        self.x.density()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(low: f64, high: f64) -> Axes {
        let axis = Axis::new(Label::symbol("x"), "m");
        Axes::fitted([&axis, &axis], [Range::new(low, high); 2], 640.0, 40.0, 300.0)
    }

    #[test]
    fn a_title_that_is_longer_than_its_axis_is_the_symbol_alone() {
        let axis = Axis::new(Label::plain("angular velocity ").then(Label::symbol("omega")), "rad/s");
        let title = |length: f64| axis.title_within(length).to_plain();
        assert!(title(300.0).starts_with("angular velocity"));
        assert!(title(60.0).starts_with('ω') && title(60.0).ends_with("(rad/s)"), "{}", title(60.0));
    }

    #[test]
    fn labels_have_room() {
        let axes = axes(-1000.0, 20.0);
        assert!(axes.area.x > axes.ticks[1].label_width(SMALL) + NORMAL);
        assert!(axes.area.right() < 640.0);
    }

    #[test]
    fn a_note_moves_the_frame_down() {
        assert_eq!(axes(0.0, 1.0).area.y, 40.0);
        assert!(axes(0.0, 1e-9).area.y > 40.0);
    }

    #[test]
    fn units_stand_in_parentheses() {
        assert_eq!(Axis::new(Label::symbol("omega0"), "rad/s").title().to_plain(), "ω_0\u{2004}(rad/s)");
        assert_eq!(Axis::new(Label::symbol("x"), "").title().to_plain(), "x");
    }
}
