//! Threads: the same work for each of many ids, shared out among some threads.
//!
//! Every value is computed by itself and put at its own place, so the result is the same for any
//! number of threads.
//!
//! What is done for each id is called in two places, by one thread and by many, so it is put inline in
//! neither, unless asked to be: where it is little, the call takes as long.

#[cfg(feature = "parallel")]
use std::sync::mpsc::{RecvTimeoutError, channel};
#[cfg(feature = "parallel")]
use std::time::Duration;

use crate::error::Error;
use crate::ids::{Id, IdVec};
#[cfg(feature = "parallel")]
use crate::watch::Flag;
use crate::watch::{STEPS, Watch, stretches};

/// With less work than this in one stage, waking another thread takes longer than doing it.
#[cfg(feature = "parallel")]
const LEAST_WORK: usize = 4096;

/// A call for fewer corners takes longer with more threads: their memory is touched for the first time.
#[cfg(feature = "parallel")]
const LEAST_CORNERS: usize = 1 << 16;

/// So many steps it takes to make a patch or to lay it out, as a watch counts them.
const STEPS_OF_PATCH: usize = 4;

/// So many ids make notes that stay in the nearest caches.
const BLOCK: usize = 256;

/// So much work at a time is made by all threads, and appended by one of them while they make the next.
#[cfg(feature = "parallel")]
const WAVE: usize = 2 * LEAST_WORK;

/// Up to so many threads, one for each core, however many are asked for.
#[cfg(feature = "parallel")]
const MOST_THREADS: usize = 64;

/// So long the calling thread waits for the others before it asks the caller.
#[cfg(feature = "parallel")]
const PATIENCE: Duration = Duration::from_millis(20);

/// The threads of one call.
#[derive(Debug, Default)]
pub struct Threads {
    #[cfg(feature = "parallel")]
    pool: Option<rayon::ThreadPool>,
}

impl Threads {
    /// So many threads, or one for each core if that is 0, for a mesh of so many corners, or what takes as
    /// long. Where the system has none to give, the calling thread does all.
    #[cfg(feature = "parallel")]
    pub fn new(wanted: u32, corners: usize) -> Threads {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let count = if wanted == 0 { cores() } else { wanted as usize };
        let pays = count > 1 && corners >= LEAST_CORNERS;
        let pool = || rayon::ThreadPoolBuilder::new().num_threads(count.min(MOST_THREADS)).build();
        Threads { pool: if pays { pool().ok() } else { None } }
    }

    /// The calling thread alone.
    #[cfg(not(feature = "parallel"))]
    pub fn new(_wanted: u32, _corners: usize) -> Threads {
        Threads {}
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            return pool.current_num_threads();
        }
        1
    }

    /// `#ids`: the value for each.
    ///
    /// # Errors
    /// What `watch` gives, which is told again and again.
    pub fn map<I: Id + Send, T: Send>(
        &self,
        count: usize,
        watch: &dyn Watch,
        value: impl Fn(I) -> T + Sync + Send,
    ) -> Result<IdVec<I, T>, Error> {
        self.map_with(
            count,
            watch,
            || (),
            #[inline(always)]
            |(), id| value(id),
        )
    }

    /// As [`Threads::map`], with a scratch value that each thread makes once.
    ///
    /// # Errors
    /// What `watch` gives.
    pub fn map_with<I: Id + Send, T: Send, S>(
        &self,
        count: usize,
        watch: &dyn Watch,
        scratch: impl Fn() -> S + Sync + Send,
        value: impl Fn(&mut S, I) -> T + Sync + Send,
    ) -> Result<IdVec<I, T>, Error> {
        let mut values = Vec::with_capacity(count);
        self.extend_with(&mut values, count, watch, scratch, value)?;
        Ok(IdVec::from_vec(values))
    }

    /// Appends the value for each of so many ids.
    fn extend_with<I: Id + Send, T: Send, S>(
        &self,
        values: &mut Vec<T>,
        count: usize,
        watch: &dyn Watch,
        scratch: impl Fn() -> S + Sync + Send,
        value: impl Fn(&mut S, I) -> T + Sync + Send,
    ) -> Result<(), Error> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = self.pool.as_ref().filter(|_| count >= LEAST_WORK) {
            use rayon::prelude::*;
            let value = |scratch: &mut S, index| value(scratch, I::new(index));
            for start in (0..count).step_by(STEPS) {
                let some = start..count.min(start + STEPS);
                let of_some = some.clone().into_par_iter().map_init(&scratch, &value);
                pool.install(|| values.par_extend(of_some));
                watch.worked(some.len())?;
            }
            return Ok(());
        }
        let mut scratch = scratch();
        for stretch in stretches(count, watch) {
            values.extend(stretch?.map(|index| value(&mut scratch, I::new(index))));
        }
        Ok(())
    }

    /// Looks at each id in the light of a state, block by block, and takes what was noted of the
    /// blocks into the state, in ascending order.
    ///
    /// # Errors
    /// What `watch` gives, which is told again and again.
    pub fn blocks_then<I: Id, S: Sync, T: Default + Send>(
        &self,
        (count, watch): (usize, &dyn Watch),
        state: &mut S,
        note: impl Fn(&S, I, &mut T) + Sync + Send,
        take: impl Fn(&mut S, &mut T),
    ) -> Result<(), Error> {
        let note_block = |state: &S, start: usize, notes: &mut T| {
            let block = start..count.min(start + BLOCK);
            block.map(I::new).for_each(|id| note(state, id, notes));
        };
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            use rayon::prelude::*;
            let mut blocks: Vec<T> = Vec::new();
            blocks.resize_with(LEAST_WORK / BLOCK, T::default);
            for start in (0..count).step_by(LEAST_WORK) {
                let work = blocks.par_iter_mut().enumerate();
                let note = |(k, notes)| note_block(state, start + k * BLOCK, notes);
                pool.install(|| work.for_each(note));
                blocks.iter_mut().for_each(|notes| take(state, notes));
                watch.worked(LEAST_WORK * STEPS_OF_PATCH)?;
            }
            return Ok(());
        }
        let mut notes = T::default();
        for start in (0..count).step_by(BLOCK) {
            note_block(state, start, &mut notes);
            take(state, &mut notes);
            watch.worked(BLOCK * STEPS_OF_PATCH)?;
        }
        Ok(())
    }

    /// Adds what is made of each id to all, in ascending order: right there, or by several threads to
    /// what is then appended, block by block, and empty again.
    ///
    /// # Errors
    /// What `watch` gives, which is told again and again.
    pub fn gather<I: Id, T: Default + Send + Sync>(
        &self,
        (count, watch): (usize, &dyn Watch),
        all: &mut T,
        add: impl Fn(I, &mut T) + Sync + Send,
        #[cfg_attr(not(feature = "parallel"), allow(unused_variables))] append: impl Fn(&mut T, &mut T)
        + Sync
        + Send,
    ) -> Result<(), Error> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            use rayon::prelude::*;
            let empty = || (0..WAVE / BLOCK).map(|_| T::default()).collect::<Vec<T>>();
            let (mut made, mut making) = (empty(), empty());
            for start in (0..count).step_by(WAVE) {
                let add_block = |(k, some): (usize, &mut T)| {
                    let block = start + k * BLOCK..count.min(start + (k + 1) * BLOCK);
                    block.for_each(|index| add(I::new(index), some));
                };
                // What was made before is appended beside.
                pool.join(
                    || making.par_iter_mut().enumerate().for_each(add_block),
                    || made.iter_mut().for_each(|some| append(all, some)),
                );
                std::mem::swap(&mut made, &mut making);
                watch.worked(WAVE * STEPS_OF_PATCH)?;
            }
            made.iter_mut().for_each(|some| append(all, some));
            return Ok(());
        }
        for start in (0..count).step_by(BLOCK) {
            (start..count.min(start + BLOCK)).for_each(|index| add(I::new(index), all));
            watch.worked(BLOCK * STEPS_OF_PATCH)?;
        }
        Ok(())
    }

    /// The value for each item, in their order, where each is some work.
    ///
    /// # Errors
    /// What `watch` gives, which is told again and again.
    pub fn map_each<I: Sync, T: Send>(
        &self,
        items: &[I],
        watch: &dyn Watch,
        value: impl Fn(&I) -> T + Sync + Send,
    ) -> Result<Vec<T>, Error> {
        let mut values = Vec::with_capacity(items.len());
        for some in items.chunks(BLOCK) {
            values.append(&mut self.map_block(some, &value));
            watch.worked(some.len() * STEPS_OF_PATCH)?;
        }
        Ok(values)
    }

    fn map_block<I: Sync, T: Send>(
        &self,
        items: &[I],
        value: impl Fn(&I) -> T + Sync + Send,
    ) -> Vec<T> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = self.pool.as_ref().filter(|_| items.len() == BLOCK) {
            use rayon::prelude::*;
            return pool.install(|| items.par_iter().map(value).collect());
        }
        items.iter().map(value).collect()
    }

    /// The value for each item, in their order, where each is much work, with a scratch value that
    /// each thread makes once.
    pub fn map_large<I: Sync, T: Send, S>(
        &self,
        items: &[I],
        scratch: impl Fn() -> S + Sync + Send,
        value: impl Fn(&mut S, &I) -> T + Sync + Send,
    ) -> Vec<T> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            use rayon::prelude::*;
            let each = || items.par_iter().with_max_len(1).map_init(&scratch, &value).collect();
            return pool.install(each);
        }
        let mut scratch = scratch();
        items.iter().map(|item| value(&mut scratch, item)).collect()
    }

    /// As [`Threads::map_large`], where the work reports to a watch, and may be stopped.
    ///
    /// # Errors
    /// What `watch` gives, or else the first that a value gives.
    pub fn map_watched<I: Sync, T: Send>(
        &self,
        items: &[I],
        watch: &dyn Watch,
        value: impl Fn(&dyn Watch, &I) -> Result<T, Error> + Sync + Send,
    ) -> Result<Vec<T>, Error> {
        self.map_beside(items, watch, value, || Ok(()))
    }

    /// As [`Threads::map_watched`], and does something else beside, or before.
    ///
    /// # Errors
    /// As there, or what the other thing gives.
    pub fn map_beside<I: Sync, T: Send>(
        &self,
        items: &[I],
        watch: &dyn Watch,
        value: impl Fn(&dyn Watch, &I) -> Result<T, Error> + Sync + Send,
        beside: impl FnOnce() -> Result<(), Error> + Send,
    ) -> Result<Vec<T>, Error> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            let flag = Flag::default();
            let all = || self.map_large(items, || (), |(), item| value(&flag, item));
            let work = || Some(pool.join(all, beside));
            let Some((values, done)) = waited_for(pool, (watch, &flag), work)? else {
                return Ok(Vec::new());
            };
            done?;
            return values.into_iter().collect();
        }
        beside()?;
        items.iter().map(|item| value(watch, item)).collect()
    }

    /// The ids that are such, in ascending order.
    pub fn filter<I: Id + Send>(
        &self,
        count: usize,
        is_such: impl Fn(I) -> bool + Sync + Send,
    ) -> Vec<I> {
        #[cfg(feature = "parallel")]
        if let Some(pool) = self.pool.as_ref().filter(|_| count >= LEAST_WORK) {
            use rayon::prelude::*;
            let all = (0..count).into_par_iter().map(I::new);
            return pool.install(|| all.filter(|&id| is_such(id)).collect());
        }
        (0..count).map(I::new).filter(|&id| is_such(id)).collect()
    }

    /// As [`Threads::filter`], telling a watch again and again.
    ///
    /// # Errors
    /// What `watch` gives.
    pub fn filter_watched<I: Id + Send>(
        &self,
        count: usize,
        watch: &dyn Watch,
        is_such: impl Fn(I) -> bool + Sync + Send,
    ) -> Result<Vec<I>, Error> {
        let mut such = Vec::new();
        for start in (0..count).step_by(STEPS) {
            let some = STEPS.min(count - start);
            let id = |within: I| I::new(start + within.index());
            let found = self.filter(
                some,
                #[inline(always)]
                |within: I| is_such(id(within)),
            );
            such.extend(found.into_iter().map(id));
            watch.worked(some)?;
        }
        Ok(such)
    }
}

/// Does some work on a pool, while the calling thread asks whether it is to go on, and raises the
/// flag if not.
#[cfg(feature = "parallel")]
fn waited_for<T: Default + Send>(
    pool: &rayon::ThreadPool,
    (watch, flag): (&dyn Watch, &Flag),
    work: impl FnOnce() -> T + Send,
) -> Result<T, Error> {
    let (mut result, mut answer) = (T::default(), Ok(()));
    // Nothing is sent: that the sender is gone tells that the work is done.
    let (sender, done) = channel::<()>();
    pool.in_place_scope(|scope| {
        let result = &mut result;
        scope.spawn(move |_| {
            let _held = sender;
            *result = work();
        });
        while done.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
            answer = answer.and_then(|()| watch.worked(STEPS));
            if answer.is_err() {
                flag.raise();
            }
        }
    });
    answer.map(|()| result)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::{Duration, Instant};

    use crate::ids::Vertex;
    use crate::watch::Unwatched;

    #[test]
    fn each_value_is_at_its_place_whatever_the_threads() {
        for threads in [0, 1, 2, 5] {
            let threads = Threads::new(threads, 100_000);
            let squares =
                threads.map(10_000, &Unwatched, |vertex: Vertex| vertex.0 * vertex.0).unwrap();
            assert!(squares.iter().copied().eq((0..10_000).map(|number| number * number)));
            let numbers: Vec<u32> = (0..10_000).collect();
            let next = threads.map_each(&numbers, &Unwatched, |number| number + 1).unwrap();
            assert_eq!(next[9_999], 10_000);
            let counted = threads.map_large(&numbers[..9], || 0, |_, number| number + 1);
            assert_eq!(counted, (1..10).collect::<Vec<u32>>());
            let odd = threads.filter(10_000, |vertex: Vertex| vertex.0 % 2 == 1);
            assert!(odd.into_iter().eq((0..5_000).map(|half| Vertex(2 * half + 1))));
        }
    }

    /// Stops when it is asked the third time.
    struct Impatient(Cell<u32>);

    impl Watch for Impatient {
        fn worked(&self, _: usize) -> Result<(), Error> {
            self.0.set(self.0.get() + 1);
            if self.0.get() < 3 { Ok(()) } else { Err(Error::Cancelled) }
        }
    }

    #[test]
    fn work_without_end_can_be_stopped() {
        for threads in [1, 2, 5] {
            let (threads, watch) = (Threads::new(threads, 100_000), Impatient(Cell::new(0)));
            let (begun, gave_up) = (Instant::now(), AtomicBool::new(false));
            let work = |watch: &dyn Watch, _: &u32| -> Result<(), Error> {
                while begun.elapsed() < Duration::from_secs(20) {
                    watch.worked(1)?;
                }
                gave_up.store(true, Ordering::Relaxed);
                Ok(())
            };
            let stopped = threads.map_watched(&[0; 9], &watch, work);
            assert!(matches!(stopped, Err(Error::Cancelled)));
            assert!(!gave_up.into_inner(), "all threads are told to stop");
            assert_eq!(watch.0.get(), 3, "who has said so is asked no more");
            let work = |watch: &dyn Watch, k: &u32| watch.worked(1).map(|()| k + 1);
            let all = threads.map_watched(&[1, 2], &Unwatched, work).unwrap();
            assert_eq!(all, [2, 3]);
        }
    }

    #[test]
    fn notes_are_taken_in_the_order_of_their_ids() {
        for threads in [1, 3] {
            let threads = Threads::new(threads, 100_000);
            let mut taken: Vec<Vertex> = Vec::new();
            let note = |_: &Vec<Vertex>, vertex: Vertex, notes: &mut Vec<Vertex>| {
                if !vertex.0.is_multiple_of(3) {
                    notes.push(vertex);
                }
            };
            let all = (10_000, &Unwatched as &dyn Watch);
            let take = |taken: &mut Vec<Vertex>, notes: &mut Vec<Vertex>| taken.append(notes);
            threads.blocks_then(all, &mut taken, note, take).unwrap();
            assert!(
                taken
                    .into_iter()
                    .eq((0..10_000).filter(|k: &u32| !k.is_multiple_of(3)).map(Vertex))
            );
        }
    }

    #[test]
    fn what_is_gathered_stands_in_the_order_of_its_ids() {
        for threads in [1, 3] {
            let threads = Threads::new(threads, 100_000);
            let (mut all, count) = (Vec::new(), 3 * STEPS + 2 * BLOCK + 2);
            let add = |vertex: Vertex, some: &mut Vec<Vertex>| {
                some.extend(std::iter::repeat_n(vertex, vertex.index() % 3));
            };
            threads.gather((count, &Unwatched), &mut all, add, Vec::append).unwrap();
            let expected = (0..count).flat_map(|k| std::iter::repeat_n(Vertex::new(k), k % 3));
            assert!(all.into_iter().eq(expected));
        }
    }

    #[test]
    fn large_counts_are_told_again_and_again() {
        for threads in [1, 2] {
            let threads = &Threads::new(threads, 100_000);
            let told = |work: &dyn Fn(&dyn Watch) -> Result<(), Error>| {
                let watch = Impatient(Cell::new(0));
                assert!(matches!(work(&watch), Err(Error::Cancelled)));
                assert_eq!(watch.0.get(), 3, "it ends when it is stopped");
            };
            let (many, items) = (3 * STEPS, &vec![0_u8; 3 * BLOCK][..]);
            told(&|watch| threads.map(many, watch, |vertex: Vertex| vertex).map(|_| ()));
            told(&|watch| threads.filter_watched(many, watch, |_: Vertex| true).map(|_| ()));
            told(&|watch| threads.map_each(items, watch, |item| *item).map(|_| ()));
            told(&|watch| {
                let note = |_: &(), _: Vertex, _: &mut ()| ();
                threads.blocks_then((many, watch), &mut (), note, |_, _| ())
            });
        }
    }
}
