//! From a sketch to a region: loose segments are chained, loops nested and healed, the origin set.

use super::error::{FaultKind, ImportError, Place, Warning};
use super::sketch::{Loop, Sketch, Source};
use super::{Drawing, ImportOptions, Origin};
use pocketry_geom::chain::{self, Branch, ChainNote, Chains, OpenChain};
use pocketry_geom::repair::{self, Note, RegionError, RepairOptions};
use pocketry_geom::{BBox, Contour, Point, Region, Segment, Vec2, tolerance};
use std::collections::HashMap;

/// Makes a region of a sketch.
///
/// # Errors
/// Contours that don't close, that cross, or that enclose nothing.
pub(super) fn assemble(mut sketch: Sketch, options: &ImportOptions) -> Result<Drawing, ImportError> {
    chain_loose(&mut sketch, options)?;
    if sketch.loops.is_empty() {
        let hint = "close the pocket's outline";
        return Err(ImportError::new(FaultKind::Empty, Place::default(), "there is no closed contour", hint));
    }
    let Sketch { loops, sources, mut warnings, units, .. } = sketch;
    let owners: Vec<u32> = loops.iter().map(|l| l.source).collect();
    let source_of = |contour: u32| owners.get(contour as usize).map_or(&sources[0], |&s| &sources[s as usize]);
    let starts = Starts::new(&loops);
    let contours: Vec<Contour> = loops.into_iter().map(|l| l.contour).collect();
    let repair = RepairOptions { join_tolerance: options.join_tolerance };
    let healed = repair::build(contours, &repair).map_err(|e| region_error(&e, |k| source_of(k).place()))?;
    warnings.extend(healed.notes.iter().map(|note| warning(note, source_of)));
    let contour_sources = healed
        .region
        .contours()
        .iter()
        .map(|c| starts.source(c).map_or_else(Source::default, |s| sources[s as usize].clone()));
    let contour_sources = contour_sources.collect();
    Ok(Drawing {
        region: placed(healed.region, options.origin),
        warnings,
        units,
        id: None,
        tool_radius: None,
        interval: None,
        sources: contour_sources,
    })
}

/// Which source drew the edge that starts at a point.
struct Starts(HashMap<(u64, u64), u32>);

impl Starts {
    fn new(loops: &[Loop]) -> Self {
        let edges = loops.iter().flat_map(|l| l.contour.segments.iter().map(|s| (Self::key(s.start()), l.source)));
        Self(edges.collect())
    }

    const fn key(p: Point) -> (u64, u64) {
        (p.x.to_bits(), p.y.to_bits())
    }

    fn source(&self, contour: &Contour) -> Option<u32> {
        contour.segments.iter().find_map(|s| self.0.get(&Self::key(s.start())).copied())
    }
}

/// Joins loose segments into loops; what stays open is left out with a warning, or an error where it looks like a contour.
fn chain_loose(sketch: &mut Sketch, options: &ImportOptions) -> Result<(), ImportError> {
    if sketch.loose.is_empty() {
        return Ok(());
    }
    let pieces: Vec<Segment> = sketch.loose.iter().map(|l| l.segment).collect();
    let chains = chain_in_two_passes(&pieces, options.join_tolerance);
    let source_of = |k: usize| sketch.loose[k].source;
    let place_of = |k: usize| sketch.sources[source_of(k) as usize].place();
    let mut loops = Vec::with_capacity(chains.closed.len());
    for (contour, members) in chains.closed {
        let source = members.first().map_or(0, |&k| source_of(k));
        loops.push(Loop { contour, source });
    }
    let alone = loops.is_empty() && sketch.loops.is_empty();
    let mut warnings = Vec::new();
    for open in &chains.open {
        let place = open.pieces.first().map_or_else(Place::default, |&k| place_of(k)).at(open.start);
        let length = open.pieces.iter().map(|&k| pieces[k].length()).sum();
        warnings.push(left_out(open, length, alone, &chains.branches, place)?);
    }
    warnings.extend(chains.notes.iter().map(|note| chain_warning(note, place_of)));
    sketch.loops.extend(loops);
    sketch.warnings.extend(warnings);
    Ok(())
}

/// Chains what meets but for rounding first, so that details finer than the join tolerance survive; only what stays open
/// then is joined within the tolerance.
fn chain_in_two_passes(pieces: &[Segment], join_tolerance: f64) -> Chains {
    let bbox = pieces.iter().fold(BBox::EMPTY, |b, s| b.union(s.bbox()));
    let rounding = tolerance::touch_length(bbox);
    let mut chains = chain::chain(pieces, rounding.min(join_tolerance));
    chains.notes.retain(|note| !matches!(note, ChainNote::Joined { .. }));
    let rest: Vec<usize> = chains.open.iter().flat_map(|open| open.pieces.iter().copied()).collect();
    if rest.is_empty() || join_tolerance <= rounding {
        return chains;
    }
    let loose: Vec<Segment> = rest.iter().map(|&k| pieces[k]).collect();
    let second = renamed(chain::chain(&loose, join_tolerance), &rest);
    chains.closed.extend(second.closed);
    chains.notes.extend(second.notes);
    Chains { open: second.open, branches: second.branches, ..chains }
}

/// The same chains with their pieces named by `names`.
fn renamed(mut chains: Chains, names: &[usize]) -> Chains {
    let rename = |pieces: &mut Vec<usize>| pieces.iter_mut().for_each(|k| *k = names[*k]);
    chains.closed.iter_mut().for_each(|(_, pieces)| rename(pieces));
    chains.open.iter_mut().for_each(|open| rename(&mut open.pieces));
    chains.branches.iter_mut().for_each(|branch| rename(&mut branch.pieces));
    for note in &mut chains.notes {
        match note {
            ChainNote::ZeroLength { piece, .. } | ChainNote::Joined { piece, .. } => *piece = names[*piece],
            ChainNote::Duplicate { piece, kept: other, .. } | ChainNote::Covered { piece, by: other, .. } => {
                (*piece, *other) = (names[*piece], names[*other]);
            }
        }
    }
    chains
}

/// An open chain: a stray line is left out, one that all but closes is a contour that the machinist means.
fn left_out(
    open: &OpenChain,
    length: f64,
    alone: bool,
    branches: &[Branch],
    place: Place,
) -> Result<Warning, ImportError> {
    let (from, to) = (open.start, open.end);
    let ends = format!("({:.4}, {:.4}) and ({:.4}, {:.4})", from.x, from.y, to.x, to.y);
    let branches_at = |p: Point| branches.iter().any(|b| b.at == p);
    if branches_at(from) && branches_at(to) {
        let problem = format!("at {ends} three or more lines meet, and it isn't clear which of them bound the pocket");
        return Err(ImportError::new(FaultKind::Open, place, problem, "remove the line that is none of its walls"));
    }
    if alone || open.gap < 0.5 * length {
        let problem = format!("the contour is open: it ends at {ends}, {:.4} mm apart", open.gap);
        let hint = "close the gap in the drawing, or raise the join tolerance if it is that small";
        return Err(ImportError::new(FaultKind::Open, place, problem, hint));
    }
    Ok(Warning::new(place, format!("an open line, from and to {ends}, is left out")))
}

fn chain_warning(note: &ChainNote, place_of: impl Fn(usize) -> Place) -> Warning {
    let (piece, at, message) = match *note {
        ChainNote::ZeroLength { piece, at } => (piece, at, "it has no length and is left out".to_owned()),
        ChainNote::Duplicate { piece, kept, at } => {
            (piece, at, format!("it is drawn twice ({}) and used once", place_of(kept)))
        }
        ChainNote::Covered { piece, by, at } => {
            (piece, at, format!("it lies on another line ({}) and is left out", place_of(by)))
        }
        ChainNote::Joined { piece, at, count, widest } => {
            (piece, at, format!("{count} gap(s) of up to {widest:.2e} mm are closed by moving ends"))
        }
    };
    Warning::new(place_of(piece).at(at), message)
}

/// A region's error in the words of the drawing.
pub(super) fn region_error(error: &RegionError, place_of: impl Fn(u32) -> Place) -> ImportError {
    let (place, problem, hint) = match *error {
        RegionError::NotFinite { contour, .. } => {
            (place_of(contour), "it holds a number that is no number".into(), "correct it")
        }
        RegionError::Absurd { contour, at } => {
            (place_of(contour).at(at), "it reaches farther than any part".into(), "check the drawing's units")
        }
        RegionError::TooSmall { size, at } => {
            let problem = format!("the whole drawing measures {size:e} mm, too small to be told from a point");
            (Place::default().at(at), problem, "check the drawing's units")
        }
        RegionError::Open { contour, at, gap } => {
            (place_of(contour).at(at), format!("the contour is open by {gap:.6} mm"), "close it in the drawing")
        }
        RegionError::Crossing { first, second, at } if first == second => {
            let hint = "trim it so that inside and outside are clear";
            (place_of(first).at(at), "the contour crosses itself".into(), hint)
        }
        RegionError::Crossing { first, second, at } => {
            let problem = format!("it crosses another contour ({})", place_of(second));
            (place_of(first).at(at), problem, "trim or move one of them so that inside and outside are clear")
        }
        RegionError::Nothing { loops, at } => {
            let problem = format!("none of its {loops} closed contours encloses an area");
            (Place::default().at(at), problem, "draw the pocket's outline")
        }
    };
    let kind = match error {
        RegionError::Open { .. } => FaultKind::Open,
        RegionError::Nothing { .. } => FaultKind::Empty,
        RegionError::Absurd { .. } | RegionError::TooSmall { .. } => FaultKind::Limit,
        RegionError::NotFinite { .. } => FaultKind::Value,
        RegionError::Crossing { .. } => FaultKind::Region,
    };
    ImportError::new(kind, place, problem, hint)
}

fn warning<'a>(note: &Note, source_of: impl Fn(u32) -> &'a Source) -> Warning {
    let (contour, other) = note.contours();
    let place = source_of(contour).place().at(note.at());
    let with = other.filter(|&o| o != contour).map(|o| source_of(o).place().to_string()).unwrap_or_default();
    let message = match note {
        Note::ZeroLength { count, .. } => format!("{count} edge(s) without length are left out"),
        Note::Closed { gap, .. } => format!("a gap of {gap:e} mm is closed"),
        Note::ZeroArea { .. } => "it encloses no area and is left out".to_owned(),
        Note::Duplicate { .. } => format!("it repeats another contour ({with}) and is left out"),
        Note::Spike { .. } => "it runs back on itself; the spike is cut off".to_owned(),
        Note::Curl { size, .. } => format!("it crosses itself; a curl of {size:.2e} mm is cut off"),
        Note::Shared { .. } => {
            format!("it shares an edge with another contour ({with}); the areas on both sides are joined")
        }
        Note::Overlap { length, .. } if with.is_empty() => {
            format!("a sliver {length:.2e} mm long where it meets itself is cut off")
        }
        Note::Overlap { length, .. } => {
            format!("a sliver {length:.2e} mm long between it and another contour ({with}) is cut off")
        }
        Note::Touch { .. } if with.is_empty() => "it touches itself; taken as it is".to_owned(),
        Note::Touch { .. } => format!("it touches another contour ({with}); taken as it is"),
    };
    Warning::new(place, message)
}

/// Whether loops are free of crossings.
pub(super) fn check_crossings(loops: &[Contour], options: &ImportOptions) -> Result<(), RegionError> {
    repair::build(loops.to_vec(), &RepairOptions { join_tolerance: options.join_tolerance }).map(|_| ())
}

/// The region with its zero point where it was asked for.
fn placed(region: Region, origin: Origin) -> Region {
    let bbox = region.bbox();
    let by: Vec2 = match origin {
        Origin::Keep => return region,
        Origin::LowerLeft => Point::ORIGIN - bbox.min,
        Origin::Center => Point::ORIGIN - bbox.center(),
    };
    let contours = region.contours().iter().map(|c| c.translated(by)).collect();
    Region::from_parts_unchecked(contours, region.parents().to_vec())
}
