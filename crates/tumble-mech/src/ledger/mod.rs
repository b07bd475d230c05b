//! # The books of a run
//! Energy, momentum and angular momentum of a finished run, with the work, impulse and angular impulse of every load, and
//! what no entry accounts for.
//!
//! They are made of the terms that were integrated, along the pieces that were accepted: power, force and torque of each
//! term are integrated over each piece to rounding (`quadrature`), and each event enters its impacts, the parameters it
//! changed and the energy that a surface keeps when it lets go (`instants`). A load with a potential energy (`potential`:
//! weight, springs, torsion springs, surfaces that give way) counts by that energy; all else that it does, such as its
//! damper's part, counts by its work, and nothing by both. So
//!
//! - the total energy changes by the work of all entries but those of [`Kind::Conservative`],
//! - momentum and angular momentum change by the impulses and angular impulses of all entries,
//!
//! and what is left of each equation is its residual. Nothing here is asked for while a motion is integrated: books are
//! read off the finished run.
//!
//! Units are SI. World axes, x to the right and y up, angles and torques counter-clockwise; angular momentum and angular
//! impulse are about one fixed point of the world. In a horizontal plane weight and support do not enter.

mod books;
mod entry;
mod instants;
mod lines;
mod potential;
mod quadrature;
mod stocks;
#[cfg(test)]
mod tests;

pub use entry::{Balance, BodyBalance, Entry, Kind, Reading, Store};

use tumble_ode::{Reason, Side};

use crate::ledger::books::Books;
use crate::ledger::quadrature::Amounts;
use crate::ledger::stocks::Stocks;
use crate::run::Run;

/// The books of a run.
pub struct Ledger<'a> {
    /// The point that angular momentum is about, m.
    pub about: [f64; 2],
    /// What every load has done, in the order in which they first did.
    pub entries: Vec<Entry>,
    /// Potential energies.
    pub stores: Vec<Store>,
    /// Kinetic and potential energy of all bodies, J.
    pub energy: Balance,
    /// Momentum, N s, and angular momentum, N m s, of each body.
    pub bodies: Vec<BodyBalance>,
    /// Momentum and angular momentum of all bodies together.
    pub total: BodyBalance,
    books: Books<'a>,
}

impl<'a> Ledger<'a> {
    /// The books of a run, angular momentum about a point of the world, m.
    ///
    /// Refused where nothing was integrated, or where a load's power is not a finite number.
    pub fn of(run: &'a Run, about: [f64; 2]) -> Result<Self, Reason> {
        let mut books = Books::new(run, about);
        books.keep()?;
        let ends = [books.first()?, books.last()?];
        let entries = books.entries();
        let stores = stores(&books, &ends);
        let energy = energy(&books, &entries, &ends);
        let bodies: Vec<BodyBalance> =
            (0..ends[0].bodies.len()).map(|body| of_body(&books, &entries, &ends, body)).collect();
        let total = of_all(&entries, &ends, &bodies);
        Ok(Self { about, entries, stores, energy, bodies, total, books })
    }

    /// The largest of all relative residuals.
    pub fn relative(&self) -> f64 {
        let bodies = self.bodies.iter().chain([&self.total]).map(BodyBalance::relative);
        bodies.fold(self.energy.relative(), f64::max)
    }

    /// The books at a time, s; at an event, on that side of it. `None` outside the motion.
    pub fn at(&mut self, time: f64, side: Side) -> Result<Option<Reading>, Reason> {
        let trajectory = &self.books.run.trajectory;
        let (start, end) = (trajectory.start(), trajectory.end());
        if start == Some(time) && side == Side::Before {
            let stocks = self.books.first()?;
            return Ok(Some(self.reading(time, &stocks, &vec![[0.0; 4]; self.entries.len()])));
        }
        if end == Some(time) && side == Side::After {
            let (stocks, totals) = (self.books.last()?, self.books.totals());
            return Ok(Some(self.reading(time, &stocks, &totals)));
        }
        let pieces = &trajectory.pieces;
        let index = match side {
            Side::After => pieces.partition_point(|piece| piece.end <= time),
            Side::Before => pieces.partition_point(|piece| piece.end < time),
        };
        let Some(piece) = pieces.get(index).filter(|piece| piece.start <= time) else { return Ok(None) };
        let mode = &trajectory.modes[piece.mode];
        let stocks = self.books.stocks(mode, time, &piece.states_at(time))?;
        let totals = self.books.totals_at(index, time)?;
        Ok(Some(self.reading(time, &stocks, &totals)))
    }

    /// Names of what [`Ledger::row`] gives: time (s), kinetic, potential and total energy, work by entry, residual (J).
    pub fn columns(&self) -> Vec<String> {
        let works = (0..self.entries.len()).map(|entry| format!("work of {}", self.name_of(entry)));
        let first = ["t", "kinetic", "potential", "energy"].map(String::from);
        first.into_iter().chain(works).chain(["residual".to_owned()]).collect()
    }

    /// The course of the energies at a time, in the order of [`Ledger::columns`]; `None` outside the motion.
    pub fn row(&mut self, time: f64, side: Side) -> Result<Option<Vec<f64>>, Reason> {
        let row = |at: Reading| {
            let first = [at.time, at.kinetic, at.potential, at.energy()];
            first.into_iter().chain(at.work).chain([at.energy_residual]).collect()
        };
        Ok(self.at(time, side)?.map(row))
    }

    /// Name of an entry that no other has: its load, its body and what it stands for.
    pub fn name_of(&self, entry: usize) -> String {
        let Entry { load, body, kind, .. } = &self.entries[entry];
        let model = self.books.run.equations.model();
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

    fn reading(&self, time: f64, stocks: &Stocks, totals: &[Amounts]) -> Reading {
        let (kinetic, potential) = (stocks.kinetic(), stocks.potential());
        let counted = self.entries.iter().zip(totals).filter(|(entry, _)| entry.counts());
        let work: f64 = counted.map(|(_, amounts)| amounts[0]).sum();
        let sum = |which: usize| totals.iter().map(|amounts| amounts[which]).sum::<f64>();
        let momentum = [0, 1].map(|axis| stocks.momentum(axis));
        let angular_momentum = stocks.angular();
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

impl Books<'_> {
    /// What there is before anything happens.
    fn first(&mut self) -> Result<Stocks, Reason> {
        let trajectory = &self.run.trajectory;
        let (event, piece) = (trajectory.events.first(), trajectory.pieces.first());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time <= piece.start));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_before, event.time, event.before.clone()),
            (None, Some(piece)) => (piece.mode, piece.start, piece.states_at_clock(0.0)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stocks(&trajectory.modes[mode], time, &states)
    }

    /// What there is after all that has happened.
    fn last(&mut self) -> Result<Stocks, Reason> {
        let trajectory = &self.run.trajectory;
        let (event, piece) = (trajectory.events.last(), trajectory.pieces.last());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time >= piece.end));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_after, event.time, event.after.clone()),
            (None, Some(piece)) => (piece.mode, piece.end, piece.states_at_clock(piece.length)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stocks(&trajectory.modes[mode], time, &states)
    }
}

fn stores(books: &Books<'_>, [first, last]: &[Stocks; 2]) -> Vec<Store> {
    let ends = first.potentials.iter().zip(&last.potentials);
    let store = |(potential, (start, end)): (&potential::Potential, (&f64, &f64))| Store {
        load: potential.load.clone(),
        law: potential.law,
        body: potential.body,
        start: *start,
        end: *end,
    };
    books.potentials.iter().zip(ends).map(store).collect()
}

fn energy(books: &Books<'_>, entries: &[Entry], [first, last]: &[Stocks; 2]) -> Balance {
    let ends = [first, last].map(|stocks| stocks.kinetic() + stocks.potential());
    let change = entries.iter().filter(|entry| entry.counts()).map(|entry| entry.work).sum();
    let scale = entries.iter().map(|entry| entry.work.abs()).fold(books.largest.energy, f64::max);
    Balance::new(ends, change, scale)
}

fn of_body(books: &Books<'_>, entries: &[Entry], [first, last]: &[Stocks; 2], body: usize) -> BodyBalance {
    let own = || entries.iter().filter(|entry| entry.body == Some(body));
    let largest = &books.largest;
    let sizes = own().map(|entry| libm::hypot(entry.impulse[0], entry.impulse[1]));
    let scale = sizes.fold(largest.momentum[body], f64::max);
    let along = |axis: usize| {
        let ends = [first, last].map(|stocks| stocks.bodies[body].momentum[axis]);
        Balance::new(ends, own().map(|entry| entry.impulse[axis]).sum(), scale)
    };
    let ends = [first, last].map(|stocks| stocks.bodies[body].angular);
    let scale = own().map(|entry| entry.angular_impulse.abs()).fold(largest.angular[body], f64::max);
    let angular_momentum = Balance::new(ends, own().map(|entry| entry.angular_impulse).sum(), scale);
    BodyBalance { momentum: [along(0), along(1)], angular_momentum }
}

fn of_all(entries: &[Entry], [first, last]: &[Stocks; 2], bodies: &[BodyBalance]) -> BodyBalance {
    let scale = |of: fn(&BodyBalance) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
    let along = |axis: usize| {
        let ends = [first, last].map(|stocks| stocks.momentum(axis));
        let change = entries.iter().map(|entry| entry.impulse[axis]).sum();
        Balance::new(ends, change, scale(|body| body.momentum[0].scale))
    };
    let ends = [first, last].map(Stocks::angular);
    let change = entries.iter().map(|entry| entry.angular_impulse).sum();
    let scale = scale(|body| body.angular_momentum.scale);
    BodyBalance { momentum: [along(0), along(1)], angular_momentum: Balance::new(ends, change, scale) }
}
