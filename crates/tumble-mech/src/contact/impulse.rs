//! Impulses of rigid impacts.

use std::collections::BTreeSet;

use tumble_ode::{Crossing, Reason};

use crate::contact::pairs::Pairs;
use crate::contact::touch::Impulses;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Jump;

/// An impulse on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulse {
    /// What exerts it.
    pub source: Source,
    /// Index of the body.
    pub body: usize,
    /// From its centre of mass to the point of action, m, world axes.
    pub arm: [f64; 2],
    /// N s, world axes.
    pub impulse: [f64; 2],
}

/// What exerts an impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A surface, by the index of the pair.
    Pair(usize),
    /// A pivot, by its index in the model.
    Pivot(usize),
}

impl Equations {
    /// Name of the pair or of the pivot.
    pub fn source_name(&self, source: Source) -> &str {
        match source {
            Source::Pair(pair) => &self.pairs()[pair].name,
            Source::Pivot(pivot) => &self.model().pivots[pivot].name,
        }
    }

    /// Impulses of the impacts of a jump, of which those along the normals are known.
    pub(crate) fn impulses(
        &self,
        along_normals: &Impulses,
        at: &Crossing<'_, Mode>,
        jump: &Jump<Mode>,
    ) -> Result<Vec<Impulse>, Reason> {
        let mut impulses = Vec::with_capacity(along_normals.len());
        for &(index, impulse) in along_normals {
            let Pairs { all, terms } = self.pair_list();
            let pair = &all[index];
            let formulas = [terms[index].arm.components(), pair.normal.components()].concat();
            let values = self.values(&formulas, at.mode, at.time, at.states, at.inputs)?;
            impulses.push(Impulse {
                source: Source::Pair(index),
                body: pair.body,
                arm: [values[0], values[1]],
                impulse: [impulse * values[2], impulse * values[3]],
            });
        }
        let bodies: BTreeSet<usize> = impulses.iter().map(|impulse| impulse.body).collect();
        for body in bodies {
            impulses.extend(self.pivot_impulse(body, &impulses, at, jump)?);
        }
        Ok(impulses)
    }

    /// What the pivot adds, so that all impulses together are the change of momentum.
    fn pivot_impulse(
        &self,
        body: usize,
        others: &[Impulse],
        at: &Crossing<'_, Mode>,
        jump: &Jump<Mode>,
    ) -> Result<Option<Impulse>, Reason> {
        let Some((pivot, arm)) = self.pivot_arm(body) else { return Ok(None) };
        let kinematics = self.model().bodies[body].kinematics();
        let mass = &self.mass_properties(body).mass;
        let momentum = kinematics.velocity().map(|v| mass * v);
        let before = self.values(momentum.components(), at.mode, at.time, at.states, at.inputs)?;
        let after = self.values(momentum.components(), &jump.mode, at.time, &jump.states, at.inputs)?;
        let arm = self.values(arm.components(), at.mode, at.time, at.states, at.inputs)?;
        let mut impulse = [after[0] - before[0], after[1] - before[1]];
        for other in others.iter().filter(|other| other.body == body) {
            impulse = [impulse[0] - other.impulse[0], impulse[1] - other.impulse[1]];
        }
        Ok(Some(Impulse { source: Source::Pivot(pivot), body, arm: [arm[0], arm[1]], impulse }))
    }
}
