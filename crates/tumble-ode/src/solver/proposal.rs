//! The next step, found but not taken: others that go on beside it may cut it short.

use tumble_expr::Row;

use super::Solver;
use super::step::Step;
use crate::expansion::Expansion;
use crate::hybrid::Hybrid;
use crate::trajectory::Piece;
use crate::{Reason, Refusal};

/// A step that has passed all checks.
pub(super) struct Proposal {
    mode: usize,
    expansion: Expansion,
    step: Step,
    /// Whether it ends at a time that is due.
    is_due: bool,
}

impl<H: Hybrid> Solver<'_, H> {
    /// Enters the first mode, and carries out what happens at the very start, if that is not done.
    pub fn begin(&mut self) -> Result<(), Refusal> {
        self.current_mode().map(|_| ()).map_err(self.refused())
    }

    /// Finds the next step, if it is not known yet; the time at which it ends, s.
    pub fn propose(&mut self) -> Result<f64, Refusal> {
        self.find_step().map_err(self.refused())
    }

    /// Takes the proposed step, and the jump at its end if there is one.
    pub fn take(&mut self) -> Result<(), Refusal> {
        self.take_step().map_err(self.refused())
    }

    /// Whether a step is proposed.
    pub fn has_proposal(&self) -> bool {
        self.proposal.is_some()
    }

    /// The proposed step as a piece of the motion; of no index among the modes.
    pub fn proposed(&self) -> Option<Piece> {
        let Proposal { mode, expansion, step, .. } = self.proposal.as_ref()?;
        Some(Piece {
            start: expansion.start,
            left_out: self.time_left_out,
            end: step.end,
            mode: *mode,
            length: step.length,
            states: expansion.states.clone(),
            time_series: expansion.time.clone(),
        })
    }

    /// Ends the proposed step at an earlier time, s, at which nothing happens to it; forgets it where nothing of it is left.
    pub fn cut_short(&mut self, time: f64) {
        let Some(Proposal { mode, expansion, step, is_due }) = self.proposal.take() else { return };
        if time <= self.time {
            self.expansion = expansion;
            return;
        }
        let is_cut = time < step.end;
        let step = if is_cut { self.fit(&expansion, step.length, time) } else { step };
        self.proposal = Some(Proposal { mode, expansion, step, is_due: is_due && !is_cut });
    }

    fn find_step(&mut self) -> Result<f64, Reason> {
        let mode = self.current_mode()?;
        if self.stopped {
            return Ok(self.time);
        }
        if let Some(known) = &self.proposal {
            return Ok(known.step.end);
        }
        self.watch_memory(mode)?;
        let end = self.next_stop(mode);
        let mut expansion = std::mem::take(&mut self.expansion);
        let step = match self.rest(mode, end, &mut expansion)? {
            Some(step) => step,
            None => {
                self.expand(mode, &mut expansion)?;
                self.accepted_step(mode, &mut expansion, end)?
            }
        };
        let (ends, is_due) = (step.end, step.end == end);
        self.proposal = Some(Proposal { mode, expansion, step, is_due });
        Ok(ends)
    }

    fn take_step(&mut self) -> Result<(), Reason> {
        let Some(Proposal { mode, mut expansion, step, is_due }) = self.proposal.take() else {
            return Ok(());
        };
        self.pass(mode, &step, &expansion)?;
        // Only a hit asks for it.
        let left_out = if step.hits.is_empty() { Row::new() } else { Row::from_slice(&self.compensation) };
        let start_left_out = self.time_left_out;
        self.accept(mode, &mut expansion, &step)?;
        let now = (self.time, self.states.as_slice());
        self.blur = self.engines[mode].blur(&step.hits, &expansion, step.length, now, &left_out)?;
        let work = &mut self.trajectory.work;
        let ends_flow = self.engines[mode].fired(&step.hits, now, work);
        self.record(mode, (&expansion, start_left_out), &step);
        self.expansion = expansion;
        self.jump_if_due(mode, ends_flow?, is_due)
    }
}
