//! The report as Markdown, with LaTeX between dollar signs and links to figure files.

use super::markup::Markup;
use super::math::{Block, Definition, Typeset};
use super::parts::Identify;
use super::parts::{Analyze, RunAnalysis};
use super::parts::{BodyModel, ModeEquations, ModelPart};
use super::parts::{Phase, Solve};
use super::picture::{Chart, Picture};
use super::prose::Text;
use super::rows;
use super::table::{Align, PrintedTable};
use super::{LESSON, Report};
use crate::site::url;

/// Characters that Markdown or HTML inside of it would read as markup.
const SPECIAL: &str = "\\`*_{}[]()#+-.!|<>&$~^=\"':";

pub(super) fn document(report: &Report) -> String {
    let meta: Vec<_> = report.meta.iter().map(|(k, v)| format!("- {}: {}", escape(k), escape(v))).collect();
    let parts = [
        format!("# {}", escape(&report.title)),
        text(&report.lead),
        report.lesson.as_ref().map(|path| format!("[{LESSON}]({})", url(path))).unwrap_or_default(),
        paragraphs(&report.intro),
        identify(&report.identify),
        model(&report.model),
        solve(&report.solve),
        analyze(&report.analyze),
        meta.join("\n"),
    ];
    joined(parts) + "\n"
}

/// The forces, laws, equations of motion and closed forms alone, as a part of a document of many scenes.
pub(super) fn equations(report: &Report) -> String {
    let body = |body: &BodyModel| {
        let forces = PrintedTable { caption: Text::default(), ..rows::forces(&body.forces) };
        titled(&heading(3, &body.name), joined([table(&forces), blocks(&body.laws)]))
    };
    let Report { model, solve, .. } = report;
    joined([
        format!("## {}", escape(&report.title)),
        joined(model.bodies.iter().map(body)),
        titled("### Equations of motion", joined(model.modes.iter().map(mode))),
        titled("### In closed form", joined(solve.phases.iter().map(phase))),
    ]) + "\n"
}

/// Parts with an empty line between them; empty ones are left out.
fn joined(parts: impl IntoIterator<Item = String>) -> String {
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n\n")
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

    fn math(formula: &Typeset) -> String {
        math(formula)
    }
}

fn text(text: &Text) -> String {
    Markdown::text(text)
}

/// LaTeX without what would end the formula or begin HTML.
fn latex(math: &Typeset) -> Option<String> {
    let latex = math.latex.trim();
    let line = latex.replace(['\n', '\r', '\u{2028}', '\u{2029}'], " ");
    let safe = line.replace('<', "\\lt ").replace('>', "\\gt ");
    (!latex.is_empty() && !latex.contains('$')).then_some(safe)
}

fn math(math: &Typeset) -> String {
    latex(math).map_or_else(|| escape(&math.text), |latex| format!("${latex}$"))
}

fn display(math: &Typeset) -> String {
    latex(math).map_or_else(|| escape(&math.text), |latex| format!("$$\n{latex}\n$$"))
}

fn paragraphs(texts: &[Text]) -> String {
    joined(texts.iter().map(text))
}

fn list(items: &[Text]) -> String {
    items.iter().map(|item| format!("- {}", text(item))).collect::<Vec<_>>().join("\n")
}

fn titled(title: &str, content: String) -> String {
    if content.is_empty() { content } else { format!("{title}\n\n{content}") }
}

fn heading(level: usize, title: &Text) -> String {
    if title.is_empty() { String::new() } else { format!("{} {}", "#".repeat(level), text(title)) }
}

fn block(block: &Block) -> String {
    let lines = block.lines.iter().map(display);
    let definition = |definition: &Definition| match text(&definition.meaning) {
        meaning if meaning.is_empty() => format!("- {}", math(&definition.symbol)),
        meaning => format!("- {}: {meaning}", math(&definition.symbol)),
    };
    let definitions: Vec<_> = block.definitions.iter().map(definition).collect();
    let definitions = titled("where", definitions.join("\n"));
    joined(std::iter::once(text(&block.title)).chain(lines).chain([definitions]))
}

fn blocks(blocks: &[Block]) -> String {
    joined(blocks.iter().map(block))
}

/// A table with its notes; columns without content are left out.
fn table(table: &PrintedTable) -> String {
    let PrintedTable { columns, rows, .. } = table;
    let kept = table.filled();
    if kept.is_empty() {
        return paragraphs(&table.notes);
    }
    let line = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
    let head = line(kept.iter().map(|i| text(&columns[*i].heading)).collect());
    let rule = |i: &usize| if columns[*i].align == Align::Right { "---:" } else { "---" }.to_owned();
    let rule = line(kept.iter().map(rule).collect());
    // A bar inside a formula would end the cell.
    let cell = |row: &Vec<Text>, i: usize| {
        row.get(i).map_or(String::new(), |cell| text(cell).replace('|', "\\|").replace("\\\\|", "\\|"))
    };
    let body = rows.iter().map(|row| line(kept.iter().map(|i| cell(row, *i)).collect()));
    let lines: Vec<_> = [head, rule].into_iter().chain(body).collect();
    let caption = text(&table.caption);
    let caption = if caption.is_empty() { caption } else { format!("**{caption}**") };
    let all = paragraphs(table.all_rows().as_slice());
    joined([caption, lines.join("\n"), paragraphs(&table.notes), all])
}

fn identify(identify: &Identify) -> String {
    joined([
        "## 1 Identify".to_owned(),
        paragraphs(&identify.intro),
        identify.scene.as_ref().map(picture).unwrap_or_default(),
        table(&rows::bodies(&identify.bodies)),
        table(&rows::quantities("Parameters", &identify.parameters)),
        table(&rows::quantities("At the start", &identify.initial)),
        titled("### Sought", list(&identify.sought)),
    ])
}

fn model(model: &ModelPart) -> String {
    let modes = joined(model.modes.iter().map(mode));
    joined([
        "## 2 Model".to_owned(),
        paragraphs(&model.intro),
        titled("### Assumptions", list(&model.assumptions)),
        joined(model.bodies.iter().map(body_model)),
        titled("### Equations of motion", modes),
    ])
}

fn body_model(body: &BodyModel) -> String {
    joined([
        heading(3, &body.name),
        joined(body.diagrams.iter().map(picture)),
        table(&rows::forces(&body.forces)),
        blocks(&body.laws),
    ])
}

fn mode(mode: &ModeEquations) -> String {
    joined([heading(4, &mode.name), text(&mode.holds), blocks(&mode.equations)])
}

fn solve(solve: &Solve) -> String {
    let facts: Vec<_> = solve.method.iter().map(|(k, v)| format!("- {}: {}", text(k), text(v))).collect();
    joined([
        "## 3 Solve".to_owned(),
        paragraphs(&solve.intro),
        joined(solve.phases.iter().map(phase)),
        facts.join("\n"),
        joined(solve.tables.iter().map(table)),
    ])
}

fn phase(phase: &Phase) -> String {
    let numbers = titled("With numbers:", blocks(&phase.numbers));
    joined([heading(4, &phase.name), text(&phase.span), blocks(&phase.symbols), numbers])
}

fn analyze(analyze: &Analyze) -> String {
    let single = analyze.cases.len() == 1;
    joined([
        "## 4 Analyze".to_owned(),
        paragraphs(&analyze.intro),
        titled("### Findings", list(&analyze.findings)),
        joined(analyze.plots.iter().map(plot)),
        joined(analyze.pictures.iter().map(picture)),
        analyze.comparison.as_ref().map(table).unwrap_or_default(),
        joined(analyze.cases.iter().map(|c| case(c, single))),
        table(&rows::checks(&analyze.checks)),
    ])
}

fn case(case: &RunAnalysis, single: bool) -> String {
    let name = if single { Text::default() } else { case.name.clone().into() };
    let balance = case.balance.as_ref().map(|balance| {
        let tables = balance.tables.iter().map(table);
        joined(
            std::iter::once(paragraphs(&balance.intro)).chain(tables).chain(balance.plots.iter().map(plot)),
        )
    });
    joined([
        heading(3, &name),
        paragraphs(&case.intro),
        joined(case.plots.iter().map(plot)),
        joined(case.pictures.iter().map(picture)),
        titled("**Energy and momentum balance**", balance.unwrap_or_default()),
        joined(case.tables.iter().map(table)),
        table(&rows::checks(&case.checks)),
    ])
}

fn picture(picture: &Picture) -> String {
    let alt = if picture.svg.description.is_empty() { &picture.svg.title } else { &picture.svg.description };
    figure(&picture.file, alt, &picture.caption)
}

fn plot(plot: &Chart) -> String {
    let title = plot.figure.title.to_plain();
    let alt = if plot.description.is_empty() { &title } else { &plot.description };
    figure(&plot.file, alt, &plot.caption)
}

/// A link to a picture with its caption below; the caption alone if there is no file.
fn figure(file: &str, alt: &str, caption: &Text) -> String {
    let image = if file.is_empty() { String::new() } else { format!("![{}]({})", escape(alt), url(file)) };
    joined([image, text(caption)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Column;
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
        let shown = super::table(&table);
        assert_eq!(shown, "**Events**\n\n| t | what |\n| ---: | --- |\n| 0\\.5 | hit \\| slide again |");
    }

    #[test]
    fn markup_is_shown() {
        let shown = escape("<script>alert(1)</script> [a](javascript:b) **c** $d$\n# e");
        assert!(
            !shown.contains('<') && shown.contains("\\[a\\]\\(javascript\\:b\\) \\*\\*c\\*\\* \\$d\\$ \\# e")
        );
        let breakout = Typeset { latex: "a$</script>$b".into(), text: "a".into(), ..Typeset::default() };
        assert_eq!(math(&breakout), "a");
    }
}
