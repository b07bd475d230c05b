//! The parts of a report in their order, whatever they are written in.

use super::markup::Markup;
use super::math::Block;
use super::parts::{
    Analyze, BalancePart, BodyModel, CheckRow, Identify, ModeEquations, ModelPart, Phase, RunAnalysis, Solve,
};
use super::picture::{Chart, Picture};
use super::prose::Text;
use super::table::PrintedTable;
use super::{Report, rows};
use tumble_drawing::Animation;

/// Names of the four moves with their anchors.
pub(super) const MOVES: [(&str, &str); 4] =
    [("identify", "Identify"), ("model", "Model"), ("solve", "Solve"), ("analyze", "Analyze")];

/// Pixels: letters in a wider drawing would be too small beside something else.
const COLUMN: f64 = 700.0;

/// How parts are written; what has no content is nothing.
pub(super) trait Writer: Markup {
    /// Parts below each other.
    fn joined(parts: impl IntoIterator<Item = String>) -> String;
    fn heading(level: usize, title: &Text) -> String;
    fn paragraph(words: &Text) -> String;
    /// Words of ours, without marks that any language has.
    fn remark(words: &str) -> String;
    fn list(items: &[Text]) -> String;
    fn facts(facts: &[(Text, Text)]) -> String;
    fn block(block: &Block) -> String;
    fn table(table: &PrintedTable) -> String;
    fn checks(checks: &[CheckRow]) -> String;
    fn picture(&mut self, picture: &Picture) -> String;
    fn plot(&mut self, plot: &Chart) -> String;
    fn animation(&mut self, animation: &Animation) -> String;
    /// One of several cases, by its number.
    fn panel(number: usize, name: &Text, content: String) -> String;
    /// What is laid out together, where there is a layout.
    fn group(class: &str, content: String) -> String;
    /// Two things side by side, where there is room for both.
    fn pair(parts: [String; 2]) -> String;

    fn titled(title: &str, content: String) -> String {
        if content.is_empty() { content } else { Self::joined([Self::heading(3, &title.into()), content]) }
    }

    fn paragraphs(texts: &[Text]) -> String {
        Self::joined(texts.iter().map(Self::paragraph))
    }

    fn blocks(blocks: &[Block]) -> String {
        Self::joined(blocks.iter().map(Self::block))
    }

    fn tables(tables: &[PrintedTable]) -> String {
        Self::joined(tables.iter().map(Self::table))
    }

    /// The four moves.
    fn moves(&mut self, report: &Report) -> [String; 4] {
        [
            self.identify(&report.identify),
            self.model(&report.model),
            self.solve(&report.solve),
            self.analyze(&report.analyze),
        ]
    }

    fn identify(&mut self, identify: &Identify) -> String {
        let scene = identify.scene.as_ref().map(|picture| self.picture(picture));
        let sought = Self::titled("Sought", Self::list(&identify.sought));
        let question = [Self::paragraphs(&identify.intro), scene.unwrap_or_default(), sought];
        let numbers = [
            ("The parameters have these values.", &identify.parameters),
            ("The motion starts from this state.", &identify.initial),
        ]
        .map(|(caption, quantities)| rows::quantities(caption, quantities));
        let given =
            [Self::table(&rows::bodies(&identify.bodies)), Self::group("beside", Self::tables(&numbers))];
        Self::pair([Self::joined(question), Self::joined(given)])
    }

    fn model(&mut self, model: &ModelPart) -> String {
        let bodies: Vec<_> = model.bodies.iter().map(|body| self.body(body)).collect();
        let equations =
            Self::joined([Self::equations_of_motion(&model.modes), Self::impacts(&model.impacts)]);
        Self::joined([
            Self::paragraphs(&model.intro),
            Self::titled("Assumptions", Self::list(&model.assumptions)),
            Self::joined(bodies),
            Self::group("columns", equations),
        ])
    }

    fn body(&mut self, body: &BodyModel) -> String {
        let is_broad = body.diagrams.iter().any(|picture| picture.svg.width > COLUMN);
        let content = [
            self.pictures("diagrams", &body.diagrams),
            Self::group("forces", Self::tables(&rows::acting(body))),
            Self::group("laws", Self::blocks(&body.laws)),
        ];
        let class = if is_broad { "acting broad" } else { "acting" };
        Self::joined([Self::heading(3, &body.name), Self::group(class, Self::joined(content))])
    }

    fn equations_of_motion(modes: &[ModeEquations]) -> String {
        let mode = |mode: &ModeEquations| {
            let parts =
                [Self::heading(4, &mode.name), Self::paragraph(&mode.holds), Self::blocks(&mode.equations)];
            Self::group("", Self::joined(parts))
        };
        Self::titled("Equations of motion", Self::group("modes", Self::joined(modes.iter().map(mode))))
    }

    fn impacts(blocks: &[Block]) -> String {
        let one = |block: &Block| Self::group("", Self::blocks(std::slice::from_ref(block)));
        Self::titled("Impacts", Self::group("modes", Self::joined(blocks.iter().map(one))))
    }

    fn solve(&mut self, solve: &Solve) -> String {
        let (how, events) = solve.tables.split_at(solve.tables.len().min(1));
        Self::joined([
            Self::paragraphs(&solve.intro),
            Self::group("phases", Self::joined(solve.phases.iter().map(|phase| Self::phase(phase, 3)))),
            Self::facts(&solve.method),
            Self::tables(how),
            Self::group("beside", Self::tables(events)),
        ])
    }

    /// A closed form, with a heading of the given level.
    fn phase(phase: &Phase, level: usize) -> String {
        let forms =
            [("In symbols:", &phase.symbols), ("With numbers:", &phase.numbers)].map(|(words, blocks)| {
                let blocks = Self::blocks(blocks);
                if blocks.is_empty() { blocks } else { Self::joined([Self::remark(words), blocks]) }
            });
        let parts = [Self::heading(level, &phase.name), Self::paragraph(&phase.span), Self::pair(forms)];
        Self::group("phase", Self::joined(parts))
    }

    fn analyze(&mut self, analyze: &Analyze) -> String {
        let found = Self::joined([Self::paragraphs(&analyze.intro), Self::list(&analyze.findings)]);
        let animation = analyze.animation.as_ref().map(|animation| self.animation(animation));
        let pair = Self::pair([Self::titled("Findings", found), animation.unwrap_or_default()]);
        let seen = Self::joined([pair, self.shown(&analyze.plots, &analyze.pictures)]);
        let parts = [
            Self::group("columns", seen),
            analyze.comparison.as_ref().map(Self::table).unwrap_or_default(),
            self.cases(&analyze.cases),
            Self::checks(&analyze.checks),
        ];
        Self::joined(parts)
    }

    /// Curves and drawings.
    fn shown(&mut self, plots: &[Chart], pictures: &[Picture]) -> String {
        let shown = [self.plots(plots), self.pictures("figures", pictures)];
        Self::group("shown", Self::joined(shown))
    }

    fn plots(&mut self, plots: &[Chart]) -> String {
        let plots: Vec<_> = plots.iter().map(|plot| self.plot(plot)).collect();
        Self::group("plots", Self::joined(plots))
    }

    fn pictures(&mut self, class: &str, pictures: &[Picture]) -> String {
        let pictures: Vec<_> = pictures.iter().map(|picture| self.picture(picture)).collect();
        Self::group(class, Self::joined(pictures))
    }

    fn cases(&mut self, cases: &[RunAnalysis]) -> String {
        if let [only] = cases {
            return self.case(only, 3);
        }
        let panel = |(i, case): (usize, &RunAnalysis)| {
            let content = self.case(case, 5);
            Self::panel(i + 1, &case.name.clone().into(), content)
        };
        let panels: Vec<_> = cases.iter().enumerate().map(panel).collect();
        Self::titled("The cases one by one", Self::group("cases", Self::joined(panels)))
    }

    /// What belongs to a case, with headings of the given level.
    fn case(&mut self, case: &RunAnalysis, level: usize) -> String {
        let parts = [
            Self::paragraphs(&case.intro),
            self.shown(&case.plots, &case.pictures),
            case.balance.as_ref().map(|balance| self.balance(balance, level)).unwrap_or_default(),
            Self::tables(&case.tables),
            Self::checks(&case.checks),
        ];
        Self::joined(parts)
    }

    fn balance(&mut self, balance: &BalancePart, level: usize) -> String {
        let accounts = [Self::group("", Self::tables(&balance.tables)), self.plots(&balance.plots)];
        Self::joined([
            Self::heading(level, &"Energy and momentum balance".into()),
            Self::paragraphs(&balance.intro),
            Self::group("accounts", Self::joined(accounts)),
        ])
    }
}
