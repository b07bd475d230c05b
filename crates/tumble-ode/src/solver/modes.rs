//! Modes of a motion: which holds, and what one begins with.

use super::Solver;
use crate::Reason;
use crate::compiled::{Compiled, beside};
use crate::engine::Engine;
use crate::hybrid::Hybrid;

impl<H: Hybrid> Solver<'_, H> {
    /// Index of the mode that holds, entered if need be.
    pub(super) fn current_mode(&mut self) -> Result<usize, Reason> {
        match self.mode {
            Some(mode) => Ok(mode),
            None => {
                if !(self.until.is_finite() && self.span > 0.0) {
                    return Err(Reason::BadEnd { until: self.until });
                }
                let mode = self.enter_first()?;
                let causes = std::mem::take(&mut self.first_causes);
                if causes.is_empty() {
                    return Ok(mode);
                }
                self.jump(mode, causes, false)?;
                Ok(self.mode.unwrap_or(mode))
            }
        }
    }

    /// Begins a mode; `zeros` are the guards that are zero now, each with how many of its derivatives.
    pub(super) fn enter(
        &mut self,
        mode: H::Mode,
        states: Vec<f64>,
        zeros: &[(String, usize)],
    ) -> Result<usize, Reason> {
        let index = match self.known.get(&mode) {
            Some(&index) => index,
            None => self.compile(mode)?,
        };
        let before = self.mode.filter(|_| states == self.states);
        let sides = before.map(|before| self.engines[before].sides());
        let engine = &mut self.engines[index];
        let system = &engine.system;
        assert_eq!(states.len(), system.len(), "a model gives a mode as many states as its flow has");
        if let Some(bad) = states.iter().position(|value| !value.is_finite()) {
            return Err(Reason::BadStart { state: system.names[bad].clone(), value: states[bad] });
        }
        self.scales.raise(&system.floors);
        self.scales.watch(system, &states);
        engine.enter(self.time, &states, zeros);
        if let Some(sides) = sides {
            engine.carry_sides(&sides);
        }
        self.compensation = self.carried(index, &states);
        self.states = states;
        self.mode = Some(index);
        Ok(index)
    }

    /// What rounding left out of the states that are the same, to the bit, after a jump.
    fn carried(&self, mode: usize, states: &[f64]) -> Vec<f64> {
        let names = |mode: usize| &self.engines[mode].system.names;
        match self.mode {
            Some(before) if names(before) == names(mode) => {
                let same = self.states.iter().zip(states).zip(&self.compensation);
                same.map(|((before, after), compensation)| if before == after { *compensation } else { 0.0 })
                    .collect()
            }
            Some(_) => vec![0.0; states.len()],
            None => self.compensation.clone(),
        }
    }

    pub(super) fn compile(&mut self, mode: H::Mode) -> Result<usize, Reason> {
        let program = self.system.program(&mode)?;
        let system = Compiled::new(&program, &self.inputs, self.span)?;
        let beside = beside(&program, &self.inputs, self.trajectory.order);
        self.engines.push(Engine::new(system, beside, self.trajectory.order, &self.inputs));
        self.trajectory.modes.push(mode.clone());
        self.trajectory.work.modes += 1;
        self.known.insert(mode, self.engines.len() - 1);
        Ok(self.engines.len() - 1)
    }
}
