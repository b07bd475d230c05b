//! Reads scenes with slips in them on all cores, and reports those that panic, last long or take much memory:
//! `cargo run --release -p tumble-scene --example fuzz -- EXECUTIONS SEED`.

#[path = "../tests/common/mutations.rs"]
mod mutations;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use mutations::{Corpus, Random, survives};

/// A scene that is read for longer is reported.
const LONG: Duration = Duration::from_secs(1);
/// kB; scenes that are read while the program holds more are reported.
const MUCH: u64 = 1 << 20;
/// How often the clock and the memory are looked at.
const TICK: Duration = Duration::from_millis(50);

/// One in so many has its mistakes drawn, which takes longer than to find them.
const SHOWN: u64 = 8;

/// What one core reads, since when, and the clock of its thread.
#[derive(Clone)]
struct Reading {
    since: Instant,
    clock: Clock,
    text: String,
}

type Work = Mutex<Option<Reading>>;

/// How long a thread has worked: on a busy machine that is less than the time that has passed.
#[derive(Clone)]
struct Clock {
    file: PathBuf,
    start: Duration,
}

impl Clock {
    /// Of the thread that calls this.
    fn start() -> Self {
        let thread = std::fs::read_link("/proc/thread-self").unwrap_or_default();
        let file = Path::new("/proc").join(thread).join("schedstat");
        let start = worked(&file).unwrap_or_default();
        Self { file, start }
    }

    fn elapsed(&self, since: Instant) -> Duration {
        worked(&self.file).map_or_else(|| since.elapsed(), |worked| worked.saturating_sub(self.start))
    }
}

/// What the system says that a thread has worked, where it does.
fn worked(file: &Path) -> Option<Duration> {
    let text = std::fs::read_to_string(file).ok()?;
    text.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

struct Hunt {
    corpus: Corpus,
    seed: u64,
    executions: u64,
    taken: AtomicU64,
    done: AtomicBool,
    found: AtomicU64,
    work: Vec<Work>,
}

fn main() -> std::io::Result<()> {
    let argument = |at: usize, default: u64| {
        std::env::args().nth(at).and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    let cores = std::thread::available_parallelism()?.get();
    let hunt = Hunt {
        corpus: Corpus::of_gallery()?,
        executions: argument(1, 100_000),
        seed: argument(2, 1),
        taken: AtomicU64::new(0),
        done: AtomicBool::new(false),
        found: AtomicU64::new(0),
        work: (0..cores).map(|_| Work::default()).collect(),
    };
    // What panics is reported with its scene.
    std::panic::set_hook(Box::new(|_| ()));
    let start = Instant::now();
    std::thread::scope(|scope| {
        scope.spawn(|| hunt.watch(start));
        let workers: Vec<_> = hunt.work.iter().map(|work| scope.spawn(|| hunt.work_through(work))).collect();
        let ended: Vec<_> = workers.into_iter().map(|worker| worker.join()).collect();
        hunt.done.store(true, Ordering::Relaxed);
        assert!(ended.iter().all(Result::is_ok), "a worker died");
    });
    hunt.sum_up(start);
    let found = hunt.found.load(Ordering::Relaxed);
    if found == 0 { Ok(()) } else { Err(std::io::Error::other(format!("{found} findings"))) }
}

impl Hunt {
    fn work_through(&self, work: &Work) {
        loop {
            let number = self.taken.fetch_add(1, Ordering::Relaxed);
            if number >= self.executions {
                return set(work, None);
            }
            let mut random = Random::new(self.seed.wrapping_mul(0x1_0000_0000).wrapping_add(number));
            let text = self.corpus.scene(&mut random);
            set(work, Some(Reading { since: Instant::now(), clock: Clock::start(), text: text.clone() }));
            let outcome = catch_unwind(AssertUnwindSafe(|| {
                survives(&text, &self.corpus.files, number.is_multiple_of(SHOWN))
            }));
            if let Err(panic) = outcome {
                let said = panic.downcast_ref::<String>().cloned();
                let said = said.or_else(|| panic.downcast_ref::<&str>().map(|said| (*said).to_owned()));
                self.report("panic", &said.unwrap_or_default(), &text);
            }
        }
    }

    /// Reports what lasts long while it lasts, so that it is known if it never ends.
    fn watch(&self, start: Instant) {
        let mut told: Vec<Option<Instant>> = vec![None; self.work.len()];
        let mut next = Duration::from_secs(30);
        while !self.done.load(Ordering::Relaxed) {
            std::thread::sleep(TICK);
            let much = memory().is_some_and(|held| held > MUCH);
            for (work, told) in self.work.iter().zip(&mut told) {
                let now = work.lock().unwrap_or_else(PoisonError::into_inner).clone();
                let Some(Reading { since, clock, text }) = now.filter(|now| *told != Some(now.since)) else {
                    continue;
                };
                let lasted = clock.elapsed(since);
                if lasted > LONG || much {
                    *told = Some(since);
                    self.report(if much { "memory" } else { "long" }, &format!("{lasted:?}"), &text);
                }
            }
            if start.elapsed() > next {
                next += Duration::from_secs(30);
                self.sum_up(start);
            }
        }
    }

    fn report(&self, kind: &str, said: &str, text: &str) {
        let number = self.found.fetch_add(1, Ordering::Relaxed);
        let file: PathBuf = std::env::temp_dir().join(format!("fuzz-{kind}-{}-{number}.toml", self.seed));
        let saved = std::fs::write(&file, text);
        println!("{kind}: {said}: {} {}", file.display(), if saved.is_ok() { "" } else { "(not saved)" });
    }

    fn sum_up(&self, start: Instant) {
        let (done, seconds) =
            (self.taken.load(Ordering::Relaxed).min(self.executions), start.elapsed().as_secs_f64());
        let found = self.found.load(Ordering::Relaxed);
        println!(
            "{done} executions in {seconds:.1} s, {:.0} per second, {found} findings",
            done as f64 / seconds
        );
    }
}

fn set(work: &Work, what: Option<Reading>) {
    *work.lock().unwrap_or_else(PoisonError::into_inner) = what;
}

/// Memory that this program holds, kB, where the system says so.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}
