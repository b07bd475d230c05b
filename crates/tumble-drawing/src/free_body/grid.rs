//! How many panels stand side by side, and their shape.

use crate::rect::Rect;

use super::fit::{Fit, Room, fit};
use super::panel::{Source, Trim, room, split};

/// Widths of panels in pixels for one, two, ... columns.
const WIDTHS: [f64; 4] = [420.0, 420.0, 320.0, 270.0];
/// Most columns: more make the text too small on paper.
const MOST_COLUMNS: usize = 5;
/// Heights of panels tried, as parts of their width.
const SHAPES: [f64; 8] = [0.6, 0.7, 0.8, 0.9, 1.0, 1.12, 1.25, 1.4];
/// Greatest height of a panel's drawing in pixels: with its texts it fits a screen.
const GREATEST_HEIGHT: f64 = 320.0;
/// Width of a good page as a part of its height: on paper it leaves room for the laws.
const PAGE_SHAPE: f64 = 1.6;
/// What a page of another shape costs, compared with smaller drawings.
const SHAPE_COST: f64 = 0.65;
/// What unused room in the panels costs.
const UNUSED_COST: f64 = 0.5;
/// What an empty place costs, beyond the one that the key fills.
const EMPTY_COST: f64 = 0.25;
/// Scores of grids stay finite above this.
const LEAST: f64 = 1e-3;
/// Height of the key of a sheet in pixels, about.
const KEY: f64 = 70.0;
/// Distance between panels.
pub(super) const SPACING: f64 = 10.0;

/// Panels of equal size in rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub(super) count: usize,
    pub(super) columns: usize,
    /// Width and height of a panel.
    pub(super) size: [f64; 2],
    pub(super) fit: Fit,
}

impl Grid {
    /// The grid that shows the panels best.
    pub(super) fn best(sources: &[Source]) -> Self {
        let columns = 1..=sources.len().clamp(1, MOST_COLUMNS);
        let grids = columns.flat_map(|columns| SHAPES.map(|shape| Self::new(sources, columns, shape)));
        let scored = grids.map(|grid| (grid.score(), grid));
        let better = |a: (f64, Self), b: (f64, Self)| if b.0 > a.0 { b } else { a };
        scored.reduce(better).map_or_else(|| Self::new(sources, 1, PAGE_SHAPE), |(_, grid)| grid)
    }

    fn new(sources: &[Source], columns: usize, shape: f64) -> Self {
        let width = WIDTHS[(columns - 1).min(WIDTHS.len() - 1)];
        let trim = Trim::new(sources, width);
        let size = [width, (shape * width).min(GREATEST_HEIGHT) + trim.above + trim.below];
        let fit = fit(&rooms(sources, size, &trim));
        Self { count: sources.len(), columns, size, fit }
    }

    pub(super) fn rows(&self) -> usize {
        self.count.div_ceil(self.columns)
    }

    /// Width and height of all panels, in pixels.
    pub(super) fn extent(&self) -> [f64; 2] {
        let side = |count: usize, size: f64| count as f64 * (size + SPACING) - SPACING;
        [side(self.columns, self.size[0]), side(self.rows(), self.size[1])]
    }

    /// Panel number `i` of a grid whose top left corner is at `at`.
    pub(super) fn frame(&self, at: [f64; 2], i: usize) -> Rect {
        let place = [i % self.columns, i / self.columns];
        let corner = |k: usize| at[k] + place[k] as f64 * (self.size[k] + SPACING);
        Rect::new(corner(0), corner(1), self.size[0], self.size[1])
    }

    /// The empty places at the end of the last row.
    pub(super) fn rest(&self, at: [f64; 2]) -> Option<Rect> {
        let empty = self.rows() * self.columns - self.count;
        let first = (empty > 0).then(|| self.frame(at, self.count))?;
        let width = empty as f64 * (self.size[0] + SPACING) - SPACING;
        Some(Rect { width, ..first })
    }

    fn score(&self) -> f64 {
        let [width, height] = self.extent();
        let empty = self.rows() * self.columns - self.count;
        let height = if empty == 0 { height + KEY } else { height };
        let shape = (width / height / PAGE_SHAPE).ln().abs();
        // Size of drawings compared with the page, as printed.
        let size = (self.size[0] * self.size[1] / (width * height)).sqrt() * self.fit.quality;
        let used = UNUSED_COST * self.fit.used.clamp(LEAST, 1.0).ln();
        size.max(LEAST).ln() + used - SHAPE_COST * shape - EMPTY_COST * empty.saturating_sub(1) as f64
    }
}

/// The room for every body in panels of some size.
pub(super) fn rooms<'a>(sources: &'a [Source], size: [f64; 2], trim: &Trim) -> Vec<Room<'a>> {
    let area = trim.area(&Rect::new(0.0, 0.0, size[0], size[1]));
    let room = |source: &'a Source| Room { body: &source.body, size: room(&split(source, &area).0) };
    sources.iter().map(room).collect()
}
