//! What a sweep takes as numbers: the axes that its runs stand along.

use tumble_expr::Dimension;
use tumble_scene::{Study, SweepAxis, Swept};

use crate::results::CaseError;
use crate::results::samples::unit;

/// What is swept, with its values in the order of the runs.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptAxis {
    /// The parameter, or the accuracy.
    pub name: String,
    /// The unit of its values, as the scene writes it; empty where there is none.
    pub unit: String,
    /// One of that unit in SI units.
    pub size: f64,
    /// Of the parameter.
    pub dimension: Dimension,
    /// The values, in that unit.
    pub values: Vec<f64>,
}

impl SweptAxis {
    fn of(study: &Study, axis: &SweepAxis) -> Result<Self, CaseError> {
        let (name, dimension) = match &axis.of {
            Swept::Accuracy => ("accuracy", Dimension::NONE),
            Swept::Parameter(name) => {
                let symbol = study.model.parameters.symbol(name);
                (name.as_str(), symbol.map_or(Dimension::NONE, |symbol| symbol.dimension))
            }
        };
        let is_pure = dimension == Dimension::NONE && !study.angles.contains(name);
        let own = if is_pure { String::new() } else { unit(dimension, study.angles.contains(name)) };
        let si = || (own, 1.0);
        let (unit, size) = axis.values.unit().unwrap_or_else(si);
        let value = |value: tumble_scene::SweepValue| Ok(study.number(&value.value)? / size);
        let values = axis.values.iter().map(value).collect::<Result<_, CaseError>>()?;
        Ok(Self { name: name.to_owned(), unit, size, dimension, values })
    }

    /// What is swept by a study, the last axis changing fastest.
    pub fn all(study: &Study) -> Result<Vec<Self>, CaseError> {
        study.sweep.iter().map(|axis| Self::of(study, axis)).collect()
    }

    /// Whether the values only grow or only fall, so that runs have neighbours.
    pub fn is_ordered(&self) -> bool {
        let grows = |pair: &[f64]| pair[0] < pair[1];
        let falls = |pair: &[f64]| pair[0] > pair[1];
        self.values.windows(2).all(grows) || self.values.windows(2).all(falls)
    }
}
