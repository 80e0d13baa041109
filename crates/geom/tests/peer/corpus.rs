//! Every polygon region of the shared corpus, where it is at hand.

use crate::definition::covered;
use crate::peer::Grid;
use pocketry_geom::offset::{BisectorEngine, Offset, OffsetEngine, OffsetOptions, bisector};
use pocketry_geom::{Region, Segment};
use pocketry_testkit::corpus::{Record, read, region, shared};

/// The limit that both sides use.
pub(crate) const LIMIT: f64 = 10.0;

/// The corpus's files.
pub(crate) const FAMILIES: [&str; 9] =
    ["param", "adversarial", "icons", "glyphs", "geo", "pcb", "mesh", "issues", "raw"];

/// How much nearer and farther the other's offsets are taken, as a share of the region's size.
const NESTING: f64 = 1e-6;

/// What came of one region.
#[derive(Default)]
pub(crate) struct Outcome {
    /// Offsets that nest with the peer's.
    pub(crate) agree: usize,
    /// Offsets that do not, where the definition is on our side.
    pub(crate) peer_wrong: usize,
    /// What is wrong with ours.
    pub(crate) wrong: Vec<String>,
}

/// Compares the offsets at `distances`.
pub(crate) fn compare(region: &Region, distances: &[f64]) -> Outcome {
    let engine = BisectorEngine { mitre_limit: Some(LIMIT), ..BisectorEngine::default() };
    let mut out = Outcome::default();
    let offsets = match engine.offsets(region, distances, &OffsetOptions::default()) {
        Ok(offsets) => offsets,
        Err(e) => {
            out.wrong.push(e.to_string());
            return out;
        }
    };
    let bbox = region.bbox();
    let (grid, step) = (Grid::new(bbox), NESTING * bbox.size());
    let paths = grid.region(region);
    let by_parts = region.edge_count() > number("POCKETRY_BY_PARTS", 10_000);
    let peer = |d: f64| {
        if by_parts { grid.inwards_by_parts(region, d, LIMIT) } else { grid.inwards(&paths, d, LIMIT) }
    };
    for offset in offsets {
        let d = offset.distance;
        if let Err(e) = well_formed(&offset) {
            out.wrong.push(format!("at {d}: {e}"));
        }
        let ours = grid.offset(&offset);
        let too_much = grid.excess(&ours, &peer(d - step));
        let too_little = grid.excess(&peer(d + step), &ours);
        // Where the two differ, the definition judges every part.
        let extra = too_much.iter().filter(|&&p| !region.contains(p) || covered(region, p, d - 0.5 * step, LIMIT));
        let lost = too_little.iter().filter(|&&p| region.contains(p) && !covered(region, p, d + 0.5 * step, LIMIT));
        let before = out.wrong.len();
        out.wrong.extend(extra.map(|p| format!("at {d}: too much at {p:?}")));
        out.wrong.extend(lost.map(|p| format!("at {d}: lost {p:?}")));
        if too_much.is_empty() && too_little.is_empty() {
            out.agree += 1;
        } else if out.wrong.len() == before {
            out.peer_wrong += 1;
        }
    }
    out
}

/// Loops are closed, and islands lie in boundaries.
pub(crate) fn well_formed(offset: &Offset) -> Result<(), String> {
    for l in &offset.loops {
        let s = &l.contour.segments;
        if s.len() < 3 || (0..s.len()).any(|k| s[k].end() != s[(k + 1) % s.len()].start()) {
            return Err("open loop".to_owned());
        }
    }
    let remaining = bisector::remaining(offset);
    for (contour, parent) in remaining.contours().iter().zip(remaining.parents()) {
        if (contour.area() > 0.0) != parent.is_none() {
            return Err(format!("wrong orientation of the loop at {:?}", contour.segments[0].start()));
        }
    }
    Ok(())
}

fn polygon(record: &Record) -> Option<Region> {
    let region = region(&record.loops).ok()?;
    let straight = region.segments().all(|s| matches!(s, Segment::Line(_)));
    straight.then_some(region)
}

/// A number from the environment.
pub(crate) fn number(name: &str, default: usize) -> usize {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(default)
}

/// Which regions are compared. `POCKETRY_LARGEST` raises the limit of edges, whose default, `largest`, keeps a test to seconds;
/// `POCKETRY_SMALLEST` and `POCKETRY_ONLY` (a part of a name) leave others out, for runs of few large ones. From `POCKETRY_BY_PARTS` edges on
/// the peer unites strips and mitres instead of going round them.
pub(crate) fn is_wanted(record: &Record, region: &Region, largest: usize) -> bool {
    let only = std::env::var("POCKETRY_ONLY").unwrap_or_default();
    let sizes = number("POCKETRY_SMALLEST", 0)..=number("POCKETRY_LARGEST", largest);
    record.id.contains(&only) && sizes.contains(&region.edge_count())
}

/// The radius and the interval meant for a record, mm.
fn spacing(record: &Record, region: &Region) -> (f64, f64) {
    let size = region.bbox().size();
    if record.tool_radius > 0.0 { (record.tool_radius, record.interval) } else { (0.02 * size, 0.03 * size) }
}

#[test]
fn polygons_of_the_corpus_agree_with_an_independent_mitre_offset() {
    let Some(shared) = shared() else { return };
    let (mut total, mut failures, mut regions) = (Outcome::default(), Vec::new(), 0);
    for family in FAMILIES {
        for record in read(&shared.join(format!("corpus/dev/{family}.jsonl"))).expect("a corpus file") {
            let Some(region) = polygon(&record).filter(|r| is_wanted(&record, r, 400)) else { continue };
            regions += 1;
            let (r, w) = spacing(&record, &region);
            let outcome = compare(&region, &[r, r + w, r + 3.0 * w]);
            total.agree += outcome.agree;
            total.peer_wrong += outcome.peer_wrong;
            if outcome.peer_wrong > 0 {
                println!("{}: {} where the peer is wrong", record.id, outcome.peer_wrong);
            }
            failures.extend(outcome.wrong.into_iter().map(|w| format!("{}: {w}", record.id)));
        }
    }
    println!("{regions} regions, {} offsets agree, {} where the peer is wrong", total.agree, total.peer_wrong);
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// Edges crowd here, so that loops are found without most of the raw curve; one of them went missing that began with an edge that stands upright.
#[test]
fn window_land_31_keeps_all_its_loops() {
    let Some(shared) = shared() else { return };
    let records = read(&shared.join("corpus/dev/geo.jsonl")).expect("a corpus file");
    let record = records.iter().find(|r| r.id == "geo/window-land/31").expect("the record");
    let region = polygon(record).expect("a polygon");
    let levels: Vec<f64> = (0..6).map(|k| record.tool_radius + f64::from(k) * record.interval).collect();
    let outcome = compare(&region, &levels);
    assert_eq!((outcome.agree, outcome.wrong), (levels.len(), Vec::<String>::new()));
}
