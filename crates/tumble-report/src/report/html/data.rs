//! The data of curves for the page's scripts.

use std::cmp::Ordering;

use crate::report::json::{list, number, object, on_grid, string};
use crate::report::picture::Chart;
use tumble_drawing::axes::Axis;
use tumble_drawing::curves::{Band, DataSeries, Mark};
use tumble_drawing::font::Face;
use tumble_drawing::text::{Label, Level};
use tumble_drawing::theme::LineStyle;
use tumble_drawing::thin::{simplified, thinned};

/// Steps over the range of the data: fifty times what a screen shows.
const STEPS: f64 = 5e4;
/// Curves of fewer points are kept as they are, so that readers see true values.
const MANY: usize = 1000;
/// Curves of more points are judged on a page of this width and height in pixels, to one pixel. Those that
/// run forward are judged on a page so wide that no curve is steep: distances from them are upright.
const SIDE: f64 = 6e3;
const WIDE: f64 = 1e7;
/// Columns of that page in which a longer curve keeps its extremes.
const COLUMNS: f64 = 1000.0;

/// A label as `[[text, face, level], ...]`.
pub(in crate::report) fn label(label: &Label) -> String {
    list(label.runs.iter().map(|run| {
        let face = match run.face {
            Face::Regular => "",
            Face::Italic => "i",
            Face::Bold => "b",
        };
        let level = match run.level {
            Level::Base => "",
            Level::Subscript => "sub",
            Level::Superscript => "sup",
        };
        list([&run.text, face, level].map(string))
    }))
}

/// A figure of curves.
pub(super) fn plot_data(plot: &Chart, description: &str) -> String {
    let figure = &plot.figure;
    let series = figure.series.iter().enumerate().map(|(i, series)| series_data(i, series));
    object([
        ("title", label(&figure.title)),
        ("description", string(description)),
        ("time", plot.over_time.to_string()),
        ("x", axis(&figure.x)),
        ("y", axis(&figure.y)),
        ("bands", list(figure.bands.iter().map(band))),
        ("series", list(series)),
        ("marks", list(figure.marks.iter().map(mark))),
    ])
}

fn axis(axis: &Axis) -> String {
    object([
        ("title", label(&axis.title())),
        ("name", label(&axis.label)),
        ("unit", label(&Label::unit(&axis.unit))),
    ])
}

pub(super) fn mark(mark: &Mark) -> String {
    object([("at", number(mark.at)), ("label", label(&mark.label))])
}

fn series_data(index: usize, series: &DataSeries) -> String {
    let (style, points) = (LineStyle::of(index), shortened(&series.points));
    let column = |k: usize| on_grid(points.iter().map(|p| p[k]), STEPS);
    object([
        ("label", label(&series.label)),
        ("style", (index % tumble_drawing::theme::PALETTE_SIZE).to_string()),
        ("dashes", string(style.dashes)),
        ("dotted", series.dotted.to_string()),
        ("x", column(0)),
        ("y", column(1)),
    ])
}

fn band(band: &Band) -> String {
    let column = |k: usize| on_grid(band.points.iter().map(|p| p[k]), STEPS);
    object([
        ("label", label(&band.label)),
        ("style", (band.series % tumble_drawing::theme::PALETTE_SIZE).to_string()),
        ("strength", number(band.strength)),
        ("x", column(0)),
        ("low", column(1)),
        ("high", column(2)),
    ])
}

/// A long curve from fewer of its own points.
fn shortened(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if points.len() <= MANY {
        return points.to_vec();
    }
    let forward = points.windows(2).all(|w| w[1][0].partial_cmp(&w[0][0]) != Some(Ordering::Less));
    let width = if forward { WIDE } else { SIDE };
    let pixels = |k: usize, side: f64| {
        let grid = tumble_drawing::scale::Range::of(points.iter().map(|p| p[k])).unwrap_or_default().opened();
        move |value: f64| (value - grid.low) / grid.span() * side
    };
    let (x, y) = (pixels(0, width), pixels(1, SIDE));
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for piece in tumble_drawing::thin::pieces(points.iter().copied()) {
        let page: Vec<_> = piece.iter().map(|p| [x(p[0]), y(p[1])]).collect();
        let short = if forward { thinned(&page, WIDE / COLUMNS) } else { page.clone() };
        let short = simplified(&short, 1.0);
        if !kept.is_empty() {
            kept.push([f64::NAN; 2]);
        }
        kept.extend(originals(&page, &piece, &short));
    }
    kept
}

/// The points of `piece` whose places on the page were kept, in order.
fn originals<'a>(
    page: &'a [[f64; 2]],
    piece: &'a [[f64; 2]],
    kept: &'a [[f64; 2]],
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let mut wanted = kept.iter().peekable();
    let is_wanted = move |(place, _): &(&[f64; 2], &[f64; 2])| {
        let hit = wanted.peek() == Some(place);
        if hit {
            wanted.next();
        }
        hit
    };
    page.iter().zip(piece).filter(is_wanted).map(|(_, point)| *point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_curves_keep_true_points_and_their_shape() {
        let wave = |i: i32| [f64::from(i) / 1e4, (f64::from(i) / 3e3).sin()];
        let points: Vec<_> = (0..100_000).map(wave).collect();
        let short = shortened(&points);
        assert!(short.len() < 4000, "{}", short.len());
        assert!(short.iter().all(|p| points.contains(p)));
        let strays = |w: &[[f64; 2]]| {
            let middle = f64::midpoint(w[0][0], w[1][0]);
            (f64::midpoint(w[0][1], w[1][1]) - (middle / 0.3).sin()).abs()
        };
        assert!(short.windows(2).map(strays).fold(0.0, f64::max) < 4e-4);
    }

    #[test]
    fn gaps_stay_gaps() {
        let gap = |i: i32| [f64::from(i), if i == 2500 { f64::NAN } else { 0.0 }];
        let short = shortened(&(0..5000).map(gap).collect::<Vec<_>>());
        assert_eq!(short.iter().filter(|p| p[0].is_nan()).count(), 1);
    }
}
