//! STL: 80 bytes of header, a count, and 50 bytes a facet; or words, from `solid` to `endsolid`.
//!
//! Normals are not used: the order of the corners says where outside is, and files agree on that more often than on normals.

use super::{Soup, check_count, facet, finite};
use crate::import::error::{FaultKind, ImportError, Place, Warning};
use pocketry_geom::mesh::Corner;

const HEADER: usize = 84;
const FACET: usize = 50;

/// Whether the bytes are STL of either kind.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    is_text(bytes) || announced(bytes).is_some_and(|n| bytes.len() == HEADER + FACET * n)
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ImportError> {
    let exact = announced(bytes).is_some_and(|n| n > 0 && bytes.len() == HEADER + FACET * n);
    if !exact && is_text(bytes) { text(bytes) } else { binary(bytes) }
}

/// The count of a binary file.
fn announced(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize)
}

/// Whether it begins like text and goes on like it: binary headers may begin with `solid`, too.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    start.get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid")) && !start.iter().take(512).any(|&b| b == 0)
}

fn binary(bytes: &[u8]) -> Result<Soup, ImportError> {
    let cut = |problem: String| {
        Err(ImportError::new(
            FaultKind::Syntax,
            Place::default(),
            problem,
            "the file is cut short: copy or export it again",
        ))
    };
    let Some(count) = announced(bytes) else {
        return cut(format!("{} bytes are too few for a binary STL file", bytes.len()));
    };
    check_count(count)?;
    let body = &bytes[HEADER..];
    if body.len() < FACET * count {
        return cut(format!("the file promises {count} facets and ends within facet {}", body.len() / FACET + 1));
    }
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let corner = |b: &[u8]| -> Corner { [number(b), number(&b[4..]), number(&b[8..])] };
    let triangle = |b: &[u8]| [corner(&b[12..]), corner(&b[24..]), corner(&b[36..])];
    let triangles = body.chunks_exact(FACET).take(count).map(triangle).collect();
    let mut soup = Soup { triangles, ..Soup::default() };
    if body.len() > FACET * count {
        let message = format!("{} bytes after the last facet were ignored", body.len() - FACET * count);
        soup.warnings.push(Warning::new(Place::default(), message));
    }
    Ok(soup)
}

/// Only `vertex` lines, `endfacet` and `endsolid` matter.
fn text(bytes: &[u8]) -> Result<Soup, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    let mut soup = Soup { lines: Some(Vec::new()), ..Soup::default() };
    let mut corners: Vec<Corner> = Vec::new();
    let (mut begun, mut ended) = (0, false);
    for (k, line) in text.lines().enumerate() {
        let bad = |problem: String| {
            ImportError::new(
                FaultKind::Syntax,
                Place::line(k + 1),
                problem,
                "export the model again, binary if possible",
            )
        };
        let mut words = line.split_ascii_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => {
                let corner = numbers(words).ok_or_else(|| bad(format!("not a corner: {}", clipped(line))))?;
                let place = || Place { line: Some(k + 1), ..facet(soup.triangles.len()) };
                corners.push(finite(corner, place)?);
                begun = if corners.len() == 1 { k + 1 } else { begun };
            }
            Some("endfacet") => {
                let triangle = <[Corner; 3]>::try_from(corners.as_slice());
                soup.triangles.push(triangle.map_err(|_| bad(format!("a facet with {} corners", corners.len())))?);
                soup.lines.get_or_insert_default().push(begun);
                corners.clear();
                check_count(soup.triangles.len())?;
            }
            Some("endsolid") => ended = true,
            _ => {}
        }
    }
    if !corners.is_empty() || !ended {
        let problem = "the file ends before the solid does";
        let place = facet(soup.triangles.len());
        return Err(ImportError::new(
            FaultKind::Syntax,
            place,
            problem,
            "the file is cut short: copy or export it again",
        ));
    }
    Ok(soup)
}

/// Three numbers and nothing else.
pub(super) fn numbers<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<Corner> {
    let mut next = || words.next()?.parse::<f64>().ok();
    let corner = [next()?, next()?, next()?];
    words.next().is_none().then_some(corner)
}

/// A line's beginning, for messages.
pub(super) fn clipped(line: &str) -> String {
    format!("{:?}", line.trim().chars().take(40).collect::<String>())
}
