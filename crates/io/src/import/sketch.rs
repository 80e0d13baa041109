//! What every format's reader hands over: closed loops, loose curves, and where each comes from.

use super::affine::Affine;
use super::curve::Curve;
use super::error::{FaultKind, ImportError, Place, Warning};
use super::units::Units;
use pocketry_geom::{Contour, Segment, tolerance};

/// The most curves that a drawing may consist of once its blocks and references are laid out.
pub(crate) const MAX_CURVES: u64 = 4_000_000;

/// The most lines and arcs that a drawing may become.
pub(crate) const MAX_SEGMENTS: usize = 8_000_000;

/// Where a curve of a drawing comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The layer (DXF), the group (SVG); empty where there is none.
    pub layer: String,
    /// The entity: its type and, where there is one, its handle or id.
    pub entity: String,
    /// The line of the file where the entity begins, from 1.
    pub line: usize,
}

impl Source {
    /// As a place for messages.
    pub(crate) fn place(&self) -> Place {
        Place {
            line: (self.line > 0).then_some(self.line),
            layer: (!self.layer.is_empty()).then(|| self.layer.clone()),
            entity: (!self.entity.is_empty()).then(|| self.entity.clone()),
            ..Place::default()
        }
    }

    /// An error about this entity.
    pub(crate) fn error(&self, problem: impl Into<String>, hint: impl Into<String>) -> ImportError {
        ImportError::new(FaultKind::Value, self.place(), problem, hint)
    }
}

/// A loop of the drawing and what drew it.
#[derive(Clone, Debug)]
pub(crate) struct Loop {
    /// The closed curve.
    pub(crate) contour: Contour,
    /// Index of its source.
    pub(crate) source: u32,
}

/// A segment that is to be chained with others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loose {
    /// The segment.
    pub(crate) segment: Segment,
    /// Index of its source.
    pub(crate) source: u32,
}

/// A drawing in millimetres, not yet a region.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sketch {
    /// Closed curves.
    pub(crate) loops: Vec<Loop>,
    /// Everything else.
    pub(crate) loose: Vec<Loose>,
    /// Where the curves come from.
    pub(crate) sources: Vec<Source>,
    /// What was assumed or healed so far.
    pub(crate) warnings: Vec<Warning>,
    /// How many lines and arcs there are so far.
    pub(crate) count: usize,
    /// The unit that the drawing was read in.
    pub(crate) units: Units,
}

impl Sketch {
    /// Registers a source.
    pub(crate) fn source(&mut self, source: Source) -> u32 {
        self.sources.push(source);
        self.sources.len() as u32 - 1
    }

    /// Notes what was healed.
    pub(crate) fn warn(&mut self, place: Place, message: impl Into<String>) {
        self.warnings.push(Warning::new(place, message));
    }

    /// Adds one entity's curves, connected end to end, mapped to millimetres by `map`.
    ///
    /// Where the entity closes (by itself or `closed` says that a straight edge closes it) it becomes a loop, else its
    /// segments become loose ones.
    pub(crate) fn add(
        &mut self,
        curves: &[Curve],
        closed: bool,
        map: &Affine,
        source: u32,
        fit_tolerance: f64,
    ) -> Result<(), ImportError> {
        let mut segments = Vec::with_capacity(curves.len());
        self.segments(curves, map, source, fit_tolerance, &mut segments)?;
        let open = gap(&segments).is_some_and(|g| g > 0.0);
        if closed || !open {
            if close(&mut segments).is_some() {
                self.loops.push(Loop { contour: Contour::new(segments), source });
            }
        } else {
            self.loose.extend(segments.into_iter().map(|segment| Loose { segment, source }));
        }
        Ok(())
    }

    /// Appends an entity's curves, mapped to millimetres, as lines and arcs.
    pub(crate) fn segments(
        &mut self,
        curves: &[Curve],
        map: &Affine,
        source: u32,
        fit_tolerance: f64,
        out: &mut Vec<Segment>,
    ) -> Result<(), ImportError> {
        for curve in curves {
            let mapped = curve.transformed(map);
            let reach = mapped.reach();
            if reach > tolerance::ABSURD {
                return Err(self.too_far(source, reach));
            }
            let before = out.len();
            mapped.segments(fit_tolerance, out);
            self.count += out.len() - before;
            if self.count > MAX_SEGMENTS {
                let place = self.sources[source as usize].place();
                let hint = "check the drawing's units, or raise the fit tolerance";
                let problem = format!("its curves take more than {MAX_SEGMENTS} arcs");
                return Err(ImportError::new(FaultKind::Limit, place, problem, hint));
            }
        }
        Ok(())
    }

    fn too_far(&self, source: u32, reach: f64) -> ImportError {
        ImportError::new(
            FaultKind::Limit,
            self.sources[source as usize].place(),
            format!("a coordinate or radius of {reach:.3e} mm is beyond what can be milled or computed with"),
            "check the drawing's units, or move the part near the origin",
        )
    }
}

/// The distance from the end of a chain to its start, mm; 0 where it is but rounding, `None` for an empty chain.
fn gap(segments: &[Segment]) -> Option<f64> {
    let (start, end) = (segments.first()?.start(), segments.last()?.end());
    let size = segments.iter().fold(0.0, |reach: f64, s| reach.max(s.start().distance(start)));
    let gap = start.distance(end);
    Some(if gap <= tolerance::COINCIDENT_CONTROL * size { 0.0 } else { gap })
}

/// Closes a chain, with a straight line where its ends don't meet; says how wide the gap was, `None` for an empty chain.
pub(crate) fn close(segments: &mut Vec<Segment>) -> Option<f64> {
    let width = gap(segments)?;
    let (start, end) = (segments[0].start(), segments[segments.len() - 1].end());
    if width > 0.0 {
        segments.push(Segment::line(end, start));
    } else {
        super::fit::weld(segments, start, start);
    }
    Some(width)
}
