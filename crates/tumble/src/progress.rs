//! How far the runs of a scene are: a bar on a terminal, elsewhere a line every few seconds; nothing for what takes no second.

use std::cell::Cell;
use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use tumble_scene::printable;

use crate::pipeline::Options;

/// Work is quiet for this long.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(5);
/// Positions of the bar: fine enough for any terminal.
const POSITIONS: f64 = 1000.0;
/// Characters of a title beside the bar.
const LONGEST_TITLE: usize = 30;
/// The clock is looked at once in so many steps: a step takes microseconds.
const STEPS_A_LOOK: u32 = 64;

/// Shows how much of all runs is done.
pub struct Progress {
    bar: ProgressBar,
    title: String,
    runs: usize,
    finished: AtomicUsize,
    began: Instant,
    /// When a line was written last, if lines are wanted.
    told: Option<Mutex<Instant>>,
    stop: Arc<AtomicBool>,
}

impl Progress {
    /// Of so many runs; silent unless the options want to see it.
    pub fn new(title: &str, runs: usize, options: &Options) -> Self {
        let is_terminal = std::io::stderr().is_terminal();
        let target = match options.progress && is_terminal {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(POSITIONS as u64), target);
        // As wide as the terminal, and no wider: what is longer than its line would be written again and again.
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let title = printable(title).into_owned();
        bar.set_prefix(short(&title));
        let began = Instant::now();
        let told = (options.progress && !is_terminal).then(|| Mutex::new(began));
        Self { bar, title, runs, finished: AtomicUsize::new(0), began, told, stop: options.stop.clone() }
    }

    /// Of one of them.
    pub fn of_run(&self) -> RunProgress<'_> {
        RunProgress { all: self, steps: Cell::new(0), last: Cell::new(0.0), began: Cell::new(Instant::now()) }
    }

    /// One more run is done.
    pub fn finish(&self) {
        self.finished.fetch_add(1, Ordering::Relaxed);
        self.show(1.0, self.began.elapsed());
    }

    /// Shows it; of a single run, how much of its motion is found, which has taken so long.
    fn show(&self, part: f64, taken: Duration) {
        let elapsed = self.began.elapsed();
        if elapsed < PATIENCE {
            return;
        }
        let finished = self.finished.load(Ordering::Relaxed);
        let (done, taken) = match self.runs {
            1 => (part, taken),
            runs => (finished as f64 / runs as f64, elapsed),
        };
        let words = words((finished, self.runs), done, taken);
        self.bar.set_position((done * POSITIONS) as u64);
        if let Some(told) = &self.told
            && let Ok(mut told) = told.try_lock()
            && told.elapsed() > PAUSE
        {
            *told = Instant::now();
            // Where nobody can be told there is nobody to tell that either.
            let _ = writeln!(std::io::stderr(), "{}: {words}", self.title);
        }
        self.bar.set_message(words);
    }
}

/// What is done and what is left: `37 of 500, 12 s left`, `40 % of the time, 3 s left`.
fn words((finished, runs): (usize, usize), done: f64, taken: Duration) -> String {
    let share = match runs {
        1 => format!("{:.0} % of the time", 100.0 * done),
        _ => format!("{finished} of {runs}"),
    };
    let left = taken.as_secs_f64() * (1.0 - done) / done;
    if left.is_finite() { format!("{share}, {left:.0} s left") } else { share }
}

/// A title that leaves room for a bar beside it.
fn short(title: &str) -> String {
    match title.char_indices().nth(LONGEST_TITLE) {
        Some((end, _)) => format!("{}..", title[..end].trim_end()),
        None => title.to_owned(),
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// How much of one motion is found.
pub struct RunProgress<'a> {
    all: &'a Progress,
    steps: Cell<u32>,
    last: Cell<f64>,
    /// When the motion was last begun: it is found several times.
    began: Cell<Instant>,
}

impl RunProgress<'_> {
    /// The motion is found up to that time of all that it lasts, s; it goes on unless no more is wanted.
    pub fn reached(&self, time: f64, until: f64) -> ControlFlow<()> {
        self.steps.set(self.steps.get().wrapping_add(1));
        if time < self.last.replace(time) {
            self.began.set(Instant::now());
        }
        if self.steps.get().is_multiple_of(STEPS_A_LOOK) {
            self.all.show(time / until, self.began.get().elapsed());
        }
        if self.all.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_is_done() {
        assert_eq!(words((37, 500), 37.0 / 500.0, Duration::from_secs(2)), "37 of 500, 25 s left");
        assert_eq!(words((0, 1), 0.4, Duration::from_secs(2)), "40 % of the time, 3 s left");
        assert_eq!(words((0, 9), 0.0, Duration::from_secs(2)), "0 of 9");
    }

    #[test]
    fn a_title_leaves_room_for_the_bar() {
        assert_eq!(short("Pendulum"), "Pendulum");
        assert_eq!(short("A pendulum of very many links in a wind"), "A pendulum of very many links..");
    }
}
