//! Components beside each other: the one that is furthest behind goes on next, so that none is far beyond where all end; what is
//! beyond is cut off.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use tumble_ode::{Accuracy, InitialState, Reason, Refusal};

use super::Islands;
use super::start::Places;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Happening;
use crate::tracks::{Motion, Track, Tracks};

/// One motion at a time goes on by this part of the run: what it uses is at hand, and little is done in vain where another ends all.
const LEAD: f64 = 1.0 / 16.0;

/// Why motions could not all go on to the end.
pub(crate) struct Refused {
    pub(crate) refusal: Refusal,
    /// The motion that is at fault, where it is one.
    pub(crate) motion: Option<Arc<Motion>>,
}

/// What motions have come to on their way.
#[derive(Clone, Copy)]
pub(crate) struct Reached<'a> {
    /// What all have come to, s.
    pub(crate) time: f64,
    race: &'a Race<'a>,
}

impl Reached<'_> {
    /// All motions up to there.
    pub(crate) fn so_far(self) -> Tracks {
        let mut tracks = self.race.components.iter().flat_map(Islands::so_far).collect();
        cut(&mut tracks, Some(self.time));
        Tracks::new(tracks, false)
    }
}

impl Equations {
    /// The motions from a start, with why they could not all go on to the end, if they could not; `progress` is told what they have
    /// come to.
    pub(crate) fn follow(
        &self,
        start: &InitialState<Mode>,
        until: f64,
        accuracy: Accuracy,
        progress: &mut dyn FnMut(Reached<'_>) -> ControlFlow<()>,
    ) -> (Tracks, Option<Refused>) {
        let places = Places::of(self, start);
        let components = 0..self.components().all().len();
        let of = |component: usize| Islands::new(self, component, &places, until, accuracy);
        let mut race = Race::new(components.map(of).collect(), until - start.time);
        race.run(progress);
        race.finish()
    }
}

struct Race<'a> {
    components: Vec<Islands<'a>>,
    /// Of those that have come to rest for good, when.
    rest: Vec<Option<f64>>,
    /// The first that may not be at rest.
    witness: usize,
    /// When all end, if not where they were to.
    end: Option<f64>,
    /// Why that is, where it is no event, and which component is at fault, where it is one.
    refused: Option<(Option<usize>, Refusal)>,
    /// By how much one may lead all others, s.
    lead: f64,
}

impl<'a> Race<'a> {
    fn new(mut components: Vec<Islands<'a>>, span: f64) -> Self {
        share_memory(&mut components);
        Self {
            rest: vec![None; components.len()],
            components,
            witness: 0,
            end: None,
            refused: None,
            lead: span * LEAD,
        }
    }

    /// Goes on until all have ended.
    fn run(&mut self, progress: &mut dyn FnMut(Reached<'_>) -> ControlFlow<()>) {
        let mut behind: BinaryHeap<Reverse<(Time, usize)>> = (0..self.components.len())
            .map(|index| Reverse((Time(self.components[index].time()), index)))
            .collect();
        while let Some(Reverse((Time(time), index))) = behind.pop() {
            if self.end.is_some_and(|end| time >= end) {
                break;
            }
            let next = behind.peek().map_or(f64::INFINITY, |Reverse((Time(time), _))| *time);
            if self.lead(index, next, progress).is_break() {
                let time = next.min(self.components[index].time());
                self.end = Some(time);
                self.refused = Some((None, Refusal { time, reason: Reason::Interrupted }));
                return;
            }
            self.end_at_rest();
            let component = &self.components[index];
            if !component.is_done() {
                behind.push(Reverse((Time(component.time()), index)));
            }
        }
    }

    /// Lets one that is furthest behind go on until it leads by some time; `next` is that of the one after it. Whether it was
    /// interrupted.
    fn lead(
        &mut self,
        index: usize,
        next: f64,
        progress: &mut dyn FnMut(Reached<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        loop {
            let component = &mut self.components[index];
            component.advance();
            let (time, is_done) = (component.time(), component.is_done());
            if let Some(end) = component.end.filter(|end| self.end.is_none_or(|known| *end < known)) {
                self.end = Some(end);
                self.refused = component.refused.clone().map(|(_, refusal)| (Some(index), refusal));
            }
            if component.refused.is_some() && is_done {
                return ControlFlow::Continue(());
            }
            if component.has_rest() {
                self.rest[index] = component.rest();
            }
            let is_last = is_done && next.is_infinite();
            let reached = Reached { time: time.min(next), race: self };
            if progress(reached).is_break() && !is_last {
                return ControlFlow::Break(());
            }
            if is_done || time > next + self.lead || self.end.is_some_and(|end| time >= end) {
                return ControlFlow::Continue(());
            }
        }
    }

    /// Ends the motions where the last of them has come to rest, once one has: the others may lie still from the start.
    fn end_at_rest(&mut self) {
        let stops = self.components.first().is_some_and(|first| first.equations.model().stops_at_rest);
        if !stops || self.rest.iter().all(Option::is_none) {
            return;
        }
        // All before this one are known to be at rest.
        while let Some(rest) = self.rest.get_mut(self.witness) {
            *rest = rest.or_else(|| self.components[self.witness].rest());
            if rest.is_none() {
                return;
            }
            self.witness += 1;
        }
        let last = self.rest.iter().flatten().copied().fold(0.0, f64::max);
        if self.end.is_none_or(|end| last < end) {
            self.end = Some(last);
            self.refused = None;
        }
    }

    fn finish(self) -> (Tracks, Option<Refused>) {
        let Self { components, end, refused, .. } = self;
        let mut tracks = vec![];
        let mut at_fault = None;
        for (index, component) in components.into_iter().enumerate() {
            let (own, fault) = component.finish();
            if refused.as_ref().is_some_and(|(of, _)| *of == Some(index)) {
                at_fault = fault.map(|fault| Arc::clone(&own[fault].motion));
            }
            tracks.extend(own);
        }
        cut(&mut tracks, end);
        let is_stopped = end.is_some() && refused.is_none();
        let refused = refused.map(|(_, refusal)| Refused { refusal, motion: at_fault });
        (Tracks::new(tracks, is_stopped), refused)
    }
}

impl Tracks {
    /// All up to a time, s.
    pub(crate) fn until(&self, time: f64) -> Self {
        let mut tracks = self.each().to_vec();
        cut(&mut tracks, Some(time));
        Self::new(tracks, false)
    }
}

/// The islands of all components count their memory together.
fn share_memory(components: &mut [Islands<'_>]) {
    let mut all = components.iter_mut().flat_map(|component| &mut component.all);
    if let Some(first) = all.next() {
        all.for_each(|other| other.solver.share_memory(&first.solver));
    }
}

/// Ends motions at a time, s, if it is not where they were to end. What comes to rest then is all at rest; that some were before is not
/// told.
fn cut(tracks: &mut Vec<Track>, end: Option<f64>) {
    let mut is_told = false;
    for track in tracks.iter_mut() {
        let motion = Arc::make_mut(&mut track.motion);
        if let Some(end) = end {
            motion.cut(end);
        }
        forget_rest(motion, |time| Some(time) != end || std::mem::replace(&mut is_told, true));
    }
    // What began at the end or beyond it has not been, but for what could not begin at all.
    let is_known = |track: &Track| track.motion.start().is_some();
    let known: HashSet<usize> =
        tracks.iter().filter(|track| is_known(track)).flat_map(|track| track.groups.clone()).collect();
    tracks.retain(|track| is_known(track) || !track.groups.iter().any(|group| known.contains(group)));
}

/// Takes out that bodies have come to rest at times that are to be forgotten, and the events that were nothing else.
fn forget_rest(motion: &mut Motion, mut forgets: impl FnMut(f64) -> bool) {
    motion.events.retain_mut(|event| {
        if !event.record.happened.contains(&Happening::Rest) || !forgets(event.time) {
            return true;
        }
        event.record.happened.retain(|happening| *happening != Happening::Rest);
        let is_change = event.before != event.after || event.mode_before != event.mode_after;
        is_change || !event.record.happened.is_empty()
    });
}

/// A time that is compared as a number.
#[derive(Clone, Copy, PartialEq)]
struct Time(f64);

impl Eq for Time {}

impl PartialOrd for Time {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Time {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
