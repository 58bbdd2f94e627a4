//! Counts of what was looked at and what broke a rule.

use std::collections::BTreeMap;
use std::fmt;

#[derive(Default)]
pub struct Tally {
    rules: BTreeMap<&'static str, Count>,
}

#[derive(Default)]
struct Count {
    checked: usize,
    broken: usize,
    of_mesh: BTreeMap<String, usize>,
    first: Vec<String>,
}

impl Tally {
    /// Notes one look at a rule; what is wrong, if something is.
    pub fn note(&mut self, rule: &'static str, mesh: &str, wrong: Option<String>) {
        let count = self.rules.entry(rule).or_default();
        count.checked += 1;
        if let Some(wrong) = wrong {
            count.broken += 1;
            let of_mesh = count.of_mesh.entry(mesh.to_owned()).or_default();
            *of_mesh += 1;
            if *of_mesh == 1 {
                count.first.push(format!("{mesh}: {wrong}"));
            }
        }
    }

    /// The share of looks at a rule that found it broken.
    pub fn share(&self, rule: &str) -> f64 {
        self.rules.get(rule).map_or(0.0, |c| c.broken as f64 / c.checked.max(1) as f64)
    }

    pub fn broken(&self, rule: &str) -> usize {
        self.rules.get(rule).map_or(0, |count| count.broken)
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (rule, count) in &self.rules {
            writeln!(f, "  {rule}: {} of {} broken", count.broken, count.checked)?;
            let mut worst: Vec<_> = count.of_mesh.iter().collect();
            worst.sort_by_key(|(_, broken)| std::cmp::Reverse(**broken));
            for (mesh, broken) in worst.into_iter().take(4) {
                writeln!(f, "      {broken} in {mesh}")?;
            }
            count.first.iter().take(2).try_for_each(|first| writeln!(f, "      e.g. {first}"))?;
        }
        Ok(())
    }
}
