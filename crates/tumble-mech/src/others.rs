//! What is known of motions beside the one that goes on: contacts by their index; sentences are made of it where people read them.

use crate::contact::Way;
use crate::equations::Equations;

/// What is known of motions beside the one that goes on.
#[derive(Clone, Debug, PartialEq)]
pub enum Others {
    /// All that are possible; the one that goes on keeps contacts as they were.
    Possible(PossibleMotions),
    /// There may be others: too many contacts take part for all to be tried.
    Unexamined,
}

/// All motions that rigid contacts with friction allow at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct PossibleMotions {
    /// What each contact does in each of them.
    pub motions: Vec<Vec<PossibleContact>>,
    /// Which of them goes on.
    pub taken: Option<usize>,
    /// Whether there are more than these.
    pub beyond: Beyond,
}

/// Motions beside those that are listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Beyond {
    /// There are none.
    None,
    /// What is between some of them is possible as well.
    Between,
    /// So it is with forces of any size.
    LargerForces,
}

/// What one contact would do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PossibleContact {
    /// Among the equations' pairs.
    pub pair: usize,
    /// What.
    pub does: PossibleChange,
}

/// What a contact would do from an instant on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PossibleChange {
    /// The gap opens.
    Opens {
        /// m/s^2
        acceleration: f64,
    },
    /// It stays closed, without friction.
    Stays {
        /// The normal force, N.
        push: f64,
    },
    /// It sticks, or rolls.
    Sticks {
        /// The normal force, N.
        push: f64,
    },
    /// It slips.
    Slides {
        /// Which way the body slips, or the first of two against the other.
        way: Way,
        /// The normal force, N.
        push: f64,
        /// Rate of its slip, m/s^2.
        change: f64,
    },
}

impl PossibleMotions {
    /// All of them in sentences, with forces and accelerations.
    pub fn told(&self, equations: &Equations) -> String {
        let listed: Vec<String> = self.motions.iter().map(|motion| told(motion, equations)).collect();
        let more = match self.beyond {
            Beyond::LargerForces => "; and others, with larger forces",
            Beyond::Between => "; and others between them",
            Beyond::None => "",
        };
        match listed.len() {
            0 => "No motion without an impact is possible".into(),
            1 => format!("One motion is possible: {}{more}", listed[0]),
            count => format!("{count} motions are possible: {}{more}", listed.join("; or ")),
        }
    }

    fn held(&self) -> usize {
        let each = self.motions.iter().map(|motion| motion.capacity() * size_of::<PossibleContact>());
        self.motions.capacity() * size_of::<Vec<PossibleContact>>() + each.sum::<usize>()
    }
}

fn told(motion: &[PossibleContact], equations: &Equations) -> String {
    let each = motion.iter().map(|PossibleContact { pair, does }| {
        let name = &equations.pairs()[*pair].name;
        match does {
            PossibleChange::Opens { acceleration } => format!("`{name}` opens with {acceleration} m/s^2"),
            PossibleChange::Stays { push } => format!("`{name}` stays closed with the normal force {push} N"),
            PossibleChange::Sticks { push } => format!("`{name}` sticks with the normal force {push} N"),
            PossibleChange::Slides { way, push, change } => {
                let way = if *way == Way::Forward { "forward" } else { "backward" };
                format!(
                    "`{name}` slides {way} with the normal force {push} N, its slip changing by {change} m/s^2"
                )
            }
        }
    });
    each.collect::<Vec<_>>().join(", ")
}

impl Others {
    /// Bytes that it holds.
    pub(crate) fn held(&self) -> usize {
        let motions = match self {
            Self::Possible(motions) => motions.held(),
            Self::Unexamined => 0,
        };
        size_of::<Self>() + motions
    }
}
