//! What is possible at the start of a run and yet most often a slip: of a unit, or of an exponent.

use thiserror::Error;
use tumble_expr::Expr;
use tumble_ode::InitialState;

use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::mode::Mode;

/// m/s; a third of the speed of light, where mechanics without relativity is off by a twentieth.
const FAST: f64 = 1e8;

/// Of two masses; beyond it the lighter one is less than the rounding error of the heavier one.
const UNLIKE: f64 = 1e15;

/// Something that does not stop a run and that its user should know.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ModelWarning {
    /// A body that starts at a speed that mechanics without relativity does not describe.
    #[error("`{body}` starts at up to {speed:e} m/s, and mechanics here knows no speed of light")]
    Speed {
        /// Name of the body.
        body: String,
        /// Speed of its centre and, added to it, of its rim about the centre, m/s.
        speed: f64,
    },
    /// Two masses of which the lighter is lost in the rounding error of the heavier.
    #[error("the mass of `{heavy}` is {ratio:e} times that of `{light}`, more than a number has digits for")]
    MassRatio {
        /// The heaviest body.
        heavy: String,
        /// The lightest body.
        light: String,
        /// Their ratio.
        ratio: f64,
    },
    /// Two bodies that no joints connect and that share a piece of the plane.
    #[error("`{first}` and `{second}` overlap at the start{}, and no contact lets them meet: they pass through each other", more(*others))]
    Overlap {
        /// The first of them.
        first: String,
        /// The second.
        second: String,
        /// Pairs besides these, as far as they were counted.
        others: usize,
    },
}

fn more(others: usize) -> String {
    match others {
        0 => String::new(),
        1 => ", and so does one more pair of bodies".to_owned(),
        _ => format!(", and so do at least {others} more pairs of bodies"),
    }
}

impl Equations {
    /// What a user should know of the start of a run, which may go on all the same.
    pub fn warnings(&self, start: &InitialState<Mode>) -> Result<Vec<ModelWarning>, ModelErrors> {
        let bodies = &self.model().bodies;
        let speed = |index: usize| {
            let motion = bodies[index].kinematics();
            motion.velocity().norm() + motion.omega().abs() * bodies[index].reach()
        };
        let mass = |index: usize| self.mass_properties(index).mass.clone();
        let indices = 0..bodies.len();
        let formulas: Vec<Expr> = indices.clone().map(speed).chain(indices.map(mass)).collect();
        let values = self.values_at(start, &formulas)?;
        let (speeds, masses) = values.split_at(bodies.len());
        let fast = bodies.iter().zip(speeds).filter(|(_, speed)| **speed > FAST);
        let fast = fast.map(|(body, speed)| ModelWarning::Speed { body: body.name.clone(), speed: *speed });
        Ok(fast.chain(self.unlike(masses)).chain(self.overlap(start)?).collect())
    }

    /// The heaviest and the lightest body, where they are too far apart.
    fn unlike(&self, masses: &[f64]) -> Option<ModelWarning> {
        let by_mass = |a: &usize, b: &usize| masses[*a].total_cmp(&masses[*b]);
        let light = (0..masses.len()).min_by(by_mass)?;
        let heavy = (0..masses.len()).max_by(by_mass)?;
        let ratio = masses[heavy] / masses[light];
        let name = |index: usize| self.model().bodies[index].name.clone();
        let warning = || ModelWarning::MassRatio { heavy: name(heavy), light: name(light), ratio };
        (ratio > UNLIKE).then(warning)
    }

    /// Values of formulas of any kinematic symbols at the start.
    pub(crate) fn values_at(
        &self,
        start: &InitialState<Mode>,
        formulas: &[Expr],
    ) -> Result<Vec<f64>, ModelError> {
        let InitialState { mode, time, states, inputs, .. } = start;
        let problem = |reason: tumble_ode::Reason| reason.to_string();
        self.values(formulas, mode, *time, states, inputs).map_err(|reason| ModelError::Start {
            body: self.model().bodies[0].name.clone(),
            problem: problem(reason),
        })
    }
}
