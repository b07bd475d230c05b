//! Sums over Gauss nodes along lines, refined until they stand for the integrals.

use std::ops::ControlFlow;

use tumble_ode::Accuracy;

use crate::equations::Equations;
use crate::mode::Mode;
use crate::model::Model;
use crate::parameters::Parameters;
use crate::run::{Run, RunError};

/// More Gauss nodes along one line than this are not tried.
const MOST_NODES: usize = 128;

/// How well sums over Gauss nodes stand for integrals along lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrature {
    /// Nodes on each line.
    pub nodes: usize,
    /// Largest change of a state at the end when the nodes were last doubled, in units of its scale.
    pub change: f64,
    /// Whether that is within the accuracy asked for. Where not, the change is what the motion can be trusted to.
    pub settled: bool,
}

impl Run {
    /// Integrates as [`Run::new`], with so many Gauss nodes along lines that more do not change the end.
    ///
    /// The nodes are doubled until the states at the end change by less than the accuracy, or there are very many;
    /// [`Run::quadrature`] says which.
    pub fn refined(
        model: Model,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        Self::refined_of(&Equations::new(model)?, parameters, until, accuracy, progress)
    }

    /// The same of equations that may be used for other motions too.
    pub fn refined_of(
        equations: &Equations,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        let with = |equations: Equations| Self::new(equations, parameters, until, accuracy, &progress);
        let mut run = with(equations.clone())?;
        while equations.model().has_quadrature() && run.equations.model().nodes < MOST_NODES {
            let mut finer = with(equations.with_nodes(2 * run.equations.model().nodes)?)?;
            let change = run.change_to(&finer);
            let settled = change <= accuracy.value();
            finer.quadrature = Some(Quadrature { nodes: finer.equations.model().nodes, change, settled });
            let mut before = std::mem::replace(&mut run, finer);
            before.coarser = None;
            run.coarser = Some(Box::new(before));
            if settled {
                break;
            }
        }
        Ok(run)
    }

    /// Largest difference of the states at the end, in units of their scales.
    fn change_to(&self, other: &Self) -> f64 {
        let parts = self.parts().into_iter().zip(other.parts());
        let changes = parts.map(|(here, there)| {
            let (here, there) = (here.trajectory(), there.trajectory());
            let (Some(last), Some(other_last)) = (here.last_states(), there.last_states()) else {
                return f64::INFINITY;
            };
            let idle = there.modes.first().map(|mode| Mode { contacts: vec![], ..mode.clone() });
            let states = idle.map(|mode| other.equations.state_rates(&mode)).unwrap_or_default();
            let scales = states.iter().map(|state| there.scales[state.measure as usize]);
            let relative = last.iter().zip(&other_last).zip(scales);
            relative.map(|((a, b), scale)| (a - b).abs() / scale.max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
        });
        changes.fold(0.0, f64::max)
    }
}
