//! Wavefront OBJ: `v x y z` and `f i j k ...`; everything else is passed over. Polygons are cut into fans.

use super::stl::clipped;
use super::{Soup, check_count, finite};
use crate::import::error::{FaultKind, ImportError, Place};
use pocketry_geom::mesh::Corner;

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    let mut soup = Soup { lines: Some(Vec::new()), ..Soup::default() };
    let mut vertices: Vec<Corner> = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let bad = |problem: String| {
            ImportError::new(FaultKind::Syntax, Place::line(k + 1), problem, "export the model again")
        };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || words.next()?.parse::<f64>().ok();
                let corner = (|| Some([next()?, next()?, next()?]))();
                let corner = corner.ok_or_else(|| bad(format!("not a vertex: {}", clipped(line))))?;
                vertices.push(finite(corner, || Place::line(k + 1))?);
            }
            Some("f") => {
                let corners: Option<Vec<Corner>> = words.map(|w| vertex(w, &vertices)).collect();
                let corners = corners.filter(|c| c.len() > 2);
                let corners = corners.ok_or_else(|| bad(format!("not a face of known vertices: {}", clipped(line))))?;
                for pair in corners[1..].windows(2) {
                    soup.triangles.push([corners[0], pair[0], pair[1]]);
                    soup.lines.get_or_insert_default().push(k + 1);
                }
                check_count(soup.triangles.len())?;
            }
            _ => {}
        }
    }
    Ok(soup)
}

/// The vertex that `i`, `i/t` or `i/t/n` names: from 1, or backwards from -1.
fn vertex(word: &str, vertices: &[Corner]) -> Option<Corner> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let index = if number < 0 { i64::try_from(vertices.len()).ok()? + number } else { number - 1 };
    vertices.get(usize::try_from(index).ok()?).copied()
}
