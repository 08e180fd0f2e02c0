//! Results that come in any order from many threads, handed on one by one in their own order.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Results by number, from 0 on.
pub(super) struct InOrder<T, F> {
    queue: Mutex<Queue<T>>,
    /// Who takes them.
    take: Mutex<F>,
}

struct Queue<T> {
    next: usize,
    waiting: BTreeMap<usize, T>,
    /// Whether a thread is handing results on.
    is_busy: bool,
}

impl<T, F: FnMut(T)> InOrder<T, F> {
    pub(super) fn new(take: F) -> Self {
        let queue = Queue { next: 0, waiting: BTreeMap::new(), is_busy: false };
        Self { queue: Mutex::new(queue), take: Mutex::new(take) }
    }

    /// Leaves a result. It is handed on now, with those that waited for it, or later by another
    /// thread: nobody waits here for what others write.
    pub(super) fn put(&self, number: usize, result: T) {
        self.queue().waiting.insert(number, result);
        while let Some(result) = self.next() {
            (self.take.lock().unwrap_or_else(PoisonError::into_inner))(result);
            self.queue().is_busy = false;
        }
    }

    /// The next result, if it is there and nobody is busy.
    fn next(&self) -> Option<T> {
        let mut queue = self.queue();
        if queue.is_busy {
            return None;
        }
        let number = queue.next;
        let result = queue.waiting.remove(&number)?;
        queue.next += 1;
        queue.is_busy = true;
        Some(result)
    }

    /// Nothing can fail while this lock is held.
    fn queue(&self) -> MutexGuard<'_, Queue<T>> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    #[test]
    fn every_result_comes_in_its_place() {
        let mut taken = Vec::new();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
        let order = InOrder::new(|number: usize| taken.push(number));
        // A permutation: 7 and 1000 have no common divisor.
        pool.install(|| {
            (0..1000_usize).into_par_iter().for_each(|k| order.put(7 * k % 1000, 7 * k % 1000));
        });
        drop(order);
        assert!(taken.into_iter().eq(0..1000));
    }
}
