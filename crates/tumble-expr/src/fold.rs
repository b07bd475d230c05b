//! What is found of a formula from the same of its parts.

use std::sync::Arc;

use crate::expr::{Expr, Inner};
use crate::hashing::FastMap;

impl Expr {
    /// What is found of the formula, where `found` tells it of a node from that of its parts.
    ///
    /// Shared parts are looked at once, and the depth of the formula is not bounded by the stack.
    pub(crate) fn folded<T: Clone>(&self, mut found: impl FnMut(&Self, &dyn Fn(&Self) -> T) -> T) -> T {
        let mut done: FastMap<*const Inner, T> = FastMap::default();
        let mut pending = vec![self];
        while let Some(next) = pending.last().copied() {
            let missing = |part: &&Self| !done.contains_key(&Arc::as_ptr(&part.0));
            let parts: Vec<&Self> = next.children().into_iter().filter(missing).collect();
            if parts.is_empty() {
                let own = found(next, &|part| done[&Arc::as_ptr(&part.0)].clone());
                done.insert(Arc::as_ptr(&next.0), own);
                pending.pop();
            } else {
                pending.extend(parts);
            }
        }
        done[&Arc::as_ptr(&self.0)].clone()
    }
}
