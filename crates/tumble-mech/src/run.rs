//! A motion that was found, with the equations and values it was found from.

use std::ops::ControlFlow;

use thiserror::Error;
use tumble_expr::{Expr, Vector};
use tumble_ode::{Accuracy, Motion, Reason, Refusal, Side, Solver};

use crate::body::Body;
use crate::equations::Equations;
use crate::error::ModelErrors;
use crate::kinematics::PointRef;
use crate::mode::Mode;
use crate::model::Model;
use crate::observer::Observer;
use crate::parameters::Parameters;
use crate::singular::Passages;
use crate::start::Start;

/// More Gauss nodes along one line than this are not tried.
const MOST_NODES: usize = 128;

/// A motion with what it was found from.
#[derive(Clone, Debug)]
pub struct Run {
    /// The equations of motion.
    pub equations: Equations,
    /// The motion.
    pub trajectory: Motion<Equations>,
    /// Values of the parameters, in the equations' order.
    pub inputs: Vec<f64>,
    /// Sums that stand for integrals along lines, where there are any that were refined.
    pub quadrature: Option<Quadrature>,
    /// The motion with half as many nodes along each line: what is off between the two is in every stated error.
    pub(crate) coarser: Option<Box<Run>>,
}

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

/// Why there is no motion, or not all of it.
#[derive(Clone, Debug, Error)]
pub enum RunError {
    /// The model does not fit together.
    #[error(transparent)]
    Model(#[from] ModelErrors),
    /// The motion was refused; what was found before stands.
    #[error("{refusal}")]
    Refused {
        /// Why, and when.
        refusal: Refusal,
        /// The motion up to there.
        partial: Box<Run>,
    },
    /// A time outside the motion.
    #[error("{time} s is outside the motion, which ends at {end} s")]
    Outside {
        /// The time asked for, s.
        time: f64,
        /// End of the motion, s.
        end: f64,
    },
    /// A formula that has no value along this motion.
    #[error(transparent)]
    Formula(#[from] Reason),
}

impl RunError {
    /// Whether it is not the motion that stands in the way, but that no more of it was wanted.
    pub fn is_interrupted(&self) -> bool {
        matches!(self, Self::Refused { refusal: Refusal { reason: Reason::Interrupted, .. }, .. })
    }
}

impl Model {
    /// Integrates from time 0 with the model's parameters and the default accuracy.
    ///
    /// Bodies that `start` does not name start as the model says. `until` is a time, a formula of the parameters.
    pub fn simulate(&self, start: &[(&Body, Start)], until: Expr) -> Result<Run, RunError> {
        self.simulate_to(start, until, Accuracy::DEFAULT)
    }

    /// Integrates from time 0 to an accuracy.
    pub fn simulate_to(
        &self,
        start: &[(&Body, Start)],
        until: Expr,
        accuracy: Accuracy,
    ) -> Result<Run, RunError> {
        let mut model = self.clone();
        for (body, start) in start {
            model.starts.retain(|(name, _)| *name != body.name);
            model.starts.push((body.name.clone(), start.clone()));
        }
        let until = self.parameters.evaluate(&[until]).map_err(ModelErrors::from)?[0];
        Run::refined(model, &self.parameters, until, accuracy, |_| ControlFlow::Continue(()))
    }
}

impl Run {
    /// Integrates from time 0 to `until`, s. `progress` is told the time reached after each step, and may end it there:
    /// the motion is then refused as [`Reason::Interrupted`].
    pub fn new(
        equations: Equations,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        let start = equations.start(parameters)?;
        Self::from_start(equations, start, until, accuracy, progress)
    }

    /// A motion that was found elsewhere, with the equations and the values of the parameters that it was found from.
    pub fn of(equations: Equations, trajectory: Motion<Equations>, inputs: Vec<f64>) -> Self {
        Self { equations, trajectory, inputs, quadrature: None, coarser: None }
    }

    pub(crate) fn from_start(
        equations: Equations,
        start: tumble_ode::Start<Mode>,
        until: f64,
        accuracy: Accuracy,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        let (inputs, first) = (start.inputs.clone(), start.clone());
        let mut solver = Solver::new(&equations, start, until, accuracy);
        let (mut refusal, mut passages) = (None, Passages::default());
        while refusal.is_none() && !solver.is_done() {
            refusal = solver.advance().err();
            refusal = passages.watch(&equations, &mut solver, &inputs, refusal);
            let time = solver.time();
            if progress(time).is_break() && !solver.is_done() {
                refusal.get_or_insert(Refusal { time, reason: Reason::Interrupted });
            }
        }
        let trajectory = solver.finish();
        let run = Self::of(equations, trajectory, inputs);
        let Some(mut refusal) = refusal else { return Ok(run) };
        if let Some(reason) = run.singular(&refusal) {
            refusal.reason = reason;
        }
        if run.trajectory.pieces.is_empty() {
            run.equations.refuse_loads(&first)?;
        }
        Err(RunError::Refused { refusal, partial: Box::new(run) })
    }

    /// That joints, and not a force, are why a motion was refused.
    fn singular(&self, refusal: &Refusal) -> Option<Reason> {
        if !matches!(
            refusal.reason,
            Reason::Stalled { .. } | Reason::NotFinite { .. } | Reason::WouldTakeTooMuchMemory { .. }
        ) {
            return None;
        }
        let mode = &self.trajectory.modes[self.trajectory.pieces.last()?.mode];
        let states = self.trajectory.last_states()?;
        let joints = self.equations.singular_joints(mode, refusal.time, &states, &self.inputs);
        (!joints.is_empty()).then(|| {
            let names: Vec<String> = joints.iter().map(|name| format!("`{name}`")).collect();
            Reason::Model(format!(
                "the bodies come to a singular configuration, in which {} can be kept in more than one way: where bars of a loop lie \
                 in one line, they may go on either side",
                names.join(", ")
            ))
        })
    }

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
        let (Some(here), Some(there)) = (self.trajectory.last_states(), other.trajectory.last_states())
        else {
            return f64::INFINITY;
        };
        let scales =
            other.equations.state_rates(&Mode::default()).into_iter().map(|state| state.measure as usize);
        let scales = scales.map(|group| other.trajectory.scales[group].max(f64::MIN_POSITIVE));
        let relative = here.iter().zip(&there).zip(scales).map(|((a, b), scale)| (a - b).abs() / scale);
        relative.fold(0.0, f64::max)
    }

    /// Prepares formulas of the motion, accelerations included, to be evaluated at any time.
    pub fn observe(&self, formulas: &[Expr]) -> Result<Observer<'_>, RunError> {
        Ok(Observer::new(&self.equations, &self.trajectory, &self.inputs, formulas)?)
    }

    /// The motion at one time, s; at an event, just after it.
    pub fn at(&self, time: f64) -> Result<Instant<'_>, RunError> {
        match self.trajectory.piece_at(time, Side::After) {
            Some(_) => Ok(Instant { run: self, time }),
            None => Err(RunError::Outside { time, end: self.trajectory.end().unwrap_or(0.0) }),
        }
    }
}

/// The motion at one time.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    run: &'a Run,
    time: f64,
}

impl Instant<'_> {
    /// Values of any formulas of the motion, SI units.
    pub fn values<const N: usize>(&self, formulas: [Expr; N]) -> Result<[f64; N], RunError> {
        let outside = || RunError::Outside { time: self.time, end: self.time };
        let values = self.run.observe(&formulas)?.at(self.time, Side::After).ok_or_else(outside)?;
        Ok(std::array::from_fn(|index| values[index]))
    }

    /// Value of any formula of the motion, SI units.
    pub fn value(&self, formula: Expr) -> Result<f64, RunError> {
        self.values([formula]).map(|[value]| value)
    }

    /// Angle of a body, rad, not wrapped.
    pub fn angle(&self, body: &Body) -> Result<f64, RunError> {
        self.value(body.kinematics().angle())
    }

    /// Angular rate of a body, rad/s.
    pub fn omega(&self, body: &Body) -> Result<f64, RunError> {
        self.value(body.kinematics().omega())
    }

    /// Place of a point, m, world axes.
    pub fn position(&self, point: &PointRef) -> Result<[f64; 2], RunError> {
        self.vector(&point.position())
    }

    /// Velocity of a point, m/s, world axes.
    pub fn velocity(&self, point: &PointRef) -> Result<[f64; 2], RunError> {
        self.vector(&point.velocity())
    }

    fn vector(&self, vector: &Vector) -> Result<[f64; 2], RunError> {
        self.values([vector.x().clone(), vector.y().clone()])
    }
}
