//! Which tool: what a round tool leaves in corners and necks, and so the largest that meets a tolerance (Chou and Cohen,
//! section 4: "this allows us to select a tool with maximum size to satisfy a given tolerance automatically. This automatic
//! selection is important when there are narrow passages between regions in a pocket").
//!
//! What is left, how deep, and which bottlenecks the tool can't pass, says [`Leftover`], without a tool path. Loops leave
//! nothing else: up to the tool's radius apart they cover all between them, and farther apart clean-up paths do.

use crate::job::PocketJob;
use pocketry_geom::Point;
use pocketry_geom::leftover::{self, Leftover, Reach};
use pocketry_geom::offset::{OffsetError, degenerate_slack};
use pocketry_geom::skeleton::Skeleton;
use serde::Serialize;

/// The largest scallop that a tool leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Scallop {
    /// Distance of its farthest point from what is cut, mm.
    pub size: f64,
    /// That point.
    pub at: Point,
}

/// A place too narrow for a tool, of several the most telling.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Narrow {
    /// Its middle.
    pub at: Point,
    /// Width, mm.
    pub width: f64,
    /// How many such places there are.
    pub count: usize,
}

/// What a tool makes of a region.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ToolFit {
    /// Diameter of the tool, mm.
    pub diameter: f64,
    /// Whether it fits anywhere.
    pub fits: bool,
    /// Its largest scallop; none where it leaves nothing, or fits nowhere.
    pub scallop: Option<Scallop>,
    /// Area that it leaves, mm².
    pub left: f64,
    /// The narrowest neck that it can't pass.
    pub neck: Option<Narrow>,
    /// Of the pockets in which it fits nowhere, the widest place.
    pub closed: Option<Narrow>,
}

/// The answer to a choice among tools.
#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    /// The largest tool that meets the tolerance: its diameter, mm.
    Tool(f64),
    /// None does; what each of them leaves, the smallest first.
    None(Vec<ToolFit>),
}

impl ToolFit {
    /// What a tool of this diameter, mm, makes of the region of a skeleton when it is to leave so much on the walls, mm.
    ///
    /// # Errors
    /// When the diameter is not a positive number, or the stock to leave not a number from 0 on.
    pub fn new(skeleton: &Skeleton, diameter: f64, stock_to_leave: f64) -> Result<Self, OffsetError> {
        let reach = Reach { radius: 0.5 * diameter, stock_to_leave };
        let found = Leftover::new(skeleton, reach)?;
        let least = reach.axis() - degenerate_slack(reach.axis());
        Ok(Self {
            diameter,
            fits: skeleton.vertices().iter().any(|v| v.clearance >= least),
            scallop: found.deepest().map(|d| Scallop { size: d.size, at: d.at }),
            left: found.area(),
            neck: narrow(found.necks().copied(), |a, b| a < b),
            closed: narrow(found.pockets().filter_map(|p| p.widest), |a, b| a > b),
        })
    }

    /// Whether it gets into every pocket and leaves scallops of at most this size, mm.
    pub fn meets(&self, scallop: f64) -> bool {
        self.fits && self.closed.is_none() && self.scallop.is_none_or(|s| s.size <= scallop)
    }
}

/// The place whose width is better than that of all others, and how many there are.
fn narrow(places: impl Iterator<Item = leftover::Neck>, better: impl Fn(f64, f64) -> bool) -> Option<Narrow> {
    places.fold(None, |best: Option<Narrow>, place| {
        let count = best.map_or(0, |b| b.count) + 1;
        let kept = best.filter(|b| !better(place.width, b.width));
        Some(kept.map_or(Narrow { at: place.at, width: place.width, count }, |b| Narrow { count, ..b }))
    })
}

/// Chooses the largest of these diameters, mm, that meets a tolerance, mm, with the job's stock to leave.
///
/// # Errors
/// As [`ToolFit::new`].
pub fn choose(skeleton: &Skeleton, diameters: &[f64], scallop: f64, job: &PocketJob) -> Result<Choice, OffsetError> {
    let mut sorted = diameters.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    sorted.dedup();
    let mut refused = Vec::new();
    for diameter in sorted {
        let fit = ToolFit::new(skeleton, diameter, job.stock_to_leave)?;
        if fit.meets(scallop) {
            return Ok(Choice::Tool(diameter));
        }
        refused.push(fit);
    }
    refused.reverse();
    Ok(Choice::None(refused))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::repair::{RepairOptions, build};
    use pocketry_geom::{Contour, point};

    fn skeleton(loops: &[&[[f64; 3]]]) -> Skeleton {
        let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
        Skeleton::build(&build(contours, &RepairOptions::default()).unwrap().region).unwrap()
    }

    /// Two squares of 10, the second 4 mm away.
    const PAIR: [[[f64; 3]; 4]; 2] = [
        [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]],
        [[14.0, 0.0, 0.0], [17.0, 0.0, 0.0], [17.0, 10.0, 0.0], [14.0, 10.0, 0.0]],
    ];

    #[test]
    fn a_tool_that_does_not_fit_into_every_pocket_is_not_chosen() {
        let s = skeleton(&[&PAIR[0], &PAIR[1]]);
        let fit = ToolFit::new(&s, 4.0, 0.0).unwrap();
        assert!(fit.fits && !fit.meets(100.0));
        let closed = fit.closed.unwrap();
        assert!((closed.width - 3.0).abs() < 1e-9 && closed.count == 1 && (closed.at.x - 15.5).abs() < 1e-9);
        assert_eq!(choose(&s, &[2.0, 4.0, 3.0], 1.0, &PocketJob::default()), Ok(Choice::Tool(3.0)));
    }

    #[test]
    fn where_none_will_do_each_is_accounted_for() {
        let s = skeleton(&[&PAIR[0]]);
        let Choice::None(refused) = choose(&s, &[12.0, 2.0, 4.0, 2.0], 0.1, &PocketJob::default()).unwrap() else {
            panic!("one was chosen")
        };
        assert_eq!(refused.iter().map(|f| f.diameter).collect::<Vec<_>>(), [2.0, 4.0, 12.0]);
        assert!(refused[0].scallop.unwrap().size > 0.4 && refused[0].neck.is_none());
        let closed = refused[2].closed.unwrap();
        assert!(!refused[2].fits && closed.at.distance(point(5.0, 5.0)) < 1e-9);
        assert!((refused[2].left - 100.0).abs() < 1e-9);
    }
}
