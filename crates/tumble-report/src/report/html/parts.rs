//! How the parts of a report are written in HTML.

use super::data::plot_data;
use super::figures::description;
use super::inline::tagged;
use super::motion::{motion_data, still};
use super::page::Page;
use super::tables;
use crate::figures::captions;
use crate::report::markup::Markup;
use crate::report::math::{Block, Definition};
use crate::report::parts::CheckRow;
use crate::report::picture::{Chart, Picture};
use crate::report::prose::Text;
use crate::report::table::PrintedTable;
use crate::report::walk::Writer;
use tumble_drawing::Animation;

/// Pixels: on paper narrower drawings fit into half its width.
const NARROW: f64 = 490.0;

impl Writer for Page {
    fn joined(parts: impl IntoIterator<Item = String>) -> String {
        parts.into_iter().collect()
    }

    fn heading(level: usize, title: &Text) -> String {
        tagged(&format!("h{level}"), "", &Self::text(title))
    }

    fn paragraph(words: &Text) -> String {
        tagged("p", "", &Self::text(words))
    }

    fn remark(words: &str) -> String {
        tagged("p", "", words)
    }

    fn list(items: &[Text]) -> String {
        let items = items.iter().map(|item| tagged("li", "", &Self::text(item)));
        tagged("ul", "", &Self::joined(items))
    }

    fn facts(facts: &[(Text, Text)]) -> String {
        let facts = facts.iter().map(|(name, value)| fact("", &Self::text(name), &Self::text(value)));
        tagged("dl", "facts", &Self::joined(facts))
    }

    fn block(block: &Block) -> String {
        let title = tagged("p", "block-title", &Self::text(&block.title));
        let lines = Self::joined(block.lines.iter().map(|line| tagged("div", "line", &Self::math(line))));
        let definition = |definition: &Definition| {
            let meaning = Self::text(&definition.meaning);
            // An equation may be as long as any: it has lines, and what it means stands below it where there is no room beside.
            let is_equation = meaning.is_empty() || definition.symbol.text.contains(" = ");
            let class = if is_equation { " class=\"line\"" } else { "" };
            fact(class, &Self::math(&definition.symbol), &meaning)
        };
        let definitions = tagged("dl", "where", &Self::joined(block.definitions.iter().map(definition)));
        let intro = if definitions.is_empty() { "" } else { "<p class=\"where\">where</p>\n" };
        format!(
            "<div class=\"block\">\n{title}<div class=\"lines\">{lines}</div>\n{intro}{definitions}</div>\n"
        )
    }

    fn table(table: &PrintedTable) -> String {
        tables::table(table)
    }

    /// Those that failed are counted in words as well.
    fn checks(checks: &[CheckRow]) -> String {
        let failed = match checks.iter().filter(|check| !check.passed && !check.is_of_other_values).count() {
            0 => String::new(),
            failed => format!("{failed} of {} checks failed.", checks.len()),
        };
        tagged("p", "failed", &failed) + &tables::checks(checks)
    }

    fn picture(&mut self, picture: &Picture) -> String {
        let drawing = self.inline(&picture.svg);
        let class = if picture.svg.width < NARROW { "drawing narrow" } else { "drawing" };
        self.figure(class, "sheet", &drawing, &picture.caption)
    }

    fn plot(&mut self, plot: &Chart) -> String {
        let description = description(plot);
        let drawing = self.inline(&plot.figure.small_svg().described(description.clone()));
        self.plots.push(plot_data(plot, &description));
        let (number, name) = (self.plots.len() - 1, plot.figure.title.to_plain_or("Curves"));
        let class =
            format!("plot\" data-plot=\"{number}\" data-name=\"{}", tumble_drawing::svg::escape(&name));
        self.figure(&class, "sheet still", &drawing, &plot.caption)
    }

    /// A stroboscopic picture until a script makes it move.
    fn animation(&mut self, animation: &Animation) -> String {
        if animation.cases.is_empty() {
            return String::new();
        }
        let svg = still(animation);
        self.motions.push(motion_data(animation, &svg.description));
        let class = format!("motion\" data-motion=\"{}", self.motions.len() - 1);
        let drawing = self.inline(&svg);
        Self::titled("Motion", self.figure(&class, "sheet still", &drawing, &captions::motion(animation)))
    }

    /// Scripts make tabs of them.
    fn panel(number: usize, name: &Text, content: String) -> String {
        let name = if name.is_empty() { format!("Case {number}") } else { Self::text(name) };
        format!(
            "<section class=\"case\" id=\"case-{number}\" aria-labelledby=\"case-{number}-name\">\n\
             <h4 id=\"case-{number}-name\">{name}</h4>\n{content}</section>\n"
        )
    }

    fn group(class: &str, content: String) -> String {
        tagged("div", class, &content)
    }

    fn pair(parts: [String; 2]) -> String {
        match parts.each_ref().map(String::as_str) {
            ["", only] | [only, ""] => only.to_owned(),
            _ => tagged("div", "pair", &parts.map(|part| tagged("div", "", &part)).concat()),
        }
    }
}

/// A row of a list of names with what they are; the class of the name is an attribute, or nothing.
fn fact(class: &str, name: &str, value: &str) -> String {
    format!("<div><dt{class}>{name}</dt><dd>{value}</dd></div>\n")
}
