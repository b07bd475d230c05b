//! Each problem in a process of its own, so that one that does not end holds up nothing.

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::survey::{Key, Measured, transfer};

/// The word by which a process is asked for the answers to one problem.
pub(crate) const ANSWER: &str = "--answer";
/// Most problems take some milliseconds, and all that end are over by then.
const LIMIT: Duration = Duration::from_secs(20);
/// A process is looked after so often.
const PAUSE: Duration = Duration::from_millis(2);

/// What the program says of a problem.
pub(crate) fn measured(key: &Key) -> Measured {
    let program = std::env::current_exe().expect("this program has a path");
    let child = Command::new(program)
        .arg(ANSWER)
        .args(key.words())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let Some(text) = child.and_then(output).expect("a process can be started") else {
        return Measured::Broken(format!("it does not end within {} s", LIMIT.as_secs()));
    };
    transfer::read(&text).unwrap_or_else(|| Measured::Broken("the process ended without an answer".into()))
}

/// What a process prints; `None` where it takes too long. It is little, so that no pipe is ever full.
fn output(mut child: Child) -> std::io::Result<Option<String>> {
    let begun = Instant::now();
    while child.try_wait()?.is_none() {
        if begun.elapsed() > LIMIT {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(PAUSE);
    }
    let mut text = String::new();
    child.stdout.take().map_or(Ok(0), |mut stdout| stdout.read_to_string(&mut text))?;
    Ok(Some(text))
}
