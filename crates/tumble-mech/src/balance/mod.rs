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
//! - the total energy changes by the work of all contributions but those of [`Kind::Conservative`],
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
mod quadrature;
mod stored;
#[cfg(test)]
mod tests;

pub use contribution::{Balance, BodyBalance, Contribution, Kind, Reading, Store};

use tumble_ode::{Reason, Side};

use crate::balance::accumulation::Accumulation;
use crate::balance::quadrature::Amounts;
use crate::balance::stored::Stored;
use crate::potential::Potential;
use crate::run::Run;

/// The energy and momentum balance of a run.
pub struct RunBalance<'a> {
    /// The point that angular momentum is about, m.
    pub about: [f64; 2],
    /// What every load has done, in the order in which they first did.
    pub contributions: Vec<Contribution>,
    /// Potential energies.
    pub stores: Vec<Store>,
    /// Kinetic and potential energy of all bodies, J.
    pub energy: Balance,
    /// Momentum, N s, and angular momentum, N m s, of each body.
    pub bodies: Vec<BodyBalance>,
    /// Momentum and angular momentum of all bodies together.
    pub total: BodyBalance,
    accumulation: Accumulation<'a>,
}

impl<'a> RunBalance<'a> {
    /// The balance of a run, angular momentum about a point of the world, m.
    ///
    /// Refused where nothing was integrated, or where a load's power is not a finite number.
    pub fn of(run: &'a Run, about: [f64; 2]) -> Result<Self, Reason> {
        let mut accumulation = Accumulation::new(run, about);
        accumulation.run_through()?;
        let ends = [accumulation.first()?, accumulation.last()?];
        let contributions = accumulation.contributions();
        let stores = stores(&accumulation, &ends);
        let energy = energy(&accumulation, &contributions, &ends);
        let bodies: Vec<BodyBalance> = (0..ends[0].bodies.len())
            .map(|body| of_body(&accumulation, &contributions, &ends, body))
            .collect();
        let total = of_all(&contributions, &ends, &bodies);
        Ok(Self { about, contributions, stores, energy, bodies, total, accumulation })
    }

    /// The largest of all relative residuals.
    pub fn relative(&self) -> f64 {
        let bodies = self.bodies.iter().chain([&self.total]).map(BodyBalance::relative);
        bodies.fold(self.energy.relative(), f64::max)
    }

    /// The balance at a time, s; at an event, on that side of it. `None` outside the motion.
    pub fn at(&mut self, time: f64, side: Side) -> Result<Option<Reading>, Reason> {
        let trajectory = &self.accumulation.run.trajectory();
        let (start, end) = (trajectory.start(), trajectory.end());
        if start == Some(time) && side == Side::Before {
            let stored = self.accumulation.first()?;
            return Ok(Some(self.reading(time, &stored, &vec![[0.0; 4]; self.contributions.len()])));
        }
        if end == Some(time) && side == Side::After {
            let (stored, totals) = (self.accumulation.last()?, self.accumulation.totals());
            return Ok(Some(self.reading(time, &stored, &totals)));
        }
        let pieces = &trajectory.pieces;
        let index = match side {
            Side::After => pieces.partition_point(|piece| piece.end <= time),
            Side::Before => pieces.partition_point(|piece| piece.end < time),
        };
        let Some(piece) = pieces.get(index).filter(|piece| piece.start <= time) else { return Ok(None) };
        let mode = &trajectory.modes[piece.mode];
        let stored = self.accumulation.stored(mode, time, &piece.states_at(time))?;
        let totals = self.accumulation.totals_at(index, time)?;
        Ok(Some(self.reading(time, &stored, &totals)))
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
        let model = self.accumulation.run.equations.model();
        let on = body.map_or_else(String::new, |body| format!(" on {}", model.bodies[body].name));
        let kind = match kind {
            Kind::Work => "",
            Kind::Conservative => " (potential)",
            Kind::Driven => " (driven)",
            Kind::Impact => " (impacts)",
            Kind::ParameterJump => " (parameters)",
            Kind::Release => " (release)",
        };
        format!("{load}{on}{kind}")
    }

    fn reading(&self, time: f64, stored: &Stored, totals: &[Amounts]) -> Reading {
        let (kinetic, potential) = (stored.kinetic(), stored.potential());
        let counted = self.contributions.iter().zip(totals).filter(|(contribution, _)| contribution.counts());
        let work: f64 = counted.map(|(_, amounts)| amounts[0]).sum();
        let sum = |which: usize| totals.iter().map(|amounts| amounts[which]).sum::<f64>();
        let momentum = [0, 1].map(|axis| stored.momentum(axis));
        let angular_momentum = stored.angular();
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

impl Accumulation<'_> {
    /// What there is before anything happens.
    fn first(&mut self) -> Result<Stored, Reason> {
        let trajectory = &self.run.trajectory();
        let (event, piece) = (trajectory.events.first(), trajectory.pieces.first());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time <= piece.start));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_before, event.time, event.before.clone()),
            (None, Some(piece)) => (piece.mode, piece.start, piece.states_at_parameter(0.0)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stored(&trajectory.modes[mode], time, &states)
    }

    /// What there is after all that has happened.
    fn last(&mut self) -> Result<Stored, Reason> {
        let trajectory = &self.run.trajectory();
        let (event, piece) = (trajectory.events.last(), trajectory.pieces.last());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time >= piece.end));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_after, event.time, event.after.clone()),
            (None, Some(piece)) => (piece.mode, piece.end, piece.states_at_parameter(piece.length)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stored(&trajectory.modes[mode], time, &states)
    }
}

fn stores(accumulation: &Accumulation<'_>, [first, last]: &[Stored; 2]) -> Vec<Store> {
    let ends = first.potentials.iter().zip(&last.potentials);
    let store = |(potential, (start, end)): (&Potential, (&f64, &f64))| Store {
        load: potential.load.clone(),
        law: potential.law,
        body: potential.body,
        start: *start,
        end: *end,
    };
    accumulation.potentials.iter().zip(ends).map(store).collect()
}

fn energy(
    accumulation: &Accumulation<'_>,
    contributions: &[Contribution],
    [first, last]: &[Stored; 2],
) -> Balance {
    let ends = [first, last].map(|stored| stored.kinetic() + stored.potential());
    let change = contributions.iter().filter(|part| part.counts()).map(|part| part.work).sum();
    let scale = contributions.iter().map(|part| part.work.abs()).fold(accumulation.largest.energy, f64::max);
    Balance::new(ends, change, scale)
}

fn of_body(
    accumulation: &Accumulation<'_>,
    contributions: &[Contribution],
    [first, last]: &[Stored; 2],
    body: usize,
) -> BodyBalance {
    let own = || contributions.iter().filter(|part| part.body == Some(body));
    let largest = &accumulation.largest;
    let sizes = own().map(|contribution| libm::hypot(contribution.impulse[0], contribution.impulse[1]));
    let scale = sizes.fold(largest.momentum[body], f64::max);
    let along = |axis: usize| {
        let ends = [first, last].map(|stored| stored.bodies[body].momentum[axis]);
        Balance::new(ends, own().map(|part| part.impulse[axis]).sum(), scale)
    };
    let ends = [first, last].map(|stored| stored.bodies[body].angular);
    let scale = own().map(|part| part.angular_impulse.abs()).fold(largest.angular[body], f64::max);
    let angular_momentum = Balance::new(ends, own().map(|part| part.angular_impulse).sum(), scale);
    BodyBalance { momentum: [along(0), along(1)], angular_momentum }
}

fn of_all(
    contributions: &[Contribution],
    [first, last]: &[Stored; 2],
    bodies: &[BodyBalance],
) -> BodyBalance {
    let scale = |of: fn(&BodyBalance) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
    let along = |axis: usize| {
        let ends = [first, last].map(|stored| stored.momentum(axis));
        let change = contributions.iter().map(|part| part.impulse[axis]).sum();
        Balance::new(ends, change, scale(|body| body.momentum[0].scale))
    };
    let ends = [first, last].map(Stored::angular);
    let change = contributions.iter().map(|part| part.angular_impulse).sum();
    let scale = scale(|body| body.angular_momentum.scale);
    BodyBalance { momentum: [along(0), along(1)], angular_momentum: Balance::new(ends, change, scale) }
}
