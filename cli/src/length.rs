//! Widths as people say them: a number, and what it counts.

use std::fmt::{self, Display};

use anyhow::{Result, bail};

/// A width of a chamfer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Finite, and not negative.
    pub value: f32,
    /// What it counts.
    pub unit: Unit,
}

/// What a width counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Hundredths of the largest side.
    Percent,
    /// Whatever the file counts in.
    File,
    /// One that people measure in; its place in [`MEASURES`].
    Measure(usize),
}

/// Names of measures, each with its metres.
const MEASURES: [(&str, f64); 4] = [("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254), ("m", 1.0)];

impl Length {
    /// So much percent of the largest side.
    pub const fn percent(value: f32) -> Length {
        Length { value, unit: Unit::Percent }
    }

    /// Reads `0.1`, `5mm` or `2%`.
    ///
    /// # Errors
    /// Says what can be given.
    pub fn parse(text: &str) -> Result<Length, String> {
        let (number, unit) = split(text.trim());
        match number.trim_end().parse::<f32>() {
            Ok(value) if value.is_finite() && value >= 0.0 => Ok(Length { value, unit }),
            _ => {
                Err("give a number of at least 0, as it is or with a unit: 0.1, 5mm, 2cm, 0.01m, \
                      0.2in or 2%"
                    .into())
            }
        }
    }

    /// The same in the units of a model whose largest side is `side`. glTF counts in metres, most
    /// other formats in what nobody knows.
    ///
    /// # Errors
    /// Where that would have to be known.
    pub fn in_units(self, side: f64, are_metres: bool) -> Result<f64> {
        let value = f64::from(self.value);
        match self.unit {
            Unit::Percent => Ok(value / 100.0 * side),
            Unit::File => Ok(value),
            Unit::Measure(number) if are_metres => Ok(value * MEASURES[number].1),
            Unit::Measure(_) => bail!(
                "a width of {self} was asked for, but this format does not say how long its units \
                 are: give the width in these, as {}, or in percent",
                self.value
            ),
        }
    }

    /// The unit as the report and files of options call it: a number that the file counts is one
    /// of `own` units.
    pub fn unit_name(self, own: &'static str) -> &'static str {
        match self.unit {
            Unit::Percent => "percent",
            Unit::File => own,
            Unit::Measure(number) => MEASURES[number].0,
        }
    }
}

impl Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.unit {
            Unit::Percent => write!(f, "{} %", self.value),
            Unit::File => write!(f, "{}", self.value),
            Unit::Measure(number) => write!(f, "{} {}", self.value, MEASURES[number].0),
        }
    }
}

/// The number of a text and its unit.
fn split(text: &str) -> (&str, Unit) {
    if let Some(number) = text.strip_suffix('%') {
        return (number, Unit::Percent);
    }
    let measures = MEASURES.iter().enumerate();
    let mut measured =
        measures.filter_map(|(k, (name, _))| Some((text.strip_suffix(name)?, Unit::Measure(k))));
    measured.next().unwrap_or((text, Unit::File))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_units_or_none() {
        let units = |text: &str| Length::parse(text).unwrap().in_units(8.0, true).unwrap();
        let told = ["0.5", "5mm", "2 cm", "2in", "3m", "25%", "1e-2m"].map(units);
        let expected = [0.5, 0.005, 0.02, 0.0508, 3.0, 2.0, 0.01];
        let is_near = |(told, expected): (f64, f64)| (told - expected).abs() < 1e-8;
        assert!(told.into_iter().zip(expected).all(is_near), "{told:?}");
    }

    #[test]
    fn what_is_no_width_is_refused() {
        for text in ["", "-1", "inf", "NaN", "5km", "mm", "inf%", "1 2"] {
            assert!(Length::parse(text).unwrap_err().contains("5mm"), "{text}");
        }
    }

    #[test]
    fn a_measure_needs_a_format_that_has_one() {
        let width = Length::parse("5mm").unwrap();
        let error = width.in_units(1.0, false).unwrap_err().to_string();
        assert!(error.starts_with("a width of 5 mm was asked for"), "{error}");
        assert_eq!(Length::percent(2.0).in_units(50.0, false).unwrap(), 1.0);
    }
}
