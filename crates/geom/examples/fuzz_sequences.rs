//! Feeds malformed point sequences to healing and to the pair-wise engine. A panic ends it; nothing else is expected.
//!
//! `cargo run --release -p pocketry-geom --example fuzz_sequences -- [COUNT] [FIRST SEED]`

use pocketry_geom::offset::{OffsetEngine, OffsetOptions, PairwiseEngine};
use pocketry_testkit::{corpus, sequences};

fn main() {
    let mut args = std::env::args().skip(1).map(|a| a.parse().unwrap_or(1));
    let (count, first): (u64, u64) = (args.next().unwrap_or(1_000_000), args.next().unwrap_or(1));
    let (mut refused, mut contradictory, mut done) = (0_u64, 0_u64, 0_u64);
    for seed in first..first.saturating_add(count) {
        match corpus::region(&sequences::malformed(seed)) {
            Err(_) => refused += 1,
            Ok(region) => match PairwiseEngine.offsets(&region, &[0.1, 0.5, 1.5], &OffsetOptions::default()) {
                Ok(_) => done += 1,
                Err(_) => contradictory += 1,
            },
        }
    }
    println!("{done} offset, {refused} refused as regions, {contradictory} refused by the engine, no panic");
}
