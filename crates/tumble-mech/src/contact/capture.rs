//! # Law
//! Bodies that a contact captures stick together from where they touch first: a weld begins there, and its beginning is a perfectly
//! inelastic impact. Momentum and moment of momentum of the two stay what they were; the energy of their motion against each other is
//! lost.
//! # Symbols and units
//! Those of the weld, see `coupling.rs`.
//! # Sign and frame
//! The weld's force is told at the centre of mass of the first body, with a couple.
//! # Validity
//! Rigid bodies that stay together for good. Other contacts and joints of the two answer to it at the same instant: joints together with
//! it, contacts after it.
//! # Source
//! Balance of momentum and of moment of momentum.
//! # Checked by
//! `tests/capture.rs`: disks off the centre, a disk and a rod, a chain of captures, against closed forms.

use std::collections::HashMap;

use tumble_ode::{Crossing, Reason};

use crate::anchor::Anchor;
use crate::contact::change::Change;
use crate::contact::pair::{Pair, Rule};
use crate::contact::touch::Now;
use crate::equations::Equations;
use crate::joint::Joint;
use crate::mode::Mode;
use crate::model::Model;
use crate::record::{Happening, Jump};

impl Model {
    /// Adds the welds that contacts make which capture, where they are not there yet.
    pub fn add_captures(&mut self) {
        for (index, contact) in self.contacts.iter().enumerate().filter(|(_, contact)| contact.captures) {
            if self.joints.iter().any(|joint| joint.captured_by == Some(index)) {
                continue;
            }
            for couple in contact.couples(self) {
                let [one, other] = couple.map(|body| &self.bodies[body]);
                let name = contact.name_of([one, other]);
                let ends = [Anchor::Material(one.cm()), Anchor::Material(other.cm())];
                let weld = Joint::weld(format!("{name}.joint"), ends).seated_on(&other.kinematics());
                self.joints.push(Joint { captured_by: Some(index), ..weld.from(name) });
            }
        }
    }
}

/// The joints of the pairs that capture.
pub(super) fn captures(model: &Model, pairs: &[Pair]) -> HashMap<usize, usize> {
    let joints = model.joints.iter().enumerate();
    let joints = joints.filter(|(_, joint)| joint.captured_by.is_some());
    let of_name: HashMap<&str, usize> =
        joints.filter_map(|(index, joint)| Some((joint.from.as_deref()?, index))).collect();
    let joint = |pair: &Pair| match (pair.rule, pair.other) {
        (Rule::Bodies(contact), Some(other)) if model.contacts[contact].captures => {
            let name = model.contacts[contact].name_of([pair.body, other].map(|body| &model.bodies[body]));
            of_name.get(name.as_str()).copied()
        }
        _ => None,
    };
    pairs.iter().enumerate().filter_map(|(index, pair)| Some((index, joint(pair)?))).collect()
}

impl Equations {
    /// The joint that a pair makes where it captures.
    pub fn capture_of(&self, pair: usize) -> Option<usize> {
        self.pair_list().captures.get(&pair).copied()
    }

    /// Pairs among bodies that may still touch or do: those of bodies that have been captured are one body.
    pub(crate) fn pairs_among(&self, mode: &Mode, bodies: &[usize]) -> Vec<usize> {
        let mut pairs = self.pair_list().among(bodies);
        pairs.retain(|pair| !self.capture_of(*pair).is_some_and(|joint| self.holds(mode, joint)));
        pairs
    }

    /// Tells of the pairs that meet now and capture; their joints are made by [`Equations::couple`].
    pub(crate) fn capture(&self, at: &Crossing<'_, Mode>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        if self.pair_list().captures.is_empty() {
            return Ok(());
        }
        let now = Now::of(at);
        let meeting = self.meeting(&jump.mode, &jump.states, now, 1.0)?.into_iter().map(|(pair, _)| pair);
        let captured = meeting.filter(|pair| self.capture_of(*pair).is_some());
        let change = Change::Impact;
        jump.record.happened.extend(captured.map(|pair| Happening::Contact { pair, change }));
        Ok(())
    }

    /// The joints that pairs make of which these happenings tell that they meet.
    pub(crate) fn capturing(&self, happened: &[Happening]) -> Vec<usize> {
        let joint = |happening: &Happening| match happening {
            Happening::Contact { pair, change: Change::Impact } => self.capture_of(*pair),
            _ => None,
        };
        happened.iter().filter_map(joint).collect()
    }
}
