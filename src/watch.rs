//! Watch: inside of long work the caller is told that it goes on, and may stop it.

use std::cell::{Cell, RefCell};
use std::ops::Range;
#[cfg(feature = "parallel")]
use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::Error;
use crate::ids::Id;

/// After so many steps the caller is told. The longest, two triangles compared exactly, takes two
/// millionths of a second; so this is well below the twentieth that a caller waits.
pub const STEPS: usize = 1 << 14;

/// What long work reports to.
pub trait Watch {
    /// So many more steps have been made.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the work is to stop.
    fn worked(&self, steps: usize) -> Result<(), Error>;
}

/// Asks the caller, on the caller's own thread.
pub struct Caller<'a> {
    ask: RefCell<&'a mut Ask<'a>>,
    /// Made since it was asked last.
    steps: Cell<usize>,
}

/// An error stops the work.
pub type Ask<'a> = dyn FnMut() -> Result<(), Error> + 'a;

impl<'a> Caller<'a> {
    pub fn new(ask: &'a mut Ask<'a>) -> Caller<'a> {
        Caller { ask: RefCell::new(ask), steps: Cell::new(0) }
    }
}

impl Watch for Caller<'_> {
    fn worked(&self, steps: usize) -> Result<(), Error> {
        let sum = self.steps.get().saturating_add(steps);
        self.steps.set(if sum < STEPS { sum } else { 0 });
        if sum < STEPS { Ok(()) } else { (self.ask.borrow_mut())() }
    }
}

/// So many numbers at a time: told of each, telling would take a share of the time.
const STRETCH: usize = 256;

/// All numbers below one, stretch by stretch, of each of which the watch is told; its error comes in
/// the place of one.
pub fn stretches(
    count: usize,
    watch: &dyn Watch,
) -> impl Iterator<Item = Result<Range<usize>, Error>> {
    (0..count).step_by(STRETCH).map(move |start| {
        let stretch = start..count.min(start + STRETCH);
        watch.worked(stretch.len()).map(|()| stretch)
    })
}

/// Does something with each of so many ids, and tells the watch of each stretch of them.
///
/// # Errors
/// What `watch` gives.
pub fn each<I: Id>(count: usize, watch: &dyn Watch, mut act: impl FnMut(I)) -> Result<(), Error> {
    for stretch in stretches(count, watch) {
        stretch?.map(I::new).for_each(&mut act);
    }
    Ok(())
}

/// Does something with each of some items, and tells the watch of each stretch of them.
///
/// # Errors
/// What `watch` gives.
pub fn each_of<T>(items: &[T], watch: &dyn Watch, mut act: impl FnMut(&T)) -> Result<(), Error> {
    for stretch in stretches(items.len(), watch) {
        items[stretch?].iter().for_each(&mut act);
    }
    Ok(())
}

/// The values of all numbers below one; the watch is told of each stretch of them.
///
/// # Errors
/// What `watch` gives.
pub fn collect<T>(
    count: usize,
    watch: &dyn Watch,
    mut value: impl FnMut(usize) -> T,
) -> Result<Vec<T>, Error> {
    let mut values = Vec::with_capacity(count);
    for stretch in stretches(count, watch) {
        values.extend(stretch?.map(&mut value));
    }
    Ok(values)
}

/// Sorts, and tells the watch again and again.
///
/// # Errors
/// What `watch` gives.
pub fn sort<T: Ord>(items: &mut [T], watch: &dyn Watch) -> Result<(), Error> {
    watch.worked(items.len())?;
    if items.len() <= STEPS {
        items.sort_unstable();
        return Ok(());
    }
    let (low, _, high) = items.select_nth_unstable(items.len() / 2);
    sort(low, watch)?;
    sort(high, watch)
}

/// Another watch, for which each step counts so many times.
pub struct Times<'a>(pub usize, pub &'a dyn Watch);

impl Watch for Times<'_> {
    fn worked(&self, steps: usize) -> Result<(), Error> {
        self.1.worked(steps.saturating_mul(self.0))
    }
}

/// Stops nothing.
pub struct Unwatched;

impl Watch for Unwatched {
    fn worked(&self, _: usize) -> Result<(), Error> {
        Ok(())
    }
}

/// Stops work on other threads once it is raised: only the caller's own may ask the caller.
#[cfg(feature = "parallel")]
#[derive(Default)]
pub struct Flag(AtomicBool);

#[cfg(feature = "parallel")]
impl Flag {
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(feature = "parallel")]
impl Watch for Flag {
    fn worked(&self, _: usize) -> Result<(), Error> {
        if self.0.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::ids::Triangle;

    #[test]
    fn the_caller_is_asked_after_so_many_steps() {
        let asked = Cell::new(0);
        let mut ask = || {
            asked.set(asked.get() + 1);
            if asked.get() < 3 { Ok(()) } else { Err(Error::Cancelled) }
        };
        let caller = Caller::new(&mut ask);
        assert!(caller.worked(STEPS - 1).is_ok() && asked.get() == 0);
        assert!(caller.worked(1).is_ok() && asked.get() == 1);
        assert!(caller.worked(usize::MAX).is_ok() && asked.get() == 2);
        assert!(caller.worked(1).is_ok() && asked.get() == 2);
        assert!(matches!(caller.worked(STEPS), Err(Error::Cancelled)));
    }

    /// Adds up what it is told, and how often.
    #[derive(Default)]
    struct Sum(Cell<[usize; 2]>);

    impl Watch for Sum {
        fn worked(&self, steps: usize) -> Result<(), Error> {
            let [sum, times] = self.0.get();
            self.0.set([sum + steps, times + 1]);
            Ok(())
        }
    }

    #[test]
    fn of_many_ids_each_has_its_turn_and_is_told() {
        let (sum, mut seen) = (Sum::default(), Vec::new());
        each(1000, &sum, |triangle: Triangle| seen.push(triangle.0)).unwrap();
        assert_eq!(seen, (0..1000).collect::<Vec<u32>>());
        assert_eq!(sum.0.get(), [1000, 4]);
    }

    #[test]
    fn values_are_collected_in_order_and_told() {
        let sum = Sum::default();
        let values = collect(1000, &sum, |number| number * 2).unwrap();
        assert!(values.into_iter().eq((0..1000).map(|number| number * 2)));
        assert_eq!(sum.0.get(), [1000, 4]);
        let stopped = |last| collect(1000, &Count { told: Cell::new(0), last }, |number| number);
        assert!([1, 4].map(stopped).iter().all(Result::is_err) && stopped(5).is_ok());
    }

    #[test]
    fn a_step_may_count_as_many() {
        let sum = Sum::default();
        Times(3, &sum).worked(5).unwrap();
        assert_eq!(sum.0.get(), [15, 1]);
        assert!(Times(usize::MAX, &Unwatched).worked(usize::MAX).is_ok());
    }

    /// Counts how often it is told, and stops the work then.
    pub struct Count {
        pub told: Cell<usize>,
        pub last: usize,
    }

    impl Watch for Count {
        fn worked(&self, _: usize) -> Result<(), Error> {
            self.told.set(self.told.get() + 1);
            if self.told.get() < self.last { Ok(()) } else { Err(Error::Cancelled) }
        }
    }

    #[test]
    fn what_is_sorted_in_parts_is_sorted() {
        let mut numbers: Vec<u32> =
            (0..100_000).map(|k: u32| k.wrapping_mul(2_654_435_761)).collect();
        let mut expected = numbers.clone();
        expected.sort_unstable();
        sort(&mut numbers, &Unwatched).unwrap();
        assert!(numbers == expected);
    }

    #[test]
    fn sorting_can_be_stopped_at_each_part() {
        let told = |last: usize| {
            let count = Count { told: Cell::new(0), last };
            let is_done = sort(&mut vec![0; 80_000], &count).is_ok();
            (is_done, count.told.get())
        };
        assert_eq!(told(usize::MAX), (true, 15), "80,000 in eight parts");
        assert_eq!([1, 8, 15].map(told), [(false, 1), (false, 8), (false, 15)]);
    }
}
