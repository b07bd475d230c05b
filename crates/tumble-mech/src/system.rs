//! The equations as the integrator sees them: flows by mode, and what happens between.

use std::sync::Arc;

use tumble_expr::Rounding;
use tumble_ode::{Cause, Crossing, Flow, Hybrid, Program, Reason};

use crate::contact::Causes;
use crate::equations::Equations;
use crate::event::Action;
use crate::link::{Linking, Nodes, Written};
use crate::load::Moment;
use crate::mode::Mode;
use crate::record::{Happening, Jump, Record};
use crate::uniqueness::Spot;

impl Hybrid for Equations {
    type Mode = Mode;
    type Record = Record;

    fn flow(&self, mode: &Mode) -> Result<Flow, Reason> {
        Ok(Linking::new(self, mode, Written).flow())
    }

    fn program(&self, mode: &Mode) -> Result<Arc<Program>, Reason> {
        if let Some(twin) = self.twin(mode) {
            let names = self.states(mode).into_iter().map(|state| state.name.to_string()).collect();
            return Ok(Arc::new(self.program(&twin.mode(mode))?.renamed(names, self.guard_names(mode))));
        }
        let link = |mode: &Mode| {
            let mut linking = Linking::new(self, mode, Nodes::default());
            let flow = Flow { rounding: Rounding::NEAREST, ..linking.flow() };
            Program::linked(&mut linking.into_algebra().linker()?, &flow)
        };
        self.built().programs.get_rounded(mode.clone(), self.rounding(), link, Program::rounded)
    }

    /// At one instant windows end before others begin, then come events, which see what was scheduled, then what is captured, then contacts,
    /// which see all forces that act from now on, and last the events that all this has made happen.
    fn jump(&self, at: &Crossing<'_, Mode>) -> Result<Jump<Mode>, Reason> {
        if self.algebraic().is_empty() { self.jump_once(at) } else { self.jump_with_forces(at) }
    }

    fn held_by(record: &Record) -> usize {
        record.held()
    }
}

impl Equations {
    /// The same for given values of the forces that loads read otherwise than linearly.
    pub(crate) fn jump_once(&self, at: &Crossing<'_, Mode>) -> Result<Jump<Mode>, Reason> {
        let mut jump = Jump::to(at.mode.clone(), at.states.to_vec());
        let events = self.events(at.mode);
        for cause in at.causes {
            match cause {
                Cause::Scheduled(index) => self.pass_time(*index, &mut jump),
                Cause::Guard(guard) if *guard < events.len() => {
                    self.pass_event(events[*guard], at, &mut jump)?;
                }
                Cause::Guard(_) | Cause::LazyGuard(_) | Cause::Wake => {}
            }
        }
        self.capture(at, &mut jump)?;
        let mut impulses = self.couple(&jump.record.happened.clone(), at, &mut jump)?;
        let causes = Causes::of(self, at);
        let braked = causes.braked.clone();
        if causes.closes() || !impulses.is_empty() {
            self.release_brakes(&mut jump.mode);
        }
        impulses.add(self.switch_contacts(at, causes, &mut jump)?);
        self.brake(at, &braked, &mut jump)?;
        let known = jump.record.happened.len();
        for event in self.carried_across(at, &jump)? {
            self.pass_event(event, at, &mut jump)?;
        }
        let carried = jump.record.happened[known..].to_vec();
        impulses.add(self.couple(&carried, at, &mut jump)?);
        if jump.mode.changes != at.mode.changes {
            self.refuse_changes(&jump.mode.changes, at.inputs)?;
        }
        let now = Spot { mode: &jump.mode, time: at.time, states: &jump.states, inputs: at.inputs };
        self.refuse_feedback(now, &[])?;
        jump.record.impulses = self.impulses(impulses, at, &jump)?;
        self.rest(at, &mut jump)?;
        Ok(jump)
    }

    fn pass_time(&self, index: usize, jump: &mut Jump<Mode>) {
        let due = self.schedule(&jump.mode).nth(index).map(|(window, ends, _)| (window, ends));
        if let Some((window, ends)) = due {
            switch(window, ends, jump);
        }
    }

    fn pass_event(&self, index: usize, at: &Crossing<'_, Mode>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let event = &self.model().events[index];
        jump.record.happened.push(Happening::Event(index));
        match &event.action {
            Action::Record => {}
            Action::Stop => jump.stop = true,
            Action::Set(_) => jump.mode.change(index),
        }
        for (window, of) in self.windows().iter().enumerate() {
            for (end, moment) in of.during.iter().enumerate() {
                let is_this = matches!(moment, Moment::Event(name) if *name == event.name);
                if is_this && !(end == 0 && self.is_over(window, at)?) {
                    switch(window, end == 1, jump);
                }
            }
        }
        Ok(())
    }

    /// Whether a window would end at a time that has passed.
    fn is_over(&self, window: usize, at: &Crossing<'_, Mode>) -> Result<bool, Reason> {
        let mut ends = self.windows()[window].times().filter(|(ends, _)| *ends).map(|(_, time)| time.clone());
        let Some(end) = ends.next() else { return Ok(false) };
        Ok(self.values(&[end], at.mode, at.time, at.states, at.inputs)?[0] <= at.time)
    }
}

fn switch(window: usize, ends: bool, jump: &mut Jump<Mode>) {
    jump.mode.windows[window] = !ends;
    jump.record.happened.push(Happening::Window { window, ends });
}
