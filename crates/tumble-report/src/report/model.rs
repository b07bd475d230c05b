//! Forces, laws, equations of motion.

use super::math::{Block, Math};
use super::picture::Picture;
use super::prose::Text;

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
    /// Newton's laws for it, as blocks.
    pub laws: Vec<Block>,
}

/// A force on a body.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ForceRow {
    /// Its name, for instance "weight".
    pub name: Text,
    /// Its symbol.
    pub symbol: Math,
    /// Its law, then what the names in it stand for.
    pub law: Vec<Math>,
    /// Where it acts.
    pub point: Text,
    /// Its torque about the centre of mass, likewise.
    pub torque: Vec<Math>,
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
