//! Legend and scale bar below the drawing.

use super::canvas::Canvas;
use super::{Look, Picture, escape, ramp, style};
use std::fmt::Write;

/// One row of the legend.
enum Row<'a> {
    Line(&'a str, Look),
    Loops(&'a str),
    Spot(&'a str, usize),
}

impl Row<'_> {
    const fn name(&self) -> &str {
        match self {
            Self::Line(name, _) | Self::Loops(name) | Self::Spot(name, _) => name,
        }
    }
}

fn collect(picture: &Picture) -> Vec<Row<'_>> {
    let mut rows: Vec<Row> = Vec::new();
    for layer in &picture.layers {
        if rows.iter().all(|r| r.name() != layer.name) {
            rows.push(match layer.look {
                Look::Loop(_) => Row::Loops(&layer.name),
                look => Row::Line(&layer.name, look),
            });
        }
    }
    for spot in &picture.spots {
        match rows.iter_mut().find(|r| r.name() == spot.name) {
            Some(Row::Spot(_, count)) => *count += 1,
            Some(_) => {}
            None => rows.push(Row::Spot(&spot.name, 1)),
        }
    }
    rows
}

/// How many rows it takes.
pub(super) fn rows(picture: &Picture) -> usize {
    collect(picture).len()
}

pub(super) fn draw(picture: &Picture, canvas: &Canvas, svg: &mut String) {
    const SWATCH: f64 = 46.0;
    let x = Canvas::left();
    for (k, row) in collect(picture).into_iter().enumerate() {
        let y = canvas.row(k);
        let label = match row {
            Row::Line(name, look) => {
                let _ = writeln!(svg, r#"<path {} d="M{x} {y}h{SWATCH}"/>"#, style(look));
                escape(name)
            }
            Row::Loops(name) => {
                draw_ramp(svg, x, y, SWATCH);
                format!("{}, first cut to last", escape(name))
            }
            Row::Spot(name, count) => {
                let _ = writeln!(
                    svg,
                    r##"<circle cx="{}" cy="{y}" r="5" fill="#d62728" fill-opacity="0.35" stroke="#d62728"/>"##,
                    x + 0.5 * SWATCH
                );
                format!("{} ({count})", escape(name))
            }
        };
        let _ = writeln!(svg, r#"<text x="{}" y="{}">{label}</text>"#, x + SWATCH + 10.0, y + 4.5);
    }
    draw_scale_bar(canvas, svg);
}

fn draw_ramp(svg: &mut String, x: f64, y: f64, width: f64) {
    const STEPS: u32 = 8;
    let part = width / f64::from(STEPS);
    for k in 0..STEPS {
        let colour = ramp(f64::from(k) / f64::from(STEPS - 1));
        let at = x + part * f64::from(k);
        let _ = writeln!(svg, r#"<path fill="none" stroke="{colour}" stroke-width="3" d="M{at} {y}h{part}"/>"#);
    }
}

fn draw_scale_bar(canvas: &Canvas, svg: &mut String) {
    let mm = canvas.scale_bar();
    let (length, y) = (canvas.length(mm), canvas.row(0));
    let end = 1000.0 - Canvas::left();
    let start = end - length;
    let _ = writeln!(
        svg,
        r##"<path fill="none" stroke="#1b1f24" stroke-width="1.5" d="M{start:.3} {}v10m0 -5H{end:.3}m0 -5v10"/>"##,
        y - 5.0
    );
    let _ =
        writeln!(svg, r#"<text x="{:.3}" y="{}" text-anchor="middle">{mm} mm</text>"#, 0.5 * (start + end), y + 20.0);
}
