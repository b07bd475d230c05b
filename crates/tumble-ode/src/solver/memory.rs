//! How much memory the pieces and events of a run may hold, and which runs are refused before they do.

use std::cell::Cell;
use std::collections::HashMap;
use std::rc::Rc;

use super::Solver;
use crate::engine::Hit;
use crate::hybrid::Hybrid;
use crate::trajectory::{Occurrence, Piece};
use crate::whole::What;
use crate::{Demands, Reason};

/// Bytes that the pieces and events of one run may hold: up to four runs of one motion are kept at once (the run, its check run
/// and two more for sweeps or finer sums), and computers of 8 GiB are common.
const LIMIT: u64 = 1 << 30;
/// From this part of the limit on, what the whole run would hold is estimated, at each doubling.
const FIRST_LOOK: f64 = 1.0 / 4.0;
/// A run that would hold so many times the limit is refused at once: estimates from half of what was seen are not better.
const SEVERAL: f64 = 4.0;

/// Between looks, parts of the next one at which it is noted how far the run has come.
const MARKS: [f64; 3] = [0.5, 0.75, 1.0];
/// A run is about to become cheap, and no estimate holds, if the later half of what was noted took so many times as long.
const SLOWING: f64 = 1.5;

/// What pieces and events hold.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    bytes: u64,
    steps: u64,
}

/// What a run holds, and when it held less.
#[derive(Debug)]
pub(super) struct Memory {
    limit: u64,
    /// By all motions that share it.
    held: Rc<Cell<Held>>,
    /// By this one alone, from which estimates are made: others may have begun before it, or be ahead of it.
    own: Held,
    /// Memory of its own at which the next estimate is due.
    next_look: f64,
    marks: Vec<Mark>,
    /// Steps that ended at each branch, table or guard, by mode.
    ended_by: HashMap<(usize, What), u64>,
}

/// How far a run had come.
#[derive(Clone, Copy, Debug, Default)]
struct Mark {
    own: Held,
    time: f64,
}

impl Default for Memory {
    fn default() -> Self {
        Self::of(LIMIT)
    }
}

impl Memory {
    pub(super) fn of(limit: u64) -> Self {
        let next_look = FIRST_LOOK * limit as f64;
        let (held, own) = (Rc::default(), Held::default());
        Self { limit, held, own, next_look, marks: vec![], ended_by: HashMap::new() }
    }

    pub(super) fn hold_piece(&mut self, piece: &Piece) {
        let series = [piece.states.all()].into_iter().chain(piece.time_series.as_deref());
        self.hold(size_of::<Piece>() + series.map(size_of_series).sum::<usize>(), 1);
    }

    pub(super) fn hold_event<Record>(&mut self, event: &Occurrence<Record>, held_by_record: usize) {
        let numbers = size_of_series(&event.before) + size_of_series(&event.after);
        self.hold(size_of::<Occurrence<Record>>() + numbers + held_by_record, 0);
    }

    fn hold(&mut self, bytes: usize, steps: u64) {
        let and_more =
            |Held { bytes: held, steps: taken }| Held { bytes: held + bytes as u64, steps: taken + steps };
        self.held.set(and_more(self.held.get()));
        self.own = and_more(self.own);
    }

    /// What all motions that share it hold.
    pub(super) fn held(&self) -> Rc<Cell<Held>> {
        Rc::clone(&self.held)
    }

    /// Counts what others hold too.
    pub(super) fn share_held(&mut self, held: Rc<Cell<Held>>) {
        self.held = held;
    }

    pub(super) fn count(&mut self, mode: usize, hits: &[Hit]) {
        for ended in hits.iter().filter_map(ended_by) {
            *self.ended_by.entry((mode, ended)).or_default() += 1;
        }
    }

    /// What a run to `until` would take, if that is too much, from where it has come to.
    fn excess(&mut self, time: f64, until: f64) -> Option<Demands> {
        let now = Mark { own: self.own, time };
        if self.own.bytes as f64 >= MARKS[self.marks.len()] * self.next_look {
            self.marks.push(now);
        }
        let is_full = self.held.get().bytes >= self.limit;
        if !is_full && self.marks.len() < MARKS.len() {
            return None;
        }
        let marks = std::mem::replace(&mut self.marks, vec![now]);
        self.next_look *= 2.0;
        let demands = match marks.first() {
            Some(then) => self.demands(*then, now, until),
            // It has just begun: as all went.
            None => self.demands(Mark::default(), Mark { own: self.held.get(), time }, until),
        };
        let is_foreseen = demands.bytes_in_all > SEVERAL * self.limit as f64 && !is_slowing(&marks);
        (is_full || is_foreseen).then_some(demands)
    }

    /// As it went from then to now, until the end.
    fn demands(&self, then: Mark, now: Mark, until: f64) -> Demands {
        let held = self.held.get();
        let times = (until - now.time) / (now.time - then.time).max(f64::MIN_POSITIVE);
        let estimate = |held: u64, now: u64, then: u64| held as f64 + (now - then) as f64 * times;
        Demands {
            steps: held.steps,
            until,
            bytes: held.bytes,
            steps_in_all: estimate(held.steps, now.own.steps, then.own.steps),
            bytes_in_all: estimate(held.bytes, now.own.bytes, then.own.bytes),
            limit: self.limit,
        }
    }

    /// What most steps ended at, with its mode, if it is a tenth of them at least.
    fn most_common(&self, steps: u64) -> Option<(usize, What)> {
        // Of two that are as common, which is told of does not depend on the order of a hash map.
        let most = self.ended_by.iter().max_by_key(|(what, count)| (**count, **what))?;
        (most.1.saturating_mul(10) >= steps).then_some(*most.0)
    }
}

fn is_slowing(marks: &[Mark]) -> bool {
    match marks {
        [first, second, third] => third.time - second.time > SLOWING * (second.time - first.time),
        _ => false,
    }
}

fn ended_by(hit: &Hit) -> Option<What> {
    match hit {
        Hit::Branch(branch, _) => Some(What::Branch(*branch)),
        Hit::Knot(table, _) => Some(What::Table(*table)),
        Hit::Guard(guard) => Some(What::Guard(*guard)),
        Hit::Turning(_) => None,
    }
}

fn size_of_series(series: &[f64]) -> usize {
    size_of::<Vec<f64>>() + size_of_val(series)
}

impl<H: Hybrid> Solver<'_, H> {
    /// Refuses a run that holds too much, or would by its end.
    pub(super) fn watch_memory(&mut self, mode: usize) -> Result<(), Reason> {
        let Some(demands) = self.memory.excess(self.time, self.until) else { return Ok(()) };
        let because = match self.memory.most_common(self.trajectory.work.steps) {
            Some((mode, ended)) => self.engines[mode].name_of(ended),
            None => {
                let (now, work) = ((self.time, self.states.as_slice()), &mut self.trajectory.work);
                self.engines[mode].expand(now, &[], work, &mut self.expansion)?;
                self.engines[mode].narrowest(&self.expansion, &self.scales)
            }
        };
        Err(match demands.bytes >= demands.limit {
            true => Reason::TooMuchMemory { demands, because },
            false => Reason::WouldTakeTooMuchMemory { demands, because },
        })
    }
}

#[cfg(test)]
mod tests;
