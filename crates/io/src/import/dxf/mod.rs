//! DXF, every ASCII release from R12 on: lines, arcs, circles, polylines with bulges, ellipses, splines, and blocks of
//! them inserted once or as arrays, scaled, turned and mirrored.
//!
//! The reader is the project's own and small, since a machinist's drawing must be read strictly: a number that is no
//! number, a missing line, a file that is cut are errors with their line, never a default value in their place. The
//! crates that exist fill such gaps silently, and the best-known refuses valid R12 files. What the reader guarantees:
//!
//! - time and memory are bounded by the file's size and [`MAX_CURVES`]; counts that the file states are never believed;
//! - what isn't geometry (text, dimensions, hatches, points) is left out silently, unknown kinds with a warning;
//! - paper space, invisible entities and layers that are off or frozen are left out, unless a layer is asked for by name.

mod entity;
mod expand;
mod groups;
mod raw;
mod tables;

use super::ImportOptions;
use super::error::{FaultKind, ImportError, Place};
use super::sketch::{MAX_CURVES, Sketch, Source};
use entity::{Entity, Reading};
use groups::{CUT_HINT, Group, Groups, decode, syntax};
use pocketry_geom::{Point, point};
use raw::{Raw, block_key};
use std::collections::{BTreeMap, HashMap};
use tables::{Header, Layers};

/// A block's base point and contents.
#[derive(Debug, Default)]
struct Block {
    base: Point,
    entities: Vec<Entity>,
}

/// Everything of a file that matters.
#[derive(Debug, Default)]
struct File {
    header: Header,
    layers: Layers,
    blocks: HashMap<String, Block>,
    entities: Vec<Entity>,
    counts: Counts,
}

/// What was left out while reading.
#[derive(Debug, Default)]
struct Counts {
    unknown: BTreeMap<String, (usize, Source)>,
    empty: BTreeMap<String, (usize, Source)>,
    hidden: usize,
    annotations: usize,
    ended: bool,
}

/// The drawing in a DXF file.
///
/// # Errors
/// Everything that makes the file no drawing; see the module's guarantees.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Sketch, ImportError> {
    let (text, healed) = decode(bytes)?;
    let file = parse(&text)?;
    let mut sketch = Sketch::default();
    if let Some(healed) = healed {
        sketch.warn(Place::default(), healed);
    }
    if !file.counts.ended {
        sketch.warn(Place::default(), "the file lacks its end mark (EOF); its sections are whole");
    }
    sketch.units = file.header.units(options, &mut sketch)?;
    let hidden_layers = expand::expand(&file, options, &mut sketch)?;
    report(&file.counts, &mut sketch);
    if sketch.loops.is_empty() && sketch.loose.is_empty() {
        return Err(nothing(&file.counts, &hidden_layers));
    }
    Ok(sketch)
}

fn report(counts: &Counts, sketch: &mut Sketch) {
    for (kind, (count, source)) in &counts.unknown {
        sketch.warn(source.place(), format!("{count} × {kind} is not a curve in the plane and is left out"));
    }
    for (kind, (count, source)) in &counts.empty {
        sketch.warn(source.place(), format!("{count} × {kind} has no length and is left out"));
    }
}

fn nothing(counts: &Counts, hidden_layers: &[String]) -> ImportError {
    let mut reasons = Vec::new();
    if counts.annotations > 0 {
        reasons.push(format!("{} texts, points, hatches or dimensions", counts.annotations));
    }
    if counts.hidden > 0 {
        reasons.push(format!("{} entities in paper space or invisible", counts.hidden));
    }
    reasons.extend(counts.empty.iter().map(|(kind, (count, _))| format!("{count} × {kind} without length")));
    reasons.extend(counts.unknown.iter().map(|(kind, (count, _))| format!("{count} × {kind}")));
    if !hidden_layers.is_empty() {
        reasons.push(format!("curves on layers that are off or frozen: {}", hidden_layers.join(", ")));
    }
    let found = if reasons.is_empty() { String::new() } else { format!(" (only {})", reasons.join(", ")) };
    let problem = format!("there are no curves to mill in the drawing's model space{found}");
    ImportError::new(FaultKind::Empty, Place::default(), problem, "draw the pocket with lines, arcs and polylines")
}

fn parse(text: &str) -> Result<File, ImportError> {
    let mut groups = Groups::new(text);
    let mut file = File::default();
    let mut any = false;
    while let Some(group) = groups.next()? {
        match (group.code, group.value) {
            (0, "SECTION") => {
                any = true;
                section(&mut groups, &mut file)?;
            }
            (0, "EOF") => {
                file.counts.ended = true;
                break;
            }
            _ if any => return Err(syntax(group.line, "text between two sections", CUT_HINT)),
            _ => {
                let hint = "give an ASCII DXF file";
                return Err(ImportError::new(FaultKind::Format, Place::line(group.line), "this is no DXF file", hint));
            }
        }
    }
    if any {
        Ok(file)
    } else {
        Err(ImportError::new(FaultKind::Format, Place::default(), "this is no DXF file", "give an ASCII DXF file"))
    }
}

/// The next group; the end of the file here means that it is cut.
fn expect<'a>(groups: &mut Groups<'a>, section: &str) -> Result<Group<'a>, ImportError> {
    groups.next()?.ok_or_else(|| {
        syntax(groups.line(), &format!("the file ends in the middle of its section {section}"), CUT_HINT)
    })
}

fn section(groups: &mut Groups<'_>, file: &mut File) -> Result<(), ImportError> {
    let name = expect(groups, "")?;
    if name.code != 2 {
        return Err(syntax(name.line, "a section without a name", CUT_HINT));
    }
    match name.value {
        "HEADER" => file.header.read(groups),
        "TABLES" => file.layers.read(groups),
        "BLOCKS" => blocks(groups, file),
        "ENTITIES" => {
            let mut at = expect(groups, "ENTITIES")?;
            let entities = entities(groups, &mut at, &["ENDSEC"], "ENTITIES", &mut file.counts)?;
            file.entities.extend(entities);
            Ok(())
        }
        other => {
            while !matches!(expect(groups, other)?, Group { code: 0, value: "ENDSEC", .. }) {}
            Ok(())
        }
    }
}

fn blocks(groups: &mut Groups<'_>, file: &mut File) -> Result<(), ImportError> {
    let mut at = expect(groups, "BLOCKS")?;
    loop {
        match (at.code, at.value) {
            (0, "ENDSEC") => return Ok(()),
            (0, "BLOCK") => {
                let (mut name, mut base) = (String::new(), [0.0; 2]);
                at = expect(groups, "BLOCKS")?;
                while at.code != 0 {
                    match at.code {
                        2 => name = block_key(at.value),
                        10 => base[0] = at.number()?,
                        20 => base[1] = at.number()?,
                        _ => {}
                    }
                    at = expect(groups, "BLOCKS")?;
                }
                // What is left out in a block matters only where the block is inserted; nobody is told.
                let entities = entities(groups, &mut at, &["ENDBLK", "ENDSEC"], "BLOCKS", &mut Counts::default())?;
                file.blocks.insert(name, Block { base: point(base[0], base[1]), entities });
            }
            _ => at = expect(groups, "BLOCKS")?,
        }
    }
}

/// Reads entities from `at`, the first one's type, until one of the end marks, which is left in `at`.
fn entities<'a>(
    groups: &mut Groups<'a>,
    at: &mut Group<'a>,
    ends: &[&str],
    section: &str,
    counts: &mut Counts,
) -> Result<Vec<Entity>, ImportError> {
    let mut entities = Vec::new();
    while !(at.code == 0 && ends.contains(&at.value)) {
        let mut raw = raw_entity(groups, at, section)?;
        if raw.kind == "POLYLINE" {
            while at.code == 0 && at.value == "VERTEX" {
                raw.vertices.extend(raw_entity(groups, at, section)?.vertex()?);
            }
        }
        let context = |error: ImportError| in_entity(error, &raw.source());
        match raw.read().map_err(context)? {
            Reading::Drawn(entity) => entities.push(*entity),
            Reading::Hidden => counts.hidden += 1,
            Reading::Annotation => counts.annotations += 1,
            Reading::Empty(source) => tally(&mut counts.empty, raw.kind, source),
            Reading::Unknown(source) => tally(&mut counts.unknown, raw.kind, source),
        }
    }
    Ok(entities)
}

/// Counts one more of a kind; the first one's source stands for all.
fn tally(counts: &mut BTreeMap<String, (usize, Source)>, kind: &str, source: Source) {
    counts.entry(kind.to_owned()).or_insert((0, source)).0 += 1;
}

/// One entity's groups; `at` moves on to the next entity's type.
fn raw_entity<'a>(groups: &mut Groups<'a>, at: &mut Group<'a>, section: &str) -> Result<Raw<'a>, ImportError> {
    let named = at.value.contains(|c: char| c.is_ascii_alphabetic());
    if at.code != 0 || !named {
        let problem = format!("{:?} (group {}) stands where an entity's type is due", at.value, at.code);
        return Err(syntax(at.line, &problem, "a line is missing or added above; save the drawing again"));
    }
    let mut raw = Raw { kind: at.value, line: at.line, ..Raw::default() };
    loop {
        *at = expect(groups, section)?;
        if at.code == 0 {
            return Ok(raw);
        }
        raw.groups.push(*at);
    }
}

/// Adds the entity to an error that knows only its line.
fn in_entity(mut error: ImportError, source: &Source) -> ImportError {
    if let ImportError::Bad(fault) = &mut error {
        if fault.place.entity.is_none() {
            fault.place.entity = Some(source.entity.clone());
            fault.place.layer = Some(source.layer.clone());
        }
    }
    error
}

/// Refuses drawings that no machine could hold.
fn too_many(count: u64) -> ImportError {
    let problem = format!("its blocks lay out to {count} curves, more than the {MAX_CURVES} that are read");
    ImportError::new(FaultKind::Limit, Place::default(), problem, "remove nested or arrayed insertions")
}
