//! The frame of the page: head, title, contents, sections, data, scripts.

use super::inline::tagged;
use super::lab;
use crate::report::markup::Markup;
use crate::report::walk::{MOVES, Writer};
use crate::report::{LESSON, Report, json};
use crate::site::{Ways, document, url};
use tumble_drawing::svg::escape;

pub(crate) const STYLE: &str = include_str!("../assets/report.css");

/// What a motion that plays is made of, behind what all share.
pub(crate) const MOTION: &str = concat!(
    include_str!("../assets/arrows.js"),
    include_str!("../assets/names.js"),
    include_str!("../assets/ground.js"),
    include_str!("../assets/shapes.js"),
    include_str!("../assets/motion.js"),
);

/// Scripts in the order in which they run.
const SCRIPTS: [&str; 7] = [
    include_str!("../assets/common.js"),
    include_str!("../assets/axes.js"),
    include_str!("../assets/plots.js"),
    MOTION,
    include_str!("../assets/folds.js"),
    include_str!("../assets/scroll.js"),
    include_str!("../assets/page.js"),
];

/// Scripts or styles as one, without indents and the lines that are for those who read the sources: a page is mailed.
pub(crate) fn joined(sources: &[&str]) -> String {
    let is_remark = |line: &&str| {
        line.is_empty() || line.starts_with("//") || (line.starts_with("/*") && line.ends_with("*/"))
    };
    let lines =
        sources.iter().flat_map(|source| source.lines()).map(str::trim).filter(|line| !is_remark(line));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// What gathers while the page is written.
#[derive(Debug, Default)]
pub(super) struct Page {
    /// Figures so far: their numbers and anchors.
    pub(super) figures: usize,
    /// Data of curves, as JSON.
    pub(super) plots: Vec<String>,
    /// Data of the animation, as JSON.
    pub(super) motions: Vec<String>,
}

/// The page.
pub(crate) fn page(report: &Report) -> String {
    let mut page = Page::default();
    let sections = page.sections(report).concat();
    let (header, footer) = (header(report), tagged("footer", "", &Page::facts(&report.meta)));
    let data = json::object([("plots", json::list(page.plots)), ("motions", json::list(page.motions))]);
    let (panel, looks, lab) = match &report.lab {
        Some(lab) => (lab::PANEL, lab::STYLE, lab::scripts(lab)),
        None => ("", "", String::new()),
    };
    let body = format!(
        "{header}{panel}<main>\n{sections}</main>\n{footer}\
         <script type=\"application/json\" id=\"report-data\">{data}</script>\n<script>\n{}</script>\n{lab}",
        joined(&SCRIPTS)
    );
    let style = format!("{}{}", joined(&[STYLE, looks]), tumble_notation::page_font());
    document([&report.title, &report.language], "", &style, &body)
}

/// The sections with their data, for a page that is there already.
pub fn parts(report: &Report) -> String {
    let mut page = Page::default();
    let sections = page.sections(report).map(|section| json::string(&section));
    let (plots, motions) = (json::list(page.plots), json::list(page.motions));
    json::object([
        ("lead", json::string(&Page::text(&report.lead))),
        ("sections", json::list(sections)),
        ("plots", plots),
        ("motions", motions),
    ])
}

impl Page {
    fn sections(&mut self, report: &Report) -> [String; 4] {
        let contents = self.moves(report);
        std::array::from_fn(|i| section(i + 1, &MOVES[i], &contents[i]))
    }
}

fn header(report: &Report) -> String {
    let links: String =
        MOVES.iter().map(|(id, name)| format!("<li><a href=\"#{id}\">{name}</a></li>")).collect();
    let lesson = report
        .lesson
        .as_ref()
        .map(|path| format!("<p class=\"lesson\"><a href=\"{}\">{LESSON}</a></p>\n", url(path)));
    format!(
        "{}<header>\n<h1>{}</h1>\n{}{}{}<nav aria-label=\"Sections\"><ol>{links}</ol></nav>\n</header>\n",
        report.ways.as_ref().map(Ways::html).unwrap_or_default(),
        escape(&report.title),
        tagged("p", "lead", &Page::text(&report.lead)),
        lesson.unwrap_or_default(),
        Page::paragraphs(&report.intro)
    )
}

fn section(number: usize, (id, name): &(&str, &str), content: &str) -> String {
    let content = if content.is_empty() { "<p class=\"note\">Nothing is said here.</p>\n" } else { content };
    format!(
        "<section id=\"{id}\" aria-labelledby=\"{id}-heading\">\n<h2 id=\"{id}-heading\">\
         <span class=\"move\">{number}</span> {name}</h2>\n{content}</section>\n"
    )
}
