//! Lazily evaluated guards of the same states: what is true of all of them is found at once.

use std::ops::Range;

use super::Watch;

/// Guards beside each other that depend on the same states.
pub(super) struct Bunch {
    pub(super) members: Range<usize>,
    /// The steepest slope of any by each of the states; `None` where one has no bound.
    slopes: Option<Vec<(usize, f64)>>,
    /// The least clearance of any when it was looked at last.
    clearance: f64,
    /// By how much any of them may have changed since.
    spent: f64,
}

impl Bunch {
    pub(super) fn all(watches: &[Watch]) -> Vec<Self> {
        let mut bunches: Vec<Self> = vec![];
        for (index, watch) in watches.iter().enumerate() {
            if !bunches.last_mut().is_some_and(|bunch| bunch.takes(watch)) {
                let members = index..index;
                bunches.push(Self { members, slopes: watch.slopes.clone(), clearance: 0.0, spent: 0.0 });
            }
            if let Some(bunch) = bunches.last_mut() {
                bunch.members.end = index + 1;
            }
        }
        bunches
    }

    /// Adds the slopes of one of the same states.
    fn takes(&mut self, watch: &Watch) -> bool {
        let (Some(own), Some(its)) = (&mut self.slopes, &watch.slopes) else { return false };
        let is_alike = own.iter().map(|(state, _)| state).eq(its.iter().map(|(state, _)| state));
        if is_alike {
            own.iter_mut().zip(its).for_each(|((_, steepest), (_, slope))| *steepest = steepest.max(*slope));
        }
        is_alike
    }

    /// By how much any of them can change while the states travel so far.
    fn change(&self, travel: &[f64]) -> f64 {
        match &self.slopes {
            None => f64::INFINITY,
            Some(slopes) => slopes.iter().map(|(state, slope)| slope * travel[*state]).sum(),
        }
    }

    /// Whether none of them comes to zero while the states travel so far.
    pub(super) fn is_clear(&self, travel: &[f64]) -> bool {
        self.clearance - self.spent > self.change(travel)
    }

    /// Tells each of them by how much it may have changed.
    pub(super) fn settle(&mut self, members: &mut [Watch]) {
        members.iter_mut().for_each(|watch| watch.clearance -= self.spent);
        self.spent = 0.0;
    }

    /// They have been looked at.
    pub(super) fn learn(&mut self, members: &[Watch]) {
        // NaN is no clearance.
        let least =
            |least: f64, watch: &Watch| if watch.clearance >= least { least } else { watch.clearance };
        self.clearance = members.iter().fold(f64::INFINITY, least);
    }

    /// The states have travelled so far.
    pub(super) fn moved(&mut self, travel: &[f64]) {
        self.spent += self.change(travel);
    }

    /// Whether the states that they depend on are the same.
    pub(super) fn stays(&self, same: impl Fn(usize) -> bool) -> bool {
        self.slopes.as_ref().is_some_and(|slopes| slopes.iter().all(|(state, _)| same(*state)))
    }

    /// Nothing is known of them any more.
    pub(super) fn forget(&mut self) {
        self.spent = f64::INFINITY;
    }
}
