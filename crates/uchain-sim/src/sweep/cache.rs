//! A cache of scenes, for the runs that share them.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use crate::registry::AnyScene;

/// A variant that is laid out, or why it cannot be.
type Laid = Result<Arc<dyn AnyScene>, String>;

/// Keeps the last few variants: one for each thread, and one more.
#[derive(Debug, Default)]
pub(super) struct SceneCache {
    kept: Mutex<VecDeque<(u64, Arc<OnceLock<Laid>>)>>,
}

impl SceneCache {
    /// A variant, laid out by the first thread that asks for it; others that want the same one wait.
    pub(super) fn get(&self, variant: u64, lay: impl FnOnce() -> Laid) -> Laid {
        self.place(variant).get_or_init(lay).clone()
    }

    fn place(&self, variant: u64) -> Arc<OnceLock<Laid>> {
        // Nobody panics while holding the lock; were it so, the cache would still be whole.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, place)) = kept.iter().find(|(known, _)| *known == variant) {
            return place.clone();
        }
        if kept.len() > rayon::current_num_threads() {
            kept.pop_front();
        }
        let place = Arc::<OnceLock<Laid>>::default();
        kept.push_back((variant, place.clone()));
        place
    }
}
