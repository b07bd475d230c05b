//! Random problems with known answers, and whether the errors that are stated of the program's answers hold.

mod ball;
mod bounces;
mod bump;
mod draw;
mod elliptic;
pub(crate) mod families;
mod ground;
mod impact;
mod judge;
mod measure;
mod oscillator;
mod pad;
mod quadrature;
mod real;
mod setup;
mod table;
mod tally;
mod touch;
pub(crate) mod transfer;
mod units;

use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Instant;

use families::FAMILIES;
use judge::{Judged, judge};
use measure::{Answer, measure};
use setup::Problem;

pub(crate) use measure::Measured;
pub(crate) use table::{missed, render};
pub(crate) use tally::Survey;

/// What one problem came to.
#[derive(Clone, Debug)]
pub(crate) struct Report {
    pub(crate) key: Key,
    pub(crate) accuracy: f64,
    pub(crate) fate: Fate,
    /// s; the only thing here that is not the same every time.
    pub(crate) seconds: f64,
}

/// How a problem ended.
#[derive(Clone, Debug)]
pub(crate) enum Fate {
    /// With answers.
    Answered(Vec<Judged>),
    /// The motion was refused.
    Refused(String),
    /// The program broke down.
    Broken(String),
}

/// Which problem: the seed of its survey, its family and its number there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub(crate) seed: u64,
    pub(crate) family: usize,
    pub(crate) index: u64,
}

impl Key {
    /// By the name of the family; `None` where there is none of that name.
    pub(crate) fn named(family: &str, seed: u64, index: u64) -> Option<Self> {
        Some(Self { seed, family: families::named(family)?, index })
    }

    /// Of all problems of a survey, in which the families take turns, or of those of one family.
    fn numbered(seed: u64, family: Option<usize>, number: u64) -> Self {
        let families = FAMILIES.len() as u64;
        match family {
            Some(family) => Self { seed, family, index: number },
            None => Self { seed, family: (number % families) as usize, index: number / families },
        }
    }

    /// Its words after `--only`.
    pub(crate) fn words(&self) -> [String; 3] {
        [FAMILIES[self.family].name.to_owned(), self.seed.to_string(), self.index.to_string()]
    }

    fn problem(&self) -> Problem {
        families::problem(self.seed, self.family, self.index)
    }

    /// The text of its scene.
    pub(crate) fn scene(&self) -> String {
        self.problem().scene
    }

    /// What the program says of it.
    pub(crate) fn measured(&self) -> Measured {
        measure(&self.problem())
    }

    /// Every value with its truth and both errors, from what was measured.
    pub(crate) fn values(&self, measured: Measured) -> String {
        table::values(&fate(&self.problem(), measured))
    }
}

/// Runs so many problems, of all families or of one, on all cores; `measured` is how one is run.
pub(crate) fn survey(
    (count, seed): (u64, u64),
    family: Option<usize>,
    measured: impl Fn(&Key) -> Measured + Sync,
) -> Survey {
    let next = AtomicU64::new(0);
    let work = || {
        let numbers = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        let keys =
            numbers.take_while(|number| *number < count).map(|number| Key::numbered(seed, family, number));
        keys.map(|key| report(key, &measured)).collect::<Vec<_>>()
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let mut reports: Vec<Report> = thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a worker")).collect()
    });
    reports.sort_by_key(|report| (report.key.index, report.key.family));
    Survey { reports }
}

fn report(key: Key, measured: &impl Fn(&Key) -> Measured) -> Report {
    let begun = Instant::now();
    let problem = key.problem();
    let fate = fate(&problem, measured(&key));
    Report { key, accuracy: problem.accuracy, fate, seconds: begun.elapsed().as_secs_f64() }
}

fn fate(problem: &Problem, measured: Measured) -> Fate {
    let judged =
        |answers: Vec<Answer>| problem.asked.iter().zip(answers).map(|(asked, answer)| judge(asked, answer));
    match measured {
        Measured::Answers(answers) => Fate::Answered(judged(answers).collect()),
        Measured::Refused(reason) => Fate::Refused(reason),
        Measured::Broken(reason) => Fate::Broken(reason),
    }
}
