//! What takes several values, one run each. A range may have more of them than memory should hold: each is made when asked for.

use std::sync::Arc;

use tumble_expr::{Binary, Dimension, Expr, Substitution, Unit};

use crate::unit_text::UnitText;

/// Something that takes several values, one after the other.
#[derive(Clone, Debug)]
pub struct SweepAxis {
    /// What it is.
    pub of: Swept,
    /// Its values. Shared: every run has a study of its own.
    pub values: Arc<SweepValues>,
}

/// What takes several values in a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Swept {
    /// The parameter of that name.
    Parameter(String),
    /// What the motion is held to.
    Accuracy,
}

/// One value of a sweep.
#[derive(Clone, Debug)]
pub struct SweepValue {
    /// The value.
    pub value: Expr,
    /// How it is called in a legend: `T = 0.5 s`, or the user's own words.
    pub label: String,
}

/// The values of a sweep in order, formulas of constants and of parameters that are not swept.
#[derive(Debug)]
pub struct SweepValues {
    pub(crate) written: Written,
    /// What the parameters are written out as that are not swept.
    pub(crate) closing: Substitution,
    /// Of the parameter, which a bare zero takes.
    pub(crate) dimension: Option<Dimension>,
}

/// Values as they are written in a scene.
#[derive(Debug)]
pub(crate) enum Written {
    List(Vec<SweepValue>),
    Range(Range),
}

/// Equal distances or ratios.
#[derive(Debug)]
pub(crate) struct Range {
    /// The ends as formulas and as numbers, SI units.
    pub(crate) ends: [Expr; 2],
    pub(crate) numbers: [f64; 2],
    /// Both ends included, two at least.
    pub(crate) count: usize,
    /// Whether it is ratios that are equal.
    pub(crate) is_log: bool,
    /// What labels call it, and in which unit.
    pub(crate) name: String,
    pub(crate) unit: UnitText,
}

impl SweepValues {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.written.count()
    }

    /// The value at a place, counted from 0.
    pub fn at(&self, index: usize) -> SweepValue {
        let SweepValue { value, label } = self.written.at(index);
        SweepValue { value: self.with_dimension(self.closing.apply(&value)), label }
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = SweepValue> {
        (0..self.count()).map(|index| self.at(index))
    }

    /// The label of the value at a place.
    pub fn label(&self, index: usize) -> String {
        self.written.label(index)
    }

    /// The unit that the scene writes them in, with its size in SI units; `None` where it writes none.
    pub fn unit(&self) -> Option<(String, f64)> {
        let unit = self.written.unit()?;
        (!unit.text().is_empty()).then(|| (unit.text().to_owned(), unit.size()))
    }

    fn with_dimension(&self, value: Expr) -> Expr {
        let one = |dimension| 1 * Unit(dimension);
        match self.dimension.filter(|_| value.is_zero()) {
            Some(dimension) => Expr::binary(Binary::Sub, one(dimension), one(dimension)),
            None => value,
        }
    }
}

impl Written {
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::List(list) => list.len(),
            Self::Range(range) => range.count,
        }
    }

    pub(crate) fn at(&self, index: usize) -> SweepValue {
        match self {
            Self::List(list) => list[index].clone(),
            Self::Range(range) => SweepValue { value: range.value(index), label: range.label(index) },
        }
    }

    /// Of a list, that of its first value.
    fn unit(&self) -> Option<UnitText> {
        match self {
            Self::List(list) => UnitText::of(list.first()?.label.split_once(" = ")?.1),
            Self::Range(range) => Some(range.unit.clone()),
        }
    }

    pub(crate) fn label(&self, index: usize) -> String {
        match self {
            Self::List(list) => list[index].label.clone(),
            Self::Range(range) => range.label(index),
        }
    }
}

impl Range {
    fn value(&self, step: usize) -> Expr {
        let [from, to] = &self.ends;
        let share = || Expr::from(step as i32) / Expr::from(self.count as i32 - 1);
        match step {
            0 => from.clone(),
            _ if step == self.count - 1 => to.clone(),
            _ if self.is_log => from * Expr::binary(Binary::Pow, to / from, share()),
            _ => from + (to - from) * share(),
        }
    }

    pub(crate) fn label(&self, step: usize) -> String {
        let share = step as f64 / (self.count - 1) as f64;
        let [from, to] = self.numbers;
        let number = if self.is_log { from * (to / from).powf(share) } else { from + (to - from) * share };
        format!("{} = {}", self.name, self.unit.write(number))
    }
}
