//! Which equations hold.

use crate::contact::{ContactMode, Grip, Pair};

/// What is switched on at an instant.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mode {
    /// Bodies whose motion it is, by index, in order.
    pub bodies: Vec<usize>,
    /// Whether each load that has a window acts, in the model's order.
    pub windows: Vec<bool>,
    /// Which events have changed parameters, in the order in which they first did; of two that change the same
    /// parameter, the later counts.
    pub changes: Vec<usize>,
    /// Which pairs touch and how, in the order of the pairs; those not mentioned are open.
    pub contacts: Vec<(usize, ContactMode)>,
    /// How those are held along the surface that press on one with friction, in the order of the pairs.
    pub grips: Vec<(usize, Grip)>,
    /// How loads that brake are held that are signs of rates, by the order of the loads; those that are not mentioned
    /// have the sign that the rate has.
    pub brakes: Vec<(usize, Grip)>,
    /// Bodies that are held so that they cannot move, in order: nothing of them is integrated.
    pub still: Vec<usize>,
    /// Joints that hold though they did not at the start, or the other way round, in order; see [`crate::Equations::holds`].
    pub switched: Vec<usize>,
    /// Rows of joints that follow from others and are left out, in order: all rows of all joints are counted.
    pub redundant: Vec<usize>,
}

impl Mode {
    /// The event of that index changes its parameters now.
    pub(crate) fn change(&mut self, event: usize) {
        self.changes.retain(|known| *known != event);
        self.changes.push(event);
    }

    /// The joint of that index begins or ceases to hold.
    pub(crate) fn switch_joint(&mut self, joint: usize) {
        match self.switched.iter().position(|known| *known == joint) {
            Some(place) => _ = self.switched.remove(place),
            None => self.switched.push(joint),
        }
        self.switched.sort_unstable();
    }

    /// Whether it is the motion of a body.
    pub(crate) fn has(&self, body: usize) -> bool {
        self.bodies.binary_search(&body).is_ok()
    }

    /// Contact mode of a pair; `None` if it is open.
    pub fn contact_mode(&self, pair: usize) -> Option<ContactMode> {
        let at = self.contacts.binary_search_by_key(&pair, |(known, _)| *known).ok()?;
        Some(self.contacts[at].1)
    }

    /// Whether a pair is pressed into a compliant surface.
    pub(crate) fn is_pressed(&self, pair: usize) -> bool {
        self.contact_mode(pair) == Some(ContactMode::Pressed)
    }

    /// Whether the friction of a pair follows from the states, as its normal force does: it slips on a compliant surface.
    pub(crate) fn has_known_friction(&self, pair: usize) -> bool {
        self.is_pressed(pair) && self.grip(pair) != Some(Grip::Sticks)
    }

    /// How a pair is held along its surface; `None` without friction or where it is not held.
    pub fn grip(&self, pair: usize) -> Option<Grip> {
        let at = self.grips.binary_search_by_key(&pair, |(known, _)| *known).ok()?;
        Some(self.grips[at].1)
    }

    /// Gives a pair that grip, or none.
    pub(crate) fn set_grip(&mut self, pair: usize, grip: Option<Grip>) {
        self.grips.retain(|(known, _)| *known != pair);
        self.grips.extend(grip.map(|grip| (pair, grip)));
        self.grips.sort_unstable();
    }

    /// How a brake is held.
    pub fn brake(&self, brake: usize) -> Option<Grip> {
        self.brakes.iter().find(|(known, _)| *known == brake).map(|(_, grip)| *grip)
    }

    /// Gives a brake that grip, or leaves it to the rate.
    pub(crate) fn set_brake(&mut self, brake: usize, grip: Option<Grip>) {
        self.brakes.retain(|(known, _)| *known != brake);
        self.brakes.extend(grip.map(|grip| (brake, grip)));
        self.brakes.sort_unstable();
    }

    /// The brakes whose rates stay zero.
    pub(crate) fn braked(&self) -> impl Iterator<Item = usize> {
        self.brakes.iter().filter(|(_, grip)| *grip == Grip::Sticks).map(|(brake, _)| *brake)
    }

    /// The pairs whose friction is as much as keeps them from slipping.
    pub(crate) fn sticking(&self) -> impl Iterator<Item = usize> {
        self.grips.iter().filter(|(_, grip)| *grip == Grip::Sticks).map(|(pair, _)| *pair)
    }

    /// The pairs that have friction.
    pub(crate) fn rubbing(&self) -> impl Iterator<Item = usize> {
        self.grips.iter().filter(|(_, grip)| *grip != Grip::Follows).map(|(pair, _)| *pair)
    }

    /// Gives a pair that contact mode, or separates it.
    pub(crate) fn set_contact_mode(&mut self, pair: usize, contact_mode: Option<ContactMode>) {
        self.contacts.retain(|(known, _)| *known != pair);
        self.contacts.extend(contact_mode.map(|contact_mode| (pair, contact_mode)));
        self.contacts.sort_unstable();
    }

    /// The same mode as far as the free motion of an island depends on it: without its lasting contacts and those of others,
    /// except where they are states.
    pub(crate) fn without_support(&self, pairs: &[Pair], island: &[usize]) -> Self {
        let mut mode = Self { grips: vec![], still: vec![], ..self.clone() };
        mode.contacts.retain(|(pair, contact_mode)| {
            let (own, is_state) = (island.contains(&pairs[*pair].body), pairs[*pair].is_hertzian());
            if own { !contact_mode.is_lasting() } else { is_state && *contact_mode == ContactMode::Pressed }
        });
        mode
    }

    /// The pairs that a rigid surface holds by a force.
    pub(crate) fn held(&self) -> impl Iterator<Item = usize> {
        self.contacts.iter().filter(|(_, contact_mode)| contact_mode.is_held()).map(|(pair, _)| *pair)
    }

    /// The pairs pressed into a compliant surface.
    pub(crate) fn pressed(&self) -> impl Iterator<Item = usize> {
        self.contacts
            .iter()
            .filter(|(_, contact_mode)| *contact_mode == ContactMode::Pressed)
            .map(|(pair, _)| *pair)
    }
}
