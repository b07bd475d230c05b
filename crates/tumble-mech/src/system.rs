//! The equations as the integrator sees them: flows by mode, and what happens between.

use tumble_ode::{Cause, Crossing, Flow, Guard, Hybrid, Jump, Reason, StateVariable};

use crate::equations::Equations;
use crate::event::Action;
use crate::load::Moment;
use crate::mode::Mode;
use crate::parameters::time_symbol;

impl Hybrid for Equations {
    type Mode = Mode;

    fn flow(&self, mode: &Mode) -> Result<Flow, Reason> {
        let in_mode = self.definitions_of(mode);
        let states = self.state_rates().into_iter().map(|state| StateVariable {
            rate: in_mode.apply(&state.rate),
            symbol: state.symbol,
            group: state.measure as usize,
        });
        let guards = self.model().events.iter().map(|event| Guard {
            name: event.name.clone(),
            formula: in_mode.apply(&event.when),
            direction: event.direction,
        });
        Ok(Flow {
            states: states.collect(),
            time: time_symbol(),
            inputs: self.model().parameters.symbols(),
            groups: self.groups(),
            schedule: self
                .windows()
                .iter()
                .flat_map(|window| window.times().map(|(_, time)| time.clone()))
                .collect(),
            guards: guards.collect(),
            clock: None,
        })
    }

    /// At one instant windows end before others begin, and events come last: they see what was scheduled.
    fn jump(&self, at: &Crossing<'_, Mode>) -> Result<Jump<Mode>, Reason> {
        let mut jump = Jump { mode: at.mode.clone(), states: at.states.to_vec(), tags: vec![], stop: false };
        for cause in at.causes {
            match cause {
                Cause::Scheduled(index) => self.pass_time(*index, &mut jump),
                Cause::Guard(event) => self.pass_event(*event, &mut jump),
            }
        }
        Ok(jump)
    }
}

impl Equations {
    fn pass_time(&self, index: usize, jump: &mut Jump<Mode>) {
        let windows = self.windows().iter().enumerate();
        let mut times = windows.flat_map(|(window, of)| of.times().map(move |(ends, _)| (window, ends)));
        if let Some((window, ends)) = times.nth(index) {
            self.switch(window, !ends, jump);
        }
    }

    fn pass_event(&self, index: usize, jump: &mut Jump<Mode>) {
        let event = &self.model().events[index];
        jump.tags.push(event.name.clone());
        match &event.action {
            Action::Record => {}
            Action::Stop => jump.stop = true,
            Action::Set(_) => jump.mode.change(index),
        }
        for (window, of) in self.windows().iter().enumerate() {
            for (end, moment) in of.during.iter().enumerate() {
                if matches!(moment, Moment::Event(name) if *name == event.name) {
                    self.switch(window, end == 0, jump);
                }
            }
        }
    }

    fn switch(&self, window: usize, acts: bool, jump: &mut Jump<Mode>) {
        jump.mode.windows[window] = acts;
        jump.tags.push(format!("{}.{}", self.windows()[window].load, if acts { "start" } else { "end" }));
    }
}
