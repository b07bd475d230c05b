//! What a run cost, in counts that do not depend on the machine.

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
