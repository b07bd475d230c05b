//! Figures of the page: their numbers, and curves in words.

use super::page::Page;
use crate::report::markup::Markup;
use crate::report::picture::Chart;
use crate::report::prose::Text;
use tumble_drawing::Label;
use tumble_drawing::curves::{CurveFigure, DataSeries};
use tumble_drawing::scale::Range;
use tumble_drawing::svg::Svg;

/// Digits of numbers in descriptions.
const DIGITS: usize = 4;
/// Curves that a description names one by one.
const NAMED: usize = 12;

impl Page {
    /// A drawing that has its number.
    pub(super) fn inline(&mut self, svg: &Svg) -> String {
        self.figures += 1;
        svg.inline(&format!("figure-{}", self.figures))
    }

    /// A drawing on a sheet with its number and caption; the class may end in further attributes.
    pub(super) fn figure(&self, class: &str, sheet: &str, drawing: &str, caption: &Text) -> String {
        let (number, caption) = (self.figures, Self::text(caption));
        format!(
            "<figure class=\"{class}\">\n<div class=\"{sheet}\">{drawing}</div>\n\
             <figcaption><span class=\"number\">Figure {number}.</span> {caption}</figcaption>\n</figure>\n"
        )
    }
}

/// The curves in words.
pub(super) fn description(plot: &Chart) -> String {
    if !plot.description.is_empty() {
        return plot.description.clone();
    }
    let figure = &plot.figure;
    let axes = format!(
        "{} over {}.",
        figure.y.title().to_plain_or("values"),
        figure.x.title().to_plain_or("values")
    );
    let curves = figure.series.iter().take(NAMED).map(|series| curve(figure, series));
    let rest = figure.series.len().saturating_sub(NAMED);
    let rest = (rest > 0).then(|| format!("And {rest} more curves."));
    std::iter::once(axes).chain(curves).chain(rest).collect::<Vec<_>>().join(" ")
}

/// Where a curve begins and ends, and its bounds.
fn curve(figure: &CurveFigure, series: &DataSeries) -> String {
    let name = series.label.to_plain_or("The curve");
    let mut finite = series.points.iter().filter(|p| p[0].is_finite() && p[1].is_finite());
    let Some(first) = finite.next() else { return format!("{name}: no data.") };
    let last = finite.next_back().unwrap_or(first);
    let bounds = Range::of(series.points.iter().map(|p| p[1])).unwrap_or_default();
    let [from, to, low, high] = [first[1], last[1], bounds.low, bounds.high].map(shown);
    let unit = Label::unit(&figure.y.unit).to_plain();
    format!("{name}: from {from} to {to}, between {low} and {high} {unit}.").replace(" .", ".")
}

fn shown(value: f64) -> String {
    Label::number(value, DIGITS).to_plain()
}
