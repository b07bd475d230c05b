//! The key of a sheet: kinds of forces, scale bars, captions.

use crate::heading::wrapped;
use crate::scale_bar::Bar;
use crate::svg::Element;
use crate::text::{Label, PlacedText, TextAnchor, middle_baseline};
use crate::theme::{GAP, LEADING, SMALL};

use super::arrow::ArrowKind;
use super::cone::Cone;
use super::draw;
use super::strokes::{Form, Stroke};

/// Length of sample arrows and the greatest length of bars, in pixels.
const SAMPLE: f64 = 38.0;
const LONGEST_BAR: f64 = 90.0;
/// Width and height of a sample of a cone.
const CONE_SAMPLE: [f64; 2] = [18.0, 16.0];
/// Distance between entries of a row, and height of a row.
const ENTRY_GAP: f64 = 26.0;
const ROW: f64 = 1.5 * SMALL;

/// An entry of the key.
#[derive(Clone, Debug)]
pub(super) enum Entry {
    /// A kind of force with a sample of its arrow.
    ArrowKind(ArrowKind),
    /// A cone of friction.
    Cone,
    /// A scale bar.
    Bar(Bar),
}

impl Entry {
    /// A bar for `density` pixels per unit, if such a bar can be drawn.
    pub(super) fn bar(density: f64, unit: &str) -> Option<Self> {
        (density.is_normal() && density > 0.0 && (1.0 / density).is_normal())
            .then(|| Self::Bar(Bar::new(LONGEST_BAR, density, unit)))
    }

    fn sample(&self) -> f64 {
        match self {
            Entry::ArrowKind(_) => SAMPLE,
            Entry::Cone => CONE_SAMPLE[0],
            Entry::Bar(bar) => bar.length,
        }
    }

    fn label(&self) -> Label {
        match self {
            Entry::ArrowKind(kind) => Label::plain(kind.name()),
            Entry::Cone => Label::plain("cone of friction"),
            Entry::Bar(bar) => bar.label.clone(),
        }
    }

    fn width(&self) -> f64 {
        self.sample() + GAP + self.label().width(SMALL)
    }

    /// The entry with its left end at `at`, centred on its height.
    fn draw(&self, [x, y]: [f64; 2]) -> Element {
        let sample = match self {
            Entry::ArrowKind(kind) => sample_arrow(*kind, [x, y]),
            Entry::Cone => {
                let [width, height] = CONE_SAMPLE;
                Cone::sample([x + 0.5 * width, y + 0.5 * height], width, height).draw()
            }
            Entry::Bar(bar) => bar.draw([x, y]),
        };
        let at = [x + self.sample() + GAP, middle_baseline(y, SMALL)];
        let text = PlacedText::new(&self.label(), at, SMALL, TextAnchor::Start);
        Element::new("g").child(sample).child(text.element())
    }
}

fn sample_arrow(kind: ArrowKind, tail: [f64; 2]) -> Element {
    let form = if kind == ArrowKind::Resultant { Form::Hollow } else { Form::Full };
    draw::arrow(&Stroke::new([tail, [tail[0] + SAMPLE, tail[1]]], kind.style(), form))
}

/// Rows of entries above lines of text.
pub(super) struct Key {
    entries: Vec<([f64; 2], Entry)>,
    lines: Vec<([f64; 2], Label)>,
    /// Height in pixels.
    pub(super) height: f64,
}

impl Key {
    /// The key in `width` pixels. Groups of entries begin rows of their own if
    /// they do not fit beside those before.
    pub(super) fn new(groups: &[Vec<Entry>], captions: &[Label], width: f64) -> Self {
        let mut flow = Flow { width, at: [0.0, 0.0], entries: Vec::new() };
        groups.iter().for_each(|group| flow.add_group(group));
        let rows = if flow.entries.is_empty() { 0.0 } else { flow.at[1] + ROW };
        let mut lines = Vec::new();
        let mut bottom = rows;
        for line in captions.iter().flat_map(|caption| wrapped(caption, SMALL, width)) {
            bottom += SMALL * LEADING;
            lines.push(([0.0, bottom - 0.3 * SMALL], line));
        }
        Self { entries: flow.entries, lines, height: bottom }
    }

    /// The key with its top left corner at `at`.
    pub(super) fn draw(&self, at: [f64; 2]) -> Element {
        let moved = |p: [f64; 2]| [at[0] + p[0], at[1] + p[1]];
        let entries = self.entries.iter().map(|(p, entry)| entry.draw(moved([p[0], p[1] + ROW / 2.0])));
        let lines = self.lines.iter();
        let lines =
            lines.map(|(p, line)| PlacedText::new(line, moved(*p), SMALL, TextAnchor::Start).element());
        Element::new("g").children(entries).children(lines)
    }
}

/// Entries set one after the other in rows.
struct Flow {
    width: f64,
    at: [f64; 2],
    entries: Vec<([f64; 2], Entry)>,
}

impl Flow {
    fn add_group(&mut self, group: &[Entry]) {
        let total: f64 = group.iter().map(|entry| entry.width() + ENTRY_GAP).sum();
        if self.at[0] + total - ENTRY_GAP > self.width {
            self.end_row();
        }
        group.iter().for_each(|entry| self.add(entry));
    }

    fn add(&mut self, entry: &Entry) {
        if self.at[0] + entry.width() > self.width {
            self.end_row();
        }
        self.entries.push((self.at, entry.clone()));
        self.at[0] += entry.width() + ENTRY_GAP;
    }

    fn end_row(&mut self) {
        if self.at[0] > 0.0 {
            self.at = [0.0, self.at[1] + ROW];
        }
    }
}
