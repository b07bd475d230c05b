//! When each contact of a run began and ended.

use tumble_ode::Occurrence;

use crate::contact::change::Change;
use crate::record::Happening;

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

impl crate::Run {
    /// Every contact of the motion, in the order in which they begin; an impact after which a pair stays in contact begins that one.
    pub fn contacts(&self) -> Vec<Contact> {
        let end = self.end().unwrap_or(0.0);
        let mut found: Vec<Contact> = vec![];
        for Occurrence { time, record, .. } in self.events() {
            for happening in &record.happened {
                let Happening::Contact { pair, change } = *happening else { continue };
                let contact =
                    |end, is_impact| Contact { pair, start: *time, end, is_impact, is_open: !is_impact };
                match change {
                    Change::Impact => found.push(contact(*time, true)),
                    Change::Start => {
                        let mut now = found.iter_mut().rev().take_while(|one| one.start == *time);
                        let impact = now.find(|one| one.pair == pair && one.is_impact);
                        // What ends a Zeno sequence comes after infinitely many impacts.
                        match impact.filter(|_| !record.zeno_sequences().any(|ended| ended == pair)) {
                            Some(impact) => *impact = contact(end, false),
                            None => found.push(contact(end, false)),
                        }
                    }
                    Change::Zeno | Change::Clear | Change::Slides | Change::Sticks | Change::Rolls => {}
                    Change::Stops | Change::Turns => {}
                    Change::End => {
                        let mut latest = found.iter_mut().rev();
                        if let Some(open) = latest.find(|open| open.pair == pair && open.is_open) {
                            (open.end, open.is_open) = (*time, false);
                        }
                    }
                }
            }
        }
        found
    }

    /// How many times impacts that followed each other ever faster have ended in contact.
    pub fn zeno_sequences(&self) -> usize {
        self.events().filter(|event| event.record.ends_zeno_sequence()).count()
    }
}
