//! The report as Markdown, with LaTeX between dollar signs and links to figure files.

use super::Report;
use super::analyze::{Analyze, Case, Check};
use super::identify::{BodyRow, Identify, Quantity};
use super::math::{Block, Math};
use super::model::{BodyModel, ForceRow, Mode, Model};
use super::picture::{Picture, Plot};
use super::prose::{Piece, Text};
use super::solve::{Phase, Solve};
use super::table::{Align, Column, Table};
use crate::font::Face;
use crate::text::{Label, Level, Run};

/// Characters that Markdown or HTML inside of it would read as markup.
const SPECIAL: &str = "\\`*_{}[]()#+-.!|<>&$~^=\"':";

pub(super) fn document(report: &Report) -> String {
    let meta: Vec<_> = report.meta.iter().map(|(k, v)| format!("- {}: {}", escape(k), escape(v))).collect();
    let parts = [
        format!("# {}", escape(&report.title)),
        paragraphs(&report.intro),
        identify(&report.identify),
        model(&report.model),
        solve(&report.solve),
        analyze(&report.analyze),
        meta.join("\n"),
    ];
    joined(parts) + "\n"
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

fn text(text: &Text) -> String {
    text.pieces.iter().map(piece).collect()
}

fn piece(piece: &Piece) -> String {
    match piece {
        Piece::Words(words) => escape(words),
        Piece::Label(words) => label(words),
        Piece::Math(formula) => math(formula),
    }
}

fn label(label: &Label) -> String {
    label.runs.iter().map(run).collect()
}

fn run(run: &Run) -> String {
    let words = escape(&run.text);
    let faced = match run.face {
        Face::Regular => words,
        Face::Italic => format!("<i>{words}</i>"),
        Face::Bold => format!("<b>{words}</b>"),
    };
    match run.level {
        Level::Base => faced,
        Level::Subscript => format!("<sub>{faced}</sub>"),
        Level::Superscript => format!("<sup>{faced}</sup>"),
    }
}

/// LaTeX without what would end the formula or begin HTML.
fn latex(math: &Math) -> Option<String> {
    let latex = math.latex.trim();
    let line = latex.replace(['\n', '\r', '\u{2028}', '\u{2029}'], " ");
    let safe = line.replace('<', "\\lt ").replace('>', "\\gt ");
    (!latex.is_empty() && !latex.contains('$')).then_some(safe)
}

fn math(math: &Math) -> String {
    latex(math).map_or_else(|| escape(&math.text), |latex| format!("${latex}$"))
}

fn display(math: &Math) -> String {
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
    let definitions: Vec<_> =
        block.definitions.iter().map(|d| format!("- {}: {}", math(&d.symbol), text(&d.meaning))).collect();
    let definitions = titled("where", definitions.join("\n"));
    joined(std::iter::once(text(&block.title)).chain(lines).chain([definitions]))
}

fn blocks(blocks: &[Block]) -> String {
    joined(blocks.iter().map(block))
}

/// A table from finished cells; columns without content are left out.
fn grid(caption: &str, columns: &[Column], rows: &[Vec<String>]) -> String {
    let filled = |i: &usize| rows.iter().any(|row| row.get(*i).is_some_and(|cell| !cell.is_empty()));
    let kept: Vec<usize> = (0..columns.len()).filter(filled).collect();
    if kept.is_empty() {
        return String::new();
    }
    let line = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
    let head = line(kept.iter().map(|i| text(&columns[*i].heading)).collect());
    let rule = |i: &usize| if columns[*i].align == Align::Right { "---:" } else { "---" }.to_owned();
    let rule = line(kept.iter().map(rule).collect());
    // A bar inside a formula would end the cell.
    let cell = |row: &Vec<String>, i: usize| {
        row.get(i).map_or(String::new(), |c| c.replace('|', "\\|").replace("\\\\|", "\\|"))
    };
    let body = rows.iter().map(|row| line(kept.iter().map(|i| cell(row, *i)).collect()));
    let lines: Vec<_> = [head, rule].into_iter().chain(body).collect();
    let caption = if caption.is_empty() { String::new() } else { format!("**{caption}**") };
    joined([caption, lines.join("\n")])
}

fn table(table: &Table) -> String {
    let rows: Vec<Vec<String>> = table.rows.iter().map(|row| row.iter().map(text).collect()).collect();
    joined([grid(&text(&table.caption), &table.columns, &rows), paragraphs(&table.notes)])
}

fn value(quantity: &Quantity) -> String {
    let space = if quantity.unit.is_empty() || quantity.unit == "deg" { "" } else { "\u{a0}" };
    format!("{}{space}{}", text(&quantity.value), label(&Label::unit(&quantity.unit)))
}

fn quantity(quantity: &Quantity) -> Vec<String> {
    let formula = quantity.formula.as_ref().map(math).unwrap_or_default();
    vec![text(&quantity.name), text(&quantity.symbol), value(quantity), formula, text(&quantity.note)]
}

fn quantities(caption: &str, quantities: &[Quantity]) -> String {
    let columns = ["Quantity", "Symbol", "Value", "Computed by", "Remark"].map(Column::words);
    grid(caption, &columns, &quantities.iter().map(quantity).collect::<Vec<_>>())
}

fn bodies(rows: &[BodyRow]) -> String {
    let columns =
        ["Body", "Shape", "Property", "Symbol", "Value", "Computed by", "Remark"].map(Column::words);
    let lines = |row: &BodyRow| {
        let name = || vec![text(&row.name), text(&row.shape)];
        let mut lines: Vec<Vec<String>> =
            row.properties.iter().map(|q| [name(), quantity(q)].concat()).collect();
        if lines.is_empty() {
            lines.push(name());
        }
        lines
    };
    grid("Bodies", &columns, &rows.iter().flat_map(lines).collect::<Vec<_>>())
}

fn identify(identify: &Identify) -> String {
    joined([
        "## 1 Identify".to_owned(),
        paragraphs(&identify.intro),
        identify.scene.as_ref().map(picture).unwrap_or_default(),
        bodies(&identify.bodies),
        quantities("Parameters", &identify.parameters),
        quantities("At the start", &identify.initial),
        titled("### Sought", list(&identify.sought)),
    ])
}

fn model(model: &Model) -> String {
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
        forces(&body.forces),
        blocks(&body.laws),
    ])
}

fn forces(forces: &[ForceRow]) -> String {
    let columns = ["Force", "Symbol", "Law", "Acts at", "Torque about the centre of mass"].map(Column::words);
    let row = |force: &ForceRow| {
        vec![
            text(&force.name),
            math(&force.symbol),
            math(&force.formula),
            text(&force.point),
            math(&force.torque),
        ]
    };
    grid("Forces", &columns, &forces.iter().map(row).collect::<Vec<_>>())
}

fn mode(mode: &Mode) -> String {
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
    joined([heading(3, &phase.name), text(&phase.span), blocks(&phase.symbols), numbers])
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
        checks(&analyze.checks),
    ])
}

fn case(case: &Case, single: bool) -> String {
    let name = if single { Text::default() } else { case.name.clone().into() };
    let books = case.books.as_ref().map(|books| {
        let tables = books.tables.iter().map(table);
        joined(std::iter::once(paragraphs(&books.intro)).chain(tables).chain(books.plots.iter().map(plot)))
    });
    joined([
        heading(3, &name),
        paragraphs(&case.intro),
        joined(case.plots.iter().map(plot)),
        joined(case.pictures.iter().map(picture)),
        titled("**Energy and the books**", books.unwrap_or_default()),
        joined(case.tables.iter().map(table)),
        checks(&case.checks),
    ])
}

fn checks(checks: &[Check]) -> String {
    let columns = ["Check", "Expected", "Found", "Within", "Result"].map(Column::words);
    let row = |check: &Check| {
        let result = if check.passed { "✓ passed" } else { "✗ **failed**" };
        vec![
            text(&check.what),
            text(&check.expected),
            text(&check.found),
            text(&check.within),
            result.to_owned(),
        ]
    };
    grid("Checks", &columns, &checks.iter().map(row).collect::<Vec<_>>())
}

fn picture(picture: &Picture) -> String {
    let alt = if picture.svg.description.is_empty() { &picture.svg.title } else { &picture.svg.description };
    figure(&picture.file, alt, &picture.caption)
}

fn plot(plot: &Plot) -> String {
    let title = plot.figure.title.to_plain();
    let alt = if plot.description.is_empty() { &title } else { &plot.description };
    figure(&plot.file, alt, &plot.caption)
}

/// A link to a picture with its caption below; the caption alone if there is no file.
fn figure(file: &str, alt: &str, caption: &Text) -> String {
    let image = if file.is_empty() {
        String::new()
    } else {
        format!("![{}]({})", escape(alt), crate::page::url(file))
    };
    joined([image, text(caption)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::Svg;

    #[test]
    fn formulas_become_latex_and_figures_links() {
        let mut report = Report { title: "A rod".into(), ..Report::default() };
        let law = Math { latex: "m a = F".into(), text: "m a = F".into(), ..Math::default() };
        report.model.modes.push(Mode {
            equations: vec![Block { lines: vec![law.clone()], ..Block::default() }],
            ..Mode::default()
        });
        report.analyze.findings.push(Text::words("It obeys ").and(law));
        let svg = Svg::new(1.0, 1.0, "A [picture]");
        report.analyze.pictures.push(Picture::new(svg, "Its path.").stored("figures/a b.svg"));
        let shown = report.markdown();
        assert!(shown.contains("$$\nm a = F\n$$") && shown.contains("- It obeys $m a = F$"));
        assert!(shown.contains("![A \\[picture\\]](./figures/a%20b.svg)\n\nIts path\\."), "{shown}");
    }

    #[test]
    fn tables_have_a_rule_and_one_line_a_row() {
        let table = Table::new("Events", vec![Column::numbers("t"), Column::words("what")])
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
        let breakout = Math { latex: "a$</script>$b".into(), text: "a".into(), ..Math::default() };
        assert_eq!(math(&breakout), "a");
    }
}
