//! A bound on what a file unpacks to. One accessor can serve many meshes, many accessors the same
//! bytes, and an accessor without bytes is all zeros: so a small file can describe a large scene,
//! or one that no memory can hold.

use std::cell::Cell;

use anyhow::{Context, Result};

/// Numbers that a file may unpack to for each of its bytes. Bytes are read as one number each;
/// sparse morph targets and shared vertices ask for a few times that.
const NUMBERS_PER_BYTE: usize = 32;

/// Numbers that any file may unpack to: some hundred megabytes of memory.
const FREE_NUMBERS: usize = 1 << 24;

/// How many numbers a file may still unpack to.
pub struct Budget {
    left: Cell<usize>,
}

impl Budget {
    /// The budget of a file with its buffers, of this many bytes.
    pub fn of_file(size: usize) -> Budget {
        Budget { left: Cell::new(FREE_NUMBERS.max(size.saturating_mul(NUMBERS_PER_BYTE))) }
    }

    /// Takes numbers off the budget, before memory for them is asked for.
    ///
    /// # Errors
    /// Where it is used up.
    pub fn spend(&self, numbers: usize) -> Result<()> {
        let left = self.left.get().checked_sub(numbers).context(
            "the geometry unpacks to far more numbers than the file has bytes: refused as an \
             attack on the memory",
        )?;
        self.left.set(left);
        Ok(())
    }
}
