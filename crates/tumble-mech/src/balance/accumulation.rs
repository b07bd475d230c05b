//! Adding up a run: pieces and events in order of time, each under its loads.

use std::collections::HashMap;

use tumble_expr::{Expr, Vector, units};
use tumble_ode::{Piece, Reason};

use crate::balance::contribution::{Contribution, ContributionKind};
use crate::balance::lines::{Key, Lines};
use crate::balance::quadrature::{Amounts, NotFinite, Quadrature, Sum};
use crate::balance::stored::{Stored, StoredEvaluator};
use crate::mode::Mode;
use crate::potential::Potential;
use crate::record::Happening;
use crate::run::Run;

/// The largest sizes in a run of what is balanced.
#[derive(Clone, Debug, Default)]
pub(super) struct Largest {
    /// J
    pub(super) energy: f64,
    /// By body of the run, J.
    pub(super) kinetic: Vec<f64>,
    /// By body, N s.
    pub(super) momentum: Vec<f64>,
    /// By body, N m s.
    pub(super) angular: Vec<f64>,
}

/// The contributions of one run while they are added up, and what evaluates them.
pub(super) struct Accumulation {
    pub(super) run: Run,
    /// Indices of its bodies, in order.
    pub(super) bodies: Vec<usize>,
    pub(super) potentials: Vec<Potential>,
    pub(super) largest: Largest,
    about: Vector,
    quadrature: Quadrature,
    /// By mode of the trajectory, with the index of each line's contribution.
    lines: HashMap<usize, (Lines, Vec<usize>)>,
    stored_evaluators: HashMap<Mode, StoredEvaluator>,
    pub(super) keys: Vec<Key>,
    known: HashMap<Key, usize>,
    sums: Vec<[Sum; 4]>,
    /// Sums of the sizes of what works of impacts are differences of, J.
    sizes: Vec<f64>,
    /// Sums at the start of each piece; contributions that came later are not there yet.
    marks: Vec<Vec<Amounts>>,
}

impl Accumulation {
    /// Of a run that is one motion, and the potentials of its bodies.
    pub(super) fn new(run: Run, potentials: Vec<Potential>, [x, y]: [f64; 2]) -> Self {
        Self {
            bodies: run.bodies(),
            run,
            potentials,
            largest: Largest::default(),
            about: Vector::planar(Expr::from(x) * units::M, Expr::from(y) * units::M),
            quadrature: Quadrature::new(),
            lines: HashMap::new(),
            stored_evaluators: HashMap::new(),
            keys: vec![],
            known: HashMap::new(),
            sums: vec![],
            sizes: vec![],
            marks: vec![],
        }
    }

    /// Adds everything from the start of the run to its end.
    pub(super) fn run_through(&mut self) -> Result<(), Reason> {
        let motion = self.run.motion();
        let mut events = motion.events.iter().peekable();
        let mut before: Option<(&Piece, Vec<Amounts>)> = None;
        for piece in &motion.pieces {
            let is_singular = motion.events.iter().any(|event| {
                event.time == piece.start && event.record.happened.contains(&Happening::Singular)
            });
            while let Some(event) = events.next_if(|event| event.time <= piece.start) {
                self.add_event(event)?;
            }
            self.marks.push(self.totals());
            let states = piece.states_at_parameter(0.0);
            let stored = self.stored(&motion.modes[piece.mode], piece.start, &states)?;
            self.watch(&stored);
            match before.take().filter(|(before, _)| is_singular && before.mode == piece.mode) {
                Some((before, totals)) => self.add_over((before, totals), piece)?,
                None => self.add_piece(piece)?,
            }
            before = Some((piece, self.marks.last().cloned().unwrap_or_default()));
        }
        events.try_for_each(|event| self.add_event(event))
    }

    /// Adds what a piece up to a singular instant and the one from there on come to together, in place of what the first did alone:
    /// next to the instant forces are rounding errors divided by the square of the distance, so that no node is to be there.
    fn add_over(&mut self, (before, totals): (&Piece, Vec<Amounts>), after: &Piece) -> Result<(), Reason> {
        self.prepare(before.mode)?;
        let quadrature = &self.quadrature;
        let Some((lines, contributions)) = self.lines.get_mut(&before.mode) else { return Ok(()) };
        self.sums.iter_mut().zip(&totals).for_each(|(sums, total)| *sums = total.map(Sum::of));
        let sums = &mut self.sums;
        let mut add = |line: usize, amounts: &Amounts| {
            sums[contributions[line]].iter_mut().zip(amounts).for_each(|(sum, amount)| sum.add(*amount));
        };
        let found = quadrature.over([before.length, after.length], &mut lines.along(before), &mut add);
        found.map_err(|bad| refused(&lines.keys, before, &bad))
    }

    fn add_piece(&mut self, piece: &Piece) -> Result<(), Reason> {
        self.prepare(piece.mode)?;
        let (sums, quadrature) = (&mut self.sums, &self.quadrature);
        let Some((lines, contributions)) = self.lines.get_mut(&piece.mode) else { return Ok(()) };
        let mut add = |line: usize, amounts: &Amounts| {
            sums[contributions[line]].iter_mut().zip(amounts).for_each(|(sum, amount)| sum.add(*amount));
        };
        let found = quadrature.integrate([0.0, piece.length], &mut lines.along(piece), &mut add);
        found.map_err(|bad| refused(&lines.keys, piece, &bad))
    }

    /// What contributions have summed up to at a time within a piece, by the piece's index.
    pub(super) fn totals_at(&mut self, index: usize, time: f64) -> Result<Vec<Amounts>, Reason> {
        let motion = self.run.motion();
        let piece = &motion.pieces[index];
        self.prepare(piece.mode)?;
        let mut totals = self.marks[index].clone();
        totals.resize(self.keys.len(), [0.0; 4]);
        let Some((lines, contributions)) = self.lines.get_mut(&piece.mode) else { return Ok(totals) };
        let mut add = |line: usize, amounts: &Amounts| {
            totals[contributions[line]].iter_mut().zip(amounts).for_each(|(total, amount)| *total += amount);
        };
        let to = piece.parameter_at(time);
        let found = self.quadrature.integrate([0.0, to], &mut lines.along(piece), &mut add);
        found.map_err(|bad| refused(&lines.keys, piece, &bad))?;
        Ok(totals)
    }

    /// Sums so far, by contribution.
    pub(super) fn totals(&self) -> Vec<Amounts> {
        self.sums.iter().map(|sums| sums.map(Sum::value)).collect()
    }

    /// Energies and momenta in a mode.
    pub(super) fn stored(&mut self, mode: &Mode, time: f64, states: &[f64]) -> Result<Stored, Reason> {
        if !self.stored_evaluators.contains_key(mode) {
            let Run { equations, inputs, .. } = &self.run;
            let evaluator = StoredEvaluator::new(equations, &self.potentials, mode, inputs, &self.about)?;
            self.stored_evaluators.insert(mode.clone(), evaluator);
        }
        match self.stored_evaluators.get_mut(mode) {
            Some(evaluator) => Ok(evaluator.take(time, states)),
            None => unreachable!("it was put in above"),
        }
    }

    /// Adds amounts to a contribution, which is created if need be.
    pub(super) fn add(&mut self, key: Key, amounts: Amounts) {
        let contribution = self.contribution(key);
        self.sums[contribution].iter_mut().zip(amounts).for_each(|(sum, amount)| sum.add(amount));
    }

    /// Adds the work and the impulses of an impact; its work is a difference of numbers of that size, J.
    pub(super) fn add_impact(&mut self, key: Key, amounts: Amounts, size: f64) {
        let contribution = self.contribution(key.clone());
        self.sizes[contribution] += size;
        self.add(key, amounts);
    }

    /// Where a body is among those of the run.
    pub(super) fn place(&self, body: usize) -> usize {
        self.bodies.partition_point(|known| *known < body)
    }

    /// Raises the largest sizes.
    pub(super) fn watch(&mut self, stored: &Stored) {
        let Largest { energy, kinetic, momentum, angular } = &mut self.largest;
        *energy = energy.max(stored.size());
        for sizes in [&mut *kinetic, &mut *momentum, &mut *angular] {
            sizes.resize(stored.bodies.len(), 0.0);
        }
        for (index, body) in stored.bodies.iter().enumerate() {
            kinetic[index] = kinetic[index].max(body.kinetic);
            momentum[index] = momentum[index].max(libm::hypot(body.momentum[0], body.momentum[1]));
            angular[index] = angular[index].max(body.angular.abs()).max(body.spin.abs());
        }
    }

    /// The contributions as they stand.
    pub(super) fn contributions(&self) -> Vec<Contribution> {
        let contribution =
            |((key, [work, x, y, angular_impulse]), size): ((&Key, Amounts), &f64)| Contribution {
                load: key.load.clone(),
                law: key.law,
                body: key.body,
                kind: key.kind,
                work,
                operands: *size,
                impulse: [x, y],
                angular_impulse,
            };
        self.keys.iter().zip(self.totals()).zip(&self.sizes).map(contribution).collect()
    }

    fn prepare(&mut self, mode: usize) -> Result<(), Reason> {
        if self.lines.contains_key(&mode) {
            return Ok(());
        }
        let Run { equations, inputs, .. } = &self.run;
        let mode_of = &self.run.trajectory().modes[mode];
        let lines = Lines::new(equations, &self.potentials, mode_of, inputs, &self.about)?;
        let contributions = lines.keys.iter().map(|key| self.contribution(key.clone())).collect();
        self.lines.insert(mode, (lines, contributions));
        Ok(())
    }

    fn contribution(&mut self, key: Key) -> usize {
        if let Some(&contribution) = self.known.get(&key) {
            return contribution;
        }
        self.known.insert(key.clone(), self.keys.len());
        self.keys.push(key);
        self.sums.push([Sum::default(); 4]);
        self.sizes.push(0.0);
        self.keys.len() - 1
    }

    /// Adds a change of a store of energy, J.
    pub(super) fn add_energy(&mut self, potential: usize, kind: ContributionKind, change: f64) {
        if change != 0.0 {
            let key = self.potentials[potential].key(None, kind);
            self.add(key, [change, 0.0, 0.0, 0.0]);
        }
    }
}

fn refused(keys: &[Key], piece: &Piece, bad: &NotFinite) -> Reason {
    let (load, time) = (&keys[bad.line].load, piece.time_at(bad.from));
    Reason::Model(format!("the power or force of `{load}` is not a finite number just after {time} s"))
}
