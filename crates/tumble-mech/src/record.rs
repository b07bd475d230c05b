//! What happened at one instant of a motion, as data; names are made of it where people read them.

use crate::contact::Change;
use crate::equations::Equations;
use crate::impulse::Impulse;
use crate::others::Others;

/// What a jump leaves to be known beside the states and modes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What happened, in the order in which it was dealt with.
    pub happened: Vec<Happening>,
    /// Impulses that acted, those of pivots included.
    pub impulses: Vec<Impulse>,
    /// Where rigid bodies with friction might go on otherwise.
    pub others: Vec<Others>,
}

/// Something that happens at an instant; what it happens to is known by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Happening {
    /// One of the model's events.
    Event(usize),
    /// A load begins or ceases to act.
    Window {
        /// Among the equations' windows.
        window: usize,
        /// Whether it is the end.
        ends: bool,
    },
    /// A joint begins or ceases to hold.
    Joint {
        /// Among the model's joints.
        joint: usize,
        /// Whether it holds from now on.
        holds: bool,
    },
    /// An impulse that an event applies, among the model's.
    Impulse(usize),
    /// A contact changes.
    Contact {
        /// Among the equations' pairs.
        pair: usize,
        /// How.
        change: Change,
    },
    /// A load whose sign brakes, such as `-mu*N*sign(v)`, begins to hold, or to give way.
    Brake {
        /// Among the equations' brakes.
        brake: usize,
        /// Whether it holds from now on.
        sticks: bool,
    },
    /// All bodies have come to rest for good.
    Rest,
    /// The joints pass a singular configuration: for this instant they could be kept in more than one way.
    Singular,
}

/// A jump that leaves a record.
pub(crate) type Jump<Mode> = tumble_ode::Jump<Mode, Record>;

impl Record {
    /// Indices of the pairs of which impacts that follow each other ever faster end here.
    pub fn zeno_sequences(&self) -> impl Iterator<Item = usize> {
        self.happened.iter().filter_map(|happening| match *happening {
            Happening::Contact { pair, change: Change::Zeno } => Some(pair),
            _ => None,
        })
    }

    /// Whether there are any.
    pub fn ends_zeno_sequence(&self) -> bool {
        self.zeno_sequences().next().is_some()
    }

    /// Whether an instant was only looked at, or what a contact does there has no force on either side.
    pub(crate) fn is_nothing(&self) -> bool {
        self.happened.is_empty() && self.impulses.is_empty() && self.others.is_empty()
    }

    /// Bytes that it holds beside its own size.
    pub(crate) fn held(&self) -> usize {
        self.happened.capacity() * size_of::<Happening>()
            + self.impulses.capacity() * size_of::<Impulse>()
            + self.others.iter().map(Others::held).sum::<usize>()
    }
}

impl Happening {
    /// Whether both are of the same load or the same contact.
    pub fn is_of_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Window { window: a, .. }, Self::Window { window: b, .. }) => a == b,
            (Self::Joint { joint: a, .. }, Self::Joint { joint: b, .. }) => a == b,
            (Self::Contact { pair: a, .. }, Self::Contact { pair: b, .. }) => a == b,
            _ => false,
        }
    }
}

impl Equations {
    /// What people call it: `apex`, `wind.start`, `floor.rod.tip.impact`.
    pub fn name_of(&self, happening: &Happening) -> String {
        match *happening {
            Happening::Event(event) => self.model().events[event].name.clone(),
            Happening::Window { window, ends } => {
                format!("{}.{}", self.windows()[window].load, if ends { "end" } else { "start" })
            }
            Happening::Joint { joint, holds } => {
                format!("{}.{}", self.model().joints[joint].name, if holds { "start" } else { "end" })
            }
            Happening::Brake { brake, sticks } => {
                let change = if sticks { Change::Sticks } else { Change::Slides };
                format!("{}.{}", self.brake_name(brake), change.word())
            }
            Happening::Rest => "rest".to_owned(),
            Happening::Singular => "singular".to_owned(),
            Happening::Impulse(impulse) => self.model().impulses[impulse].name.clone(),
            Happening::Contact { pair, change } => format!("{}.{}", self.pairs()[pair].name, change.word()),
        }
    }

    /// What people call all that happened at an instant.
    pub fn names_of(&self, record: &Record) -> Vec<String> {
        record.happened.iter().map(|happening| self.name_of(happening)).collect()
    }

    /// The event, the start or end of a load or a joint, the impulse or the rest that people call so.
    pub fn named(&self, name: &str) -> Option<Happening> {
        let events = (0..self.model().events.len()).map(Happening::Event);
        let ends = |window| [false, true].map(|ends| Happening::Window { window, ends });
        let joints = (0..self.model().joints.len())
            .flat_map(|joint| [true, false].map(|holds| Happening::Joint { joint, holds }));
        let impulses = (0..self.model().impulses.len()).map(Happening::Impulse);
        let loads = (0..self.windows().len()).flat_map(ends);
        let whole = [Happening::Rest, Happening::Singular];
        let mut all = events.chain(loads).chain(joints).chain(impulses).chain(whole);
        all.find(|happening| self.name_of(happening) == name).or_else(|| self.named_brake(name))
    }
}
