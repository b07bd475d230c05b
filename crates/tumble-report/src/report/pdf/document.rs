//! The sections of the report, in order.

use super::inline::{block, label, list, paragraphs, string, text, words};
use super::tables::table;
use crate::report::Report;
use crate::report::analyze::{Analyze, Balance, Case};
use crate::report::html::{description, still};
use crate::report::identify::Identify;
use crate::report::math::Block;
use crate::report::model::{BodyModel, Mode, Model};
use crate::report::picture::{Picture, Plot};
use crate::report::prose::Text;
use crate::report::rows::{bodies, checks, forces, quantities};
use crate::report::solve::{Phase, Solve};
use crate::report::table::Table;
use crate::svg::Svg;

/// What gathers while the document is written: drawings by file name.
#[derive(Debug, Default)]
struct Document {
    drawings: Vec<(String, String)>,
}

/// The document and its drawings, SVG by file name.
pub(super) fn of(report: &Report) -> (String, Vec<(String, String)>) {
    let mut document = Document::default();
    let sections = [
        head(report),
        paragraphs(&report.intro),
        document.identify(&report.identify),
        document.model(&report.model),
        document.solve(&report.solve),
        document.analyze(&report.analyze),
        meta(&report.meta),
    ];
    (sections.concat(), document.drawings)
}

fn head(report: &Report) -> String {
    let title = string(&report.title);
    let language = language(&report.language).map(|l| format!(", language: {}", string(l)));
    format!("#import \"looks.typ\": *\n#show: report.with(title: {title}{})\n", language.unwrap_or_default())
}

/// The language without its region, if it is one that Typst accepts.
fn language(name: &str) -> Option<&str> {
    let language = name.split('-').next().unwrap_or_default();
    let is_code = matches!(language.len(), 2 | 3) && language.bytes().all(|b| b.is_ascii_lowercase());
    is_code.then_some(language)
}

fn meta(meta: &[(String, String)]) -> String {
    let facts: Vec<_> =
        meta.iter().map(|(name, value)| (name.as_str().into(), value.as_str().into())).collect();
    if facts.is_empty() { String::new() } else { format!("#colophon[{}]\n", self::facts(&facts)) }
}

/// A heading; moves have the level 1. What is below it must not be empty.
fn heading(level: u8, title: &str) -> String {
    if title.is_empty() { String::new() } else { format!("\n#heading(level: {level})[{title}]\n") }
}

fn titled(level: u8, title: &str, content: String) -> String {
    if content.is_empty() { content } else { heading(level, &words(title)) + &content }
}

/// Names and values.
fn facts(facts: &[(Text, Text)]) -> String {
    let facts: String = facts.iter().map(|(k, v)| format!("([{}], [{}]), ", text(k), text(v))).collect();
    if facts.is_empty() { facts } else { format!("#facts({facts})\n") }
}

fn tables(tables: &[Table]) -> String {
    tables.iter().map(table).collect()
}

fn blocks(blocks: &[Block]) -> String {
    blocks.iter().map(block).collect()
}

impl Document {
    fn identify(&mut self, identify: &Identify) -> String {
        [
            heading(1, "Identify"),
            paragraphs(&identify.intro),
            identify.scene.as_ref().map(|picture| self.picture(picture)).unwrap_or_default(),
            table(&bodies(&identify.bodies)),
            table(&quantities("Parameters", &identify.parameters)),
            table(&quantities("At the start", &identify.initial)),
            titled(2, "Sought", list(&identify.sought)),
        ]
        .concat()
    }

    fn model(&mut self, model: &Model) -> String {
        let bodies: String = model.bodies.iter().map(|body| self.body(body)).collect();
        [
            heading(1, "Model"),
            paragraphs(&model.intro),
            titled(2, "Assumptions", list(&model.assumptions)),
            bodies,
            titled(2, "Equations of motion", model.modes.iter().map(mode).collect()),
        ]
        .concat()
    }

    fn body(&mut self, body: &BodyModel) -> String {
        let diagrams = self.pictures(&body.diagrams);
        [heading(2, &text(&body.name)), diagrams, table(&forces(&body.forces)), blocks(&body.laws)].concat()
    }

    fn solve(&mut self, solve: &Solve) -> String {
        let phases: String = solve.phases.iter().map(phase).collect();
        let intro = paragraphs(&solve.intro);
        [heading(1, "Solve"), intro, phases, facts(&solve.method), tables(&solve.tables)].concat()
    }

    fn analyze(&mut self, analyze: &Analyze) -> String {
        let motion = analyze.animation.as_ref().filter(|animation| !animation.cases.is_empty());
        let motion = motion.map(|motion| self.figure(&still(motion), &motion.title.clone().into()));
        [
            heading(1, "Analyze"),
            paragraphs(&analyze.intro),
            titled(2, "Findings", list(&analyze.findings)),
            titled(2, "Motion", motion.unwrap_or_default()),
            self.plots(&analyze.plots),
            self.pictures(&analyze.pictures),
            analyze.comparison.as_ref().map(table).unwrap_or_default(),
            self.cases(&analyze.cases),
            table(&checks(&analyze.checks)),
        ]
        .concat()
    }

    fn cases(&mut self, cases: &[Case]) -> String {
        if let [only] = cases {
            return self.case(only, 2);
        }
        let cases = cases.iter().map(|case| heading(3, &label(&case.name)) + &self.case(case, 4)).collect();
        titled(2, "The cases one by one", cases)
    }

    /// What belongs to a case, with headings of the given level.
    fn case(&mut self, case: &Case, level: u8) -> String {
        [
            paragraphs(&case.intro),
            self.plots(&case.plots),
            self.pictures(&case.pictures),
            case.balance.as_ref().map(|balance| self.balance(balance, level)).unwrap_or_default(),
            tables(&case.tables),
            table(&checks(&case.checks)),
        ]
        .concat()
    }

    fn balance(&mut self, balance: &Balance, level: u8) -> String {
        let content =
            [paragraphs(&balance.intro), tables(&balance.tables), self.plots(&balance.plots)].concat();
        titled(level, "Energy and momentum balance", content)
    }

    fn pictures(&mut self, pictures: &[Picture]) -> String {
        pictures.iter().map(|picture| self.picture(picture)).collect()
    }

    fn picture(&mut self, picture: &Picture) -> String {
        self.figure(&picture.svg, &picture.caption)
    }

    fn plots(&mut self, plots: &[Plot]) -> String {
        let drawn = |plot: &Plot| plot.figure.svg().described(description(plot));
        plots.iter().map(|plot| self.figure(&drawn(plot), &plot.caption)).collect()
    }

    /// A drawing with its number and caption.
    fn figure(&mut self, svg: &Svg, caption: &Text) -> String {
        let file = format!("figure-{}.svg", self.drawings.len() + 1);
        let alternative = if svg.description.is_empty() { &svg.title } else { &svg.description };
        let (name, alternative, caption) = (string(&file), string(alternative), text(caption));
        self.drawings.push((file, svg.to_string()));
        format!("#drawing({name}, {}, {}, {alternative})[{caption}]\n", svg.width, svg.height)
    }
}

fn mode(mode: &Mode) -> String {
    [heading(3, &text(&mode.name)), paragraphs(std::slice::from_ref(&mode.holds)), blocks(&mode.equations)]
        .concat()
}

fn phase(phase: &Phase) -> String {
    let numbers = blocks(&phase.numbers);
    let numbers = if numbers.is_empty() { numbers } else { format!("\nWith numbers:\n\n{numbers}") };
    let span = paragraphs(std::slice::from_ref(&phase.span));
    [heading(2, &text(&phase.name)), span, blocks(&phase.symbols), numbers].concat()
}
