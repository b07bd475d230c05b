//! Ctrl-C: the first one keeps what is finished, the second one ends at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::say::tell;
use crate::commands::Ending;

/// A flag that Ctrl-C sets; the second one ends the command at once.
pub(crate) fn interruptible() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    let handler = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(Ending::Interrupted as u8));
        }
        tell!("stopping, to keep what is finished; Ctrl-C again ends at once");
    };
    // Where there is none to be had, Ctrl-C ends the command at once, as it does elsewhere.
    let _ = ctrlc::set_handler(handler);
    stop
}
