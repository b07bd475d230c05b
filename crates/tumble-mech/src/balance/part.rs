//! The balance of one motion of a run: what its bodies have, and what changes it.

use tumble_ode::{Reason, Side};

use crate::balance::Held;
use crate::balance::accumulation::Accumulation;
use crate::balance::contribution::{Balance, BodyBalance, Contribution, Store};
use crate::balance::quadrature::Amounts;
use crate::balance::stored::Stored;
use crate::potential::Potential;
use crate::run::Run;

/// One motion, added up.
pub(super) struct Part {
    pub(super) accumulation: Accumulation,
    pub(super) contributions: Vec<Contribution>,
    /// What there is before anything happens, and after all that has happened.
    ends: [Stored; 2],
}

impl Part {
    pub(super) fn of(run: Run, potentials: Vec<Potential>, about: [f64; 2]) -> Result<Self, Reason> {
        let mut accumulation = Accumulation::new(run, potentials, about);
        accumulation.run_through()?;
        let ends = [accumulation.first()?, accumulation.last()?];
        let contributions = accumulation.contributions();
        Ok(Self { accumulation, contributions, ends })
    }

    /// What the bodies have at a time, and what contributions have summed up to; `None` outside the motion.
    pub(super) fn at(&mut self, time: f64, side: Side) -> Result<Option<(Held, Vec<Amounts>)>, Reason> {
        let motion = self.accumulation.run.motion();
        if motion.start() == Some(time) && side == Side::Before {
            return Ok(Some((Held::of(&self.ends[0]), vec![[0.0; 4]; self.contributions.len()])));
        }
        if motion.end() == Some(time) && side == Side::After {
            return Ok(Some((Held::of(&self.ends[1]), self.accumulation.totals())));
        }
        let index = match side {
            Side::After => motion.pieces.partition_point(|piece| piece.end <= time),
            Side::Before => motion.pieces.partition_point(|piece| piece.end < time),
        };
        let Some(piece) = motion.pieces.get(index).filter(|piece| piece.start <= time) else {
            return Ok(None);
        };
        let stored = self.accumulation.stored(&motion.modes[piece.mode], time, &piece.states_at(time))?;
        Ok(Some((Held::of(&stored), self.accumulation.totals_at(index, time)?)))
    }

    pub(super) fn stores(&self) -> Vec<Store> {
        let [first, last] = &self.ends;
        let ends = first.potentials.iter().zip(&last.potentials);
        let store = |(potential, (start, end)): (&Potential, (&f64, &f64))| Store {
            load: potential.load.clone(),
            law: potential.law,
            body: potential.body,
            start: *start,
            end: *end,
        };
        self.accumulation.potentials.iter().zip(ends).map(store).collect()
    }

    pub(super) fn energy(&self) -> Balance {
        let ends = self.ends.each_ref().map(|stored| stored.kinetic() + stored.potential());
        let change = self.contributions.iter().filter(|part| part.counts()).map(|part| part.work).sum();
        let sizes = self.contributions.iter().map(|part| part.work.abs());
        Balance::new(ends, change, sizes.fold(self.accumulation.largest.energy, f64::max))
    }

    /// Of each body, by its index.
    pub(super) fn bodies(&self) -> Vec<(usize, BodyBalance)> {
        let bodies = self.accumulation.bodies.iter().enumerate();
        bodies.map(|(place, body)| (*body, self.of_body(place, *body))).collect()
    }

    fn of_body(&self, place: usize, body: usize) -> BodyBalance {
        let own = || self.contributions.iter().filter(|part| part.body == Some(body));
        let largest = &self.accumulation.largest;
        let sizes = own().map(|contribution| libm::hypot(contribution.impulse[0], contribution.impulse[1]));
        let scale = sizes.fold(largest.momentum[place], f64::max);
        let along = |axis: usize| {
            let ends = self.ends.each_ref().map(|stored| stored.bodies[place].momentum[axis]);
            Balance::new(ends, own().map(|part| part.impulse[axis]).sum(), scale)
        };
        let ends = self.ends.each_ref().map(|stored| stored.bodies[place].angular);
        let scale = own().map(|part| part.angular_impulse.abs()).fold(largest.angular[place], f64::max);
        let angular_momentum = Balance::new(ends, own().map(|part| part.angular_impulse).sum(), scale);
        BodyBalance { momentum: [along(0), along(1)], angular_momentum }
    }
}

/// Of all bodies together.
pub(super) fn of_all(contributions: &[Contribution], parts: &[Part], bodies: &[BodyBalance]) -> BodyBalance {
    let scale = |of: fn(&BodyBalance) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
    let ends = |of: &dyn Fn(&Stored) -> f64| {
        [0, 1].map(|end: usize| parts.iter().map(|part| of(&part.ends[end])).sum::<f64>())
    };
    let along = |axis: usize| {
        let change = contributions.iter().map(|part| part.impulse[axis]).sum();
        Balance::new(ends(&|stored| stored.momentum(axis)), change, scale(|body| body.momentum[0].scale))
    };
    let change = contributions.iter().map(|part| part.angular_impulse).sum();
    let scale = scale(|body| body.angular_momentum.scale);
    let angular_momentum = Balance::new(ends(&Stored::angular), change, scale);
    BodyBalance { momentum: [along(0), along(1)], angular_momentum }
}

impl Accumulation {
    fn first(&mut self) -> Result<Stored, Reason> {
        let motion = self.run.motion();
        let (event, piece) = (motion.events.first(), motion.pieces.first());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time <= piece.start));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_before, event.time, event.before.clone()),
            (None, Some(piece)) => (piece.mode, piece.start, piece.states_at_parameter(0.0)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stored(&motion.modes[mode], time, &states)
    }

    fn last(&mut self) -> Result<Stored, Reason> {
        let motion = self.run.motion();
        let (event, piece) = (motion.events.last(), motion.pieces.last());
        let event = event.filter(|event| piece.is_none_or(|piece| event.time >= piece.end));
        let (mode, time, states) = match (event, piece) {
            (Some(event), _) => (event.mode_after, event.time, event.after.clone()),
            (None, Some(piece)) => (piece.mode, piece.end, piece.states_at_parameter(piece.length)),
            (None, None) => return Err(Reason::Model("nothing was integrated".into())),
        };
        self.stored(&motion.modes[mode], time, &states)
    }
}
