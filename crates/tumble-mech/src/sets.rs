//! Numbers in sets that are joined one after the other.

use std::collections::HashMap;

/// The numbers from 0 up, each in a set of its own at first.
#[derive(Clone)]
pub(crate) struct Sets {
    parents: Vec<usize>,
}

impl Sets {
    pub(crate) fn new(count: usize) -> Self {
        Self { parents: (0..count).collect() }
    }

    /// The least number of the set that a number is in.
    pub(crate) fn least(&mut self, of: usize) -> usize {
        let mut least = of;
        while self.parents[least] != least {
            self.parents[least] = self.parents[self.parents[least]];
            least = self.parents[least];
        }
        least
    }

    /// Makes one set of those of two numbers.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.least(a), self.least(b));
        self.parents[a.max(b)] = a.min(b);
    }

    /// Makes one set of all.
    pub(crate) fn join_all(&mut self) {
        self.parents.fill(0);
    }

    /// The sets by their least numbers, each in order, and by number the index of its set.
    pub(crate) fn in_order(mut self) -> (Vec<Vec<usize>>, Vec<usize>) {
        let mut sets: Vec<Vec<usize>> = vec![];
        let mut by_least: HashMap<usize, usize> = HashMap::new();
        let mut of = vec![];
        for number in 0..self.parents.len() {
            let set = *by_least.entry(self.least(number)).or_insert(sets.len());
            if set == sets.len() {
                sets.push(vec![]);
            }
            sets[set].push(number);
            of.push(set);
        }
        (sets, of)
    }
}
