//! Plans by pattern: rows that hold together in one way do so in many modes, and at every instant of one.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::Plan;
use crate::hashing::FastMap;

/// When all plans together are of more factors than this, they are forgotten: patterns come from scenes, of which there may be many.
const MOST_FACTORS: usize = 1 << 20;

/// What has been found so far. Which plans are there changes no result: the same pattern has the same plan.
#[derive(Debug, Default)]
struct Known {
    plans: FastMap<Vec<Vec<u32>>, Arc<Plan>>,
    /// How many factors they are of.
    factors: usize,
}

impl Plan {
    /// That of a matrix of which each row has entries in these columns, found once for a pattern.
    pub(crate) fn of(rows: Vec<Vec<u32>>) -> Arc<Self> {
        if let Some(plan) = known().plans.get(&rows) {
            return Arc::clone(plan);
        }
        // Not under the lock: two threads may both find it, and one of the two is kept.
        let plan = Arc::new(Self::new(&rows));
        let mut known = known();
        if known.factors + plan.room > MOST_FACTORS {
            *known = Known::default();
        }
        known.factors += plan.room;
        Arc::clone(known.plans.entry(rows).or_insert(plan))
    }
}

fn known() -> std::sync::MutexGuard<'static, Known> {
    static KNOWN: OnceLock<Mutex<Known>> = OnceLock::new();
    KNOWN.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_has_one_plan() {
        let rows = |last: u32| vec![vec![0, 1], vec![0, 1, last], vec![1, 2]];
        assert!(Arc::ptr_eq(&Plan::of(rows(2)), &Plan::of(rows(2))));
        assert!(!Arc::ptr_eq(&Plan::of(rows(2)), &Plan::of(vec![vec![0, 1], vec![0, 1], vec![2]])));
    }
}
