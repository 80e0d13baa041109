//! 3MF core: a zip archive whose model part holds objects (meshes, or components of other objects) and a build list of
//! items, each with an affine transform.

use super::{Soup, check_count};
use crate::import::error::{FaultKind, ImportError, Place, Warning};
use pocketry_geom::mesh::Corner;
use roxmltree::{Document, Node};
use std::collections::HashMap;
use std::io::{Cursor, Read};

/// Parts larger than this when unpacked are refused, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Components nested deeper than this are a circle.
const DEEPEST: usize = 32;

/// Rows of a 4 × 3 matrix: `x' = x m0 + y m3 + z m6 + m9`, and so on.
type Transform = [f64; 12];

const IDENTITY: Transform = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

fn bad(kind: FaultKind, problem: impl Into<String>) -> ImportError {
    ImportError::new(kind, Place::default(), problem, "export the model again, or as STL")
}

fn bad_at(node: Node<'_, '_>, problem: impl Into<String>) -> ImportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    ImportError::new(FaultKind::Syntax, Place::line(line), problem, "export the model again, or as STL")
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ImportError> {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes))
        .map_err(|e| bad(FaultKind::Syntax, format!("not a 3MF package: {e}")))?;
    let relations = part(&mut archive, "_rels/.rels")?;
    let name = model_part(&relations).unwrap_or_else(|| "3D/3dmodel.model".to_owned());
    let text = part(&mut archive, &name)?;
    let document = Document::parse(&text).map_err(|e| bad(FaultKind::Syntax, format!("{name}: {e}")))?;
    let model = document.root_element();
    let mut soup = Soup::default();
    if let Some(unit) = model.attribute("unit") {
        soup.units = Some(unit.parse()?);
    }
    let objects: HashMap<&str, Node> = model
        .descendants()
        .filter(|n| n.has_tag_name_local("object"))
        .filter_map(|n| Some((n.attribute("id")?, n)))
        .collect();
    let items: Vec<Node> = model.descendants().filter(|n| n.has_tag_name_local("item")).collect();
    for &item in &items {
        add(item, &IDENTITY, &objects, 0, &mut soup)?;
    }
    if items.is_empty() && !objects.is_empty() {
        let message = "the model has no build list: nothing of it is meant to be made";
        soup.warnings.push(Warning::new(Place::default(), message));
    }
    Ok(soup)
}

/// A part of the package as text.
fn part(archive: &mut zip::ZipArchive<Cursor<&[u8]>>, name: &str) -> Result<String, ImportError> {
    let file = archive.by_name(name).map_err(|e| bad(FaultKind::Syntax, format!("no part {name} in it: {e}")))?;
    let mut text = String::new();
    let read = file.take(MOST_BYTES + 1).read_to_string(&mut text);
    let size = read.map_err(|e| bad(FaultKind::Syntax, format!("{name}: {e}")))?;
    if size as u64 > MOST_BYTES {
        return Err(bad(FaultKind::Limit, format!("{name} is larger than {} MB", MOST_BYTES >> 20)));
    }
    Ok(text)
}

/// The name of the model part that the package's relations give.
fn model_part(relations: &str) -> Option<String> {
    let document = Document::parse(relations).ok()?;
    let relation = document.descendants().find(|n| n.attribute("Type").is_some_and(|t| t.ends_with("/3dmodel")))?;
    Some(relation.attribute("Target")?.trim_start_matches('/').to_owned())
}

/// Adds what an item or component names.
fn add(
    named: Node<'_, '_>,
    outer: &Transform,
    objects: &HashMap<&str, Node<'_, '_>>,
    depth: usize,
    soup: &mut Soup,
) -> Result<(), ImportError> {
    let object = named.attribute("objectid").and_then(|id| objects.get(id));
    let object = *object.ok_or_else(|| bad_at(named, "an object that is not in the file"))?;
    if depth > DEEPEST {
        return Err(bad_at(object, "the object is a component of itself"));
    }
    let own = named.attribute("transform").map_or(Some(IDENTITY), transform);
    let own = own.ok_or_else(|| bad_at(named, "a transform of other than 12 numbers"))?;
    let whole = compose(&own, outer);
    for child in object.children() {
        if child.has_tag_name_local("mesh") {
            add_mesh(child, &whole, soup)?;
        } else if child.has_tag_name_local("components") {
            for component in child.children().filter(|c| c.has_tag_name_local("component")) {
                add(component, &whole, objects, depth + 1, soup)?;
            }
        }
    }
    Ok(())
}

fn add_mesh(mesh: Node<'_, '_>, by: &Transform, soup: &mut Soup) -> Result<(), ImportError> {
    let mut vertices: Vec<Corner> = Vec::new();
    for node in mesh.descendants().filter(|n| n.has_tag_name_local("vertex")) {
        let number = |name: &str| node.attribute(name)?.trim().parse::<f64>().ok();
        let corner = (|| Some([number("x")?, number("y")?, number("z")?]))();
        vertices.push(apply(by, corner.ok_or_else(|| bad_at(node, "a vertex without three numbers"))?));
    }
    let mirrored = determinant(by) < 0.0;
    for node in mesh.descendants().filter(|n| n.has_tag_name_local("triangle")) {
        let corner = |name: &str| vertices.get(node.attribute(name)?.trim().parse::<usize>().ok()?).copied();
        let triangle = (|| Some([corner("v1")?, corner("v2")?, corner("v3")?]))();
        let [a, b, c] = triangle.ok_or_else(|| bad_at(node, "a triangle of vertices that are not there"))?;
        soup.triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
        check_count(soup.triangles.len())?;
    }
    Ok(())
}

fn transform(text: &str) -> Option<Transform> {
    let numbers: Vec<f64> = text.split_ascii_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    numbers.try_into().ok()
}

fn apply(m: &Transform, p: Corner) -> Corner {
    [0, 1, 2].map(|k| p[0] * m[k] + p[1] * m[3 + k] + p[2] * m[6 + k] + m[9 + k])
}

/// First `inner`, then `outer`.
fn compose(inner: &Transform, outer: &Transform) -> Transform {
    let mut out = [0.0; 12];
    for row in 0..4 {
        let place = [inner[3 * row], inner[3 * row + 1], inner[3 * row + 2]];
        for k in 0..3 {
            let shift = if row == 3 { outer[9 + k] } else { 0.0 };
            out[3 * row + k] = place[0] * outer[k] + place[1] * outer[3 + k] + place[2] * outer[6 + k] + shift;
        }
    }
    out
}

fn determinant(m: &Transform) -> f64 {
    m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6])
}

/// Names without their namespace: exporters differ in prefixes and years.
trait LocalName {
    fn has_tag_name_local(&self, name: &str) -> bool;
}

impl LocalName for Node<'_, '_> {
    fn has_tag_name_local(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}
