//! Figures of the page: what stands there without scripts.

use super::data::plot_data;
use super::inline::{tagged, text};
use super::motion::{motion_data, still};
use super::page::Page;
use crate::figures::captions;
use crate::report::picture::{Chart, Picture};
use crate::report::prose::Text;
use tumble_drawing::Animation;
use tumble_drawing::Label;
use tumble_drawing::curves::{CurveFigure, DataSeries};
use tumble_drawing::scale::Range;
use tumble_drawing::svg::Svg;

/// Pixels: on paper narrower drawings fit into half its width.
const NARROW: f64 = 490.0;
/// Digits of numbers in descriptions.
const DIGITS: usize = 4;
/// Curves that a description names one by one.
const NAMED: usize = 12;

impl Page {
    /// A drawing with its caption.
    pub(super) fn picture(&mut self, picture: &Picture) -> String {
        let drawing = self.inline(&picture.svg);
        let class = if picture.svg.width < NARROW { "drawing narrow" } else { "drawing" };
        self.figure(class, &format!("<div class=\"sheet\">{drawing}</div>\n"), &picture.caption)
    }

    /// Drawings side by side where there is room.
    pub(super) fn pictures(&mut self, pictures: &[Picture]) -> String {
        let pictures: String = pictures.iter().map(|picture| self.picture(picture)).collect();
        tagged("div", "figures", &pictures)
    }

    /// Curves one below the other.
    pub(super) fn plots(&mut self, plots: &[Chart]) -> String {
        let plots: String = plots.iter().map(|plot| self.plot(plot)).collect();
        tagged("div", "plots", &plots)
    }

    fn plot(&mut self, plot: &Chart) -> String {
        let description = description(plot);
        let drawing = self.inline(&plot.figure.small_svg().described(description.clone()));
        self.plots.push(plot_data(plot, &description));
        let (number, title) = (self.plots.len() - 1, plot.figure.title.to_plain());
        let content = format!("<div class=\"sheet still\">{drawing}</div>\n");
        let name = if title.is_empty() { "Curves".to_owned() } else { title };
        let data =
            format!("plot\" data-plot=\"{number}\" data-name=\"{}", tumble_drawing::svg::escape(&name));
        self.figure(&data, &content, &plot.caption)
    }

    /// A motion: a stroboscopic picture until a script makes it move.
    pub(super) fn animation(&mut self, animation: &Animation) -> String {
        if animation.cases.is_empty() {
            return String::new();
        }
        let svg = still(animation);
        let description = svg.description.clone();
        let drawing = self.inline(&svg);
        self.motions.push(motion_data(animation, &description));
        let content = format!("<div class=\"sheet still\">{drawing}</div>\n");
        let data = format!("motion\" data-motion=\"{}", self.motions.len() - 1);
        format!("<h3>Motion</h3>\n{}", self.figure(&data, &content, &captions::motion(animation)))
    }

    fn inline(&mut self, svg: &Svg) -> String {
        self.figures += 1;
        svg.inline(&format!("figure-{}", self.figures))
    }

    /// A figure with its number and caption; the class may end in further attributes.
    fn figure(&self, class: &str, content: &str, caption: &Text) -> String {
        let number = self.figures;
        format!(
            "<figure class=\"{class}\">\n{content}<figcaption><span class=\"number\">Figure {number}.</span> {}</figcaption>\n</figure>\n",
            text(caption)
        )
    }
}

/// The curves in words.
pub(in crate::report) fn description(plot: &Chart) -> String {
    if !plot.description.is_empty() {
        return plot.description.clone();
    }
    let figure = &plot.figure;
    let axes = format!("{} over {}.", title(&figure.y.title(), "values"), title(&figure.x.title(), "values"));
    let curves = figure.series.iter().take(NAMED).map(|series| curve(figure, series));
    let rest = figure.series.len().saturating_sub(NAMED);
    let rest = (rest > 0).then(|| format!("And {rest} more curves."));
    std::iter::once(axes).chain(curves).chain(rest).collect::<Vec<_>>().join(" ")
}

fn title(label: &Label, otherwise: &str) -> String {
    if label.is_empty() { otherwise.to_owned() } else { label.to_plain() }
}

/// Where a curve begins and ends, and its bounds.
fn curve(figure: &CurveFigure, series: &DataSeries) -> String {
    let name = title(&series.label, "The curve");
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
