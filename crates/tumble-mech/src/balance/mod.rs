//! # The energy and momentum balance of a run
//! Energy, momentum and angular momentum of a finished run, with the work, impulse and angular impulse of every load,
//! and what no contribution accounts for.
//!
//! It is made of the terms that were integrated, along the pieces that were accepted: power, force and torque of each
//! term are integrated over each piece to rounding (`quadrature`), and each event adds its impacts, the parameters it
//! changed and the energy that a surface keeps when it lets go (`instants`). A load with a potential energy
//! (`Potential`: weight, springs, torsion springs, compliant surfaces) counts by that energy; all else that it does,
//! such as its damper's part, counts by its work, and nothing by both. So
//!
//! - the total energy changes by the work of all contributions but those of [`ContributionKind::Conservative`],
//! - momentum and angular momentum change by the impulses and angular impulses of all contributions,
//!
//! and what is left of each equation is its residual. Nothing here is asked for while a motion is integrated: the
//! balance is read off the finished run.
//!
//! Units are SI. World axes, x to the right and y up, angles and torques counter-clockwise; angular momentum and
//! angular impulse are about one fixed point of the world. In a horizontal plane weight and support do not count.

mod accumulation;
mod contribution;
mod instants;
mod lines;
mod part;
mod quadrature;
mod stored;
#[cfg(test)]
mod tests;

pub use contribution::{Balance, BodyBalance, Contribution, ContributionKind, Reading, Store};

use std::collections::HashMap;

use tumble_ode::{Reason, Side};

use crate::balance::part::{Part, of_all};
use crate::balance::quadrature::Amounts;
use crate::balance::stored::Stored;
use crate::potential::Potential;
use crate::run::Run;

/// The energy and momentum balance of a run.
pub struct RunBalance {
    /// The point that angular momentum is about, m.
    pub about: [f64; 2],
    /// What every load has done, in the order in which they first did; bodies that nothing couples one after the other.
    pub contributions: Vec<Contribution>,
    /// Potential energies.
    pub stores: Vec<Store>,
    /// Kinetic and potential energy of all bodies, J.
    pub energy: Balance,
    /// Momentum, N s, and angular momentum, N m s, of each body of the run.
    pub bodies: Vec<BodyBalance>,
    /// Momentum and angular momentum of all bodies together.
    pub total: BodyBalance,
    parts: Vec<Part>,
}

impl RunBalance {
    /// The balance of a run, angular momentum about a point of the world, m.
    ///
    /// Refused where nothing was integrated, or where a load's power is not a finite number.
    pub fn of(run: &Run, about: [f64; 2]) -> Result<Self, Reason> {
        let parts = run.parts();
        let potentials = potentials(run, &parts);
        let parts =
            parts.into_iter().zip(potentials).map(|(run, potentials)| Part::of(run, potentials, about));
        let parts = parts.collect::<Result<Vec<_>, Reason>>()?;
        let contributions: Vec<Contribution> =
            parts.iter().flat_map(|part| part.contributions.clone()).collect();
        let mut bodies: Vec<(usize, BodyBalance)> = parts.iter().flat_map(Part::bodies).collect();
        bodies.sort_by_key(|(body, _)| *body);
        let bodies: Vec<BodyBalance> = bodies.into_iter().map(|(_, balance)| balance).collect();
        Ok(Self {
            about,
            stores: parts.iter().flat_map(Part::stores).collect(),
            energy: Balance::sum(parts.iter().map(Part::energy)),
            total: of_all(&contributions, &parts, &bodies),
            bodies,
            contributions,
            parts,
        })
    }

    /// The largest of all relative residuals.
    pub fn relative(&self) -> f64 {
        let bodies = self.bodies.iter().chain([&self.total]).map(BodyBalance::relative);
        bodies.fold(self.energy.relative(), f64::max)
    }

    /// The balance at a time, s; at an event, on that side of it. `None` outside the motion.
    pub fn at(&mut self, time: f64, side: Side) -> Result<Option<Reading>, Reason> {
        let mut all = Held::default();
        let mut totals = vec![];
        for part in &mut self.parts {
            let Some((held, own)) = part.at(time, side)? else { return Ok(None) };
            all.add(&held);
            totals.extend(own);
        }
        Ok(Some(self.reading(time, &all, &totals)))
    }

    /// Names of what [`RunBalance::row`] gives: time (s), kinetic, potential and total energy, work by contribution,
    /// residual (J).
    pub fn columns(&self) -> Vec<String> {
        let works = (0..self.contributions.len())
            .map(|contribution| format!("work of {}", self.name_of(contribution)));
        let first = ["t", "kinetic", "potential", "energy"].map(String::from);
        first.into_iter().chain(works).chain(["residual".to_owned()]).collect()
    }

    /// The course of the energies at a time, in the order of [`RunBalance::columns`]; `None` outside the motion.
    pub fn row(&mut self, time: f64, side: Side) -> Result<Option<Vec<f64>>, Reason> {
        let row = |at: Reading| {
            let first = [at.time, at.kinetic, at.potential, at.energy()];
            first.into_iter().chain(at.work).chain([at.energy_residual]).collect()
        };
        Ok(self.at(time, side)?.map(row))
    }

    /// Name of a contribution that no other has: its load, its body and what it stands for.
    pub fn name_of(&self, contribution: usize) -> String {
        let Contribution { load, body, kind, .. } = &self.contributions[contribution];
        let model = self.parts[0].accumulation.run.equations.model();
        let on = body.map_or_else(String::new, |body| format!(" on {}", model.bodies[body].name));
        let kind = match kind {
            ContributionKind::Work => "",
            ContributionKind::Conservative => " (potential)",
            ContributionKind::Driven => " (driven)",
            ContributionKind::Impact => " (impacts)",
            ContributionKind::ParameterJump => " (parameters)",
            ContributionKind::Release => " (release)",
        };
        format!("{load}{on}{kind}")
    }

    fn reading(&self, time: f64, held: &Held, totals: &[Amounts]) -> Reading {
        let Held { kinetic, potential, momentum, angular: angular_momentum } = *held;
        let counted = self.contributions.iter().zip(totals).filter(|(contribution, _)| contribution.counts());
        let work: f64 = counted.map(|(_, amounts)| amounts[0]).sum();
        let sum = |which: usize| totals.iter().map(|amounts| amounts[which]).sum::<f64>();
        let BodyBalance { momentum: start, angular_momentum: angular_start } = &self.total;
        Reading {
            time,
            kinetic,
            potential,
            momentum,
            angular_momentum,
            work: totals.iter().map(|amounts| amounts[0]).collect(),
            impulse: totals.iter().map(|amounts| [amounts[1], amounts[2]]).collect(),
            angular_impulse: totals.iter().map(|amounts| amounts[3]).collect(),
            energy_residual: (kinetic + potential - self.energy.start) - work,
            momentum_residual: [0, 1].map(|axis| (momentum[axis] - start[axis].start) - sum(1 + axis)),
            angular_momentum_residual: (angular_momentum - angular_start.start) - sum(3),
        }
    }
}

/// What the bodies have at one instant.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    /// J
    kinetic: f64,
    /// J
    potential: f64,
    /// N s
    momentum: [f64; 2],
    /// N m s
    angular: f64,
}

impl Held {
    fn of(stored: &Stored) -> Self {
        Self {
            kinetic: stored.kinetic(),
            potential: stored.potential(),
            momentum: [stored.momentum(0), stored.momentum(1)],
            angular: stored.angular(),
        }
    }

    fn add(&mut self, other: &Self) {
        self.kinetic += other.kinetic;
        self.potential += other.potential;
        self.momentum = [0, 1].map(|axis| self.momentum[axis] + other.momentum[axis]);
        self.angular += other.angular;
    }
}

/// The potentials of a run, by the motions that it is made of.
fn potentials(run: &Run, parts: &[Run]) -> Vec<Vec<Potential>> {
    let of = |part: usize| parts[part].all_tracks().groups.iter().map(move |group| (*group, part));
    let part_of: HashMap<usize, usize> = (0..parts.len()).flat_map(of).collect();
    let mut found = vec![vec![]; parts.len()];
    for potential in run.equations.potentials() {
        let read = run.equations.components().read_by([&potential.energy]);
        if let Some(part) = read.iter().find_map(|group| part_of.get(group)) {
            found[*part].push(potential);
        }
    }
    found
}
