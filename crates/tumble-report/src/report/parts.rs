//! The four moves of a report: what each of its parts holds.

use super::math::{Block, Typeset};
use super::picture::{Chart, Picture};
use super::prose::Text;
use super::table::PrintedTable;
use tumble_drawing::{Animation, Label};

/// The first move: the system, its numbers, the question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Identify {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// The scene at the start, see [`SceneDrawing`](tumble_drawing::SceneDrawing).
    pub scene: Option<Picture>,
    /// The bodies.
    pub bodies: Vec<BodyRow>,
    /// Parameters with symbols, values and units.
    pub parameters: Vec<QuantityRow>,
    /// The state at the start.
    pub initial: Vec<QuantityRow>,
    /// What is to be found.
    pub sought: Vec<Text>,
}

/// A body with what its motion depends on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BodyRow {
    /// Its name.
    pub name: Text,
    /// What it is, for instance "uniform rod of 1 m"; may be empty.
    pub shape: Text,
    /// Mass, centre of mass, moment of inertia and the like, in order.
    pub properties: Vec<QuantityRow>,
}

/// A quantity with its value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct QuantityRow {
    /// What it is, in words.
    pub name: Text,
    /// Its symbol; may be empty.
    pub symbol: Text,
    /// Its value as it is to be printed.
    pub value: Text,
    /// Its unit as scenes write it, for instance `kg*m^2`; may be empty.
    pub unit: String,
    /// The formula by which it was computed.
    pub formula: Option<Typeset>,
    /// Anything else, for instance "given" or where it comes from; may be empty.
    pub note: Text,
}

impl QuantityRow {
    /// With the formula by which it was computed.
    pub fn by(mut self, formula: Typeset) -> Self {
        self.formula = Some(formula);
        self
    }

    /// With a remark.
    pub fn noted(mut self, note: impl Into<Text>) -> Self {
        self.note = note.into();
        self
    }
}

/// The second move: from the system to equations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelPart {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// What is taken for granted, one item each.
    pub assumptions: Vec<Text>,
    /// Each body by itself.
    pub bodies: Vec<BodyModel>,
    /// The equations of motion, for every mode of contact; one mode needs no name.
    pub modes: Vec<ModeEquations>,
    /// The laws of the impacts that happened, a block for each kind.
    pub impacts: Vec<Block>,
}

/// A body set free, with its forces and laws.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyModel {
    /// Its name.
    pub name: Text,
    /// Free-body diagrams.
    pub diagrams: Vec<Picture>,
    /// Forces and couples on it.
    pub forces: Vec<ForceRow>,
    /// Impulses that events apply to it; their torques are angular impulses.
    pub impulses: Vec<ForceRow>,
    /// Newton's laws for it, as blocks.
    pub laws: Vec<Block>,
}

/// A force on a body.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ForceRow {
    /// Its name, for instance "weight".
    pub name: Text,
    /// Its symbol.
    pub symbol: Typeset,
    /// Its law, then what the names in it stand for.
    pub law: Vec<Typeset>,
    /// Where it acts.
    pub point: Text,
    /// Its torque about the centre of mass, likewise.
    pub torque: Vec<Typeset>,
}

/// The equations of motion while the contacts do not change.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModeEquations {
    /// Its name, for instance "sliding"; may be empty if there is one mode only.
    pub name: Text,
    /// When it holds, and what ends it; may be empty.
    pub holds: Text,
    /// The equations.
    pub equations: Vec<Block>,
}

/// The third move: the solution.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Solve {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// Phases that have a closed form.
    pub phases: Vec<Phase>,
    /// How it was integrated, as name and value: accuracy asked, order, steps, rejected steps.
    pub method: Vec<(Text, Text)>,
    /// Events and phases, a table each, or for each case; long ones collapse.
    pub tables: Vec<PrintedTable>,
}

/// A stretch of time with a closed form.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Phase {
    /// Its name, for instance "flight".
    pub name: Text,
    /// From when to when, and in which mode; may be empty.
    pub span: Text,
    /// The closed form in symbols.
    pub symbols: Vec<Block>,
    /// The same with numbers.
    pub numbers: Vec<Block>,
}

/// The fourth move: what the solution says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Analyze {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// The motion, for every case.
    pub animation: Option<Animation>,
    /// Curves of all cases together.
    pub plots: Vec<Chart>,
    /// Paths and stroboscopic pictures of all cases together.
    pub pictures: Vec<Picture>,
    /// What differs between the cases of a sweep, and what became of it.
    pub comparison: Option<PrintedTable>,
    /// What belongs to single cases; one case is shown without its name.
    pub cases: Vec<RunAnalysis>,
    /// Checks that concern no single case.
    pub checks: Vec<CheckRow>,
    /// What was found, one item each.
    pub findings: Vec<Text>,
}

/// One case of a sweep, or the only run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunAnalysis {
    /// What sets it apart, for instance `T = 2 s`.
    pub name: Label,
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// Its curves.
    pub plots: Vec<Chart>,
    /// Its paths and stroboscopic pictures.
    pub pictures: Vec<Picture>,
    /// Energy, momentum and their residuals.
    pub balance: Option<BalancePart>,
    /// Other tables.
    pub tables: Vec<PrintedTable>,
    /// Its checks.
    pub checks: Vec<CheckRow>,
}

/// What flowed in and out, and what is left unexplained.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BalancePart {
    /// Paragraphs.
    pub intro: Vec<Text>,
    /// The balances, with their residuals.
    pub tables: Vec<PrintedTable>,
    /// Energies over time, residuals over time.
    pub plots: Vec<Chart>,
}

/// A number that was compared with another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CheckRow {
    /// What was checked.
    pub what: Text,
    /// The value it should have, with its origin.
    pub expected: Text,
    /// The value it has.
    pub found: Text,
    /// How far they may differ.
    pub within: Text,
    /// Whether they agree.
    pub passed: bool,
    /// Whether the error stated is small enough to say so.
    pub is_sure: bool,
    /// Whether the values are not the scene's own: the value it should have may be stated for those.
    pub is_of_other_values: bool,
}
