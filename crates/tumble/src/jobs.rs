//! Work that falls into parts, on several cores.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Does `work` with each of 0 to `count`, on so many cores at once, or on all there are. `take` is given what each came to,
/// in order and as soon as all before it are done, so that nothing waits that is not early.
///
/// Once one has failed no more are begun: those are `None`. All before the first that has failed are done, on however many cores.
pub(crate) fn in_order<T: Send, E: Send>(
    count: usize,
    jobs: Option<NonZeroUsize>,
    work: impl Fn(usize) -> Result<T, E> + Sync,
    take: impl FnMut(usize, Option<Result<T, E>>) + Send,
) {
    let jobs = jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let (next, has_failed) = (AtomicUsize::new(0), AtomicBool::new(false));
    let queue = Mutex::new(Queue { next: 0, early: BTreeMap::new(), take });
    let worker = || {
        while !has_failed.load(Ordering::SeqCst) {
            let index = next.fetch_add(1, Ordering::SeqCst);
            if index >= count {
                break;
            }
            let result = work(index);
            has_failed.fetch_or(result.is_err(), Ordering::SeqCst);
            queue.lock().unwrap_or_else(PoisonError::into_inner).put(index, result);
        }
    };
    if jobs.min(count) <= 1 {
        worker();
    } else {
        // A panic of one is one of all.
        thread::scope(|scope| (0..jobs.min(count)).for_each(|_| drop(scope.spawn(worker))));
    }
    queue.into_inner().unwrap_or_else(PoisonError::into_inner).end(count);
}

/// What was done before its turn.
struct Queue<T, F> {
    /// Whose turn it is.
    next: usize,
    early: BTreeMap<usize, T>,
    take: F,
}

impl<T, F: FnMut(usize, Option<T>)> Queue<T, F> {
    fn put(&mut self, index: usize, done: T) {
        self.early.insert(index, done);
        while let Some(done) = self.early.remove(&self.next) {
            (self.take)(self.next, Some(done));
            self.next += 1;
        }
    }

    /// Gives away the rest, with gaps for what was not done.
    fn end(mut self, count: usize) {
        (self.next..count).for_each(|index| (self.take)(index, self.early.remove(&index)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(jobs: usize, fails: usize) -> Vec<Option<Result<usize, usize>>> {
        let work = |index: usize| if index == fails { Err(index) } else { Ok(index * index) };
        let mut all = vec![];
        in_order(50, NonZeroUsize::new(jobs), work, |index, done| {
            assert_eq!(index, all.len());
            all.push(done);
        });
        all
    }

    #[test]
    fn the_order_is_that_of_the_parts() {
        for jobs in [1, 2, 7, 100] {
            let squares: Vec<_> = (0..50).map(|index| Some(Ok(index * index))).collect();
            assert_eq!(numbers(jobs, 99), squares);
        }
    }

    #[test]
    fn all_before_a_failure_is_done() {
        for jobs in [1, 2, 7] {
            let done = numbers(jobs, 20);
            assert!(done[..20].iter().all(|part| matches!(part, Some(Ok(_)))));
            assert_eq!(done[20], Some(Err(20)));
        }
        assert!(numbers(1, 20)[21..].iter().all(Option::is_none));
    }
}
