//! What a balance is made of: contributions by load, stores of energy, balances.

use crate::term::Law;

/// Rounding errors of a work, relative: a few ulps.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// The same of impacts, of what their works are differences of: each is a product of an impulse and a mean speed, both rounded a
/// few times, and their errors are added up as if all had one sign.
const ROUNDING_OF_IMPACTS: f64 = 2.0 * f64::EPSILON;

/// What kind of change a contribution stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContributionKind {
    /// A force that a potential energy stands for: its work is told, but the potential counts in its place.
    Conservative,
    /// Any other force or torque while it acts: applied, of the air, of a damper, of a pivot or a rigid surface.
    Work,
    /// What changes a potential energy while the bodies are held in thought: an anchor or a compliant surface that is
    /// moved on a given path, or a coefficient that is a formula of the time.
    Driven,
    /// Impacts of no duration.
    Impact,
    /// Parameters that an event has given other values.
    ParameterJump,
    /// Energy that a surface still holds when it lets go of a body before it has recovered, negative.
    Release,
}

/// What one load has done to one body, or to a store of energy, in the whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// Name of the load, joint or pair; of the event for bodies whose parameters it changed.
    pub load: String,
    /// The law it follows; `None` for an event.
    pub law: Option<Law>,
    /// Index of the body; `None` where a store of energy is changed and no body pushed.
    pub body: Option<usize>,
    /// What it stands for.
    pub kind: ContributionKind,
    /// Work on the body, J, positive where it gains energy; for a store, what it gains.
    pub work: f64,
    /// Of impacts, the size of what their work in the whole run is a difference of, J; zero for others.
    pub operands: f64,
    /// Impulse on the body, N s, world axes.
    pub impulse: [f64; 2],
    /// Angular impulse on the body about the balance's point, N m s, counter-clockwise positive.
    pub angular_impulse: f64,
}

impl Contribution {
    /// What tells it from all others of a balance.
    pub(crate) fn key(&self) -> (String, Option<usize>, ContributionKind) {
        (self.load.clone(), self.body, self.kind)
    }

    /// What rounding may have made of its work, J, where that is `work`.
    pub fn rounding(&self, work: f64) -> f64 {
        (ROUNDING * work.abs()).max(ROUNDING_OF_IMPACTS * self.operands)
    }

    /// Whether its work changes the total energy: that of a potential only moves it.
    pub fn counts(&self) -> bool {
        self.kind != ContributionKind::Conservative
    }
}

/// A potential energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Store {
    /// Name of the load.
    pub load: String,
    /// The law it follows.
    pub law: Law,
    /// Index of the body; `None` for a spring, which may belong to two.
    pub body: Option<usize>,
    /// J, at the start of the run.
    pub start: f64,
    /// J, at its end.
    pub end: f64,
}

/// A quantity at the start and at the end, and what the contributions say it has changed by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// At the start of the run.
    pub start: f64,
    /// At its end.
    pub end: f64,
    /// Sum of the contributions that change it.
    pub change: f64,
    /// `end - start - change`: zero, but for errors of the integration and rounding.
    pub residual: f64,
    /// Largest size in the run of the quantity's parts, or of a contribution: what a residual is relative to.
    pub scale: f64,
}

impl Balance {
    pub(super) fn new([start, end]: [f64; 2], change: f64, scale: f64) -> Self {
        let residual = (end - start) - change;
        Self { start, end, change, residual, scale }
    }

    /// Of all of several together; the scale is the largest of theirs.
    pub(super) fn sum(all: impl Iterator<Item = Self>) -> Self {
        let add = |sum: Self, next: Self| {
            let ends = [sum.start + next.start, sum.end + next.end];
            Self::new(ends, sum.change + next.change, sum.scale.max(next.scale))
        };
        all.reduce(add).unwrap_or_default()
    }

    /// Size of the residual in units of the scale; zero where there is no residual.
    pub fn relative(&self) -> f64 {
        if self.residual == 0.0 { 0.0 } else { self.residual.abs() / self.scale }
    }
}

/// Balances of one body, or of all together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyBalance {
    /// N s, world axes.
    pub momentum: [Balance; 2],
    /// About the balance's point, N m s, counter-clockwise positive.
    pub angular_momentum: Balance,
}

impl BodyBalance {
    /// The largest relative residual.
    pub fn relative(&self) -> f64 {
        let momentum = self.momentum.iter().map(Balance::relative);
        momentum.fold(self.angular_momentum.relative(), f64::max)
    }
}

/// All quantities at one time, and what the contributions have summed up to by then, in the balance's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// s
    pub time: f64,
    /// Energy of the motion of all bodies, J.
    pub kinetic: f64,
    /// Sum of all potential energies, J.
    pub potential: f64,
    /// Of all bodies, N s.
    pub momentum: [f64; 2],
    /// Of all bodies about the balance's point, N m s.
    pub angular_momentum: f64,
    /// Work by contribution since the start, J.
    pub work: Vec<f64>,
    /// Impulse by contribution since the start, N s.
    pub impulse: Vec<[f64; 2]>,
    /// Angular impulse by contribution since the start, N m s.
    pub angular_impulse: Vec<f64>,
    /// Energy that no contribution accounts for, J.
    pub energy_residual: f64,
    /// Momentum that no contribution accounts for, N s.
    pub momentum_residual: [f64; 2],
    /// Angular momentum that no contribution accounts for, N m s.
    pub angular_momentum_residual: f64,
}

impl Reading {
    /// Total energy, J.
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential
    }
}
