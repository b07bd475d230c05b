//! A bar for work that takes over a second, on a terminal only.

use std::cell::Cell;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work is quiet for this long before a bar appears.
const PATIENCE: Duration = Duration::from_secs(1);
/// Positions of the bar: fine enough for any terminal.
const POSITIONS: f64 = 1000.0;
/// The clock is looked at once in so many steps: a step takes microseconds.
const STEPS_A_LOOK: u32 = 64;

/// Shows how much of the motion is found.
pub struct Progress {
    bar: ProgressBar,
    until: f64,
    began: Instant,
    steps: Cell<u32>,
}

impl Progress {
    /// A bar for a motion until that time, s; hidden unless `visible`.
    pub fn new(title: &str, until: f64, visible: bool) -> Self {
        let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(POSITIONS as u64), target);
        let style = ProgressStyle::with_template("{msg} {bar:40} {percent} % of the time, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(title.to_owned());
        Self { bar, until, began: Instant::now(), steps: Cell::new(0) }
    }

    /// The motion is found up to that time, s.
    pub fn reached(&self, time: f64) {
        self.steps.set(self.steps.get().wrapping_add(1));
        if self.steps.get().is_multiple_of(STEPS_A_LOOK) && self.began.elapsed() > PATIENCE {
            self.bar.set_position((time / self.until * POSITIONS) as u64);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
