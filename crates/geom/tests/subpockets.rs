//! Properties 3.2 to 3.5, 6.1 and 6.2 of Chou and Cohen, and that subpockets tile their region: on the corpus and on generated
//! regions. Each is judged from bare facts, so that a fact can be falsified to see the judge fail.

use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::voronoi::{EdgeCurve, upward};
use pocketry_geom::skeleton::check::CheckOptions;
use pocketry_geom::skeleton::trees::{DisjointSets, Kind, Trees};
use pocketry_geom::skeleton::{EdgeId, Site, SiteShape, Skeleton, Vertex, VertexId};
use pocketry_geom::subpockets::{Border, Subpockets};
use pocketry_geom::{Contour, Point, Region, Segment};
use pocketry_testkit::{Loops, corpus, shapes, strategies};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Larger regions of the corpus are left to release builds (`cargo test --release -p pocketry-geom --test subpockets`).
const MOST_EDGES: usize = if cfg!(debug_assertions) { 400 } else { 1_000_000 };
/// What a clearance may be off, relative to the region's size.
const ACCURACY: f64 = 1e-7;
/// Walls this much farther than the nearest still count as contacts, relative to the region's size: a vertex of high degree
/// is a cluster of vertices.
const CONTACT: f64 = 1e-5;
/// What the angle between two contacts may be off: it moves with the root of what a clearance is off.
const ANGLE: f64 = 0.02;
/// Shares of a peak's clearance at which loops are drawn.
const SHARES: [f64; 4] = [0.05, 0.4, 0.75, 0.98];

/// What is known of a decomposed region.
#[derive(Clone, Default)]
struct Facts {
    size: f64,
    area: f64,
    /// For each plateau: what it is, its clearance, and the plateaus that its edges rise to.
    plateaus: Vec<(Kind, f64, Vec<u32>)>,
    /// Distances to the walls along every edge that is not constant but for rounding, from its lower end.
    slopes: Vec<Vec<f64>>,
    /// Directions of the contacts at peaks and passes of one vertex, those that only rounding makes left out.
    contacts: Vec<(Kind, Vec<f64>)>,
    /// For each subpocket: its peak, whether it is an annulus, and its contours.
    subpockets: Vec<(Point, bool, Vec<Contour>)>,
    /// Loops by subpocket and number of their distance.
    loops: BTreeMap<(u32, usize), Vec<Contour>>,
}

impl Facts {
    fn of(region: &Region, skeleton: &Skeleton) -> Self {
        let (trees, walls) = (Trees::new(skeleton), Boundary::new(region));
        let subpockets = Subpockets::new(skeleton);
        let place = |v: VertexId| subpockets.skeleton().vertices()[v as usize].point;
        let list = subpockets.list().iter().map(|s| (place(s.peak[0]), s.is_annulus, s.contours.clone())).collect();
        Self {
            size: region.bbox().size(),
            area: region.area(),
            plateaus: plateaus(skeleton, &trees),
            slopes: slopes(skeleton, &walls, ACCURACY * region.bbox().size()),
            contacts: contacts(skeleton, &trees, &subpockets, region.bbox().size()),
            subpockets: list,
            loops: loops(&subpockets),
        }
    }
}

fn plateaus(skeleton: &Skeleton, trees: &Trees) -> Vec<(Kind, f64, Vec<u32>)> {
    let to = |&e: &EdgeId| trees.plateau_of(skeleton.target(e));
    trees.plateaus().iter().map(|p| (p.kind, p.clearance, p.up.iter().map(to).collect())).collect()
}

fn slopes(skeleton: &Skeleton, walls: &Boundary, constant: f64) -> Vec<Vec<f64>> {
    let edges = (0..skeleton.edge_count() as EdgeId).map(|k| upward(skeleton, 2 * k));
    edges
        .map(|e| EdgeCurve::new(skeleton, e))
        .filter(|c| c.high().clearance - c.low().clearance > constant)
        .map(|c| {
            let (low, high) = (c.low().clearance, c.high().clearance);
            (0..=4).map(|k| walls.distance(c.at_clearance(low + (high - low) * f64::from(k) / 4.0))).collect()
        })
        .collect()
}

fn contacts(skeleton: &Skeleton, trees: &Trees, subpockets: &Subpockets, size: f64) -> Vec<(Kind, Vec<f64>)> {
    // A pass that a neighbouring peak rises above by no more than rounding is no pass, and that peak no peak.
    let peak = |k: u32| &subpockets.list()[k as usize];
    let flat = |b: &&Border| b.between.iter().any(|&k| peak(k).clearance - b.clearance <= CONTACT * size);
    let noise: Vec<&Border> = subpockets.borders().iter().filter(flat).collect();
    let real = |v: VertexId| {
        let point = skeleton.vertices()[v as usize].point;
        noise.iter().all(|b| b.pass != point && b.between.iter().all(|&k| !peak(k).peak.contains(&v)))
    };
    let single = trees.plateaus().iter().filter(|p| p.vertices.len() == 1 && real(p.vertices[0]));
    let extreme = single.filter(|p| matches!(p.kind, Kind::Peak | Kind::Pass));
    let directions = |v: VertexId| {
        let Vertex { point: p, clearance } = skeleton.vertices()[v as usize];
        let near = |foot: Point| (foot.distance(p) <= clearance + CONTACT * size).then(|| (foot - p).angle());
        let of_site = |site: &Site| match site.shape {
            SiteShape::Line(l) => vec![near(l.nearest(p))],
            // About its centre an arc touches everywhere; its ends and its middle stand for that.
            SiteShape::Arc(a) => vec![near(a.nearest(p)), near(a.start), near(a.end), near(Segment::Arc(a).at(0.5))],
            SiteShape::Point(q) => vec![near(q)],
        };
        skeleton.sites().iter().flat_map(of_site).flatten().collect()
    };
    extreme.map(|p| (p.kind, directions(p.vertices[0]))).collect()
}

fn loops(subpockets: &Subpockets) -> BTreeMap<(u32, usize), Vec<Contour>> {
    let offsetter = subpockets.offsetter();
    let mut found: BTreeMap<(u32, usize), Vec<Contour>> = BTreeMap::new();
    for (s, subpocket) in subpockets.list().iter().enumerate().take(12) {
        for (k, share) in SHARES.iter().enumerate() {
            let all = subpockets.loops_at(&offsetter, share * subpocket.clearance).unwrap();
            let own = all.into_iter().filter(|l| l.subpocket as usize == s).map(|l| l.path.contour);
            found.insert((s as u32, k), own.collect());
        }
    }
    found
}

type Judgement = Result<(), String>;

fn require(holds: bool, what: impl FnOnce() -> String) -> Judgement {
    if holds { Ok(()) } else { Err(what()) }
}

/// 3.2: peaks and passes lie at vertices, which have the contacts that a maximum or a minimum has.
fn extremes_have_their_contacts(f: &Facts) -> Judgement {
    f.contacts.iter().try_for_each(|(kind, angles)| {
        let mut sorted: Vec<f64> = angles.iter().map(|a| a.rem_euclid(TAU)).collect();
        sorted.sort_by(f64::total_cmp);
        let gap = |k: usize| (sorted[(k + 1) % sorted.len()] - sorted[k]).rem_euclid(TAU);
        let opposite = |a: f64| sorted.iter().any(|b| ((a - b).rem_euclid(TAU) - PI).abs() < ANGLE);
        let right = match kind {
            Kind::Peak => (0..sorted.len()).all(|k| gap(k) <= PI + ANGLE) && sorted.len() > 1,
            _ => sorted.iter().any(|&a| opposite(a)),
        };
        require(right, || format!("3.2: a {kind:?} with contacts {sorted:?}"))
    })
}

/// 3.3: clearance is monotone along every edge.
fn edges_are_monotone(f: &Facts) -> Judgement {
    f.slopes.iter().try_for_each(|s| {
        require(s.windows(2).all(|w| w[1] > w[0] - ACCURACY * f.size), || format!("3.3: clearances {s:?} on an edge"))
    })
}

/// 3.4: with passes as leaves of each tree that they join, plateaus are a forest rooted at the peaks.
fn plateaus_are_a_forest(f: &Facts) -> Judgement {
    let copies: usize = f.plateaus.iter().map(|p| p.2.len().max(1)).sum();
    let mut sets = DisjointSets::new(f.plateaus.len() + copies);
    let (mut fresh, mut trees) = (f.plateaus.len() as u32, f.plateaus.len());
    for (k, (kind, _, ups)) in f.plateaus.iter().enumerate() {
        let leaf = matches!(kind, Kind::Pass | Kind::Boundary);
        require(leaf || ups.len() == usize::from(*kind != Kind::Peak), || {
            format!("3.4: {kind:?} with {} ups", ups.len())
        })?;
        for (j, &up) in ups.iter().enumerate() {
            let node = if j == 0 { k as u32 } else { fresh };
            if j > 0 {
                fresh += 1;
                trees += 1;
            }
            require(sets.find(node) != sets.find(up), || format!("3.4: a cycle at plateau {k}"))?;
            sets.join(node, up);
            trees -= 1;
        }
    }
    let peaks = f.plateaus.iter().filter(|p| p.0 == Kind::Peak).count();
    require(trees == peaks, || format!("3.4: {trees} trees with {peaks} peaks"))
}

/// 3.5: clearance falls from root to leaf.
fn branches_fall(f: &Facts) -> Judgement {
    f.plateaus.iter().try_for_each(|(kind, clearance, ups)| {
        require(ups.iter().all(|&u| f.plateaus[u as usize].1 > *clearance), || {
            format!("3.5: {kind:?} at {clearance} below {ups:?}")
        })
    })
}

/// 6.1: one loop in each subpocket (two in an annulus).
fn one_loop_each(f: &Facts) -> Judgement {
    f.loops.iter().try_for_each(|(&(s, k), loops)| {
        let expected = 1 + usize::from(f.subpockets[s as usize].1);
        // A loop smaller than rounding may be dropped.
        let tiny = k + 1 == SHARES.len() && loops.is_empty();
        require(loops.len() == expected || tiny, || format!("6.1: {} loops in subpocket {s}, level {k}", loops.len()))
    })
}

/// 6.2: every loop of a subpocket goes round its peak.
fn loops_share_the_peak(f: &Facts) -> Judgement {
    f.loops.iter().filter(|l| !f.subpockets[l.0.0 as usize].1).try_for_each(|(&(s, k), loops)| {
        let peak = f.subpockets[s as usize].0;
        let around = |c: &Contour| {
            let inside = Region::from_parts_unchecked(vec![c.clone()], vec![None]).contains(peak);
            inside || c.distance(peak) <= ACCURACY * f.size
        };
        require(loops.iter().all(around), || format!("6.2: level {k} of subpocket {s} leaves {peak:?} out"))
    })
}

/// Areas add up; loops of each run counter-clockwise once, so that none is counted negative.
fn subpockets_tile(f: &Facts) -> Judgement {
    let area = |s: &(Point, bool, Vec<Contour>)| s.2.iter().map(Contour::area).sum::<f64>();
    let sum: f64 = f.subpockets.iter().map(area).sum();
    let scale = f.size * f.size;
    let off = (sum - f.area).abs();
    require(off <= ACCURACY * scale, || format!("areas add up to {sum}, not {}", f.area))?;
    f.subpockets.iter().try_for_each(|s| {
        require(area(s) > -ACCURACY * scale && s.2.len() <= 1 + usize::from(s.1), || {
            format!("a subpocket of area {} with {} contours", area(s), s.2.len())
        })
    })
}

const PROPERTIES: [fn(&Facts) -> Judgement; 7] = [
    extremes_have_their_contacts,
    edges_are_monotone,
    plateaus_are_a_forest,
    branches_fall,
    one_loop_each,
    loops_share_the_peak,
    subpockets_tile,
];

/// All properties of a region; a region whose skeleton does not pass its own check is another test's affair.
fn holds(loops: &Loops) -> Result<bool, String> {
    let region = corpus::region(loops).map_err(|e| e.to_string())?;
    let Ok(skeleton) = Skeleton::build(&region) else { return Ok(false) };
    if !skeleton.check(&region, &CheckOptions::default()).is_ok() {
        return Ok(false);
    }
    let facts = Facts::of(&region, &skeleton);
    PROPERTIES.iter().try_for_each(|property| property(&facts))?;
    Ok(true)
}

fn facts(loops: &Loops) -> Facts {
    let region = corpus::region(loops).unwrap();
    Facts::of(&region, &Skeleton::build(&region).unwrap())
}

#[test]
fn the_corpus_has_the_properties() {
    let Some(folder) = corpus::shared() else { return };
    let (mut judged, mut failures) = (0, Vec::new());
    for family in ["param", "adversarial", "icons", "glyphs", "geo", "pcb", "mesh"] {
        let records = corpus::read(&folder.join(format!("corpus/dev/{family}.jsonl"))).unwrap();
        for record in records.iter().filter(|r| r.loops.iter().map(Vec::len).sum::<usize>() <= MOST_EDGES) {
            match holds(&record.loops) {
                Ok(sound) => judged += usize::from(sound),
                Err(e) => failures.push(format!("{}: {e}", record.id)),
            }
        }
    }
    eprintln!("{judged} regions judged");
    assert!(failures.is_empty(), "{} of {judged}:\n{}", failures.len(), failures.join("\n"));
    assert!(judged > 1000);
}

#[test]
fn each_judge_can_fail() {
    let good = facts(&shapes::smooth_with_islands(240, false));
    for property in PROPERTIES {
        property(&good).unwrap();
    }
    assert!(good.contacts.iter().any(|c| c.0 == Kind::Pass) && good.subpockets.len() > 1);
    let fails = |property: fn(&Facts) -> Judgement, falsify: fn(&mut Facts)| {
        let mut bad = good.clone();
        falsify(&mut bad);
        property(&bad).unwrap_err();
    };
    // A peak off its vertex; a pass where the contacts do not face one another.
    fails(extremes_have_their_contacts, |f| f.contacts.push((Kind::Peak, vec![0.0, 1.0, 2.0])));
    fails(extremes_have_their_contacts, |f| f.contacts.push((Kind::Pass, vec![0.0, 3.0])));
    // An edge that was not split at its apex.
    fails(edges_are_monotone, |f| {
        let both: Vec<f64> = f.slopes[0].iter().rev().chain(&f.slopes[0]).copied().collect();
        f.slopes.push(both);
    });
    // A pass that was not taken for one; an edge too many.
    fails(plateaus_are_a_forest, |f| {
        f.plateaus.iter_mut().filter(|p| p.0 == Kind::Pass).for_each(|p| p.0 = Kind::Slope);
    });
    fails(plateaus_are_a_forest, |f| {
        let again = f.plateaus.iter().position(|p| p.0 == Kind::Slope).unwrap();
        let up = f.plateaus[again].2[0];
        f.plateaus[again].2.push(up);
    });
    fails(branches_fall, |f| f.plateaus.iter_mut().filter(|p| p.0 == Kind::Peak).for_each(|p| p.1 = 0.0));
    // A pass that was not cut: two loops, or one that goes round another peak.
    fails(one_loop_each, |f| {
        let other = f.loops[&(1, 0)].clone();
        f.loops.get_mut(&(0, 0)).unwrap().extend(other);
    });
    fails(loops_share_the_peak, |f| f.subpockets.swap(0, 1));
    // A subpocket too few, and one twice.
    fails(subpockets_tile, |f| f.subpockets.truncate(1));
    fails(subpockets_tile, |f| f.subpockets.extend_from_within(..1));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_regions_have_the_properties(loops in strategies::region()) {
        prop_assert!(holds(&loops).is_ok(), "{:?}", holds(&loops));
    }
}
