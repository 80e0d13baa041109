//! SVG at true size, millimetres, with true arcs.

use super::Sheet;
use pocketry_geom::{BBox, Contour, Point, Segment};
use std::f64::consts::PI;
use std::fmt::Write;

/// One group a sheet; the viewBox is in millimetres, y points up in the drawing.
pub fn to_svg(sheets: &[Sheet]) -> String {
    let bounds = sheets.iter().flat_map(|s| &s.loops).fold(BBox::EMPTY, |b, c| b.union(c.bbox()));
    let bounds = if bounds.is_empty() { BBox::of(Point::ORIGIN, Point::ORIGIN) } else { bounds };
    let (w, h) = (bounds.width(), bounds.height());
    let mut svg = format!(
        concat!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{w}mm" height="{h}mm" viewBox="{x} {y} {w} {h}">"#,
            "\n"
        ),
        w = w,
        h = h,
        x = bounds.min.x,
        y = -bounds.max.y
    );
    let pen = 0.002 * bounds.size();
    for sheet in sheets {
        let name: String = sheet.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let _ = writeln!(svg, r#"<g id="{name}" fill="none" stroke="black" stroke-width="{pen}">"#);
        for contour in &sheet.loops {
            let _ = writeln!(svg, r#"<path d="{}"/>"#, path_data(contour));
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

fn path_data(contour: &Contour) -> String {
    let mut data = String::new();
    if let Some(first) = contour.segments.first() {
        let _ = write!(data, "M{} {}", first.start().x, -first.start().y);
    }
    for segment in &contour.segments {
        match segment {
            Segment::Line(line) => {
                let _ = write!(data, "L{} {}", line.end.x, -line.end.y);
            }
            Segment::Arc(arc) => {
                let halves = if arc.sweep().abs() > PI { 2 } else { 1 };
                for k in 1..=halves {
                    let p = segment.at(f64::from(k) / f64::from(halves));
                    let _ = write!(data, "A{0} {0} 0 0 {1} {2} {3}", arc.radius, u8::from(!arc.ccw), p.x, -p.y);
                }
            }
        }
    }
    data.push('Z');
    data
}
