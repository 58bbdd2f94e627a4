//! Property tests that try the same cases on every run, or as many as `PROPTEST_CASES` asks for.

use proptest::test_runner::{Config, RngSeed};

pub fn seeded(cases: u32) -> Config {
    let asked = Config::default();
    Config {
        cases: if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { cases },
        rng_seed: match asked.rng_seed {
            RngSeed::Random => RngSeed::Fixed(1),
            fixed => fixed,
        },
        failure_persistence: None,
        ..asked
    }
}
