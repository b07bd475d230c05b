//! Motions that go on beside each other, as one: pieces are cut wherever one of any of them ends.

use std::collections::HashMap;

use crate::coefficients::Coefficients;
use crate::trajectory::{Event, Piece, Side, Trajectory};
use crate::work::Work;

/// Where a state of all is found: whose it is, and its index there.
pub type Of = [usize; 2];

/// A mode of all that has no name yet, and its states in order.
pub type AsOne<'a, Mode> = dyn Fn(&[&Mode]) -> (Mode, Vec<Of>) + 'a;

impl<Mode, Record: Clone> Trajectory<Mode, Record> {
    /// These motions, which begin and end together, as one. None of them may have pieces in another parameter than the time.
    ///
    /// `as_one` makes one mode of theirs, and says what its states are. The causes of an event stay those of the motion that it
    /// belongs to.
    ///
    /// # Panics
    /// If a piece has a time series.
    pub fn joined(parts: &[&Self], as_one: &AsOne<'_, Mode>) -> Self {
        let mut joining = Joining { parts, as_one, modes: vec![], layouts: vec![], known: HashMap::new() };
        let pieces = joining.pieces();
        let events = joining.events();
        let largest = |of: fn(&Self) -> &[f64]| {
            let groups = parts.iter().map(|part| of(part).len()).max().unwrap_or_default();
            let one = |group| parts.iter().filter_map(move |part| of(part).get(group).copied());
            (0..groups).map(|group: usize| one(group).fold(0.0, f64::max)).collect()
        };
        Self {
            modes: joining.modes,
            pieces,
            events,
            work: parts.iter().map(|part| part.work).sum::<Work>(),
            order: parts.iter().map(|part| part.order).max().unwrap_or_default(),
            scales: largest(|part| &part.scales),
            rounding: largest(|part| &part.rounding),
        }
    }
}

struct Joining<'a, Mode, Record> {
    parts: &'a [&'a Trajectory<Mode, Record>],
    as_one: &'a AsOne<'a, Mode>,
    modes: Vec<Mode>,
    layouts: Vec<Vec<Of>>,
    /// By the modes of the parts.
    known: HashMap<Vec<usize>, usize>,
}

impl<Mode, Record: Clone> Joining<'_, Mode, Record> {
    /// Index of the mode that the parts' modes are together.
    fn mode(&mut self, of: &[usize]) -> usize {
        if let Some(known) = self.known.get(of) {
            return *known;
        }
        let modes: Vec<&Mode> = self.parts.iter().zip(of).map(|(part, mode)| &part.modes[*mode]).collect();
        let (mode, layout) = (self.as_one)(&modes);
        self.modes.push(mode);
        self.layouts.push(layout);
        self.known.insert(of.to_vec(), self.modes.len() - 1);
        self.modes.len() - 1
    }

    fn pieces(&mut self) -> Vec<Piece> {
        let parts = self.parts;
        let mut next = vec![0; parts.len()];
        let mut pieces = vec![];
        let mut now = f64::NEG_INFINITY;
        loop {
            let here: Option<Vec<&Piece>> =
                parts.iter().zip(&next).map(|(part, index)| part.pieces.get(*index)).collect();
            let Some(here) = here.filter(|here| !here.is_empty()) else { return pieces };
            now = here.iter().map(|piece| piece.start).fold(now, f64::max);
            let end = here.iter().map(|piece| piece.end).fold(f64::INFINITY, f64::min);
            if end > now {
                pieces.push(self.piece(&here, now, end));
            }
            for (index, piece) in next.iter_mut().zip(&here) {
                *index += usize::from(piece.end <= end);
            }
        }
    }

    /// What all of these pieces are between two times.
    fn piece(&mut self, here: &[&Piece], start: f64, end: f64) -> Piece {
        assert!(here.iter().all(|piece| piece.time_series.is_none()), "pieces in the time");
        let modes: Vec<usize> = here.iter().map(|piece| piece.mode).collect();
        let mode = self.mode(&modes);
        let from = |piece: &Piece| if piece.start == start { 0.0 } else { piece.parameter_at(start) };
        // What rounding has left out of a time is that of the part to which something happens then.
        let begins = here.iter().find(|piece| piece.start == start && piece.left_out != 0.0);
        let ends = here.iter().find(|piece| piece.end == end).expect("one of them ends there");
        let series: Vec<Vec<Vec<f64>>> = here.iter().map(|piece| piece.series_at(from(piece)).0).collect();
        let order = series.iter().flatten().map(Vec::len).max().unwrap_or_default();
        let rows = self.layouts[mode].iter().map(|[part, state]| {
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
            length: ends.length - from(ends),
            states: Coefficients::of(rows.iter().map(Vec::as_slice)),
            time_series: None,
        }
    }

    fn events(&mut self) -> Vec<Event<Record>> {
        let parts = self.parts;
        let each = parts.iter().enumerate();
        let mut order: Vec<Of> =
            each.flat_map(|(part, of)| (0..of.events.len()).map(move |event| [part, event])).collect();
        order.sort_by(|a, b| parts[a[0]].events[a[1]].time.total_cmp(&parts[b[0]].events[b[1]].time));
        let mut modes: Vec<usize> = parts.iter().map(|part| part.first_mode().unwrap_or_default()).collect();
        // Of each, the events that have been dealt with.
        let mut dealt = vec![0; parts.len()];
        let mut events = Vec::with_capacity(order.len());
        for [part, index] in order {
            let event = &parts[part].events[index];
            let before = self.at(&modes, event.time, &dealt);
            modes[part] = event.mode_after;
            dealt[part] = index + 1;
            let after = self.at(&modes, event.time, &dealt);
            events.push(Event {
                before: before.1,
                after: after.1,
                mode_before: before.0,
                mode_after: after.0,
                ..event.clone()
            });
        }
        events
    }

    /// The mode of all and its states at a time, when so many events of each have been dealt with.
    fn at(&mut self, modes: &[usize], time: f64, dealt: &[usize]) -> (usize, Vec<f64>) {
        let states = self.parts.iter().zip(dealt).map(|(part, dealt)| {
            let before = dealt.checked_sub(1).map(|last| &part.events[last]).filter(|last| last.time == time);
            let next = part.events.get(*dealt).filter(|next| next.time == time);
            match (before, next) {
                (Some(event), _) => event.after.clone(),
                (None, Some(event)) => event.before.clone(),
                (None, None) => part.states_at(time, Side::Before).unwrap_or_default(),
            }
        });
        let states: Vec<Vec<f64>> = states.collect();
        let mode = self.mode(modes);
        let value = |[part, state]: &Of| states[*part].get(*state).copied().unwrap_or(f64::NAN);
        (mode, self.layouts[mode].iter().map(value).collect())
    }
}
