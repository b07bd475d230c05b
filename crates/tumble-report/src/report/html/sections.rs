//! The sections of the page, in order.

use super::inline::{block, label, list, paragraphs, tagged, text};
use super::page::Page;
use super::tables::{checks, facts, table, titled};
use crate::report::math::Block;
use crate::report::parts::Identify;
use crate::report::parts::{Analyze, BalancePart, CheckRow, RunAnalysis};
use crate::report::parts::{BodyModel, ModeEquations, ModelPart};
use crate::report::parts::{Phase, Solve};
use crate::report::picture::{Chart, Picture};
use crate::report::rows::{bodies, forces, quantities};
use crate::report::table::PrintedTable;

/// Pixels: letters in a wider drawing would be too small beside something else.
const COLUMN: f64 = 700.0;

impl Page {
    /// What is given and what is sought.
    pub(super) fn identify(&mut self, identify: &Identify) -> String {
        let scene = identify.scene.as_ref().map(|picture| self.picture(picture)).unwrap_or_default();
        let numbers =
            [quantities("Parameters", &identify.parameters), quantities("At the start", &identify.initial)];
        let given = [table(&bodies(&identify.bodies)), tagged("div", "beside", &tables(&numbers))].concat();
        let sought = titled("Sought", &list(&identify.sought));
        pair([paragraphs(&identify.intro) + &scene + &sought, given])
    }

    /// Forces, laws, equations.
    pub(super) fn model(&mut self, model: &ModelPart) -> String {
        let bodies: String = model.bodies.iter().map(|body| self.body_model(body)).collect();
        let heading = if model.modes.is_empty() { "" } else { "<h3>Equations of motion</h3>\n" };
        let modes = tagged("div", "modes", &model.modes.iter().map(mode).collect::<String>());
        let assumptions = titled("Assumptions", &list(&model.assumptions));
        [paragraphs(&model.intro), assumptions, bodies, heading.to_owned(), modes].concat()
    }

    fn body_model(&mut self, body: &BodyModel) -> String {
        let diagrams: String = body.diagrams.iter().map(|picture| self.picture(picture)).collect();
        let is_broad = body.diagrams.iter().any(|picture| picture.svg.width > COLUMN);
        let content = [
            tagged("div", "diagrams", &diagrams),
            tagged("div", "forces", &table(&forces(&body.forces))),
            tagged("div", "laws", &blocks(&body.laws)),
        ];
        let class = if is_broad { "acting broad" } else { "acting" };
        tagged("h3", "", &text(&body.name)) + &tagged("div", class, &content.concat())
    }

    /// The solution.
    pub(super) fn solve(&mut self, solve: &Solve) -> String {
        let phases: String = solve.phases.iter().map(phase).collect();
        let (how, events) = solve.tables.split_at(solve.tables.len().min(1));
        let events = tagged("div", "beside", &tables(events));
        [paragraphs(&solve.intro), phases, facts(&solve.method), tables(how), events].concat()
    }

    /// What the solution says.
    pub(super) fn analyze(&mut self, analyze: &Analyze) -> String {
        let animation = analyze.animation.as_ref().map(|a| self.animation(a)).unwrap_or_default();
        let shown = self.shown(&analyze.plots, &analyze.pictures);
        let comparison = analyze.comparison.as_ref().map(table).unwrap_or_default();
        let cases = self.cases(&analyze.cases);
        let findings = titled("Findings", &(paragraphs(&analyze.intro) + &list(&analyze.findings)));
        let checks = titled_checks(&analyze.checks);
        [pair([findings, animation]), shown, comparison, cases, checks].concat()
    }

    /// Curves and drawings.
    fn shown(&mut self, plots: &[Chart], pictures: &[Picture]) -> String {
        let content = self.plots(plots) + &self.pictures(pictures);
        tagged("div", "shown", &content)
    }

    /// Cases as panels; scripts turn them into tabs.
    fn cases(&mut self, cases: &[RunAnalysis]) -> String {
        match cases {
            [] => String::new(),
            [only] => self.case(only, 3),
            _ => {
                let panels: String = cases.iter().enumerate().map(|(i, case)| self.panel(i, case)).collect();
                format!("<h3>The cases one by one</h3>\n<div class=\"cases\">\n{panels}</div>\n")
            }
        }
    }

    fn panel(&mut self, index: usize, case: &RunAnalysis) -> String {
        let (number, content) = (index + 1, self.case(case, 5));
        let name = if case.name.is_empty() { format!("Case {number}") } else { label(&case.name) };
        format!(
            "<section class=\"case\" id=\"case-{number}\" aria-labelledby=\"case-{number}-name\">\n\
             <h4 id=\"case-{number}-name\">{name}</h4>\n{content}</section>\n"
        )
    }

    /// What belongs to a case, with headings of the given level.
    fn case(&mut self, case: &RunAnalysis, level: u8) -> String {
        let shown = self.shown(&case.plots, &case.pictures);
        let balance = case.balance.as_ref().map(|balance| self.balance(balance, level)).unwrap_or_default();
        [paragraphs(&case.intro), shown, balance, tables(&case.tables), titled_checks(&case.checks)].concat()
    }

    fn balance(&mut self, balance: &BalancePart, level: u8) -> String {
        let plots = self.plots(&balance.plots);
        let heading = format!("<h{level}>Energy and momentum balance</h{level}>\n");
        let accounts = format!("<div>{}</div>\n{plots}", tables(&balance.tables));
        [heading, paragraphs(&balance.intro), tagged("div", "accounts", &accounts)].concat()
    }
}

/// Two things side by side, where there is room for both.
fn pair(parts: [String; 2]) -> String {
    match parts.each_ref().map(String::as_str) {
        ["", only] | [only, ""] => only.to_owned(),
        _ => tagged("div", "pair", &parts.map(|part| format!("<div>{part}</div>\n")).concat()),
    }
}

fn mode(mode: &ModeEquations) -> String {
    let name = tagged("h4", "", &text(&mode.name));
    tagged("div", "", &[name, tagged("p", "", &text(&mode.holds)), blocks(&mode.equations)].concat())
}

fn phase(phase: &Phase) -> String {
    let (name, span) = (tagged("h3", "", &text(&phase.name)), tagged("p", "", &text(&phase.span)));
    let numbers = blocks(&phase.numbers);
    let numbers = if numbers.is_empty() { numbers } else { format!("<p>With numbers:</p>\n{numbers}") };
    let symbols = blocks(&phase.symbols);
    let symbols = if symbols.is_empty() { symbols } else { format!("<p>In symbols:</p>\n{symbols}") };
    format!("{name}{span}{}", tagged("div", "phase", &pair([symbols, numbers])))
}

fn blocks(blocks: &[Block]) -> String {
    blocks.iter().map(block).collect()
}

fn tables(tables: &[PrintedTable]) -> String {
    tables.iter().map(table).collect()
}

/// Checks; those that failed are counted in words as well.
fn titled_checks(all: &[CheckRow]) -> String {
    let failed = all.iter().filter(|check| !check.passed).count();
    let summary = if failed == 0 {
        String::new()
    } else {
        format!("<p class=\"failed\">{failed} of {} checks failed.</p>\n", all.len())
    };
    summary + &checks(all)
}
