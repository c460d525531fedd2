//! Parallel processing of numbered items on all processors.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use anyhow::Result;

/// Applies `work` to each number in parallel and returns the results in order.
///
/// # Errors
/// Returns the first error of `work`. Work in progress finishes first.
pub(crate) fn map<T: Send>(
    numbers: Range<u64>,
    work: impl Fn(u64) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let next = AtomicU64::new(numbers.start);
    let made: Mutex<Vec<(u64, T)>> = Mutex::default();
    let worker = || -> Result<()> {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= numbers.end {
                return Ok(());
            }
            let one = work(number)?;
            let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
            made.push((number, one));
        }
    };
    thread::scope(|scope| {
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let started: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        started.into_iter().try_for_each(|t| {
            t.join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    })?;
    let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    made.sort_by_key(|(number, _)| *number);
    Ok(made.into_iter().map(|(_, one)| one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_made_once_and_in_order() {
        let squares = map(3..200, |n| Ok(n * n)).unwrap();
        assert!(
            squares.into_iter().eq((3..200).map(|n| n * n)),
            "the results are in the order of the input"
        );
        let told = map(0..9, |n| if n == 4 { anyhow::bail!("four") } else { Ok(n) });
        assert_eq!(told.unwrap_err().to_string(), "four");
    }
}
