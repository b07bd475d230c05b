//! Curves over time, or of one quantity against another.

use std::cmp::Ordering;

use crate::axes::{Axes, Axis, clipped};
use crate::ends::{self, End};
use crate::heading::Heading;
use crate::legend::{Legend, styled};
use crate::marks::MarkRows;
use crate::outline::Plane;
use crate::placing::Occupancy;
use crate::rect::Rect;
use crate::retrace::without_laps;
use crate::scale::{Range, drawable};
use crate::svg::{Element, PathData, Svg, circle};
use crate::text::{Label, PlacedText};
use crate::theme::{GAP, GREY, LineStyle, SMALL};
use crate::thin::{pieces, simplified, thinned};

/// Width of a picture, and height of its plotting area, in pixels.
#[derive(Clone, Copy, Debug)]
struct Size {
    width: f64,
    height: f64,
}

/// A picture of its own.
const ALONE: Size = Size { width: 600.0, height: 300.0 };
/// One of two beside each other on a sheet of paper: its letters are not made smaller there.
const BESIDE: Size = Size { width: 390.0, height: 138.0 };
/// Room above and below the data, as a part of their range.
const PADDING: f64 = 0.06;
/// Width of a column in which only the extremes of a curve are kept, in pixels.
const COLUMN: f64 = 0.5;
/// Curves of more points are reduced to their extremes first.
const MANY: usize = 5000;
/// How far a simplified curve may lie beside the true one, in pixels.
const TOLERANCE: f64 = 0.04;
/// Radius of a point that no line leads to.
const LONE_POINT: f64 = 2.2;

/// A curve with its label; an empty label keeps it out of the legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DataSeries {
    /// What the legend says.
    pub label: Label,
    /// Points `[x, y]` in the units of the axes; one that is not finite makes a gap.
    pub points: Vec<[f64; 2]>,
    /// Whether each point has a dot, because just these are known.
    pub dotted: bool,
}

/// What lies between two curves, as that between the least and the greatest of many runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// What the legend says.
    pub label: Label,
    /// Points `[x, low, high]` in the units of the axes; one that is not finite makes a gap.
    pub points: Vec<[f64; 3]>,
    /// The series whose colour it has, by its place.
    pub series: usize,
    /// How strong that colour is, from 0 to 1.
    pub strength: f64,
}

/// A vertical line at an event.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Where, in the unit of the horizontal axis.
    pub at: f64,
    /// What is written above the frame, where there is room; may be empty.
    pub label: Label,
}

/// A diagram of curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveFigure {
    /// Title above the diagram; may be empty.
    pub title: Label,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Bands behind the curves, in drawing order.
    pub bands: Vec<Band>,
    /// Curves in drawing order.
    pub series: Vec<DataSeries>,
    /// Events.
    pub marks: Vec<Mark>,
}

impl CurveFigure {
    /// A diagram without curves.
    pub fn new(title: Label, x: Axis, y: Axis) -> Self {
        Self { title, x, y, ..Self::default() }
    }

    /// The drawing. Without data it is an empty frame that says so.
    pub fn svg(&self) -> Svg {
        Layout::new(self, ALONE).draw()
    }

    /// The drawing in half the width of a sheet of paper.
    pub fn small_svg(&self) -> Svg {
        Layout::new(self, BESIDE).draw()
    }

    fn points(&self) -> impl Iterator<Item = [f64; 2]> + Clone {
        let edges = |p: &[f64; 3]| [[p[0], p[1]], [p[0], p[2]]];
        let bands = self.bands.iter().flat_map(move |band| band.points.iter().flat_map(edges));
        let points = self.series.iter().flat_map(|series| series.points.iter().copied()).chain(bands);
        points.filter(|p| drawable(p[0]) && drawable(p[1]))
    }

    fn ranges(&self) -> [Range; 2] {
        let range = |i: usize, tight: bool| {
            let data = Range::of(self.points().map(|p| p[i]));
            let padded = data.map(|r| if tight { r } else { r.padded(PADDING) });
            padded.unwrap_or_default().opened()
        };
        [range(0, self.runs_forward()), range(1, false)]
    }

    /// Whether x never decreases, as time does: then the frame ends with the data.
    fn runs_forward(&self) -> bool {
        let mut pairs = self.series.iter().flat_map(|series| series.points.windows(2));
        pairs.all(|w| w[1][0].partial_cmp(&w[0][0]) != Some(Ordering::Less))
    }

    fn legend(&self) -> Option<Legend> {
        let labelled = self.series.iter().enumerate().filter(|(_, series)| !series.label.is_empty());
        let curves = labelled.map(|(i, series)| (series.label.clone(), LineStyle::of(i)));
        let named = self.bands.iter().filter(|band| !band.label.is_empty());
        let bands = named.map(|band| (band.label.clone(), LineStyle::of_band(band.series, band.strength)));
        Legend::column(bands.chain(curves).collect())
    }
}

/// A figure with everything in its place.
struct Layout<'a> {
    figure: &'a CurveFigure,
    size: Size,
    heading: Heading,
    axes: Axes,
    bands: Vec<Vec<Vec<[f64; 2]>>>,
    curves: Vec<Vec<Vec<[f64; 2]>>>,
    marks: MarkRows,
    legend: Option<(Legend, [f64; 2])>,
    /// Labels at the ends of the curves, instead of a legend.
    ends: Option<Element>,
}

impl<'a> Layout<'a> {
    fn new(figure: &'a CurveFigure, size: Size) -> Self {
        if let Some(direct) = Self::with_ends(figure, size) {
            return direct;
        }
        let heading = Heading::new(&figure.title, size.width);
        let mut layout = Self::beside((figure, size), heading, 0.0, 0.0);
        let Some(legend) = figure.legend() else { return layout };
        let inside = legend.free_place(&layout.axes.area, &layout.occupancy());
        if let Some(place) = inside {
            layout.legend = Some((legend, [place.x, place.y]));
            return layout;
        }
        layout.with_legend_above(legend)
    }

    /// With labels at the ends of the curves, where all of them fit there.
    fn with_ends(figure: &'a CurveFigure, size: Size) -> Option<Self> {
        let labels = figure.series.iter().map(|series| &series.label);
        let all = figure.runs_forward() && labels.clone().all(|label| !label.is_empty());
        let room = ends::room(labels.filter(|_| all))?;
        let layout = Self::beside((figure, size), Heading::new(&figure.title, size.width), 0.0, room);
        let end = |(i, series): (usize, &DataSeries)| {
            let last = series.points.iter().rfind(|p| drawable(p[0]) && drawable(p[1]))?;
            Some(End { label: series.label.clone(), style: LineStyle::of(i), at: layout.axes.pixel(*last) })
        };
        let ends: Vec<End> = figure.series.iter().enumerate().map(end).collect::<Option<_>>()?;
        let ends = ends::draw(&ends, &layout.axes.area)?;
        Some(Self { ends: Some(ends), ..layout })
    }

    /// The layout with `extra` pixels between the title and the marks, and with room to the right of the frame.
    fn beside((figure, size): (&'a CurveFigure, Size), heading: Heading, extra: f64, room: f64) -> Self {
        let (names, Size { width, height }) = ([&figure.x, &figure.y], size);
        let axes = |top| Axes::fitted(names, figure.ranges(), width - room, top, height);
        let top = heading.bottom() + extra;
        let marks = MarkRows::new(&figure.marks, &axes(top), width);
        let axes = axes(top + marks.height());
        let forward = figure.runs_forward();
        let curve = |series: &DataSeries| {
            let pixels = pieces(series.points.iter().map(|p| axes.pixel(*p)));
            pixels.iter().flat_map(|piece| shortened(piece, forward)).collect()
        };
        let curves = figure.series.iter().map(curve).collect();
        let bands = figure.bands.iter().map(|band| outlines(&axes, band)).collect();
        Self { figure, size, heading, axes, bands, curves, marks, legend: None, ends: None }
    }

    fn with_legend_above(self, legend: Legend) -> Self {
        let legend = legend.spread(self.axes.area.width);
        let [width, height] = legend.size();
        let at = [self.axes.area.centre()[0] - width / 2.0, self.heading.bottom()];
        let mut layout = Self::beside((self.figure, self.size), self.heading, height + GAP, 0.0);
        layout.legend = Some((legend, at));
        layout
    }

    fn occupancy(&self) -> Occupancy {
        let mut drawn = Occupancy::new(self.axes.area);
        self.curves.iter().flatten().for_each(|piece| drawn.add_line(piece.clone()));
        self.bands.iter().flatten().for_each(|piece| drawn.add_line(piece.clone()));
        self.marks.lines(&self.axes.area).for_each(|line| drawn.add_line(line.to_vec()));
        drawn
    }

    fn draw(&self) -> Svg {
        let height = self.axes.end()[1];
        let mut svg = Svg::on_paper(self.size.width, height, self.figure.title.to_plain());
        svg.push(self.marks.draw(&self.axes.area));
        svg.push(clipped(
            self.axes.area,
            self.draw_bands().chain(self.draw_curves()).chain(self.draw_dots()),
        ));
        svg.push(self.axes.draw());
        svg.push(self.heading.draw());
        svg.children.extend(self.legend.iter().map(|(legend, at)| legend.draw(*at)));
        svg.children.extend(self.ends.clone());
        svg.children.extend(self.no_data());
        svg
    }

    fn draw_bands(&self) -> impl Iterator<Item = Element> {
        let shown = self.figure.bands.iter().zip(&self.bands);
        shown.flat_map(|(band, pieces)| {
            let colour = LineStyle::of_band(band.series, band.strength).colour;
            pieces.iter().map(move |piece| PathData::polygon(piece).fill(colour))
        })
    }

    fn draw_dots(&self) -> impl Iterator<Item = Element> {
        let dotted = self.figure.series.iter().enumerate().filter(|(_, series)| series.dotted);
        dotted.flat_map(|(index, series)| {
            let places = pieces(series.points.iter().map(|p| self.axes.pixel(*p))).into_iter().flatten();
            places.map(move |place| circle(place, LONE_POINT).attr("fill", LineStyle::of(index).colour))
        })
    }

    fn draw_curves(&self) -> impl Iterator<Item = Element> {
        self.curves.iter().enumerate().flat_map(|(i, pieces)| draw_curve(pieces, LineStyle::of(i)))
    }

    fn no_data(&self) -> Option<Element> {
        let empty = self.figure.points().next().is_none();
        empty.then(|| no_data(&self.axes.area))
    }
}

/// The pieces of a band as closed lines: along the upper edge, back along the lower.
fn outlines(axes: &Axes, band: &Band) -> Vec<Vec<[f64; 2]>> {
    let is_there = |p: &&[f64; 3]| p.iter().all(|value| drawable(*value));
    let edge = |k: usize| {
        let points = band.points.iter().map(move |p| match is_there(&p) {
            true => axes.pixel([p[0], p[k]]),
            false => [f64::NAN; 2],
        });
        pieces(points)
    };
    let back = |(mut upper, lower): (Vec<[f64; 2]>, Vec<[f64; 2]>)| {
        upper.extend(lower.into_iter().rev());
        upper
    };
    edge(2).into_iter().zip(edge(1)).map(back).collect()
}

/// The same line on the page from fewer points; laps over itself go if it does not run forward.
fn shortened(piece: &[[f64; 2]], forward: bool) -> Vec<Vec<[f64; 2]>> {
    if forward && piece.len() > MANY {
        return vec![simplified(&thinned(piece, COLUMN), TOLERANCE)];
    }
    let simple = simplified(piece, TOLERANCE);
    if forward { vec![simple] } else { without_laps(&simple) }
}

/// The words in the middle of a frame without data.
pub(crate) fn no_data(area: &Rect) -> Element {
    PlacedText::centred(&Label::plain("no data"), area, SMALL).colour(GREY).element()
}

/// One path for all pieces of a curve, and dots for its lone points.
fn draw_curve(pieces: &[Vec<[f64; 2]>], style: LineStyle) -> Vec<Element> {
    let mut path = PathData::default();
    pieces.iter().filter(|piece| piece.len() > 1).for_each(|piece| path.add_polyline(piece));
    let lone = pieces.iter().filter(|piece| piece.len() == 1);
    let dots = lone.map(|piece| circle(piece[0], LONE_POINT).attr("fill", style.colour));
    let line = (!path.is_empty()).then(|| styled(path.fill("none"), style));
    line.into_iter().chain(dots).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(points: Vec<[f64; 2]>) -> CurveFigure {
        let axis = |name| Axis::new(Label::symbol(name), "m");
        let curve = DataSeries { label: Label::default(), points, dotted: false };
        CurveFigure {
            series: vec![curve],
            ..CurveFigure::new(Label::plain("A <script>"), axis("t"), axis("theta"))
        }
    }

    #[test]
    fn equal_input_gives_equal_bytes() {
        let points: Vec<_> = (0..500).map(|i| [f64::from(i), f64::from(i).sin()]).collect();
        assert_eq!(figure(points.clone()).svg().to_string(), figure(points).svg().to_string());
    }

    #[test]
    fn without_data_the_frame_says_so() {
        for points in [vec![], vec![[f64::NAN, 1.0]], vec![[1.0, f64::INFINITY]]] {
            let svg = figure(points).svg().to_string();
            assert!(svg.contains("no data"));
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
        }
    }

    #[test]
    fn a_single_point_is_a_dot() {
        let svg = figure(vec![[1.0, 2.0]]).svg().to_string();
        assert!(svg.contains("<circle") && !svg.contains("no data"));
    }

    #[test]
    fn a_million_points_give_a_small_file() {
        let points = (0..1_000_000).map(|i| [f64::from(i) * 1e-5, (f64::from(i) * 0.01).sin()]).collect();
        assert!(figure(points).svg().to_string().len() < 100_000);
    }

    #[test]
    fn markup_in_titles_is_shown() {
        assert!(!figure(vec![]).svg().to_string().contains("<script"));
    }
}
