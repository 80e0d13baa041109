//! SVG's basic shapes as curves in user units.

use super::path::{self, Subpath};
use super::viewport::{Viewport, length};
use crate::import::curve::{Curve, Elliptic};
use crate::import::error::ImportError;
use crate::import::sketch::Source;
use pocketry_geom::{Point, Vec2, point, vec2};
use roxmltree::Node;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The element names that draw.
pub(super) const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// What an element draws; a reason in place of a shape where it has no extent.
pub(super) fn subpaths(
    node: Node<'_, '_>,
    viewport: Viewport,
    source: &Source,
) -> Result<Result<Vec<Subpath>, String>, ImportError> {
    let shape = Shape { node, viewport, source };
    match node.tag_name().name() {
        "path" => path::parse(node.attribute("d").unwrap_or_default())
            .map(Ok)
            .map_err(|problem| source.error(problem, "correct the path or export it again")),
        "rect" => shape.rect(),
        "circle" => {
            let r = shape.diagonal("r")?.unwrap_or(0.0);
            shape.ellipse(r, r)
        }
        "ellipse" => {
            let (rx, ry) = (shape.x("rx")?, shape.y("ry")?);
            shape.ellipse(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0))
        }
        "line" => {
            let from = point(shape.x("x1")?.unwrap_or(0.0), shape.y("y1")?.unwrap_or(0.0));
            let to = point(shape.x("x2")?.unwrap_or(0.0), shape.y("y2")?.unwrap_or(0.0));
            Ok(Ok(vec![chain(&[from, to], false)]))
        }
        "polyline" => shape.points().map(|points| Ok(vec![chain(&points, false)])),
        _ => shape.points().map(|points| Ok(vec![chain(&points, true)])),
    }
}

struct Shape<'a, 'i> {
    node: Node<'a, 'i>,
    viewport: Viewport,
    source: &'a Source,
}

impl Shape<'_, '_> {
    fn x(&self, name: &str) -> Result<Option<f64>, ImportError> {
        length(self.node, name, self.viewport.width, self.source)
    }

    fn y(&self, name: &str) -> Result<Option<f64>, ImportError> {
        length(self.node, name, self.viewport.height, self.source)
    }

    fn diagonal(&self, name: &str) -> Result<Option<f64>, ImportError> {
        let whole = self.viewport.width.hypot(self.viewport.height) / 2.0_f64.sqrt();
        length(self.node, name, whole, self.source)
    }

    fn rect(&self) -> Result<Result<Vec<Subpath>, String>, ImportError> {
        let (w, h) = (self.x("width")?.unwrap_or(0.0), self.y("height")?.unwrap_or(0.0));
        if !(w > 0.0 && h > 0.0) {
            return Ok(Err(format!("its size is {w} × {h}")));
        }
        let (x, y) = (self.x("x")?.unwrap_or(0.0), self.y("y")?.unwrap_or(0.0));
        let (rx, ry) = (self.x("rx")?, self.y("ry")?);
        let rx = rx.or(ry).unwrap_or(0.0).clamp(0.0, 0.5 * w);
        let ry = ry.or(self.x("rx")?).unwrap_or(0.0).clamp(0.0, 0.5 * h);
        let (x1, y1) = (x + w, y + h);
        if rx == 0.0 || ry == 0.0 {
            let corners = [point(x, y), point(x1, y), point(x1, y1), point(x, y1)];
            return Ok(Ok(vec![chain(&corners, true)]));
        }
        let corner = |start: Point, end: Point, center: Point, from: f64| {
            let (u, v) = (vec2(rx, 0.0), vec2(0.0, ry));
            Curve::Elliptic(Elliptic { start, end, center, u, v, from, sweep: FRAC_PI_2 })
        };
        let ends = [
            (point(x1 - rx, y), point(x1, y + ry), point(x1 - rx, y + ry), -FRAC_PI_2),
            (point(x1, y1 - ry), point(x1 - rx, y1), point(x1 - rx, y1 - ry), 0.0),
            (point(x + rx, y1), point(x, y1 - ry), point(x + rx, y1 - ry), FRAC_PI_2),
            (point(x, y + ry), point(x + rx, y), point(x + rx, y + ry), 2.0 * FRAC_PI_2),
        ];
        let mut curves = Vec::with_capacity(8);
        for (k, &(start, end, center, from)) in ends.iter().enumerate() {
            curves.push(corner(start, end, center, from));
            curves.push(Curve::Line(end, ends[(k + 1) % 4].0));
        }
        Ok(Ok(vec![Subpath { curves, closed: true }]))
    }

    fn ellipse(&self, rx: f64, ry: f64) -> Result<Result<Vec<Subpath>, String>, ImportError> {
        if !(rx > 0.0 && ry > 0.0) {
            return Ok(Err(format!("its radius is {}", rx.min(ry))));
        }
        let center = point(self.x("cx")?.unwrap_or(0.0), self.y("cy")?.unwrap_or(0.0));
        let (u, v): (Vec2, Vec2) = (vec2(rx, 0.0), vec2(0.0, ry));
        let whole = Curve::Elliptic(Elliptic::new(center, u, v, 0.0, TAU));
        Ok(Ok(vec![Subpath { curves: vec![whole], closed: true }]))
    }

    fn points(&self) -> Result<Vec<Point>, ImportError> {
        let text = self.node.attribute("points").unwrap_or_default();
        let numbers: Option<Vec<f64>> = text
            .split(|c: char| c.is_ascii_whitespace() || c == ',')
            .filter(|t| !t.is_empty())
            .map(|t| t.parse::<f64>().ok().filter(|x| x.is_finite()))
            .collect();
        let points: Vec<Point> = match numbers {
            Some(numbers) if numbers.len() % 2 == 0 => numbers.chunks_exact(2).map(|p| point(p[0], p[1])).collect(),
            Some(_) => return Err(self.source.error("its points are an odd number of coordinates", "correct them")),
            // Signs may stand in place of separators; the lenient reader understands them.
            None => svgtypes::PointsParser::from(text).map(|(x, y)| point(x, y)).collect(),
        };
        let finite = points.iter().all(|p| p.is_finite());
        if finite { Ok(points) } else { Err(self.source.error("its points are no numbers", "correct them")) }
    }
}

fn chain(points: &[Point], closed: bool) -> Subpath {
    let mut curves: Vec<Curve> = points.windows(2).filter(|w| w[0] != w[1]).map(|w| Curve::Line(w[0], w[1])).collect();
    if let (true, Some(&first), Some(&last)) = (closed, points.first(), points.last())
        && first != last
    {
        curves.push(Curve::Line(last, first));
    }
    Subpath { curves, closed }
}
