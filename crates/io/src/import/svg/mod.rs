//! SVG: paths and basic shapes with nested transforms, units and view boxes; y is turned to point up.
//!
//! Filled shapes are closed loops, resolved by their fill rule one element at a time; all elements together are then
//! filled even-odd, as a drawing's nesting says. Shapes that are only stroked are the lines of a drawing: closed ones are
//! loops, open ones are chained. What is neither filled nor stroked, hidden, or a definition is left out. Nothing outside the
//! file is ever read, and the elements that references multiply are counted: time and memory stay bounded.

mod decode;
mod fill;
mod path;
mod shapes;
mod style;
mod viewport;

use super::ImportOptions;
use super::affine::Affine;
use super::error::{FaultKind, ImportError, Place};
use super::sketch::{MAX_CURVES, Sketch, Source};
use path::Subpath;
use pocketry_geom::{Contour, Segment};
use roxmltree::Node;
use std::collections::{BTreeSet, HashMap};
use std::str::FromStr;
use style::{Sheet, Style};
use viewport::Viewport;

/// Groups and references nested deeper than this are refused.
const MAX_DEPTH: usize = 300;

/// The most elements that are visited; those drawn by reference count [`USE_WEIGHT`] times each.
const MAX_ELEMENTS: u64 = 1_000_000;

/// See [`MAX_ELEMENTS`]: references multiply without the file growing.
const USE_WEIGHT: u64 = 10;

/// Elements that hold definitions or something other than geometry.
const NOT_DRAWN: [&str; 21] = [
    "defs",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "symbol",
    "linearGradient",
    "radialGradient",
    "filter",
    "style",
    "script",
    "metadata",
    "title",
    "desc",
    "text",
    "foreignObject",
    "image",
    "namedview",
    "animate",
    "font",
    "view",
];

/// The drawing in an SVG file.
///
/// # Errors
/// Everything that makes the file no drawing.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Sketch, ImportError> {
    let text = decode::decode(bytes)?;
    let document = decode::parse(&text)?;
    let root = document.root_element();
    let mut sketch = Sketch::default();
    let source = source_of(root, "");
    let (map, viewport) = viewport::root(root, &source, options, &mut sketch)?;
    let mut walk = Walk {
        options,
        sketch,
        sheet: Sheet::of(root),
        ids: root.descendants().filter_map(|n| Some((n.attribute("id")?, n))).collect(),
        lines: decode::Lines::new(&text),
        visited: 0,
        curves: 0,
        in_use: Vec::new(),
        present: BTreeSet::new(),
        found: BTreeSet::new(),
        other: BTreeSet::new(),
        edges: Vec::new(),
    };
    let selected = options.layers.is_empty();
    let state = State { map, viewport, style: Style::default(), layer: "", selected, depth: 0 };
    walk.children(root, &state)?;
    walk.finish()
}

/// Where an element is from, its line left out.
fn source_of(node: Node<'_, '_>, layer: &str) -> Source {
    let tag = node.tag_name().name();
    let entity = match node.attribute("id") {
        Some(id) => format!("<{tag} id={id:?}>"),
        None => format!("<{tag}>"),
    };
    Source { layer: layer.to_owned(), entity, line: 0 }
}

/// What an element hands down to its children.
#[derive(Clone, Copy)]
struct State<'a> {
    map: Affine,
    viewport: Viewport,
    style: Style,
    layer: &'a str,
    selected: bool,
    depth: usize,
}

struct Walk<'a> {
    options: &'a ImportOptions,
    sketch: Sketch,
    sheet: Sheet,
    ids: HashMap<&'a str, Node<'a, 'a>>,
    lines: decode::Lines,
    visited: u64,
    curves: u64,
    in_use: Vec<Node<'a, 'a>>,
    /// Groups that hold shapes.
    present: BTreeSet<&'a str>,
    /// Wanted groups that are there.
    found: BTreeSet<&'a str>,
    /// Text, images and the like that were met.
    other: BTreeSet<&'a str>,
    edges: Vec<Segment>,
}

impl<'a> Walk<'a> {
    fn children(&mut self, node: Node<'a, 'a>, state: &State<'a>) -> Result<(), ImportError> {
        for child in node.children().filter(Node::is_element) {
            self.element(child, state)?;
        }
        Ok(())
    }

    fn source(&self, node: Node<'_, '_>, layer: &str) -> Source {
        Source { line: self.lines.of(node.range().start), ..source_of(node, layer) }
    }

    fn element(&mut self, node: Node<'a, 'a>, outer: &State<'a>) -> Result<(), ImportError> {
        self.visited += if self.in_use.is_empty() { 1 } else { USE_WEIGHT };
        if self.visited > MAX_ELEMENTS || outer.depth >= MAX_DEPTH {
            let hint = "remove nested uses and groups";
            let problem = format!("more than {MAX_ELEMENTS} elements, or nested more than {MAX_DEPTH} deep");
            return Err(ImportError::new(FaultKind::Limit, self.source(node, outer.layer).place(), problem, hint));
        }
        let tag = node.tag_name().name();
        if NOT_DRAWN.contains(&tag) {
            self.other.insert(tag);
            return Ok(());
        }
        let Some(style) = outer.style.of_child(node, &self.sheet) else { return Ok(()) };
        let mut state = State { style, depth: outer.depth + 1, ..*outer };
        state.map = self.transformed(node, outer)?;
        match tag {
            "svg" => {
                let source = self.source(node, outer.layer);
                let (map, viewport) = viewport::inner(node, outer.viewport, (None, None), &source)?;
                (state.map, state.viewport) = (state.map.after(&map), viewport);
                self.children(node, &state)
            }
            "g" => {
                self.enter_group(node, &mut state);
                self.children(node, &state)
            }
            "a" | "switch" => self.children(node, &state),
            "use" => self.reference(node, &state),
            tag if shapes::SHAPES.contains(&tag) => self.shape(node, &state),
            _ => Ok(()),
        }
    }

    fn enter_group(&mut self, node: Node<'a, 'a>, state: &mut State<'a>) {
        const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
        let names = [node.attribute((INKSCAPE, "label")), node.attribute("id")];
        for name in names.into_iter().flatten() {
            if self.options.layers.iter().any(|wanted| wanted == name) {
                self.found.insert(name);
                state.selected = true;
            }
        }
        if let Some(name) = names.into_iter().flatten().next() {
            state.layer = name;
        }
    }

    fn transformed(&self, node: Node<'a, 'a>, outer: &State<'a>) -> Result<Affine, ImportError> {
        let Some(text) = node.attribute("transform") else { return Ok(outer.map) };
        let bad = |problem: String| self.source(node, outer.layer).error(problem, "correct the transform");
        let t =
            svgtypes::Transform::from_str(text).map_err(|e| bad(format!("its transform {text:?} is broken: {e}")))?;
        let own = Affine { a: t.a, b: t.b, c: t.c, d: t.d, e: t.e, f: t.f };
        let map = outer.map.after(&own);
        if own.is_singular() || map.is_singular() {
            return Err(bad(format!("its transform {text:?} squeezes everything onto a line or is no number")));
        }
        Ok(map)
    }

    fn reference(&mut self, node: Node<'a, 'a>, state: &State<'a>) -> Result<(), ImportError> {
        const XLINK: &str = "http://www.w3.org/1999/xlink";
        let source = self.source(node, state.layer);
        let target = node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default();
        let Some(&target_node) = target.strip_prefix('#').and_then(|id| self.ids.get(id)) else {
            self.sketch.warn(source.place(), format!("what it uses, {target:?}, is not in the file and is left out"));
            return Ok(());
        };
        if self.in_use.contains(&target_node) || node.ancestors().any(|n| n == target_node) {
            return Err(source.error(format!("it uses {target:?}, which holds it"), "remove the circular use"));
        }
        let size = |name, whole| viewport::length(node, name, whole, &source);
        let (w, h) = (state.viewport.width, state.viewport.height);
        let corner = Affine::translate(pocketry_geom::vec2(size("x", w)?.unwrap_or(0.0), size("y", h)?.unwrap_or(0.0)));
        let mut state = State { map: state.map.after(&corner), ..*state };
        self.in_use.push(target_node);
        if target_node.has_tag_name("symbol") || target_node.tag_name().name() == "symbol" {
            let asked = (size("width", w)?, size("height", h)?);
            let (map, viewport) = viewport::inner(target_node, state.viewport, asked, &source)?;
            (state.map, state.viewport) = (state.map.after(&map), viewport);
            self.children(target_node, &state)?;
        } else {
            self.element(target_node, &state)?;
        }
        self.in_use.pop();
        Ok(())
    }

    fn shape(&mut self, node: Node<'a, 'a>, state: &State<'a>) -> Result<(), ImportError> {
        self.present.insert(state.layer);
        let drawn = state.style.visible && (state.style.filled || state.style.stroked);
        if !drawn || !(state.selected || self.selects(node)) {
            return Ok(());
        }
        let source = self.source(node, state.layer);
        if node.has_attribute("clip-path") || node.has_attribute("mask") {
            self.sketch.warn(source.place(), "its clipping or mask is ignored; the whole shape is taken");
        }
        let subpaths = match shapes::subpaths(node, state.viewport, &source)? {
            Ok(subpaths) => subpaths,
            Err(why) => {
                self.sketch.warn(source.place(), format!("{why}; it is left out"));
                return Ok(());
            }
        };
        self.curves += subpaths.iter().map(|s| s.curves.len() as u64).sum::<u64>();
        if self.curves > MAX_CURVES {
            let problem = format!("the drawing lays out to more than {MAX_CURVES} curves");
            return Err(ImportError::new(FaultKind::Limit, source.place(), problem, "remove nested uses"));
        }
        self.add(&subpaths, state, &source)
    }

    /// Whether the shape itself is asked for by its id.
    fn selects(&mut self, node: Node<'a, 'a>) -> bool {
        let id = node.attribute("id").filter(|id| self.options.layers.iter().any(|wanted| wanted == id));
        self.found.extend(id);
        id.is_some()
    }

    fn add(&mut self, subpaths: &[Subpath], state: &State<'a>, source: &Source) -> Result<(), ImportError> {
        let fit = self.options.fit_tolerance;
        let id = self.sketch.source(source.clone());
        if !state.style.filled {
            for subpath in subpaths {
                self.sketch.add(&subpath.curves, subpath.closed, &state.map, id, fit)?;
            }
            return Ok(());
        }
        let mut loops = Vec::with_capacity(subpaths.len());
        for subpath in subpaths {
            self.edges.clear();
            self.sketch.segments(&subpath.curves, &state.map, id, fit, &mut self.edges)?;
            let Some(gap) = super::sketch::close(&mut self.edges) else { continue };
            if gap > 0.0 && !subpath.closed {
                let at = self.edges[0].start();
                let message = format!("the filled path is open by {gap:.6} mm; a straight line closes it");
                self.sketch.warn(source.place().at(at), message);
            }
            loops.push(Contour::new(std::mem::take(&mut self.edges)));
        }
        if !state.style.even_odd && loops.len() > 1 {
            loops = self.nonzero(loops, source)?;
        }
        self.sketch.loops.extend(loops.into_iter().map(|contour| super::sketch::Loop { contour, source: id }));
        Ok(())
    }

    /// The loops that bound what is filled. Loops are dropped only from paths that are proven free of crossings.
    fn nonzero(&mut self, loops: Vec<Contour>, source: &Source) -> Result<Vec<Contour>, ImportError> {
        let bounding = fill::bounding(&loops);
        if bounding.iter().all(|&b| b) {
            return Ok(loops);
        }
        super::assemble::check_crossings(&loops, self.options)
            .map_err(|e| super::assemble::region_error(&e, |_| source.place()))?;
        let dropped = bounding.iter().filter(|&&b| !b).count();
        let message = format!("{dropped} loop(s) inside what the nonzero fill rule fills anyway are left out");
        self.sketch.warn(source.place(), message);
        Ok(loops.into_iter().zip(bounding).filter_map(|(contour, keep)| keep.then_some(contour)).collect())
    }

    fn finish(self) -> Result<Sketch, ImportError> {
        for name in &self.options.layers {
            if !self.found.contains(name.as_str()) {
                let present: Vec<&str> = self.present.iter().copied().filter(|l| !l.is_empty()).collect();
                let hint = format!("groups with shapes: {}", present.join(", "));
                let problem = format!("group {name} is not in the drawing");
                return Err(ImportError::new(FaultKind::Layer, Place::default(), problem, hint));
            }
        }
        if self.sketch.loops.is_empty() && self.sketch.loose.is_empty() {
            let also: Vec<&str> = self.other.into_iter().filter(|t| ["text", "image"].contains(t)).collect();
            let found = if also.is_empty() { String::new() } else { format!(" (only {})", also.join(", ")) };
            let problem = format!("there are no shapes to mill in the drawing{found}");
            let hint = "convert text and images to paths";
            return Err(ImportError::new(FaultKind::Empty, Place::default(), problem, hint));
        }
        Ok(self.sketch)
    }
}
