//! Impulses of an instant: of rigid impacts, of joints that begin to hold, and those that an event applies.

use std::collections::BTreeSet;

use tumble_expr::{Expr, Vector};
use tumble_ode::{Crossing, Reason};

use crate::contact::Pair;
use crate::equations::Equations;
use crate::kinematics::rotated;
use crate::load::{Application, Frame};
use crate::mode::Mode;
use crate::record::Jump;
use crate::term::Law;

/// An impulse that an event applies to a body.
#[derive(Clone, Debug)]
pub struct AppliedImpulse {
    /// Its name.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// Name of the event.
    pub when: String,
    /// As of a force, with N s in the place of N, formulas of the motion just before.
    pub application: Application,
}

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
    /// Angular impulse beyond the moment of the impulse, N m s.
    pub couple: f64,
}

/// What exerts an impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A surface, or another body, along the normal, by the index of the pair.
    Pair(usize),
    /// Friction there, by the index of the pair.
    Friction(usize),
    /// A pivot, by its index in the model.
    Pivot(usize),
    /// A joint, by its index in the model.
    Joint(usize),
    /// One that an event applies, by its index in the model.
    Applied(usize),
}

impl Source {
    /// The law that it follows.
    pub fn law(self) -> Law {
        match self {
            Self::Pair(_) => Law::Contact,
            Self::Friction(_) => Law::Friction,
            Self::Pivot(_) | Self::Joint(_) => Law::Reaction,
            Self::Applied(_) => Law::Force,
        }
    }
}

/// Sizes of the impulses of an instant, before they are told by body and place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sizes {
    /// Along the normals by the index of the pair, N s.
    pub(crate) normals: Vec<(usize, f64)>,
    /// Along the surfaces by the index of the pair, N s.
    pub(crate) frictions: Vec<(usize, f64)>,
    /// Of rows of joints by their index, N s or N m s.
    pub(crate) rows: Vec<(usize, f64)>,
    /// What events apply.
    pub(crate) applied: Vec<Impulse>,
}

impl Sizes {
    /// Whether nothing acts.
    pub(crate) fn is_empty(&self) -> bool {
        self.normals.is_empty()
            && self.frictions.is_empty()
            && self.rows.is_empty()
            && self.applied.is_empty()
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.normals.extend(other.normals);
        self.frictions.extend(other.frictions);
        self.applied.extend(other.applied);
        for (row, size) in other.rows {
            match self.rows.iter_mut().find(|(known, _)| *known == row) {
                Some((_, sum)) => *sum += size,
                None => self.rows.push((row, size)),
            }
        }
    }
}

impl Equations {
    /// Name of the pair, the pivot, the joint or the impulse.
    pub fn source_name(&self, source: Source) -> &str {
        match source {
            Source::Pair(pair) => &self.pairs()[pair].name,
            Source::Friction(pair) => &self.pair_list().friction_terms(pair)[0].load,
            Source::Pivot(pivot) => &self.model().pivots[pivot].name,
            Source::Joint(joint) => &self.model().joints[joint].name,
            Source::Applied(impulse) => &self.model().impulses[impulse].name,
        }
    }

    /// Impulses of a jump, of which the sizes are known.
    pub(crate) fn impulses(
        &self,
        sizes: Sizes,
        at: &Crossing<'_, Mode>,
        jump: &Jump<Mode>,
    ) -> Result<Vec<Impulse>, Reason> {
        let mut impulses = vec![];
        let across = sizes.normals.iter().map(|(index, size)| (Source::Pair(*index), *index, *size));
        let along = sizes.frictions.iter().map(|(index, size)| (Source::Friction(*index), *index, *size));
        for (source, index, impulse) in across.chain(along) {
            let pair = &self.pairs()[index];
            let (direction, arm): (_, fn(&Pair, usize) -> Vector) = match source {
                Source::Pair(_) => (pair.normal.clone(), Pair::arm_of),
                _ => (pair.tangent(), Pair::slip_arm_of),
            };
            let arms = pair.bodies().flat_map(|body| arm(pair, body).components().to_vec());
            let formulas: Vec<Expr> = direction.components().iter().cloned().chain(arms).collect();
            let values = self.values(&formulas, at.mode, at.time, at.states, at.inputs)?;
            let (direction, arms) = values.split_at(2);
            for ((body, sign), arm) in pair.sides().zip(arms.chunks_exact(2)) {
                let size = f64::from(sign) * impulse;
                impulses.push(Impulse {
                    source,
                    body,
                    arm: [arm[0], arm[1]],
                    impulse: [size * direction[0], size * direction[1]],
                    couple: 0.0,
                });
            }
        }
        impulses.extend(self.joint_impulses(&sizes.rows, at, jump)?);
        impulses.extend(sizes.applied);
        let bodies: BTreeSet<usize> = impulses.iter().map(|impulse| impulse.body).collect();
        for body in bodies {
            impulses.extend(self.pivot_impulse(body, &impulses, at, jump)?);
        }
        Ok(impulses)
    }

    /// What joints do to their bodies, by the sizes of their rows' impulses.
    fn joint_impulses(
        &self,
        rows: &[(usize, f64)],
        at: &Crossing<'_, Mode>,
        jump: &Jump<Mode>,
    ) -> Result<Vec<Impulse>, Reason> {
        let mut impulses = vec![];
        let mut first = 0;
        for (index, (joint, known)) in self.model().joints.iter().zip(self.joints()).enumerate() {
            let own = first..first + known.rows.len();
            first = own.end;
            let size = |row: usize| {
                let found = rows.iter().find(|(known, _)| *known == own.start + row);
                found.map_or(0.0, |(_, size)| *size)
            };
            if !rows.iter().any(|(row, size)| own.contains(row) && *size != 0.0) {
                continue;
            }
            for (side, &body) in joint.sides().zip(&known.bodies) {
                let arm = side.point.world_arm();
                let arm = self.values(arm.components(), &jump.mode, at.time, &jump.states, at.inputs)?;
                let sign = f64::from(side.sign);
                impulses.push(Impulse {
                    source: Source::Joint(index),
                    body,
                    arm: [arm[0], arm[1]],
                    impulse: [sign * size(0), sign * size(1)],
                    couple: if known.rows.len() > 2 { sign * size(2) } else { 0.0 },
                });
            }
        }
        Ok(impulses)
    }

    /// What an event applies, as the motion was just before.
    pub(crate) fn applied(&self, index: usize, at: &Crossing<'_, Mode>) -> Result<Impulse, Reason> {
        let applied = &self.model().impulses[index];
        let body = self.model().body_index(&applied.body).expect("the model was checked");
        let motion = self.model().bodies[body].kinematics();
        let nothing = || Vector::planar(Expr::zero(), Expr::zero());
        let (arm, impulse, couple) = match &applied.application {
            Application::Torque(couple) => (nothing(), nothing(), couple.clone()),
            Application::Force { at, force, frame } => {
                let turned =
                    if *frame == Frame::Body { rotated(force, &motion.angle()) } else { force.clone() };
                (at.arm(&motion), turned, Expr::zero())
            }
        };
        let formulas = [arm.components(), impulse.components(), &[couple]].concat();
        let values = self.values(&formulas, at.mode, at.time, at.states, at.inputs)?;
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(Reason::Model(format!(
                "the impulse `{}` is {value}: it must be a finite number",
                applied.name
            )));
        }
        Ok(Impulse {
            source: Source::Applied(index),
            body,
            arm: [values[0], values[1]],
            impulse: [values[2], values[3]],
            couple: values[4],
        })
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
        let source = Source::Pivot(pivot);
        Ok(Some(Impulse { source, body, arm: [arm[0], arm[1]], impulse, couple: 0.0 }))
    }
}
