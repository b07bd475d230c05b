//! A bar for work that takes over a second, on a terminal only.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use tumble_scene::printable;

use crate::pipeline::Options;

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
    stop: Arc<AtomicBool>,
}

impl Progress {
    /// A bar for a motion until that time, s; hidden unless the options want one.
    pub fn new(title: &str, until: f64, options: &Options) -> Self {
        let target =
            if options.progress { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(POSITIONS as u64), target);
        let style = ProgressStyle::with_template("{msg} {bar:40} {percent} % of the time, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(printable(title).into_owned());
        Self { bar, until, began: Instant::now(), steps: Cell::new(0), stop: options.stop.clone() }
    }

    /// The motion is found up to that time, s; it goes on unless no more is wanted.
    pub fn reached(&self, time: f64) -> ControlFlow<()> {
        self.steps.set(self.steps.get().wrapping_add(1));
        if self.steps.get().is_multiple_of(STEPS_A_LOOK) && self.began.elapsed() > PATIENCE {
            self.bar.set_position((time / self.until * POSITIONS) as u64);
        }
        if self.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
