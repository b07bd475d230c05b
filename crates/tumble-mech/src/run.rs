//! A motion that was found, with the equations and values it was found from.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use thiserror::Error;
use tumble_expr::{Expr, Symbol, Vector};
use tumble_ode::{Accuracy, Motion, MotionState, Occurrence, Reason, Refusal, Side, Work};

use crate::body::Body;
use crate::equations::Equations;
use crate::error::ModelErrors;
use crate::islands::{Reached, Refused};
use crate::kinematics::PointRef;
use crate::mode::Mode;
use crate::model::Model;
use crate::observer::Observer;
use crate::parameters::Parameters;
use crate::record::Record;
use crate::refined::Quadrature;
use crate::start::Start;
use crate::tracks::Tracks;

/// A motion with what it was found from.
#[derive(Clone, Debug)]
pub struct Run {
    /// The equations of motion.
    pub equations: Equations,
    tracks: Tracks,
    /// Values of the parameters, in the equations' order.
    pub inputs: Vec<f64>,
    /// Sums that stand for integrals along lines, where there are any that were refined.
    pub quadrature: Option<Quadrature>,
    /// The motion with half as many nodes along each line: what is off between the two is in every stated error.
    pub(crate) coarser: Option<Box<Run>>,
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
        let groups = (0..equations.components().groups().len()).collect();
        let tracks = Tracks::one(groups, Arc::new(trajectory));
        Self { equations, tracks, inputs, quadrature: None, coarser: None }
    }

    /// The motion of all bodies as one. Where nothing couples them this is made of their motions when it is first asked for, and
    /// larger than they are: [`Run::events`], [`Run::end`] and [`Run::observe`] do without it.
    pub fn trajectory(&self) -> &Motion<Equations> {
        self.tracks.whole(&self.equations)
    }

    /// The same, to be kept.
    pub(crate) fn motion(&self) -> Arc<Motion<Equations>> {
        Arc::clone(self.tracks.whole(&self.equations))
    }

    /// The motions of islands, each by itself: bodies that are coupled are one for as long as they are.
    pub fn tracks(&self) -> impl ExactSizeIterator<Item = &Motion<Equations>> {
        self.tracks.each().iter().map(|track| &*track.motion)
    }

    /// The runs of bodies that nothing ever couples.
    pub(crate) fn parts(&self) -> Vec<Self> {
        match self.tracks.each() {
            [_] => vec![self.clone()],
            _ => {
                let components = self.equations.components();
                let own = |groups: &&Vec<usize>| self.tracks.groups.binary_search(&groups[0]).is_ok();
                components.all().iter().filter(own).map(|groups| self.part(groups)).collect()
            }
        }
    }

    /// The groups of bodies that always move as one; all together, where they were one motion from the start.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        match self.tracks.each() {
            [_] => vec![self.tracks.groups.clone()],
            _ => self.tracks.groups.iter().map(|group| vec![*group]).collect(),
        }
    }

    /// The run of some groups only, as one motion: with others, as long as they are one motion with these.
    pub(crate) fn part(&self, groups: &[usize]) -> Self {
        Self {
            equations: self.equations.clone(),
            tracks: self.tracks.of(groups, &self.equations),
            inputs: self.inputs.clone(),
            quadrature: self.quadrature,
            coarser: self.coarser.as_ref().map(|coarser| Box::new(coarser.part(groups))),
        }
    }

    /// The run of a body, and of those that anything may ever couple to it, as one motion.
    #[must_use]
    pub fn of_body(&self, body: usize) -> Self {
        let components = self.equations.components();
        self.part(&components.all()[components.of_group(components.group_of(body))])
    }

    /// The groups whose motion formulas read; all, where they are one motion.
    pub(crate) fn read_by(&self, formulas: &[Expr]) -> Vec<usize> {
        match self.tracks.each() {
            [_] => self.tracks.groups.clone(),
            _ => self.equations.components().read_by(formulas),
        }
    }

    /// The run as far as formulas read it.
    pub(crate) fn along(&self, formulas: &[Expr]) -> Self {
        self.part(&self.read_by(formulas))
    }

    /// The groups that formulas read, with the indices of those that read the same.
    pub(crate) fn grouped(&self, formulas: &[Expr]) -> Vec<(Vec<usize>, Vec<usize>)> {
        let mut found: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for index in 0..formulas.len() {
            found.entry(self.read_by(&formulas[index..=index])).or_default().push(index);
        }
        found.into_iter().collect()
    }

    /// Bodies whose motion it is, in order.
    pub(crate) fn bodies(&self) -> Vec<usize> {
        self.equations.components().bodies_of(&self.tracks.groups)
    }

    pub(crate) fn all_tracks(&self) -> &Tracks {
        &self.tracks
    }

    /// All events at which something happens, in order of time. The modes and states of an event are those of the motion that it belongs to.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = &Occurrence<Record>> + Clone {
        self.tracks.events().map(|event| self.tracks.event(event))
    }

    /// Time of the start, s; `None` if nothing was integrated and nothing happened.
    pub fn start(&self) -> Option<f64> {
        self.tracks().next()?.start()
    }

    /// Time up to which the motion is known, s; `None` if nothing was integrated and nothing happened.
    pub fn end(&self) -> Option<f64> {
        self.tracks.last().map(|track| track.end()).reduce(|a, b| Some(a?.min(b?)))?
    }

    /// Whether something happens at its end.
    pub fn ends_at_event(&self) -> bool {
        self.tracks.last().any(|track| track.last_event().is_some())
    }

    /// The states at its end, by the modes that the bodies are in then.
    pub fn last_states(&self) -> Vec<(Symbol, f64)> {
        let of = |track: &Motion<Equations>| {
            let place = track.end().and_then(|end| track.place_at(end, Side::After));
            place.map(|place| {
                let symbols = self.equations.states(&track.modes[place.mode]);
                symbols.into_iter().zip(place.states).collect::<Vec<_>>()
            })
        };
        self.tracks.last().filter_map(of).flatten().collect()
    }

    /// Whether nothing was integrated.
    pub fn is_empty(&self) -> bool {
        self.tracks.last().any(|track| track.pieces.is_empty())
    }

    /// What it cost.
    pub fn work(&self) -> Work {
        self.tracks().map(|track| track.work).sum()
    }

    /// Order of the Taylor steps.
    pub fn order(&self) -> usize {
        self.tracks().map(|track| track.order).max().unwrap_or_default()
    }

    pub(crate) fn from_start(
        equations: Equations,
        start: tumble_ode::InitialState<Mode>,
        until: f64,
        accuracy: Accuracy,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        Self::watched(equations, start, until, accuracy, |reached| progress(reached.time))
    }

    /// The same for a motion that is looked at on its way.
    pub(crate) fn watched(
        equations: Equations,
        start: tumble_ode::InitialState<Mode>,
        until: f64,
        accuracy: Accuracy,
        mut progress: impl FnMut(Reached<'_>) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        let (tracks, refused) = equations.follow(&start, until, accuracy, &mut progress);
        let inputs = start.inputs.clone();
        let run = Self { equations, tracks, inputs, quadrature: None, coarser: None };
        let run = run.with_contacts_kept(accuracy)?;
        let Some(Refused { mut refusal, motion }) = refused else { return Ok(run) };
        if let Some(reason) = motion.and_then(|motion| run.singular(&motion, &refusal)) {
            refusal.reason = reason;
        }
        if run.is_empty() {
            run.equations.refuse_loads(&start)?;
        }
        Err(RunError::Refused { refusal, partial: Box::new(run) })
    }

    /// That joints, and not a force, are why a motion was refused.
    fn singular(&self, motion: &Motion<Equations>, refusal: &Refusal) -> Option<Reason> {
        if !matches!(
            refusal.reason,
            Reason::Stalled { .. } | Reason::NotFinite { .. } | Reason::WouldTakeTooMuchMemory { .. }
        ) {
            return None;
        }
        // An event at the very end has led to another mode than that of the last piece.
        let MotionState { mode, states, .. } = motion.place_at(motion.end()?, Side::After)?;
        let mode = &motion.modes[mode];
        let joints = self.equations.singular_joints(mode, refusal.time, &states, &self.inputs)?;
        Some(Reason::Model(format!(
            "the bodies come to a singular configuration, in which {joints} can be kept in more than one way: where bars of a loop lie \
             in one line, they may go on either side"
        )))
    }

    /// Another motion of the same equations.
    pub(crate) fn beside(&self, tracks: Tracks) -> Self {
        Self { tracks, coarser: None, ..self.clone() }
    }

    /// The run up to a time, s.
    pub(crate) fn until(&self, time: f64) -> Self {
        Self { tracks: self.tracks.until(time), ..self.clone() }
    }

    /// Prepares formulas of the motion, accelerations included, to be evaluated at any time.
    pub fn observe(&self, formulas: &[Expr]) -> Result<Observer, RunError> {
        Ok(Observer::new(self, formulas)?)
    }

    /// The motion at one time, s; at an event, just after it.
    pub fn at(&self, time: f64) -> Result<Snapshot<'_>, RunError> {
        let is_within = self.start().is_some_and(|start| start <= time) && Some(time) <= self.end();
        match is_within {
            true => Ok(Snapshot { run: self, time }),
            false => Err(RunError::Outside { time, end: self.end().unwrap_or(0.0) }),
        }
    }
}

/// The motion at one time.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    run: &'a Run,
    time: f64,
}

impl Snapshot<'_> {
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
