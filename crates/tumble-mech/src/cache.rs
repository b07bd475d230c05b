//! What is built once and shared by all copies of the equations.

use std::collections::HashMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

use tumble_expr::Rounding;

/// More values than this are not kept: formulas with the times and works of one run are asked for once.
const MOST: usize = 2048;

/// Values by key, built when they are first asked for. Which of them are there changes no result.
pub(crate) struct Cache<K, V>(Arc<Mutex<HashMap<K, Arc<V>>>>);

impl<K: Clone + Eq + Hash, V> Cache<K, V> {
    /// The value of a key, if it has been built.
    pub(crate) fn known(&self, key: &K) -> Option<Arc<V>> {
        self.lock().get(key).map(Arc::clone)
    }

    /// The value of a key. Two threads that ask at once may both build it; one of the two is kept.
    pub(crate) fn get<E>(&self, key: &K, build: impl FnOnce() -> Result<V, E>) -> Result<Arc<V>, E> {
        if let Some(value) = self.known(key) {
            return Ok(value);
        }
        // Not under the lock: what is built may ask for other values.
        let value = Arc::new(build()?);
        let mut known = self.lock();
        if known.len() >= MOST {
            known.clear();
        }
        Ok(Arc::clone(known.entry(key.clone()).or_insert(value)))
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<K, Arc<V>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Of what holds numbers: they alone differ where numbers are rounded in another way.
impl<K: Clone + Eq + Hash, V> Cache<(K, Rounding), V> {
    /// The value of a key with numbers rounded so: built with the nearest, and from that rounded again.
    pub(crate) fn get_rounded<E>(
        &self,
        key: K,
        rounding: Rounding,
        build: impl FnOnce(&K) -> Result<V, E>,
        again: impl FnOnce(&V, Rounding) -> V,
    ) -> Result<Arc<V>, E> {
        let nearest = (key, Rounding::NEAREST);
        if rounding.is_nearest() {
            return self.get(&nearest, || build(&nearest.0));
        }
        let key = (nearest.0.clone(), rounding);
        if let Some(known) = self.known(&key) {
            return Ok(known);
        }
        let found = self.get(&nearest, || build(&nearest.0))?;
        self.get(&key, || Ok(again(&found, rounding)))
    }
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<K, V> Clone for Cache<K, V> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<K, V> fmt::Debug for Cache<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_built_once() {
        let cache: Cache<u8, u8> = Cache::default();
        assert_eq!(cache.get(&1, || Err("refused")), Err("refused"));
        assert_eq!(cache.clone().get(&1, || Ok::<_, &str>(7)).as_deref(), Ok(&7));
        assert_eq!(cache.get(&1, || Ok::<_, &str>(8)).as_deref(), Ok(&7));
    }
}
