//! # Law
//! A pose of a body system is one of equilibrium where forces and torques of all loads, joints and contacts add up to nothing on each
//! body: `Q(q) + B(q)^T lambda = 0` with the conditions `g(q) = 0` of the joints and of the contacts that push. About it, small
//! motions `q + B-kernel Z y` follow `Z^T M Z y'' = Z^T K Z y` with `K = d(Q + B^T lambda)/dq`: with `y ~ exp(i w t)` the w^2 are
//! eigenvalues. It is stable where all of them are positive, and unstable where one is negative or complex.
//! # Symbols and units
//! q coordinates (m, rad), Q generalized forces (N, N m), g (m, rad), `B = dg/dq`, lambda (N, N m), M (kg, kg m^2), w (rad/s).
//! # Sign and frame
//! World axes, torques and angles counter-clockwise; a contact's force is positive out of the surface.
//! # Validity
//! Forces as they are at time 0 and without velocities; no friction. Frequencies are those without damping and without forces that
//! depend on velocities. Contacts that push hold in both directions. A Hertzian contact that only touches has no stiffness yet by which
//! its depth could be found.
//! # Source
//! Lagrange's equations of the first kind, linearised; the principle of virtual work.
//! # Checked by
//! `tests/equilibrium.rs`: a hanging pendulum, a triangle of rods hung up, a rod on two springs, an inverted pendulum with and
//! without a torsion spring, a box and a ball on floors.

mod formulas;
mod small_motions;
mod statics;

pub use small_motions::{Growth, SmallMotions, Stability};

use nalgebra::{DMatrix, DVector};
use thiserror::Error;
use tumble_expr::Expr;
use tumble_ode::Reason;

use crate::contact::ContactMode;
use crate::equations::Equations;
use crate::error::ModelErrors;
use crate::mode::Mode;
use crate::parameters::Parameters;
use statics::{At, Contacts, Statics};

/// Newton's method doubles its digits near the answer; far from it steps are cut.
const MOST_STEPS: usize = 200;
/// A step is cut in half at most so often: what no thousandth of it makes better it does not make better.
const MOST_CUTS: usize = 10;
/// What is left of forces, in parts of the largest of them: rounding of sums of a few forces is a hundred times less.
const BALANCED: f64 = 1e-12;
/// Contacts are let go of or taken in one at a time, and so many times.
const MOST_CHANGES: usize = 100;

/// A pose in which nothing accelerates.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// Of each body, in the model's order.
    pub poses: Vec<EquilibriumPose>,
    /// What holds the bodies: joints, pivots and contacts that push.
    pub reactions: Vec<Reaction>,
    /// What becomes of small motions about it.
    pub small_motions: SmallMotions,
}

/// Where a body is.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumPose {
    /// Its name.
    pub body: String,
    /// Its centre of mass, m.
    pub at: [f64; 2],
    /// rad
    pub angle: f64,
}

/// What a joint, a pivot or a contact does to the body that it holds; of two bodies, to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// Name of the joint, or of the pair such as `floor.rod.tip`.
    pub name: String,
    /// N, world axes.
    pub force: [f64; 2],
    /// N m; only welds have one.
    pub couple: f64,
}

/// Why there is no equilibrium to tell of.
#[derive(Clone, Debug, Error)]
pub enum NoEquilibrium {
    /// The model does not fit together.
    #[error(transparent)]
    Model(#[from] ModelErrors),
    /// A formula that has no value there.
    #[error(transparent)]
    Formula(#[from] Reason),
    /// No pose was found.
    #[error(
        "no pose near the start is one of equilibrium: the nearest that was found leaves {body} an acceleration of {residual:.3e} {unit}"
    )]
    NotFound {
        /// The body that accelerates most, with its quotes.
        body: String,
        /// How much it accelerates.
        residual: f64,
        /// m/s^2 or rad/s^2
        unit: &'static str,
    },
    /// What touches with friction rests in many poses.
    #[error(
        "`{contact}` touches with friction, and what does rests in many poses beside each other: let the motion go on until \"rest\" instead"
    )]
    Rough {
        /// Name of the pair.
        contact: String,
    },
    /// A load that is the sign of a rate holds in many poses.
    #[error(
        "`{load}` is dry friction, and what it holds rests in many poses beside each other: let the motion go on until \"rest\" instead"
    )]
    Braked {
        /// Name of the load.
        load: String,
    },
    /// A load that reads forces of contacts or joints.
    #[error(
        "`{load}` depends on forces of contacts or joints, with which no equilibrium is looked for: let the motion come to rest instead"
    )]
    Fed {
        /// Name of the load.
        load: String,
    },
    /// Contacts that neither push nor let go.
    #[error("contacts near the start do not settle on which of them push")]
    Contacts,
}

impl Equations {
    /// The pose of equilibrium near the start of a run with these parameters, with the contacts that are closed there.
    pub fn equilibrium(&self, parameters: &Parameters) -> Result<Equilibrium, NoEquilibrium> {
        let start = self.start(parameters)?;
        let mut mode = start.mode.clone();
        for cause in &start.causes {
            if let tumble_ode::Cause::LazyGuard(pair) = cause {
                mode.set_contact_mode(*pair, Some(self.contact_of(*pair)));
            }
        }
        let mut states = start.states.clone();
        for body in 0..self.model().bodies.len() {
            self.velocity_states(&mode, body).into_iter().for_each(|state| states[state] = 0.0);
        }
        for _ in 0..MOST_CHANGES {
            self.refuse_friction(&mode)?;
            let mut statics = Statics::new(self, &mode, &states, &start.inputs)?;
            let found = statics.solve()?;
            match self.change(&mode, &statics.contacts(&found)?) {
                None => return Ok(self.told(&mut statics, &found)?),
                Some((pair, contact_mode)) => mode.set_contact_mode(pair, contact_mode),
            }
            states = found.states;
        }
        Err(NoEquilibrium::Contacts)
    }

    fn refuse_friction(&self, mode: &Mode) -> Result<(), NoEquilibrium> {
        let mut touching = mode.contacts.iter().map(|(pair, _)| &self.pairs()[*pair]);
        if let Some(pair) = touching.find(|pair| pair.friction.is_some()) {
            return Err(NoEquilibrium::Rough { contact: pair.name.clone() });
        }
        if let Some(brake) = self.acting_brakes(mode).first() {
            return Err(NoEquilibrium::Braked { load: self.brake_name(*brake).to_owned() });
        }
        let implicit = self.implicit(mode).into_iter().flat_map(|index| &self.algebraic()[index].loads);
        let implicit = implicit.map(|load| &self.loads()[*load]);
        match self.feeding(mode).map(|(_, term)| term).chain(implicit).next() {
            Some(term) => Err(NoEquilibrium::Fed { load: term.load.clone() }),
            None => Ok(()),
        }
    }

    fn contact_of(&self, pair: usize) -> ContactMode {
        if self.pairs()[pair].is_rigid() { ContactMode::Resting } else { ContactMode::Pressed }
    }

    /// The contact that is least as it has to be: one that pulls is let go of, one that is inside a surface is taken in.
    fn change(
        &self,
        mode: &Mode,
        Contacts { gaps, forces }: &Contacts,
    ) -> Option<(usize, Option<ContactMode>)> {
        let strongest = forces.iter().map(|(_, force)| force.abs()).fold(0.0, f64::max);
        let pulls = forces.iter().filter(|(_, force)| *force < -BALANCED * strongest);
        if let Some((pair, _)) = pulls.min_by(|a, b| a.1.total_cmp(&b.1)) {
            return Some((*pair, None));
        }
        let size = gaps.iter().map(|gap| gap.abs()).filter(|gap| gap.is_finite()).fold(1.0, f64::max);
        let inside = gaps
            .iter()
            .enumerate()
            .filter(|(pair, gap)| mode.contact_mode(*pair).is_none() && **gap < -BALANCED * size);
        let (pair, _) = inside.min_by(|a, b| a.1.total_cmp(b.1))?;
        Some((pair, Some(self.contact_of(pair))))
    }

    fn told(&self, statics: &mut Statics<'_>, found: &At) -> Result<Equilibrium, Reason> {
        let place = |body: usize| {
            let motion = self.model().bodies[body].kinematics();
            [motion.position().components(), &[motion.angle()]].concat()
        };
        let formulas: Vec<Expr> = (0..self.model().bodies.len()).flat_map(place).collect();
        let values = statics.values(found, &formulas)?;
        let poses = self.model().bodies.iter().zip(values.chunks_exact(3));
        let poses = poses.map(|(body, pose)| EquilibriumPose {
            body: body.name.clone(),
            at: [pose[0], pose[1]],
            angle: pose[2],
        });
        Ok(Equilibrium {
            poses: poses.collect(),
            reactions: statics.reactions(found)?,
            small_motions: SmallMotions::of(&statics.linearised(found)),
        })
    }
}

/// The linearised equations about a pose.
pub(crate) struct Linearised {
    /// By coordinate, kg or kg m^2.
    pub(crate) mass: DVector<f64>,
    /// `d(Q + B^T lambda)/dq`.
    pub(crate) stiffness: DMatrix<f64>,
    /// `dg/dq`, by row and coordinate.
    pub(crate) gradient: DMatrix<f64>,
}
