//! The study as a chart: length and uncut material against the stepover.

use super::Row;
use crate::console::figure;
use pocketry_io::plot::escape;
use std::fmt::Write;

/// The drawing area of a panel, in pixels.
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 90.0;
const TOP: f64 = 60.0;
const APART: f64 = 80.0;
/// With clean-up, without.
const COLOURS: [&str; 2] = ["#1f6fb4", "#c8502d"];

/// An SVG of two panels.
pub(super) fn svg(title: &str, rows: &[Row]) -> String {
    let (width, height) = (LEFT + WIDTH + 40.0, TOP + 2.0 * HEIGHT + APART + 60.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"24\" font-size=\"16\">{}</text>\n",
        escape(title)
    );
    for (k, name) in ["with clean-up", "without"].iter().enumerate() {
        let x = LEFT + 140.0 * k as f64;
        let _ = writeln!(
            out,
            "<path d=\"M{x} 42h24\" stroke=\"{}\" stroke-width=\"2\"/><text x=\"{}\" y=\"46\">{name}</text>",
            COLOURS[k],
            x + 30.0
        );
    }
    panel(&mut out, TOP, "length of cutting moves, mm", rows, |r| r.length);
    panel(&mut out, TOP + HEIGHT + APART, "uncut material, mm²", rows, |r| r.uncut);
    out + "</svg>\n"
}

fn panel(out: &mut String, top: f64, name: &str, rows: &[Row], value: impl Fn(&Row) -> f64) {
    let extent = |of: &dyn Fn(&Row) -> f64, from: f64| {
        rows.iter().map(of).fold((from, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
    };
    let (left, right) = extent(&|r| r.stepover, f64::INFINITY);
    let (low, high) = extent(&|r| value(r), 0.0);
    let share = |v: f64, a: f64, b: f64| if b > a { (v - a) / (b - a) } else { 0.5 };
    let x = |v: f64| LEFT + WIDTH * share(v, left, right);
    let y = |v: f64| top + HEIGHT * (1.0 - share(v, low, if high > low { high } else { low + 1.0 }));
    let _ = writeln!(
        out,
        "<path d=\"M{LEFT} {top}v{HEIGHT}h{WIDTH}\" fill=\"none\" stroke=\"#444\"/><text x=\"{LEFT}\" y=\"{}\">{name}</text>",
        top - 6.0
    );
    for k in 0..=5 {
        let at = f64::from(k) / 5.0;
        let (step, v) = (left + (right - left) * at, low + (high - low) * at);
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            x(step),
            top + HEIGHT + 18.0,
            figure(step),
            LEFT - 8.0,
            y(v) + 4.0,
            if v.abs() >= 100.0 { format!("{v:.0}") } else { figure(v) },
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">stepover, mm</text>",
        LEFT + WIDTH,
        top + HEIGHT + 36.0
    );
    for (k, cleanup) in [true, false].into_iter().enumerate() {
        let points =
            rows.iter().filter(|r| r.cleanup == cleanup).map(|r| format!("{:.1},{:.1}", x(r.stepover), y(value(r))));
        let points = points.collect::<Vec<_>>().join(" ");
        let _ =
            writeln!(out, "<polyline points=\"{points}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>", COLOURS[k]);
    }
}
