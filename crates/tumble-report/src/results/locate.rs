//! Where along a sweep an answer is greatest or least: between the best run and its neighbours more runs are made until the
//! parameter is known to [`DIGITS`] digits, or until answers differ by no more than their errors.
//!
//! What is stated is an interval: at both of its ends a run was made whose answer is worse than the best by more than both errors.
//! If the answer changes continuously with the parameter, a greatest (least) value lies in it. Beyond the neighbours of the
//! best run nothing is claimed.

use tumble_mech::Extreme;

/// Digits to which the parameter is found.
pub(crate) const DIGITS: i32 = 4;
/// A sweep of fewer runs is too coarse to look between them: its best run and the neighbours are all that is told.
pub(crate) const LEAST_RUNS: usize = 8;
/// More runs than these are not made for one extreme: the golden section has shortened its interval ten thousand times by then.
const MOST_MADE: usize = 20;
/// The part of the wider side at which it is cut: the smaller part of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// An answer of one run of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Value of what is swept, in its unit.
    pub at: f64,
    /// The answer, in its unit.
    pub value: f64,
    /// Error stated of it; infinite where nothing is known of it.
    pub error: f64,
}

/// The best run of a sweep with its neighbours, which is all that is kept of the runs as they are made.
#[derive(Clone, Debug, Default)]
pub(crate) struct Best {
    sign: f64,
    last: Option<Sample>,
    before: Option<Sample>,
    best: Option<Sample>,
    after: Option<Sample>,
    /// Whether the last run is the best.
    is_last: bool,
    /// Whether an answer differs from the best by more than both errors.
    differs: bool,
    /// The runs that are as good but for their errors: how many, the first and the last.
    equal: Option<Equal>,
    runs: usize,
}

impl Best {
    /// Of no run.
    pub(crate) fn new(which: Extreme) -> Self {
        let sign = if which == Extreme::Greatest { 1.0 } else { -1.0 };
        Self { sign, ..Self::default() }
    }

    /// Adds the next run; `None` where it has no answer.
    pub(crate) fn add(&mut self, sample: Option<Sample>) {
        self.runs += 1;
        if let Some(sample) = sample {
            self.compare(sample);
            match self.best {
                Some(best) if !is_better(self.sign, sample, best) => {
                    self.differs |= is_clearly_worse(self.sign, sample, best);
                    self.after = if self.is_last { Some(sample) } else { self.after };
                }
                best => {
                    self.differs |= best.is_some_and(|best| is_clearly_worse(self.sign, best, sample));
                    (self.before, self.best, self.after) = (self.last, Some(sample), None);
                }
            }
        }
        self.is_last = sample.is_some() && self.best == sample;
        self.last = sample;
    }

    /// Counts the runs that are as good as the best.
    fn compare(&mut self, sample: Sample) {
        let alone = Equal { runs: 1, first: sample.at, last: sample.at };
        self.equal = match (self.best, self.equal) {
            (Some(best), equal) if is_clearly_worse(self.sign, sample, best) => equal,
            (Some(best), Some(equal)) if !is_clearly_worse(self.sign, best, sample) => {
                Some(Equal { runs: equal.runs + 1, last: sample.at, ..equal })
            }
            _ => Some(alone),
        };
    }

    /// Where it is best, from the runs and from those that `answer` makes between the neighbours; `None` where no run has an
    /// answer, or all have the same.
    ///
    /// The run of that value of what is swept may have no answer, and then no more are made.
    pub(crate) fn locate<E>(
        &self,
        mut answer: impl FnMut(f64) -> Result<Option<Sample>, E>,
    ) -> Result<Option<Optimum>, E> {
        let Some(best) = self.best.filter(|_| self.differs) else { return Ok(None) };
        let mut place =
            Optimum { best, between: None, equal: self.equal.filter(|equal| equal.runs > 1), made: 0 };
        if place.equal.is_some() {
            return Ok(Some(place));
        }
        let (Some(before), Some(after)) = (self.before, self.after) else { return Ok(Some(place)) };
        let mut known = vec![before, best, after];
        while self.runs >= LEAST_RUNS && place.made < MOST_MADE && !is_known(&known, place.best) {
            let Some(found) = answer(next(&known, place.best))? else { break };
            place.made += 1;
            let is_tie = (found.value - place.best.value).abs() <= found.error + place.best.error;
            place.best = if is_better(self.sign, found, place.best) { found } else { place.best };
            known.push(found);
            if is_tie {
                break;
            }
        }
        place.between = Some(self.between(&known, place.best));
        Ok(Some(place))
    }

    /// The nearest runs on both sides that are worse for certain, or the outermost that there are.
    fn between(&self, known: &[Sample], best: Sample) -> [f64; 2] {
        let worse = |sample: &&Sample| is_clearly_worse(self.sign, **sample, best);
        let all = || known.iter().map(|sample| sample.at);
        let low = known.iter().filter(worse).map(|sample| sample.at).filter(|at| *at < best.at);
        let high = known.iter().filter(worse).map(|sample| sample.at).filter(|at| *at > best.at);
        [
            low.reduce(f64::max).unwrap_or_else(|| all().fold(f64::INFINITY, f64::min)),
            high.reduce(f64::min).unwrap_or_else(|| all().fold(f64::NEG_INFINITY, f64::max)),
        ]
    }
}

/// Where an answer is greatest or least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimum {
    /// The best of all runs.
    pub best: Sample,
    /// Between which values of what is swept it is; `None` where the best run is at an end of the sweep, or has no answer beside it.
    pub between: Option<[f64; 2]>,
    /// Several runs of the sweep that are as good but for their errors, where there are: then no place is looked for.
    pub equal: Option<Equal>,
    /// Runs that were made beyond those of the sweep.
    pub made: usize,
}

/// Runs whose answers differ by no more than their errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equal {
    /// How many.
    pub runs: usize,
    /// Value of what is swept of the first.
    pub first: f64,
    /// And of the last.
    pub last: f64,
}

fn is_better(sign: f64, one: Sample, other: Sample) -> bool {
    sign * one.value > sign * other.value
}

fn is_clearly_worse(sign: f64, one: Sample, best: Sample) -> bool {
    sign * (best.value - one.value) > one.error + best.error
}

/// Both neighbours of the best.
fn sides(known: &[Sample], best: Sample) -> [f64; 2] {
    let places = || known.iter().map(|sample| sample.at);
    let low = places().filter(|at| *at < best.at).fold(f64::NEG_INFINITY, f64::max);
    let high = places().filter(|at| *at > best.at).fold(f64::INFINITY, f64::min);
    [low, high]
}

fn is_known(known: &[Sample], best: Sample) -> bool {
    let [low, high] = sides(known, best);
    let wanted = 10f64.powi(-DIGITS) * best.at.abs();
    (best.at - low).max(high - best.at) <= wanted
}

/// The golden section of the wider side.
fn next(known: &[Sample], best: Sample) -> f64 {
    let [low, high] = sides(known, best);
    match high - best.at > best.at - low {
        true => best.at + GOLDEN * (high - best.at),
        false => best.at - GOLDEN * (best.at - low),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(which: Extreme, runs: usize, answer: impl Fn(f64) -> Sample) -> Option<Optimum> {
        let mut best = Best::new(which);
        (0..runs).for_each(|run| best.add(Some(answer(run as f64 / (runs - 1) as f64))));
        let place: Result<_, ()> = best.locate(|at| Ok(Some(answer(at))));
        place.expect("an answer")
    }

    fn hump(at: f64) -> Sample {
        Sample { at, value: -(at - 0.437).powi(2), error: 1e-12 }
    }

    #[test]
    fn a_hump_is_found_to_the_digits_that_are_stated() {
        let place = sweep(Extreme::Greatest, 9, hump).expect("a place");
        let [low, high] = place.between.expect("between runs");
        assert!(low < 0.437 && 0.437 < high && high - low < 2e-4 * 0.437, "{place:?}");
        assert!(place.made > 0 && place.made <= MOST_MADE);
    }

    #[test]
    fn a_least_value_at_an_end_is_where_the_sweep_ends() {
        let place = sweep(Extreme::Least, 9, hump).expect("a place");
        assert_eq!((place.best.at, place.between, place.made), (1.0, None, 0));
    }

    #[test]
    fn few_runs_say_no_more_than_between_which_of_them_it_is() {
        let place = sweep(Extreme::Greatest, 5, hump).expect("a place");
        assert_eq!((place.between, place.made), (Some([0.25, 0.75]), 0));
    }

    /// Within errors nothing is greater: the interval stays as wide as the errors make it.
    #[test]
    fn errors_widen_the_interval() {
        let place = sweep(Extreme::Greatest, 8, |at| Sample { error: 1e-3, ..hump(at) }).expect("a place");
        let [low, high] = place.between.expect("between runs");
        assert!(low < 0.437 && 0.437 < high, "{place:?}");
        assert!([low, high].iter().all(|end| hump(*end).value + 2e-3 < place.best.value), "{place:?}");
    }

    #[test]
    fn runs_as_good_as_the_best_are_counted_and_nothing_is_looked_for() {
        let roof = |at: f64| Sample { at, value: (1.0 - (at - 0.5).abs()).min(0.7), error: 1e-9 };
        let place = sweep(Extreme::Greatest, 11, roof).expect("a place");
        let equal = place.equal.expect("several");
        assert_eq!((equal.runs, equal.first, equal.last, place.made), (7, 0.2, 0.8, 0));
    }

    #[test]
    fn what_does_not_change_has_no_greatest_value() {
        assert_eq!(sweep(Extreme::Greatest, 9, |at| Sample { at, value: 2.0, error: 1e-9 }), None);
    }
}
