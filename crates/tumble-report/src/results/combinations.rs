//! Every combination of what a study sweeps.

use tumble_expr::{Expr, Unit};
use tumble_mech::Parameters;
use tumble_ode::Accuracy;
use tumble_scene::{Study, SweepAxis, SweepValue, Swept};

use crate::results::CaseError;
use crate::results::swept::SweptAxis;

/// What one run is made with, and its label.
pub(crate) struct Values {
    pub(crate) label: String,
    pub(crate) parameters: Parameters,
    pub(crate) accuracy: Accuracy,
}

impl Values {
    /// Those that the study has itself.
    fn of(study: &Study) -> Self {
        Self { label: String::new(), parameters: study.model.parameters.clone(), accuracy: study.accuracy }
    }

    /// Puts in a value of a sweep.
    fn set(&mut self, study: &Study, axis: &SweepAxis, value: SweepValue) -> Result<(), CaseError> {
        match &axis.of {
            Swept::Parameter(name) => {
                let set = self.parameters.set(name, value.value);
                set.map_err(tumble_mech::ModelErrors::from)?;
            }
            Swept::Accuracy => self.accuracy = Accuracy::new(study.number(&value.value)?)?,
        }
        Ok(())
    }
}

/// Every combination of what is swept, each made when it is asked for; the last axis changes fastest.
#[derive(Clone, Copy, Debug)]
pub struct Combinations<'a>(&'a Study);

impl<'a> Combinations<'a> {
    /// Refuses what no run can be made with, before any is begun.
    pub fn of(study: &'a Study) -> Result<Self, CaseError> {
        for axis in &study.sweep {
            let mut values = Values::of(study);
            axis.values.iter().try_for_each(|value| values.set(study, axis, value))?;
        }
        Ok(Self(study))
    }

    /// The study that they are of.
    pub(crate) fn study(&self) -> &'a Study {
        self.0
    }

    /// How many there are; one where nothing is swept.
    pub fn count(&self) -> usize {
        self.0.sweep.iter().map(|axis| axis.values.count()).product()
    }

    /// A value of each axis, by its place there.
    fn choice(&self, index: usize) -> impl Iterator<Item = (&'a SweepAxis, usize)> {
        let mut inner = self.count();
        self.0.sweep.iter().map(move |axis| {
            let outer = inner;
            inner /= axis.values.count();
            (axis, index % outer / inner)
        })
    }

    /// What is different about one of them, as legends say it: `T = 0.5 s`; empty where there is only one.
    pub fn label(&self, index: usize) -> String {
        let labels: Vec<String> = self.choice(index).map(|(axis, place)| axis.values.label(place)).collect();
        labels.join(", ")
    }

    /// What a run between those of the sweep is made with: one parameter, in the unit of its axis.
    pub(crate) fn between(&self, axis: &SweptAxis, at: f64) -> Result<Values, CaseError> {
        let mut values = Values::of(self.0);
        let value = Expr::from(at * axis.size) * Unit(axis.dimension);
        values.parameters.set(&axis.name, value).map_err(tumble_mech::ModelErrors::from)?;
        values.label = format!("{} = {at} {}", axis.name, axis.unit).trim_end().to_owned();
        Ok(values)
    }

    pub(crate) fn values(&self, index: usize) -> Result<Values, CaseError> {
        let mut values = Values { label: self.label(index), ..Values::of(self.0) };
        self.choice(index).try_for_each(|(axis, place)| values.set(self.0, axis, axis.values.at(place)))?;
        Ok(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_axis_changes_fastest() {
        let scene = r#"
            version = 1
            run.until = "1 s"
            world.gravity = "9.81 m/s^2"
            [parameters]
            a = 1
            b = 1
            [body.stone]
            point = {}
            mass = "a*b*1 kg"
            [sweep]
            a = [1, 2]
            b = [3, 4, 5]
        "#;
        let study = tumble_scene::read("scene", scene, &[]).expect("a scene without mistakes");
        let all = Combinations::of(&study).expect("values that can be set");
        let labels: Vec<String> = (0..all.count()).map(|index| all.label(index)).collect();
        let expected =
            ["a = 1, b = 3", "a = 1, b = 4", "a = 1, b = 5", "a = 2, b = 3", "a = 2, b = 4", "a = 2, b = 5"];
        assert_eq!(labels, expected);
        assert_eq!(all.values(4).expect("a run").parameters.values().expect("numbers"), [2.0, 4.0]);
    }
}
