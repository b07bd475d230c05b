//! What a run cost, in counts that do not depend on the machine.

use std::iter::Sum;

/// Counts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps accepted.
    pub steps: u64,
    /// Steps tried and found too long.
    pub rejected: u64,
    /// Taylor expansions: one a step (a rejected step is shortened, not expanded again), and one for each sign of a
    /// branch that turned out not to hold.
    pub expansions: u64,
    /// Evaluations of the rates by the independent check.
    pub checks: u64,
    /// Steps that are exact because the solution is a polynomial in time.
    pub exact_steps: u64,
    /// Changes of sign of branches (abs, sign, step, min, max, if).
    pub flips: u64,
    /// Knots of tables passed.
    pub knots: u64,
    /// Steps cut where a length, root or power is least.
    pub turns: u64,
    /// Expansions of lazily evaluated guards that the motion might have reached within a step.
    pub near: u64,
    /// Parts of steps that were looked at as a whole.
    pub enclosures: u64,
    /// Steps that were cut where they were not known as a whole.
    pub cuts: u64,
    /// Tapes built, one a mode.
    pub modes: u64,
}

impl Sum for Work {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |a, b| Self {
            steps: a.steps + b.steps,
            rejected: a.rejected + b.rejected,
            expansions: a.expansions + b.expansions,
            checks: a.checks + b.checks,
            exact_steps: a.exact_steps + b.exact_steps,
            flips: a.flips + b.flips,
            knots: a.knots + b.knots,
            turns: a.turns + b.turns,
            near: a.near + b.near,
            enclosures: a.enclosures + b.enclosures,
            cuts: a.cuts + b.cuts,
            modes: a.modes + b.modes,
        })
    }
}
