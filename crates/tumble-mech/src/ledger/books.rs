//! Keeping the books: pieces and events in order of time, each entered under its loads.

use std::collections::HashMap;

use tumble_expr::{Expr, Vector, units};
use tumble_ode::{Piece, Reason};

use crate::ledger::entry::{Entry, Kind};
use crate::ledger::lines::{Key, Lines};
use crate::ledger::potential::{Potential, potentials};
use crate::ledger::quadrature::{Amounts, NotFinite, Quadrature, Sum};
use crate::ledger::stocks::{Stocks, Stocktaking};
use crate::mode::Mode;
use crate::run::Run;

/// The largest sizes in a run of what is balanced.
#[derive(Clone, Debug, Default)]
pub(super) struct Largest {
    /// J
    pub(super) energy: f64,
    /// By body, J.
    pub(super) kinetic: Vec<f64>,
    /// By body, N s.
    pub(super) momentum: Vec<f64>,
    /// By body, N m s.
    pub(super) angular: Vec<f64>,
}

/// The books of one run while they are kept, and what evaluates them.
pub(super) struct Books<'a> {
    pub(super) run: &'a Run,
    pub(super) potentials: Vec<Potential>,
    pub(super) largest: Largest,
    about: Vector,
    quadrature: Quadrature,
    /// By mode of the trajectory, with the index of each line's entry.
    lines: HashMap<usize, (Lines, Vec<usize>)>,
    stocktakings: HashMap<Mode, Stocktaking>,
    pub(super) keys: Vec<Key>,
    known: HashMap<Key, usize>,
    sums: Vec<[Sum; 4]>,
    /// Sums at the start of each piece; entries that came later are not there yet.
    marks: Vec<Vec<Amounts>>,
}

impl<'a> Books<'a> {
    pub(super) fn new(run: &'a Run, [x, y]: [f64; 2]) -> Self {
        Self {
            run,
            potentials: potentials(&run.equations),
            largest: Largest::default(),
            about: Vector::planar(Expr::from(x) * units::M, Expr::from(y) * units::M),
            quadrature: Quadrature::new(),
            lines: HashMap::new(),
            stocktakings: HashMap::new(),
            keys: vec![],
            known: HashMap::new(),
            sums: vec![],
            marks: vec![],
        }
    }

    /// Enters everything from the start of the run to its end.
    pub(super) fn keep(&mut self) -> Result<(), Reason> {
        let run = self.run;
        let times: Vec<f64> = run.trajectory.events.iter().map(|event| event.time).collect();
        let mut next = 0;
        for piece in &run.trajectory.pieces {
            while next < times.len() && times[next] <= piece.start {
                self.enter_event(next)?;
                next += 1;
            }
            self.marks.push(self.totals());
            let states = piece.states_at_clock(0.0);
            let stocks = self.stocks(&run.trajectory.modes[piece.mode], piece.start, &states)?;
            self.watch(&stocks);
            self.enter_piece(piece)?;
        }
        (next..times.len()).try_for_each(|event| self.enter_event(event))
    }

    fn enter_piece(&mut self, piece: &Piece) -> Result<(), Reason> {
        self.prepare(piece.mode)?;
        let (sums, quadrature) = (&mut self.sums, &self.quadrature);
        let Some((lines, entries)) = self.lines.get_mut(&piece.mode) else { return Ok(()) };
        let mut add = |line: usize, amounts: &Amounts| {
            sums[entries[line]].iter_mut().zip(amounts).for_each(|(sum, amount)| sum.add(*amount));
        };
        let found = quadrature.integrate([0.0, piece.length], &mut |s| lines.sample(piece, s), &mut add);
        found.map_err(|bad| refused(&lines.keys, piece, &bad))
    }

    /// What entries have summed up to at a time within a piece, by the piece's index.
    pub(super) fn totals_at(&mut self, index: usize, time: f64) -> Result<Vec<Amounts>, Reason> {
        let piece = &self.run.trajectory.pieces[index];
        self.prepare(piece.mode)?;
        let mut totals = self.marks[index].clone();
        totals.resize(self.keys.len(), [0.0; 4]);
        let Some((lines, entries)) = self.lines.get_mut(&piece.mode) else { return Ok(totals) };
        let mut add = |line: usize, amounts: &Amounts| {
            totals[entries[line]].iter_mut().zip(amounts).for_each(|(total, amount)| *total += amount);
        };
        let to = piece.clock_at(time);
        let found = self.quadrature.integrate([0.0, to], &mut |s| lines.sample(piece, s), &mut add);
        found.map_err(|bad| refused(&lines.keys, piece, &bad))?;
        Ok(totals)
    }

    /// Sums so far, by entry.
    pub(super) fn totals(&self) -> Vec<Amounts> {
        self.sums.iter().map(|sums| sums.map(Sum::value)).collect()
    }

    /// Energies and momenta in a mode.
    pub(super) fn stocks(&mut self, mode: &Mode, time: f64, states: &[f64]) -> Result<Stocks, Reason> {
        if !self.stocktakings.contains_key(mode) {
            let Run { equations, inputs, .. } = self.run;
            let taking = Stocktaking::new(equations, &self.potentials, mode, inputs, &self.about)?;
            self.stocktakings.insert(mode.clone(), taking);
        }
        match self.stocktakings.get_mut(mode) {
            Some(taking) => Ok(taking.take(time, states)),
            None => unreachable!("it was put in above"),
        }
    }

    /// Adds amounts to an entry, which is opened if need be.
    pub(super) fn enter(&mut self, key: Key, amounts: Amounts) {
        let entry = self.entry(key);
        self.sums[entry].iter_mut().zip(amounts).for_each(|(sum, amount)| sum.add(amount));
    }

    /// Raises the largest sizes.
    pub(super) fn watch(&mut self, stocks: &Stocks) {
        let Largest { energy, kinetic, momentum, angular } = &mut self.largest;
        *energy = energy.max(stocks.size());
        for sizes in [&mut *kinetic, &mut *momentum, &mut *angular] {
            sizes.resize(stocks.bodies.len(), 0.0);
        }
        for (index, body) in stocks.bodies.iter().enumerate() {
            kinetic[index] = kinetic[index].max(body.kinetic);
            momentum[index] = momentum[index].max(libm::hypot(body.momentum[0], body.momentum[1]));
            angular[index] = angular[index].max(body.angular.abs()).max(body.spin.abs());
        }
    }

    /// The entries as they stand.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let entry = |(key, [work, x, y, angular_impulse]): (&Key, Amounts)| Entry {
            load: key.load.clone(),
            law: key.law,
            body: key.body,
            kind: key.kind,
            work,
            impulse: [x, y],
            angular_impulse,
        };
        self.keys.iter().zip(self.totals()).map(entry).collect()
    }

    fn prepare(&mut self, mode: usize) -> Result<(), Reason> {
        if self.lines.contains_key(&mode) {
            return Ok(());
        }
        let Run { equations, trajectory, inputs, .. } = self.run;
        let lines = Lines::new(equations, &self.potentials, &trajectory.modes[mode], inputs, &self.about)?;
        let entries = lines.keys.iter().map(|key| self.entry(key.clone())).collect();
        self.lines.insert(mode, (lines, entries));
        Ok(())
    }

    fn entry(&mut self, key: Key) -> usize {
        if let Some(&entry) = self.known.get(&key) {
            return entry;
        }
        self.known.insert(key.clone(), self.keys.len());
        self.keys.push(key);
        self.sums.push([Sum::default(); 4]);
        self.keys.len() - 1
    }

    /// Enters a change of a store of energy, J.
    pub(super) fn enter_energy(&mut self, potential: usize, kind: Kind, change: f64) {
        if change != 0.0 {
            let key = self.potentials[potential].key(None, kind);
            self.enter(key, [change, 0.0, 0.0, 0.0]);
        }
    }
}

fn refused(keys: &[Key], piece: &Piece, bad: &NotFinite) -> Reason {
    let (load, time) = (&keys[bad.line].load, piece.time_at(bad.from));
    Reason::Model(format!("the power or force of `{load}` is not a finite number just after {time} s"))
}
