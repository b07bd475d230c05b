//! Work that falls into parts, on several cores.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

/// Does `work` with each of 0 to `count`, on so many cores at once, or on all there are; what each came to, in order.
///
/// Once one has failed no more are begun: those are `None`. All before the first that has failed are done, on however many cores.
pub(crate) fn in_order<T: Send, E: Send>(
    count: usize,
    jobs: Option<NonZeroUsize>,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> Vec<Option<Result<T, E>>> {
    let jobs = jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let (next, has_failed) = (AtomicUsize::new(0), AtomicBool::new(false));
    let worker = || {
        let mut done = vec![];
        while !has_failed.load(Ordering::SeqCst) {
            let index = next.fetch_add(1, Ordering::SeqCst);
            if index >= count {
                break;
            }
            let result = work(index);
            has_failed.fetch_or(result.is_err(), Ordering::SeqCst);
            done.push((index, result));
        }
        done
    };
    let mut all: Vec<Option<Result<T, E>>> = (0..count).map(|_| None).collect();
    let mut keep = |done: Vec<(usize, Result<T, E>)>| {
        done.into_iter().for_each(|(index, result)| all[index] = Some(result));
    };
    if jobs.min(count) <= 1 {
        keep(worker());
        return all;
    }
    thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.min(count)).map(|_| scope.spawn(worker)).collect();
        for worker in workers {
            match worker.join() {
                Ok(done) => keep(done),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(jobs: usize, fails: usize) -> Vec<Option<Result<usize, usize>>> {
        let work = |index: usize| if index == fails { Err(index) } else { Ok(index * index) };
        in_order(50, NonZeroUsize::new(jobs), work)
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
