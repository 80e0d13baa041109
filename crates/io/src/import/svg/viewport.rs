//! Sizes, units and view boxes: from user units to millimetres, y pointing up.

use crate::import::ImportOptions;
use crate::import::affine::Affine;
use crate::import::error::{FaultKind, ImportError};
use crate::import::sketch::{Sketch, Source};
use crate::import::units::Units;
use pocketry_geom::{tolerance, vec2};
use roxmltree::Node;
use std::str::FromStr;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

/// The size of the viewport in user units, which percentages refer to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport {
    /// Along x.
    pub(super) width: f64,
    /// Along y.
    pub(super) height: f64,
}

/// A length in CSS pixels, and whether its unit is one that a ruler knows.
fn pixels(length: Length, whole: f64) -> (f64, bool) {
    const INCH: f64 = 96.0;
    let n = length.number;
    match length.unit {
        LengthUnit::None | LengthUnit::Px => (n, false),
        LengthUnit::In => (n * INCH, true),
        LengthUnit::Cm => (n * INCH / 2.54, true),
        LengthUnit::Mm => (n * INCH / 25.4, true),
        LengthUnit::Pt => (n * INCH / 72.0, true),
        LengthUnit::Pc => (n * INCH / 6.0, true),
        LengthUnit::Em => (n * 16.0, false),
        LengthUnit::Ex => (n * 8.0, false),
        LengthUnit::Percent => (n / 100.0 * whole, false),
    }
}

/// An attribute that is a length, in user units.
pub(super) fn length(node: Node<'_, '_>, name: &str, whole: f64, source: &Source) -> Result<Option<f64>, ImportError> {
    let Some(text) = node.attribute(name) else { return Ok(None) };
    if text.trim() == "auto" {
        return Ok(None);
    }
    let length = Length::from_str(text.trim()).ok().map(|l| pixels(l, whole).0).filter(|x| x.is_finite());
    length.map(Some).ok_or_else(|| source.error(format!("its {name} {text:?} is no length"), "correct it"))
}

fn view_box(node: Node<'_, '_>, source: &Source) -> Result<Option<ViewBox>, ImportError> {
    let Some(text) = node.attribute("viewBox") else { return Ok(None) };
    let finite = |v: &ViewBox| [v.x, v.y, v.w, v.h].iter().all(|k| k.is_finite());
    let parsed = ViewBox::from_str(text).ok().filter(finite);
    parsed.map(Some).ok_or_else(|| source.error(format!("its viewBox {text:?} is empty or no view box"), "correct it"))
}

fn aspect(node: Node<'_, '_>) -> AspectRatio {
    node.attribute("preserveAspectRatio").and_then(|t| AspectRatio::from_str(t).ok()).unwrap_or_default()
}

/// The map of a view box into a viewport whose corner is the origin.
fn fit(view: ViewBox, width: f64, height: f64, aspect: AspectRatio) -> Affine {
    let (mut sx, mut sy) = (width / view.w, height / view.h);
    let (mut dx, mut dy) = (0.0, 0.0);
    if aspect.align != Align::None {
        let s = if aspect.slice { sx.max(sy) } else { sx.min(sy) };
        (sx, sy) = (s, s);
        let (share_x, share_y) = shares(aspect.align);
        (dx, dy) = ((width - view.w * s) * share_x, (height - view.h * s) * share_y);
    }
    let moved = Affine::translate(vec2(dx, dy)).after(&Affine::scale(sx, sy));
    moved.after(&Affine::translate(vec2(-view.x, -view.y)))
}

/// Where the view box goes in a viewport that is larger: 0 at the low end, 1 at the high end.
const fn shares(align: Align) -> (f64, f64) {
    match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    }
}

/// The outermost element's map to millimetres with y up, and its viewport; sets the sketch's units.
pub(super) fn root(
    svg: Node<'_, '_>,
    source: &Source,
    options: &ImportOptions,
    sketch: &mut Sketch,
) -> Result<(Affine, Viewport), ImportError> {
    let view = view_box(svg, source)?;
    let side = |name| {
        let parsed = svg.attribute(name).and_then(|t| Length::from_str(t.trim()).ok());
        parsed.filter(|l| l.unit != LengthUnit::Percent && l.number > 0.0).map(|l| pixels(l, 0.0))
    };
    let (width, height) = (side("width"), side("height"));
    let physical = width.or(height).is_some_and(|(_, physical)| physical);
    let pixel = Units::PIXEL.millimeters();
    let viewport = Viewport {
        width: view.map_or(width.map_or(0.0, |w| w.0), |v| v.w),
        height: view.map_or(height.map_or(0.0, |h| h.0), |v| v.h),
    };
    let to_pixels = match view {
        _ if options.units.is_some() => Affine::translate(view.map_or(vec2(0.0, 0.0), |v| vec2(-v.x, -v.y))),
        Some(v) => {
            let (w, h) = match (width, height) {
                (Some((w, _)), Some((h, _))) => (w, h),
                (Some((w, _)), None) => (w, v.h * w / v.w),
                (None, Some((h, _))) => (v.w * h / v.h, h),
                (None, None) => (v.w, v.h),
            };
            let stretch = (w / v.w) / (h / v.h);
            if (stretch - 1.0).abs() > tolerance::KINK {
                let message = "width : height differs from the viewBox's; scaled as preserveAspectRatio says";
                sketch.warn(source.place(), message);
            }
            fit(v, w, h, aspect(svg))
        }
        None => Affine::IDENTITY,
    };
    let unit = options.units.map_or(pixel, Units::millimeters);
    sketch.units = options.units.unwrap_or(if physical && view.is_some() { Units::MILLIMETER } else { Units::PIXEL });
    if options.units.is_none() && !(physical && view.is_some()) {
        let message = "the drawing doesn't say its physical size (width and height in mm or in, with a viewBox); \
                       pixels of 1/96 inch are assumed";
        sketch.warn(source.place(), message);
    }
    let page = if options.units.is_some() { viewport.height } else { height.map_or(viewport.height, |h| h.0) };
    let flip = Affine { f: page * unit, ..Affine::scale(unit, -unit) };
    let map = flip.after(&to_pixels);
    if map.is_singular() {
        return Err(ImportError::new(
            FaultKind::Value,
            source.place(),
            "the drawing has no size",
            "correct its viewBox",
        ));
    }
    Ok((map, viewport))
}

/// The map of an inner `svg` or a `symbol` in use, and its viewport.
pub(super) fn inner(
    node: Node<'_, '_>,
    outer: Viewport,
    size: (Option<f64>, Option<f64>),
    source: &Source,
) -> Result<(Affine, Viewport), ImportError> {
    let own = |name, whole| length(node, name, whole, source);
    let width = size.0.or(own("width", outer.width)?).unwrap_or(outer.width);
    let height = size.1.or(own("height", outer.height)?).unwrap_or(outer.height);
    let x = own("x", outer.width)?.unwrap_or(0.0);
    let y = own("y", outer.height)?.unwrap_or(0.0);
    let corner = Affine::translate(vec2(x, y));
    match view_box(node, source)? {
        Some(view) => {
            let fitted = fit(view, width, height, aspect(node));
            Ok((corner.after(&fitted), Viewport { width: view.w, height: view.h }))
        }
        None => Ok((corner, Viewport { width, height })),
    }
}
