//! What is given and what is sought.

use super::math::Math;
use super::picture::Picture;
use super::prose::Text;
use tumble_drawing::Label;

/// Digits of numbers that are printed from a value.
const DIGITS: usize = 6;

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
    pub parameters: Vec<Quantity>,
    /// The state at the start.
    pub initial: Vec<Quantity>,
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
    pub properties: Vec<Quantity>,
}

/// A quantity with its value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Quantity {
    /// What it is, in words.
    pub name: Text,
    /// Its symbol; may be empty.
    pub symbol: Text,
    /// Its value as it is to be printed.
    pub value: Text,
    /// Its unit as scenes write it, for instance `kg*m^2`; may be empty.
    pub unit: String,
    /// The formula by which it was computed.
    pub formula: Option<Math>,
    /// Anything else, for instance "given" or where it comes from; may be empty.
    pub note: Text,
}

impl Quantity {
    /// A quantity from words, the name of its symbol (`omega0`), a value printed with six digits, and a unit.
    pub fn number(name: impl Into<Text>, symbol: &str, value: f64, unit: &str) -> Self {
        let (name, symbol) = (name.into(), Text::symbol(symbol));
        Self {
            name,
            symbol,
            value: Label::number(value, DIGITS).into(),
            unit: unit.to_owned(),
            ..Self::default()
        }
    }

    /// With the formula by which it was computed.
    pub fn by(mut self, formula: Math) -> Self {
        self.formula = Some(formula);
        self
    }

    /// With a remark.
    pub fn noted(mut self, note: impl Into<Text>) -> Self {
        self.note = note.into();
        self
    }
}
