//! Malformed point sequences heal or are refused with an error; nothing panics. `examples/fuzz_sequences.rs` runs many more.

use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::{OffsetEngine, OffsetOptions, PairwiseEngine};
use pocketry_testkit::{corpus, sequences};

#[test]
fn malformed_sequences_heal_or_are_refused() {
    let (mut healed, mut refused) = (0, 0);
    for seed in 1..2000 {
        let Ok(region) = corpus::region(&sequences::malformed(seed)) else {
            refused += 1;
            continue;
        };
        healed += 1;
        let walls = Boundary::new(&region);
        let Ok(offsets) = PairwiseEngine.offsets(&region, &[0.1, 0.5, 1.5], &OffsetOptions::default()) else {
            continue;
        };
        for (offset, s) in offsets
            .iter()
            .flat_map(|o| o.loops.iter().flat_map(move |l| l.contour.segments.iter().map(move |s| (o, s))))
        {
            let off = (walls.distance(s.at(0.5)) - offset.distance).abs();
            assert!(off <= 1e-6, "seed {seed}: {s:?} is off by {off} at {}", offset.distance);
        }
    }
    assert!(healed > 100 && refused + healed == 1999, "{healed} healed, {refused} refused");
}
