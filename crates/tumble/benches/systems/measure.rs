//! Times that can be compared: the least of many, taken in turn.

use std::time::{Duration, Instant};

/// However long it takes, so many repetitions.
const FEWEST: usize = 5;

/// How often work is repeated: until that long has passed.
#[derive(Clone, Copy)]
pub(crate) struct Patience(pub(crate) Duration);

impl Patience {
    pub(crate) fn of(is_long: bool) -> Self {
        Self(Duration::from_millis(if is_long { 5000 } else { 500 }))
    }
}

/// The least time of each piece of work, which says itself how long it took; they take turns.
pub(crate) fn in_turn<const N: usize>(
    Patience(patience): Patience,
    work: [&mut dyn FnMut() -> Duration; N],
) -> [Duration; N] {
    let (began, mut rounds, mut least) = (Instant::now(), 0, [Duration::MAX; N]);
    while rounds < FEWEST || began.elapsed() < patience {
        for index in 0..N {
            least[index] = least[index].min(work[index]());
        }
        rounds += 1;
    }
    least
}

/// How long something takes.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> Duration {
    let began = Instant::now();
    std::hint::black_box(work());
    began.elapsed()
}

pub(crate) fn micros(time: Duration) -> f64 {
    time.as_secs_f64() * 1e6
}

/// The first over the second.
pub(crate) fn ratio(first: Duration, second: Duration) -> f64 {
    first.as_secs_f64() / second.as_secs_f64()
}
