//! What of a motion is that of some bodies: others may be one motion with them for a while.

use std::borrow::Cow;

use tumble_ode::{Motion, Occurrence};

use crate::contact::ContactMode;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::{Happening, Record};
use crate::run::Run;

/// Some groups of bodies.
#[derive(Clone, Debug)]
pub(super) struct Own {
    equations: Equations,
    groups: Vec<usize>,
    bodies: Vec<usize>,
}

impl Own {
    pub(super) fn of(run: &Run) -> Self {
        let groups = run.all_tracks().groups.clone();
        Self { equations: run.equations.clone(), groups, bodies: run.bodies() }
    }

    /// Events that happen to them.
    pub(super) fn events<'a>(
        &'a self,
        motion: &'a Motion<Equations>,
    ) -> impl Iterator<Item = &'a Occurrence<Record>> {
        motion.events.iter().filter(|event| self.has(motion, event))
    }

    /// Whether an event happens to them, or changes how they move.
    pub(super) fn has(&self, motion: &Motion<Equations>, event: &Occurrence<Record>) -> bool {
        self.is_all(&motion.modes[event.mode_before])
            || self.has_part(&event.record)
            || self.changes(motion, event)
    }

    /// Whether an event changes how they move.
    pub(super) fn changes(&self, motion: &Motion<Equations>, event: &Occurrence<Record>) -> bool {
        let [before, after] = [event.mode_before, event.mode_after].map(|mode| &motion.modes[mode]);
        match self.is_all(before) && self.is_all(after) {
            true => {
                // What was looked at and is as it was, such as friction that breaks where nothing presses any more: check runs round states anew
                // there too.
                let is_something = !event.record.is_nothing();
                self.mode(before) != self.mode(after) || (event.before != event.after && is_something)
            }
            false => {
                // Check runs round all states anew at any event.
                let is_moved = || self.states(before, &event.before) != self.states(after, &event.after);
                self.mode(before) != self.mode(after) || (self.has_part(&event.record) && is_moved())
            }
        }
    }

    fn has_part(&self, record: &Record) -> bool {
        let has = |body: usize| self.bodies.binary_search(&body).is_ok();
        record.happened.iter().any(|happening| self.concerns(happening))
            || record.impulses.iter().any(|impulse| has(impulse.body))
    }

    /// What happens to them.
    pub(super) fn happened(&self, record: &Record) -> Vec<Happening> {
        record.happened.iter().filter(|happening| self.concerns(happening)).copied().collect()
    }

    /// A mode as far as it is theirs, with what they touch of others; that some contacts press too little to have a force is no difference.
    pub(super) fn mode<'a>(&self, mode: &'a Mode) -> Cow<'a, Mode> {
        if mode.contacts.iter().any(|(_, contact_mode)| contact_mode.is_slight()) {
            let mut pressed = mode.clone();
            let slight = pressed.contacts.iter_mut().filter(|(_, contact_mode)| contact_mode.is_slight());
            slight.for_each(|(_, contact_mode)| *contact_mode = ContactMode::Pressed);
            return Cow::Owned(self.mode(&pressed).into_owned());
        }
        if self.is_all(mode) {
            return Cow::Borrowed(mode);
        }
        let has = |body: usize| self.bodies.binary_search(&body).is_ok();
        let touches = |pair: usize| self.equations.pairs()[pair].bodies().any(has);
        let mut own = self.equations.restricted(mode, &self.bodies);
        own.contacts = mode.contacts.iter().filter(|(pair, _)| touches(*pair)).copied().collect();
        own.grips = mode.grips.iter().filter(|(pair, _)| touches(*pair)).copied().collect();
        Cow::Owned(own)
    }

    fn is_all(&self, mode: &Mode) -> bool {
        mode.bodies.len() == self.bodies.len()
    }

    fn states(&self, mode: &Mode, states: &[f64]) -> Vec<f64> {
        let first = |body: usize| self.equations.first_state(mode, body);
        let own = self.bodies.iter().flat_map(|body| first(*body)..first(*body + 1));
        own.map(|state| states[state]).collect()
    }

    fn concerns(&self, happening: &Happening) -> bool {
        let components = self.equations.components();
        let has_group = |group: &usize| self.groups.binary_search(group).is_ok();
        let has = |body: usize| self.bodies.binary_search(&body).is_ok();
        let model = self.equations.model();
        match happening {
            Happening::Event(event) => components.of_event(*event).iter().any(has_group),
            Happening::Window { window, .. } => has(self.equations.windows()[*window].body),
            Happening::Joint { joint, .. } => {
                self.equations.joints()[*joint].bodies.iter().any(|body| has(*body))
            }
            Happening::Impulse(impulse) => model.body_index(&model.impulses[*impulse].body).is_some_and(has),
            Happening::Contact { pair, .. } => self.equations.pairs()[*pair].bodies().any(has),
            Happening::Brake { brake, .. } => {
                self.equations.brakes()[*brake].bodies.iter().any(|body| has(*body))
            }
            // They are told of with those that come to rest last.
            Happening::Rest => false,
            Happening::Singular => true,
        }
    }
}
