//! One quantity over two others, as colours of cells with their scale beside them.

use crate::axes::{Axes, Axis};
use crate::curves::no_data;
use crate::heading::Heading;
use crate::outline::Plane;
use crate::rect::Rect;
use crate::scale::{Range, Scale, drawable};
use crate::svg::{Element, PathData, Svg, circle, line};
use crate::text::{Label, PlacedText, TextAnchor, middle_baseline};
use crate::theme::{GAP, HAIRLINE, INK, LEADING, MARGIN, NORMAL, PAPER, Rgb, SMALL};
use crate::ticks::Ticks;

/// Width of the picture in pixels.
const WIDTH: f64 = 680.0;
/// Height of the cells in pixels.
const HEIGHT: f64 = 380.0;
/// Width of the scale of colours, and its distance from the cells.
const SCALE_WIDTH: f64 = 20.0;
const SCALE_GAP: f64 = 22.0;
/// Length of the scale's ticks.
const TICK: f64 = 4.0;
/// Colours that are told apart: cells of one colour are one path.
const LEVELS: usize = 64;
/// Ticks of the scale.
const TICKS: usize = 6;
/// Radius of the ring about a marked cell.
const RING: f64 = 6.0;
/// Cells without a value.
const NOTHING: Rgb = Rgb(0xdd, 0xdd, 0xdd);

/// Viridis (van der Walt and Smith, CC0) at equal distances: it grows in lightness all along, so that it is read without colours, and
/// by colour-blind readers.
const VIRIDIS: [Rgb; 9] = [
    Rgb(0x44, 0x01, 0x54),
    Rgb(0x47, 0x2d, 0x7b),
    Rgb(0x3b, 0x52, 0x8b),
    Rgb(0x2c, 0x72, 0x8e),
    Rgb(0x21, 0x91, 0x8c),
    Rgb(0x28, 0xae, 0x80),
    Rgb(0x5e, 0xc9, 0x62),
    Rgb(0xad, 0xdc, 0x30),
    Rgb(0xfd, 0xe7, 0x25),
];

/// A map of cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapFigure {
    /// Title above the map; may be empty.
    pub title: Label,
    /// Horizontal and vertical axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What the colours are.
    pub z: Axis,
    /// Where the columns of cells stand, growing or falling.
    pub columns: Vec<f64>,
    /// Where the rows stand, growing or falling.
    pub rows: Vec<f64>,
    /// A value for each cell, row by row; one that is not finite is none.
    pub cells: Vec<f64>,
    /// Cells with a ring about them, as column and row.
    pub marked: Vec<[usize; 2]>,
}

impl MapFigure {
    /// The drawing. Without data it is an empty frame that says so.
    pub fn svg(&self) -> Svg {
        let heading = Heading::new(&self.title, WIDTH);
        let scale = Ticks::new(self.values(), TICKS);
        let beside = SCALE_GAP + SCALE_WIDTH + TICK + GAP + scale.label_width(SMALL) + NORMAL * LEADING;
        let ranges = [&self.columns, &self.rows].map(|places| bounds(&edges(places)));
        let top = heading.bottom() + NORMAL;
        let axes = Axes::fitted([&self.x, &self.y], ranges, WIDTH - beside, top, HEIGHT);
        let mut svg = Svg::on_paper(WIDTH, axes.end()[1], self.title.to_plain());
        svg.children.extend(self.draw_cells(&axes));
        svg.children.extend(self.rings(&axes));
        svg.push(axes.draw());
        svg.push(heading.draw());
        svg.push(self.draw_scale(&axes.area, &scale));
        svg.children.extend(self.is_empty().then(|| no_data(&axes.area)));
        svg
    }

    fn is_empty(&self) -> bool {
        !self.cells.iter().any(|value| drawable(*value))
    }

    fn values(&self) -> Range {
        Range::of(self.cells.iter().copied()).unwrap_or_default().opened()
    }

    /// One path for each colour.
    fn draw_cells(&self, axes: &Axes) -> Vec<Element> {
        let (across, up, values) = (edges(&self.columns), edges(&self.rows), self.values());
        let mut paths: Vec<PathData> = vec![PathData::default(); LEVELS + 1];
        for (index, value) in self.cells.iter().enumerate() {
            let (column, row) = (index % self.columns.len(), index / self.columns.len());
            let Some(pair) = up.get(row..row + 2) else { break };
            let corners = [[across[column], pair[0]], [across[column + 1], pair[1]]].map(|p| axes.pixel(p));
            let [[x0, y0], [x1, y1]] = corners;
            paths[level(*value, values)].add_polygon(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
        }
        let colour =
            |level| if level == LEVELS { NOTHING } else { colour((level as f64 + 0.5) / LEVELS as f64) };
        let drawn = paths.into_iter().enumerate().filter(|(_, path)| !path.is_empty());
        let fill = |(level, path): (usize, PathData)| {
            // Without it there are seams between cells of one colour.
            path.fill(colour(level)).attr("shape-rendering", "crispEdges")
        };
        drawn.map(fill).collect()
    }

    fn rings(&self, axes: &Axes) -> impl Iterator<Item = Element> {
        let at = |[column, row]: &[usize; 2]| {
            Some(axes.pixel([*self.columns.get(*column)?, *self.rows.get(*row)?]))
        };
        let ring = |at| {
            let ring = |colour: Rgb, width: f64| circle(at, RING).attr("fill", "none").stroked(colour, width);
            [ring(PAPER, 3.0), ring(INK, 1.4)]
        };
        self.marked.iter().filter_map(at).flat_map(ring)
    }

    /// The colours with their values, to the right of the cells.
    fn draw_scale(&self, area: &Rect, ticks: &Ticks) -> Element {
        let (left, values) = (area.right() + SCALE_GAP, self.values());
        let right = left + SCALE_WIDTH;
        let scale = Scale::new(values, area.bottom(), area.y);
        let step = area.height / LEVELS as f64;
        let strip = (0..LEVELS).map(|level| {
            let bar =
                Element::new("rect").attrs([("x", left), ("width", SCALE_WIDTH), ("height", step + 0.4)]);
            let y = area.bottom() - (level + 1) as f64 * step;
            bar.attr("y", y).attr("fill", colour((level as f64 + 0.5) / LEVELS as f64))
        });
        let frame = Rect { x: left, width: SCALE_WIDTH, ..*area };
        let frame = frame.element("rect").attr("fill", "none").stroked(INK, HAIRLINE);
        let marks = ticks.major.iter().flat_map(|tick| {
            let y = scale.pixel(tick.value);
            let mark = line([right, y], [right + TICK, y]).stroked(INK, HAIRLINE);
            let at = [right + TICK + GAP, middle_baseline(y, SMALL)];
            [mark, PlacedText::new(&tick.label, at, SMALL, TextAnchor::Start).element()]
        });
        let note = PlacedText::new(&ticks.note, [left, area.y - GAP], SMALL, TextAnchor::Start);
        let title_at = [WIDTH - MARGIN, area.centre()[1]];
        let title = PlacedText::new(&self.z.title(), title_at, NORMAL, TextAnchor::Middle).upward();
        let words = [note, title].into_iter().filter(|text| !text.is_empty()).map(|text| text.element());
        Element::new("g").children(strip).child(frame).children(marks).children(words)
    }
}

/// Where cells end: half-way to their neighbours.
fn edges(places: &[f64]) -> Vec<f64> {
    let [first, .., last] = places else {
        return places.iter().flat_map(|only| [only - 0.5, only + 0.5]).collect();
    };
    let between = |pair: &[f64]| f64::midpoint(pair[0], pair[1]);
    let inner: Vec<f64> = places.windows(2).map(between).collect();
    let (begin, end) = (2.0 * first - inner[0], 2.0 * last - inner[inner.len() - 1]);
    std::iter::once(begin).chain(inner).chain([end]).collect()
}

fn bounds(edges: &[f64]) -> Range {
    Range::of(edges.iter().copied()).unwrap_or_default()
}

/// The colour of a value by its number; the last is that of none.
fn level(value: f64, range: Range) -> usize {
    if !drawable(value) {
        return LEVELS;
    }
    let part = (value - range.low) / range.span();
    ((part * LEVELS as f64) as usize).min(LEVELS - 1)
}

/// The colour at a part of the scale, from 0 to 1.
fn colour(part: f64) -> Rgb {
    let along = part.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (along as usize).min(VIRIDIS.len() - 2);
    let (a, b, part) = (VIRIDIS[below], VIRIDIS[below + 1], along - below as f64);
    let mix = |a: u8, b: u8| (f64::from(a) + part * (f64::from(b) - f64::from(a))).round() as u8;
    Rgb(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(cells: Vec<f64>) -> MapFigure {
        let axis = |name| Axis::new(Label::symbol(name), "s");
        let (columns, rows) = (vec![1.0, 2.0, 4.0], vec![0.0, 1.0]);
        MapFigure { x: axis("a"), y: axis("b"), z: axis("c"), columns, rows, cells, ..MapFigure::default() }
    }

    #[test]
    fn cells_end_half_way_to_their_neighbours() {
        assert_eq!(edges(&[1.0, 2.0, 4.0]), [0.5, 1.5, 3.0, 5.0]);
        assert_eq!(edges(&[3.0]), [2.5, 3.5]);
    }

    #[test]
    fn lightness_grows_with_the_value() {
        let luma = |c: Rgb| 0.2126 * f64::from(c.0) + 0.7152 * f64::from(c.1) + 0.0722 * f64::from(c.2);
        let all: Vec<f64> = (0..LEVELS).map(|level| luma(colour(level as f64 / LEVELS as f64))).collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn a_cell_without_a_value_is_grey_and_no_number_is_written_that_is_none() {
        let svg = figure(vec![1.0, 2.0, f64::NAN, 3.0, 4.0, 5.0]).svg().to_string();
        assert!(svg.contains(&NOTHING.hex()) && !svg.contains("NaN"));
        assert!(figure(vec![f64::NAN; 6]).svg().to_string().contains("no data"));
    }

    #[test]
    fn ten_thousand_cells_are_a_small_file() {
        let places: Vec<f64> = (0..100).map(f64::from).collect();
        let cells = (0..10_000).map(|i| f64::from(i % 97)).collect();
        let figure = MapFigure { columns: places.clone(), rows: places, ..figure(cells) };
        assert!(figure.svg().to_string().len() < 600_000);
    }
}
