//! The report as Markdown, with LaTeX between dollar signs and links to figure files.

use std::iter;

use super::markup::Markup;
use super::math::{Block, Definition, Typeset};
use super::parts::{BodyModel, CheckRow};
use super::picture::{Chart, Picture};
use super::prose::Text;
use super::table::{Align, PrintedTable};
use super::walk::{MOVES, Writer};
use super::{LESSON, Report, rows};
use crate::site::url;
use tumble_drawing::Animation;

/// Characters that Markdown or HTML inside of it would read as markup.
const SPECIAL: &str = "\\`*_{}[]()#+-.!|<>&$~^=\"':";

pub(super) fn document(report: &Report) -> String {
    let lesson = report.lesson.as_ref().map(|path| format!("[{LESSON}]({})", url(path)));
    let head = [
        format!("# {}", escape(&report.title)),
        Markdown::text(&report.lead),
        lesson.unwrap_or_default(),
        Markdown::paragraphs(&report.intro),
    ];
    let numbered = |(i, content): (usize, String)| format!("## {} {}\n\n{content}", i + 1, MOVES[i].1);
    let moves = Markdown.moves(report).into_iter().enumerate().map(numbered);
    Markdown::joined(head.into_iter().chain(moves).chain([Markdown::facts(&report.meta)])) + "\n"
}

/// The forces, laws, equations of motion and closed forms alone, as a part of a document of many scenes.
pub(super) fn equations(report: &Report) -> String {
    let body = |body: &BodyModel| {
        let acting = rows::acting(body).map(|table| PrintedTable { caption: Text::default(), ..table });
        let content = Markdown::joined([Markdown::tables(&acting), Markdown::blocks(&body.laws)]);
        if content.is_empty() {
            content
        } else {
            Markdown::joined([Markdown::heading(3, &body.name), content])
        }
    };
    let Report { model, solve, .. } = report;
    let phases = solve.phases.iter().map(|phase| Markdown::phase(phase, 4));
    Markdown::joined([
        format!("## {}", escape(&report.title)),
        Markdown::joined(model.bodies.iter().map(body)),
        Markdown::equations_of_motion(&model.modes),
        Markdown::impacts(&model.impacts),
        Markdown::titled("In closed form", Markdown::joined(phases)),
    ]) + "\n"
}

/// Plain characters; whatever could be markup gets a backslash, and lines stay lines of text.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => out.push(' '),
            c if tumble_drawing::svg::turns(c) => out.push('\u{FFFD}'),
            // Entities: many readers pass tags on whatever stands before them.
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            c if SPECIAL.contains(c) => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out
}

/// The language of the file.
struct Markdown;

impl Markup for Markdown {
    fn words(text: &str) -> String {
        escape(text)
    }

    fn math(math: &Typeset) -> String {
        latex(math).map_or_else(|| escape(&math.text), |latex| format!("${latex}$"))
    }
}

/// LaTeX without what would end the formula or begin HTML.
fn latex(math: &Typeset) -> Option<String> {
    let latex = math.latex.trim();
    let line = latex.replace(['\n', '\r', '\u{2028}', '\u{2029}'], " ");
    let safe = line.replace('<', "\\lt ").replace('>', "\\gt ");
    (!latex.is_empty() && !latex.contains('$')).then_some(safe)
}

fn display(math: &Typeset) -> String {
    latex(math).map_or_else(|| escape(&math.text), |latex| format!("$$\n{latex}\n$$"))
}

impl Writer for Markdown {
    /// With an empty line between them.
    fn joined(parts: impl IntoIterator<Item = String>) -> String {
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n\n")
    }

    fn heading(level: usize, title: &Text) -> String {
        if title.is_empty() { String::new() } else { format!("{} {}", "#".repeat(level), Self::text(title)) }
    }

    fn paragraph(words: &Text) -> String {
        Self::text(words)
    }

    fn remark(words: &str) -> String {
        words.to_owned()
    }

    fn list(items: &[Text]) -> String {
        items.iter().map(|item| format!("- {}", Self::text(item))).collect::<Vec<_>>().join("\n")
    }

    fn facts(facts: &[(Text, Text)]) -> String {
        let facts =
            facts.iter().map(|(name, value)| format!("- {}: {}", Self::text(name), Self::text(value)));
        facts.collect::<Vec<_>>().join("\n")
    }

    fn block(block: &Block) -> String {
        let definition = |Definition { symbol, meaning }: &Definition| match meaning.is_empty() {
            true => format!("- {}", Self::math(symbol)),
            false => format!("- {}: {}", Self::math(symbol), Self::text(meaning)),
        };
        let definitions: Vec<_> = block.definitions.iter().map(definition).collect();
        let intro = if definitions.is_empty() { "" } else { "where" };
        let ends = [intro.to_owned(), definitions.join("\n")];
        Self::joined(iter::once(Self::text(&block.title)).chain(block.lines.iter().map(display)).chain(ends))
    }

    /// With its notes; columns without content are left out.
    fn table(table: &PrintedTable) -> String {
        let PrintedTable { columns, rows, caption, .. } = table;
        let kept = table.filled();
        if kept.is_empty() {
            return Self::paragraphs(&table.notes);
        }
        let line = |cell: &dyn Fn(usize) -> String| {
            format!("| {} |", kept.iter().map(|i| cell(*i)).collect::<Vec<_>>().join(" | "))
        };
        let head = line(&|i| Self::text(&columns[i].heading));
        let rule = line(&|i| if columns[i].align == Align::Right { "---:" } else { "---" }.to_owned());
        // A bar inside a formula would end the cell.
        let cell = |cell: &Text| Self::text(cell).replace('|', "\\|").replace("\\\\|", "\\|");
        let body = rows.iter().map(|row| line(&|i| row.get(i).map(cell).unwrap_or_default()));
        let lines: Vec<_> = [head, rule].into_iter().chain(body).collect();
        let caption = if caption.is_empty() { String::new() } else { format!("**{}**", Self::text(caption)) };
        let all = Self::paragraphs(table.all_rows().as_slice());
        Self::joined([caption, lines.join("\n"), Self::paragraphs(&table.notes), all])
    }

    fn checks(checks: &[CheckRow]) -> String {
        Self::table(&rows::checks(checks))
    }

    fn picture(&mut self, Picture { svg, caption, file }: &Picture) -> String {
        figure(file, [&svg.description, &svg.title], caption)
    }

    fn plot(&mut self, plot: &Chart) -> String {
        figure(&plot.file, [&plot.description, &plot.figure.title.to_plain()], &plot.caption)
    }

    /// Nothing moves on paper.
    fn animation(&mut self, _: &Animation) -> String {
        String::new()
    }

    fn panel(_: usize, name: &Text, content: String) -> String {
        Self::joined([Self::heading(4, name), content])
    }

    fn group(_: &str, content: String) -> String {
        content
    }

    fn pair(parts: [String; 2]) -> String {
        Self::joined(parts)
    }
}

/// A link to a picture, told by its description or else its title, with its caption below; the caption alone if there is no file.
fn figure(file: &str, [description, title]: [&str; 2], caption: &Text) -> String {
    let alt = if description.is_empty() { title } else { description };
    let image = if file.is_empty() { String::new() } else { format!("![{}]({})", escape(alt), url(file)) };
    Markdown::joined([image, Markdown::text(caption)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Column, ModeEquations};
    use tumble_drawing::svg::Svg;

    #[test]
    fn formulas_become_latex_and_figures_links() {
        let mut report = Report { title: "A rod".into(), ..Report::default() };
        let law = Typeset { latex: "m a = F".into(), text: "m a = F".into(), ..Typeset::default() };
        report.model.modes.push(ModeEquations {
            equations: vec![Block { lines: vec![law.clone()], ..Block::default() }],
            ..ModeEquations::default()
        });
        report.analyze.findings.push(Text::from("It obeys ").and(law));
        let svg = Svg::new(1.0, 1.0, "A [picture]");
        report.analyze.pictures.push(Picture::new(svg, "Its path.").stored("figures/a b.svg"));
        let shown = report.markdown();
        assert!(shown.contains("$$\nm a = F\n$$") && shown.contains("- It obeys $m a = F$"));
        assert!(shown.contains("![A \\[picture\\]](./figures/a%20b.svg)\n\nIts path\\."), "{shown}");
    }

    #[test]
    fn tables_have_a_rule_and_one_line_a_row() {
        let table = PrintedTable::new("Events", vec![Column::numbers("t"), Column::words("what")])
            .row(vec!["0.5".into(), "hit | slide\nagain".into()]);
        let shown = Markdown::table(&table);
        assert_eq!(shown, "**Events**\n\n| t | what |\n| ---: | --- |\n| 0\\.5 | hit \\| slide again |");
    }

    #[test]
    fn markup_is_shown() {
        let shown = escape("<script>alert(1)</script> [a](javascript:b) **c** $d$\n# e");
        assert!(
            !shown.contains('<') && shown.contains("\\[a\\]\\(javascript\\:b\\) \\*\\*c\\*\\* \\$d\\$ \\# e")
        );
        let breakout = Typeset { latex: "a$</script>$b".into(), text: "a".into(), ..Typeset::default() };
        assert_eq!(Markdown::math(&breakout), "a");
    }
}
