//! Lines for the person at the terminal.

use std::fmt::Display;
use std::io::Write;

/// Prints a line on standard output. A closed pipe (`chamfer ... | head`) is no reason to stop.
pub fn say(line: impl Display) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Prints a line on standard error.
pub fn warn(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
