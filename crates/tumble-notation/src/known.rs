//! What was worked out before. Numbers are moved again and again while formulas stay: parameters are letters in them.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use tumble_expr::Formulas;

use crate::MathError;
use crate::layout::Math;
use crate::notation::Printed;

/// So many are kept; then all are forgotten.
const MOST: usize = 512;

/// All that a form depends on.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    pub(crate) symbols: BTreeMap<String, String>,
    pub(crate) positive: BTreeSet<String>,
    pub(crate) automatic: bool,
    /// Names of definitions, and how many parts they have, which their order depends on.
    pub(crate) names: Vec<(String, usize)>,
    /// Left sides, each with whether it has a factor.
    pub(crate) lefts: Vec<Option<(Math, bool)>>,
    /// Definitions, right sides, factors.
    pub(crate) formulas: Formulas,
}

thread_local! {
    static KNOWN: RefCell<HashMap<Key, Result<Printed, MathError>>> = RefCell::new(HashMap::new());
}

/// What is known of it, or else what comes of working it out.
pub(crate) fn or_else(
    key: Key,
    work_out: impl FnOnce() -> Result<Printed, MathError>,
) -> Result<Printed, MathError> {
    if let Some(known) = KNOWN.with_borrow(|known| known.get(&key).cloned()) {
        return known;
    }
    let shown = work_out();
    KNOWN.with_borrow_mut(|known| {
        if known.len() >= MOST {
            known.clear();
        }
        known.insert(key, shown.clone());
    });
    shown
}
