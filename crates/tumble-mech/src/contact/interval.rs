//! What happened at contacts in a run: when each began and ended, and the impulses of impacts.

use tumble_ode::{Event, Reason, Trajectory};

use crate::contact::pair::Pair;
use crate::mode::Mode;

/// What can happen to a pair at an instant; its tag on an event ends in this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// An impact, of no duration.
    Impact,
    /// Impacts have become too small to be followed one by one.
    Zeno,
    /// A contact begins that lasts.
    Start,
    /// A lasting contact ends.
    End,
    /// A body that a surface has let go inside itself is out of it.
    Clear,
}

impl Change {
    const ALL: [(Self, &'static str); 5] = [
        (Self::Impact, "impact"),
        (Self::Zeno, "zeno"),
        (Self::Start, "start"),
        (Self::End, "end"),
        (Self::Clear, "clear"),
    ];

    fn word(self) -> &'static str {
        Self::ALL.iter().find(|(change, _)| *change == self).map_or("", |(_, word)| word)
    }

    /// `floor.rod.tip.impact`
    pub(crate) fn tag(self, pair: &Pair) -> String {
        format!("{}.{}", pair.name, self.word())
    }

    /// Whether impacts that follow each other ever faster end there.
    pub(crate) fn ends_zeno_sequence(event: &Event) -> bool {
        let is_zeno = |tag: &String| Self::read(tag).is_some_and(|(_, change)| change == Self::Zeno);
        event.tags.iter().any(is_zeno)
    }

    /// The pair's name and the change that a tag tells of.
    fn read(tag: &str) -> Option<(&str, Self)> {
        let (pair, word) = tag.rsplit_once('.')?;
        let (change, _) = Self::ALL.iter().find(|(_, known)| *known == word)?;
        Some((pair, *change))
    }
}

/// A stretch of time in which a point of a body touches a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Index among the equations' pairs.
    pub pair: usize,
    /// When it begins, s.
    pub start: f64,
    /// When it ends, s; where the run ends first, the end of the run. A rigid impact ends when it begins.
    pub end: f64,
    /// Whether it is an impact of no duration.
    pub is_impact: bool,
    /// Whether it was still going on at the end of the run.
    pub is_open: bool,
}

/// An impulse on a body, of a rigid impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulse {
    /// Name of the pair or of the pivot.
    pub load: String,
    /// Index of the body.
    pub body: usize,
    /// From its centre of mass to the point of action, m, world axes.
    pub arm: [f64; 2],
    /// N s, world axes.
    pub impulse: [f64; 2],
}

/// Every contact of a run, in the order in which they begin.
pub(crate) fn contacts(pairs: &[Pair], trajectory: &Trajectory<Mode>) -> Vec<Contact> {
    let end = trajectory.end().unwrap_or(0.0);
    let mut found: Vec<Contact> = vec![];
    for Event { time, tags, .. } in &trajectory.events {
        for (name, change) in tags.iter().filter_map(|tag| Change::read(tag)) {
            let Some(pair) = pairs.iter().position(|pair| pair.name == name) else { continue };
            let contact =
                |end, is_impact| Contact { pair, start: *time, end, is_impact, is_open: !is_impact };
            match change {
                Change::Impact => found.push(contact(*time, true)),
                Change::Start => found.push(contact(end, false)),
                Change::Zeno | Change::Clear => {}
                Change::End => {
                    if let Some(open) = found.iter_mut().rev().find(|open| open.pair == pair && open.is_open)
                    {
                        (open.end, open.is_open) = (*time, false);
                    }
                }
            }
        }
    }
    found
}

/// How many Zeno sequences of impacts have come to an end in contact.
pub(crate) fn zeno_sequences(trajectory: &Trajectory<Mode>) -> usize {
    trajectory.events.iter().filter(|event| Change::ends_zeno_sequence(event)).count()
}

impl crate::Run {
    /// Every contact of the motion, in the order in which they begin.
    pub fn contacts(&self) -> Vec<Contact> {
        contacts(self.equations.pairs(), &self.trajectory)
    }

    /// How many times impacts that followed each other ever faster have ended in contact.
    pub fn zeno_sequences(&self) -> usize {
        zeno_sequences(&self.trajectory)
    }

    /// Impulses of the impacts at an event, those of pivots included; the event by its index in the trajectory.
    pub fn impulses(&self, event: usize) -> Result<Vec<Impulse>, Reason> {
        let Some(event) = self.trajectory.events.get(event) else { return Ok(vec![]) };
        self.equations.impulses(event, &self.trajectory, &self.inputs)
    }
}
