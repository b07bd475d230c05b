//! Numbers in sets that are joined one after the other.

/// The numbers from 0 up, each in a set of its own at first.
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
}
