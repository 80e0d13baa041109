//! Pictures of a job as SVG: walls, loops in the order of cutting, links, rapids, what stays uncut; with a scale and a
//! legend. Lines and arcs are drawn as true lines and arcs.
//!
//! The picture is made of plain layers of paths, whoever computed them, so that every stage of a job can be drawn.

mod canvas;
mod legend;
mod projection;

pub use projection::Projection;

use canvas::Canvas;
use pocketry_geom::{BBox, Point, Region, Segment};
use std::fmt::Write;

/// How a layer looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// Boundary of the pocket; the inside is tinted.
    Wall,
    /// A cutting loop, coloured by its place in the order of cutting, from 0 (first) to 1 (last).
    Loop(f64),
    /// A link from loop to loop at cutting depth.
    Link,
    /// An entry helix or ramp.
    Entry,
    /// A move at rapid speed.
    Rapid,
    /// An edge of the skeleton.
    Skeleton,
    /// Anything else that is drawn thin.
    Thin,
}

/// Paths that look alike. Consecutive segments of a path join.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// What the legend calls it; layers of one name share a row.
    pub name: String,
    /// How it is drawn.
    pub look: Look,
    /// Its paths.
    pub paths: Vec<Vec<Segment>>,
}

/// A place to point at: material that stays, a gouge.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Where.
    pub at: Point,
    /// Its size, mm; drawn no smaller than can be seen.
    pub radius: f64,
    /// What the legend calls it.
    pub name: String,
}

/// A picture to be drawn; later layers lie on top of earlier ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Heading.
    pub title: String,
    /// Lines under the heading.
    pub notes: Vec<String>,
    /// What is drawn.
    pub layers: Vec<Layer>,
    /// What is marked.
    pub spots: Vec<Spot>,
}

impl Picture {
    /// A picture of the region's walls, to be added to.
    pub fn of(region: &Region, title: impl Into<String>) -> Self {
        let paths = region.contours().iter().map(|c| c.segments.clone()).collect();
        let walls = Layer { name: "wall".to_owned(), look: Look::Wall, paths };
        Self { title: title.into(), layers: vec![walls], ..Self::default() }
    }

    /// Adds a layer unless it has no paths.
    pub fn add(&mut self, name: impl Into<String>, look: Look, paths: Vec<Vec<Segment>>) {
        if !paths.is_empty() {
            self.layers.push(Layer { name: name.into(), look, paths });
        }
    }

    /// The SVG text.
    pub fn to_svg(&self) -> String {
        let canvas = Canvas::fit(self.bounds(), self.notes.len(), legend::rows(self));
        let mut svg = canvas.open(&self.title);
        self.draw_heading(&mut svg);
        for layer in &self.layers {
            draw_layer(layer, &canvas, &mut svg);
        }
        for spot in &self.spots {
            let at = canvas.place(spot.at);
            let r = canvas.length(spot.radius).max(4.0);
            let _ = writeln!(
                svg,
                r##"<circle cx="{:.3}" cy="{:.3}" r="{r:.3}" fill="#d62728" fill-opacity="0.35" stroke="#d62728"/>"##,
                at.0, at.1
            );
        }
        legend::draw(self, &canvas, &mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    fn bounds(&self) -> BBox {
        let segments = self.layers.iter().flat_map(|l| l.paths.iter().flatten()).filter(|s| s.is_finite());
        segments.fold(BBox::EMPTY, |b, s| b.union(s.bbox()))
    }

    fn draw_heading(&self, svg: &mut String) {
        let x = Canvas::left();
        let _ =
            writeln!(svg, r#"<text x="{x}" y="28" font-size="17" font-weight="bold">{}</text>"#, escape(&self.title));
        for (k, note) in self.notes.iter().enumerate() {
            let _ =
                writeln!(svg, r##"<text x="{x}" y="{}" fill="#555">{}</text>"##, Canvas::note_line(k), escape(note));
        }
    }
}

fn draw_layer(layer: &Layer, canvas: &Canvas, svg: &mut String) {
    let mut data = String::new();
    for path in &layer.paths {
        canvas.path(path, &mut data);
    }
    let _ = writeln!(svg, r#"<path {} d="{}"/>"#, style(layer.look), data.trim_end());
}

/// Presentation attributes of a look.
fn style(look: Look) -> String {
    match look {
        Look::Wall => r##"fill="#eef1f4" fill-rule="evenodd" stroke="#1b1f24" stroke-width="1.8""##.to_owned(),
        Look::Loop(order) => format!(r#"fill="none" stroke="{}" stroke-width="1.3""#, ramp(order)),
        Look::Link => r##"fill="none" stroke="#d6249f" stroke-width="1.5""##.to_owned(),
        Look::Entry => r##"fill="none" stroke="#e8590c" stroke-width="1.5""##.to_owned(),
        Look::Rapid => r##"fill="none" stroke="#c92a2a" stroke-width="1" stroke-dasharray="6 4""##.to_owned(),
        Look::Skeleton => r##"fill="none" stroke="#868e96" stroke-width="0.7""##.to_owned(),
        Look::Thin => r##"fill="none" stroke="#495057" stroke-width="0.7""##.to_owned(),
    }
}

/// A colour between violet (0) and green (1) by way of blue, dark enough for white paper.
fn ramp(order: f64) -> String {
    const STOPS: [[f64; 3]; 4] = [[110.0, 40.0, 160.0], [45.0, 90.0, 200.0], [20.0, 140.0, 160.0], [60.0, 170.0, 60.0]];
    let at = order.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let k = (at as usize).min(STOPS.len() - 2);
    let part = at - k as f64;
    let [r, g, b] = std::array::from_fn(|c| (STOPS[k][c] * (1.0 - part) + STOPS[k + 1][c] * part).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text that is safe in XML.
pub fn escape(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '&' => "&amp;".to_owned(),
            '<' => "&lt;".to_owned(),
            '>' => "&gt;".to_owned(),
            '"' => "&quot;".to_owned(),
            c if c.is_control() => " ".to_owned(),
            c => c.to_string(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::{Contour, point};

    fn disc() -> Region {
        let contour = Contour::from_vertices(&[[0.0, 0.0, 1.0], [20.0, 0.0, 1.0]]);
        Region::from_parts_unchecked(vec![contour], vec![None])
    }

    #[test]
    fn arcs_are_drawn_as_arcs_with_y_up() {
        let svg = Picture::of(&disc(), "disc").to_svg();
        // Counter-clockwise with y up is sweep flag 0 with y down; the lower half comes first, so it runs below.
        assert_eq!(svg.matches(" 0 0 0 ").count() + svg.matches(" 0 1 0 ").count(), 2, "{svg}");
    }

    #[test]
    fn text_is_escaped_and_legend_names_each_layer_once() {
        let mut picture = Picture::of(&disc(), "<a> & b");
        picture.add("rapid", Look::Rapid, vec![vec![Segment::line(point(1.0, 0.0), point(2.0, 0.0))]]);
        picture.add("rapid", Look::Rapid, vec![vec![Segment::line(point(3.0, 0.0), point(4.0, 0.0))]]);
        picture.add("link", Look::Link, Vec::new());
        let svg = picture.to_svg();
        assert!(svg.contains("&lt;a&gt; &amp; b"));
        assert_eq!(svg.matches(">rapid<").count(), 1);
        assert!(!svg.contains(">link<"));
    }

    #[test]
    fn an_empty_picture_is_still_a_picture() {
        assert!(Picture::default().to_svg().ends_with("</svg>\n"));
    }
}
