//! The motions of a model's islands, each found by itself, and of several of them as one where a quantity reads several.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::convert::Infallible;
use std::sync::{Arc, OnceLock};

use tumble_expr::Symbol;
use tumble_ode::{Occurrence, Of, Segment};

use crate::cache::Cache;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Record;

pub(crate) type Motion = tumble_ode::Motion<Equations>;

/// The motion of an island, from when it came to be to when it was joined to others or fell apart.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// The groups that it is of.
    pub(crate) groups: Vec<usize>,
    pub(crate) motion: Arc<Motion>,
}

/// Motions beside each other and one after the other, from one start to one end.
#[derive(Clone, Debug)]
pub(crate) struct Tracks {
    /// Which groups they are of, in order.
    pub(crate) groups: Vec<usize>,
    each: Vec<Track>,
    /// By group, those that it has a part in, in order.
    by_group: Arc<BTreeMap<usize, Vec<usize>>>,
    /// The last of each island.
    last: Arc<BTreeSet<usize>>,
    /// Whether an event of one of them has ended all.
    pub(crate) is_stopped: bool,
    /// Where each event is, in order of time: the motion and its index there.
    order: Arc<OnceLock<Vec<(usize, usize)>>>,
    /// All as one.
    whole: Arc<OnceLock<Arc<Motion>>>,
    joined: Cache<Vec<usize>, Motion>,
}

impl Tracks {
    /// The only motion, of all these groups.
    pub(crate) fn one(groups: Vec<usize>, motion: Arc<Motion>) -> Self {
        Self::new(vec![Track { groups, motion }], false)
    }

    /// Motions of which one that follows another comes later.
    pub(crate) fn new(each: Vec<Track>, is_stopped: bool) -> Self {
        let mut by_group: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, track) in each.iter().enumerate() {
            track.groups.iter().for_each(|group| by_group.entry(*group).or_default().push(index));
        }
        Self {
            groups: by_group.keys().copied().collect(),
            each,
            last: Arc::new(by_group.values().filter_map(|own| own.last()).copied().collect()),
            by_group: Arc::new(by_group),
            is_stopped,
            order: Arc::default(),
            whole: Arc::default(),
            joined: Cache::default(),
        }
    }

    /// The motions, each by itself.
    pub(crate) fn each(&self) -> &[Track] {
        &self.each
    }

    /// The last motion of each island.
    pub(crate) fn last(&self) -> impl Iterator<Item = &Motion> {
        self.last.iter().map(|index| &*self.each[*index].motion)
    }

    /// These groups, with those that were ever one motion with any of them, in order.
    pub(crate) fn ever_with(&self, groups: &[usize]) -> Vec<usize> {
        let mut found: BTreeSet<usize> = groups.iter().copied().collect();
        let mut ahead = groups.to_vec();
        while let Some(group) = ahead.pop() {
            for track in &self.by_group[&group] {
                ahead.extend(self.each[*track].groups.iter().filter(|group| found.insert(**group)));
            }
        }
        found.into_iter().collect()
    }

    /// All as one.
    pub(crate) fn whole(&self, equations: &Equations) -> &Arc<Motion> {
        match &self.each[..] {
            [one] => &one.motion,
            all => self.whole.get_or_init(|| Arc::new(joined(equations, all.iter()))),
        }
    }

    /// Those of some groups, with others as long as they are one motion with these; all, where they are one motion already.
    pub(crate) fn of(&self, groups: &[usize], equations: &Equations) -> Self {
        if self.each.len() == 1 {
            return self.clone();
        }
        let one = |motion| Self { is_stopped: self.is_stopped, ..Self::one(groups.to_vec(), motion) };
        if groups.len() == self.groups.len() {
            return one(Arc::clone(self.whole(equations)));
        }
        let own: BTreeSet<usize> = groups.iter().flat_map(|group| &self.by_group[group]).copied().collect();
        let own: Vec<&Track> = own.into_iter().map(|index| &self.each[index]).collect();
        if let [only] = own[..] {
            return one(Arc::clone(&only.motion));
        }
        let join = || Ok::<_, Infallible>(joined(equations, own.into_iter()));
        let motion = self.joined.get(&groups.to_vec(), join).unwrap_or_else(|never| match never {});
        one(motion)
    }

    /// Where each event is at which something happens, in order of time: the motion and its index there.
    pub(crate) fn events(&self) -> impl DoubleEndedIterator<Item = (usize, usize)> + Clone {
        self.all_events().iter().copied().filter(|event| !self.event(*event).record.is_nothing())
    }

    /// The same of all events.
    pub(crate) fn all_events(&self) -> &[(usize, usize)] {
        self.order.get_or_init(|| {
            let each = self.each.iter().enumerate();
            let places =
                each.flat_map(|(of, track)| (0..track.motion.events.len()).map(move |index| (of, index)));
            let mut all: Vec<(usize, usize)> = places.collect();
            all.sort_by(|a, b| self.event(*a).time.total_cmp(&self.event(*b).time));
            all
        })
    }

    /// Of each of [`Tracks::events`], its index among all events of the motion of some groups; `None` where they have no part in it.
    pub(crate) fn own_events(&self, groups: &[usize]) -> Vec<Option<usize>> {
        let is_own = |group: &usize| groups.binary_search(group).is_ok();
        // Of a run that is one motion its events are all.
        let is_of = |of: &Track| self.each.len() == 1 || of.groups.iter().any(is_own);
        let is_of: Vec<bool> = self.each.iter().map(is_of).collect();
        let (mut found, mut before) = (vec![], 0);
        for event in self.all_events() {
            let own = is_of[event.0].then_some(before);
            before += usize::from(own.is_some());
            if !self.event(*event).record.is_nothing() {
                found.push(own);
            }
        }
        found
    }

    /// An event by where it is.
    pub(crate) fn event(&self, (of, index): (usize, usize)) -> &Occurrence<Record> {
        &self.each[of].motion.events[index]
    }
}

/// Several motions as one.
fn joined<'a>(equations: &Equations, tracks: impl Iterator<Item = &'a Track>) -> Motion {
    let segments: Vec<Segment<'_, Mode, Record>> =
        tracks.map(|track| Segment { members: &track.groups, motion: &track.motion }).collect();
    Motion::joined(&segments, &|modes| equations.laid_out(modes))
}

impl Equations {
    /// Modes beside each other as one, and where each of its states is.
    pub(crate) fn laid_out(&self, modes: &[&Mode]) -> (Mode, Vec<Of>) {
        let mode = self.as_one(modes);
        let names: Vec<Vec<Symbol>> = modes.iter().map(|mode| self.states(mode)).collect();
        let each = names.iter().enumerate();
        let places: HashMap<&Symbol, Of> = each
            .flat_map(|(part, own)| {
                own.iter().enumerate().map(move |(state, symbol)| (symbol, [part, state]))
            })
            .collect();
        let layout = self.states(&mode).iter().map(|symbol| places[symbol]).collect();
        (mode, layout)
    }
}
