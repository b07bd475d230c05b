//! Which equations hold.

use crate::contact::{Pair, Phase};

/// What is switched on at an instant.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mode {
    /// Whether each load that has a window acts, in the model's order.
    pub windows: Vec<bool>,
    /// Which events have changed parameters, in the order in which they first did; of two that change the same
    /// parameter, the later counts.
    pub changes: Vec<usize>,
    /// Which pairs touch and how, in the order of the pairs; those not mentioned are apart.
    pub contacts: Vec<(usize, Phase)>,
}

impl Mode {
    /// The event of that index changes its parameters now.
    pub(crate) fn change(&mut self, event: usize) {
        self.changes.retain(|known| *known != event);
        self.changes.push(event);
    }

    /// How a pair touches; `None` if it is apart.
    pub fn phase(&self, pair: usize) -> Option<Phase> {
        let at = self.contacts.binary_search_by_key(&pair, |(known, _)| *known).ok()?;
        Some(self.contacts[at].1)
    }

    /// Makes a pair touch in that way, or come apart.
    pub(crate) fn set_phase(&mut self, pair: usize, phase: Option<Phase>) {
        self.contacts.retain(|(known, _)| *known != pair);
        self.contacts.extend(phase.map(|phase| (pair, phase)));
        self.contacts.sort_unstable();
    }

    /// The same mode as far as a body's free motion depends on it: without its lasting contacts and those of others,
    /// except where they are states.
    pub(crate) fn without_support(&self, pairs: &[Pair], body: usize) -> Self {
        let mut mode = self.clone();
        mode.contacts.retain(|(pair, phase)| {
            let (own, is_state) = (pairs[*pair].body == body, pairs[*pair].is_hertzian());
            if own { !phase.is_lasting() } else { is_state && *phase == Phase::Pressed }
        });
        mode
    }

    /// The pairs that a rigid surface holds by a force.
    pub(crate) fn held(&self) -> impl Iterator<Item = usize> {
        self.contacts.iter().filter(|(_, phase)| phase.is_held()).map(|(pair, _)| *pair)
    }

    /// The pairs pressed into a surface that gives way.
    pub(crate) fn pressed(&self) -> impl Iterator<Item = usize> {
        self.contacts.iter().filter(|(_, phase)| *phase == Phase::Pressed).map(|(pair, _)| *pair)
    }
}
