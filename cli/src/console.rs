//! Lines for the person at the terminal.

use std::fmt::Display;
use std::io::Write;

use anyhow::Error;

/// Prints a line on standard output. A closed pipe (`chamfer ... | head`) is no reason to stop.
pub fn say(line: impl Display) {
    let _ = writeln!(std::io::stdout(), "{}", harmless(&line.to_string()));
}

/// Prints a line on standard error.
pub fn warn(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", harmless(&line.to_string()));
}

/// Names in files, and of files, may hold what a terminal takes for commands.
pub fn harmless(text: &str) -> String {
    let mut told = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' => told.push(character),
            _ if character.is_control() => told.extend(character.escape_default()),
            _ => told.push(character),
        }
    }
    told
}

/// The same where all is one line.
pub fn one_line(text: &str) -> String {
    harmless(text).replace('\n', "\\n")
}

/// An error and what led to it, in one line.
pub fn with_causes(error: &Error) -> String {
    format!("{error:#}").replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_to_a_terminal_are_shown_and_not_given() {
        assert_eq!(
            harmless("a\u{1b}[31mred\u{7}\u{9b}2J\n\u{e9}"),
            "a\\u{1b}[31mred\\u{7}\\u{9b}2J\n\u{e9}"
        );
        assert_eq!(one_line("a\nb\r"), "a\\nb\\r");
    }
}
