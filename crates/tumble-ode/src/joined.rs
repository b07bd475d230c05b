//! Motions that go on beside each other and one after the other, as one: pieces are cut wherever one of any of them ends.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;
use std::rc::Rc;

use crate::coefficients::Coefficients;
use crate::trajectory::{Occurrence, Piece, Side, Trajectory};
use crate::work::Work;

/// Where a state of all is found: which motion of those beside each other, and its index there.
pub type Of = [usize; 2];

/// A mode of several that go on beside each other, and its states in order.
pub type AsOne<'a, Mode> = dyn Fn(&[&Mode]) -> (Mode, Vec<Of>) + 'a;

/// The motion of some members, from an instant at which they came together to one at which they part.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'a, Mode, Record> {
    /// Whose motion it is, in order.
    pub members: &'a [usize],
    /// The motion.
    pub motion: &'a Trajectory<Mode, Record>,
}

impl<Mode: Clone + Eq + Hash, Record: Clone> Trajectory<Mode, Record> {
    /// These motions as one: at any time each member has a part in one of them, and one that follows another comes later in the list.
    ///
    /// `as_one` makes one mode of those of several, and says what its states are. The causes of an event stay those of the motion
    /// that it belongs to.
    ///
    /// # Panics
    /// If a piece that has a time series goes on beside others.
    pub fn joined(segments: &[Segment<'_, Mode, Record>], as_one: &AsOne<'_, Mode>) -> Self {
        let motions = || segments.iter().map(|segment| segment.motion);
        let mut joining =
            Joining { segments, as_one, modes: vec![], by_mode: HashMap::new(), known: HashMap::new() };
        let pieces = joining.pieces();
        let events = joining.events();
        let largest = |of: fn(&Self) -> &[f64]| {
            let groups = motions().map(|motion| of(motion).len()).max().unwrap_or_default();
            let one = |group| motions().filter_map(move |motion| of(motion).get(group).copied());
            (0..groups).map(|group: usize| one(group).fold(0.0, f64::max)).collect()
        };
        Self {
            modes: joining.modes,
            pieces,
            events,
            work: motions().map(|motion| motion.work).sum::<Work>(),
            order: motions().map(|motion| motion.order).max().unwrap_or_default(),
            scales: largest(|motion| &motion.scales),
            rounding: largest(|motion| &motion.rounding),
        }
    }
}

/// Index of a motion, and of its mode.
type ModeOf = (usize, usize);

struct Joining<'a, Mode, Record> {
    segments: &'a [Segment<'a, Mode, Record>],
    as_one: &'a AsOne<'a, Mode>,
    modes: Vec<Mode>,
    by_mode: HashMap<Mode, usize>,
    /// Index of the mode that several modes are together, and its states.
    known: HashMap<Vec<ModeOf>, (usize, Rc<[Of]>)>,
}

impl<Mode: Clone + Eq + Hash, Record: Clone> Joining<'_, Mode, Record> {
    /// What modes of motions beside each other are together.
    fn mode(&mut self, of: &[ModeOf]) -> (usize, Rc<[Of]>) {
        if let Some((mode, layout)) = self.known.get(of) {
            return (*mode, Rc::clone(layout));
        }
        let modes: Vec<&Mode> =
            of.iter().map(|(segment, mode)| &self.segments[*segment].motion.modes[*mode]).collect();
        let (mode, layout) = (self.as_one)(&modes);
        let next = self.modes.len();
        let index = *self.by_mode.entry(mode.clone()).or_insert(next);
        if index == next {
            self.modes.push(mode);
        }
        let found: (usize, Rc<[Of]>) = (index, layout.into());
        self.known.insert(of.to_vec(), found.clone());
        found
    }

    fn pieces(&mut self) -> Vec<Piece> {
        let segments = self.segments;
        let starts = segments
            .iter()
            .enumerate()
            .filter_map(|(index, of)| Some((index, of.motion.pieces.first()?.start)));
        let mut later: Vec<(usize, f64)> = starts.collect();
        later.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let mut later = later.into_iter().peekable();
        // Motions that have begun and not ended, each with the piece that it has come to.
        let mut here: Vec<(usize, usize)> = vec![];
        let mut pieces = vec![];
        let mut now = f64::NEG_INFINITY;
        loop {
            if here.is_empty() {
                let Some((_, start)) = later.peek() else { return pieces };
                now = now.max(*start);
            }
            while let Some((segment, _)) = later.next_if(|(_, start)| *start <= now) {
                here.push((segment, 0));
                here.sort_unstable();
            }
            let piece = |(segment, index): &(usize, usize)| &segments[*segment].motion.pieces[*index];
            let next = later.peek().map_or(f64::INFINITY, |(_, start)| *start);
            let end = here.iter().map(|place| piece(place).end).fold(next, f64::min);
            if end > now {
                pieces.push(self.piece(&here, now, end));
            }
            here.iter_mut().for_each(|place| place.1 += usize::from(piece(place).end <= end));
            here.retain(|(segment, index)| *index < segments[*segment].motion.pieces.len());
            now = end;
        }
    }

    /// What all of these pieces are between two times.
    fn piece(&mut self, here: &[(usize, usize)], start: f64, end: f64) -> Piece {
        let pieces: Vec<&Piece> =
            here.iter().map(|(segment, index)| &self.segments[*segment].motion.pieces[*index]).collect();
        let modes: Vec<ModeOf> =
            here.iter().zip(&pieces).map(|((segment, _), piece)| (*segment, piece.mode)).collect();
        let (mode, layout) = self.mode(&modes);
        if let [only] = pieces[..]
            && (only.start, only.end) == (start, end)
        {
            return Piece { mode, ..only.clone() };
        }
        assert!(pieces.iter().all(|piece| piece.time_series.is_none()), "pieces in the time");
        let from = |piece: &Piece| if piece.start == start { 0.0 } else { piece.parameter_at(start) };
        // What rounding has left out of a time is that of the motion to which something happens then.
        let begins = pieces.iter().find(|piece| piece.start == start && piece.left_out != 0.0);
        let ends = pieces.iter().find(|piece| piece.end == end);
        let length = match ends {
            Some(piece) => piece.length - from(piece),
            None => pieces[0].parameter_at(end) - from(pieces[0]),
        };
        let series: Vec<Vec<Vec<f64>>> = pieces.iter().map(|piece| piece.series_at(from(piece)).0).collect();
        let order = series.iter().flatten().map(Vec::len).max().unwrap_or_default();
        let rows = layout.iter().map(|[part, state]| {
            let mut row = series[*part][*state].clone();
            row.resize(order, 0.0);
            row
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        Piece {
            start,
            left_out: begins.map_or(0.0, |piece| piece.left_out),
            end,
            mode,
            length,
            states: Coefficients::of(rows.iter().map(Vec::as_slice)),
            time_series: None,
        }
    }

    fn events(&mut self) -> Vec<Occurrence<Record>> {
        let segments = self.segments;
        let each = segments.iter().enumerate();
        let mut order: Vec<Of> =
            each.flat_map(|(of, own)| (0..own.motion.events.len()).map(move |event| [of, event])).collect();
        let event_at = |[of, index]: Of| &segments[of].motion.events[index];
        order.sort_by(|a, b| event_at(*a).time.total_cmp(&event_at(*b).time));
        let mut modes: Vec<usize> =
            segments.iter().map(|of| of.motion.first_mode().unwrap_or_default()).collect();
        // Of each, the events that have been dealt with.
        let mut dealt = vec![0; segments.len()];
        let mut events = Vec::with_capacity(order.len());
        for [of, index] in order {
            let event = event_at([of, index]);
            let beside = self.beside(of, event.time);
            let before = self.at(&beside, &modes, event.time, &dealt);
            modes[of] = event.mode_after;
            dealt[of] = index + 1;
            let after = self.at(&beside, &modes, event.time, &dealt);
            events.push(Occurrence {
                before: before.1,
                after: after.1,
                mode_before: before.0,
                mode_after: after.0,
                ..event.clone()
            });
        }
        events
    }

    /// Motions that go on beside one at a time, itself among them, in order: of two that follow each other then, that which is known
    /// to be over is left out.
    fn beside(&self, of: usize, time: f64) -> Vec<usize> {
        let mut found = vec![of];
        let mut taken: HashSet<usize> = self.segments[of].members.iter().copied().collect();
        for other in (0..of).rev().chain(of + 1..self.segments.len()) {
            let Segment { members: own, motion } = self.segments[other];
            let holds = motion.start().is_some_and(|start| start <= time) && Some(time) <= motion.end();
            if holds && own.iter().all(|member| !taken.contains(member)) {
                found.push(other);
                taken.extend(own);
            }
        }
        found.sort_unstable();
        found
    }

    /// The mode of motions beside each other and their states at a time, when so many events of each have been dealt with.
    fn at(&mut self, beside: &[usize], modes: &[usize], time: f64, dealt: &[usize]) -> (usize, Vec<f64>) {
        let states = beside.iter().map(|of| {
            let (motion, dealt) = (self.segments[*of].motion, dealt[*of]);
            let before =
                dealt.checked_sub(1).map(|last| &motion.events[last]).filter(|last| last.time == time);
            let next = motion.events.get(dealt).filter(|next| next.time == time);
            match (before, next) {
                (Some(event), _) => event.after.clone(),
                (None, Some(event)) => event.before.clone(),
                (None, None) => motion.states_at(time, Side::Before).unwrap_or_default(),
            }
        });
        let states: Vec<Vec<f64>> = states.collect();
        let modes: Vec<ModeOf> = beside.iter().map(|of| (*of, modes[*of])).collect();
        let (mode, layout) = self.mode(&modes);
        let value = |[part, state]: &Of| states[*part].get(*state).copied().unwrap_or(f64::NAN);
        (mode, layout.iter().map(value).collect())
    }
}
