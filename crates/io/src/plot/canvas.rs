//! The sheet: from millimetres with y up to pixels with y down.

use pocketry_geom::{Arc, BBox, Point, Segment};
use std::f64::consts::PI;
use std::fmt::Write;

const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 30.0;
const HEADING: f64 = 42.0;
const NOTE: f64 = 18.0;
const ROW: f64 = 22.0;

/// Where things lie on the sheet.
pub(super) struct Canvas {
    bounds: BBox,
    scale: f64,
    top: f64,
    /// Extent of the drawing on the sheet.
    extent: (f64, f64),
    legend_rows: usize,
}

impl Canvas {
    pub(super) fn fit(bounds: BBox, notes: usize, legend_rows: usize) -> Self {
        let bounds = if bounds.is_empty() { BBox::of(Point::ORIGIN, Point::ORIGIN) } else { bounds };
        let room = WIDTH - 2.0 * MARGIN;
        let scale = if bounds.size() > 0.0 { room / bounds.size() } else { 1.0 };
        let top = HEADING + NOTE * notes as f64 + 0.5 * MARGIN;
        Self { bounds, scale, top, extent: (bounds.width() * scale, bounds.height() * scale), legend_rows }
    }

    pub(super) fn open(&self, title: &str) -> String {
        let height = self.legend_top() + ROW * (self.legend_rows as f64 + 1.0) + 0.5 * MARGIN;
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h:.0}" viewBox="0 0 {w} {h:.0}" "#,
                r#"font-family="sans-serif" font-size="13" stroke-linejoin="round" stroke-linecap="round">"#,
                "\n<title>{title}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
            ),
            w = WIDTH,
            h = height,
            title = super::escape(title)
        )
    }

    pub(super) const fn left() -> f64 {
        MARGIN
    }

    pub(super) fn note_line(k: usize) -> f64 {
        HEADING + 6.0 + NOTE * k as f64
    }

    pub(super) fn legend_top(&self) -> f64 {
        self.top + self.extent.1 + MARGIN
    }

    pub(super) fn row(&self, k: usize) -> f64 {
        self.legend_top() + ROW * (k as f64 + 0.5)
    }

    /// Pixels of a length in mm.
    pub(super) fn length(&self, mm: f64) -> f64 {
        mm * self.scale
    }

    /// A round length that takes about a fifth of the sheet, mm.
    pub(super) fn scale_bar(&self) -> f64 {
        let about = 0.2 * WIDTH / self.scale;
        let decade = 10f64.powf(about.log10().floor());
        [5.0, 2.0, 1.0].into_iter().map(|k| k * decade).find(|&l| l <= about).unwrap_or(decade)
    }

    pub(super) fn place(&self, p: Point) -> (f64, f64) {
        let left = 0.5 * (WIDTH - self.extent.0);
        (left + (p.x - self.bounds.min.x) * self.scale, self.top + (self.bounds.max.y - p.y) * self.scale)
    }

    /// Path data of joining segments, closed where they end where they start.
    pub(super) fn path(&self, segments: &[Segment], data: &mut String) {
        let mut pen: Option<Point> = None;
        for segment in segments.iter().filter(|s| s.is_finite()) {
            if pen != Some(segment.start()) {
                let (x, y) = self.place(segment.start());
                let _ = write!(data, "M{x:.3} {y:.3}");
            }
            match segment {
                Segment::Line(line) => {
                    let (x, y) = self.place(line.end);
                    let _ = write!(data, "L{x:.3} {y:.3}");
                }
                Segment::Arc(arc) => self.arc(arc, data),
            }
            pen = Some(segment.end());
        }
        let closed = segments.len() > 1 && segments.first().map(Segment::start) == pen;
        data.push_str(if closed { "Z " } else { " " });
    }

    /// In two halves where it is more than half a circle, so that no flag has to be guessed from rounded numbers.
    fn arc(&self, arc: &Arc, data: &mut String) {
        let whole = Segment::Arc(*arc);
        let halves = if arc.sweep().abs() > PI { 2 } else { 1 };
        let r = self.length(arc.radius);
        for k in 1..=halves {
            let (x, y) = self.place(whole.at(f64::from(k) / f64::from(halves)));
            let _ = write!(data, "A{r:.3} {r:.3} 0 0 {} {x:.3} {y:.3}", u8::from(!arc.ccw));
        }
    }
}
