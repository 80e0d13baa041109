use super::*;
use crate::plan::testing::{block, region, tool};
use pocketry_geom::Segment;
use pocketry_motion::{Direction, Stock};

fn job(profile: &ToolProfile) -> PocketJob {
    let (_, radius) = inscribed_circle(profile).unwrap();
    let usual = PocketJob::for_diameter(2.0 * radius);
    PocketJob { stock: Stock { top: 0.0, depth: 1.0 }, stepdown: 1.0, ..usual }
}

#[test]
fn directions_go_on_without_jumps() {
    let pocket = region(&[&block(30.0, 20.0), &[[-5.0, 0.0, 1.0], [5.0, 0.0, 1.0]]]);
    let profile = tool("rect:8x3");
    for direction in [Direction::Climb, Direction::Conventional] {
        let job = PocketJob { direction, ..job(&profile) };
        let plan = plan_turning(&pocket, &profile, &job).unwrap();
        assert_eq!(plan.program.check(&job.stock), Ok(()));
        assert_eq!(plan.program.headings.len(), plan.program.moves.len());
        for (k, (from, step)) in plan.program.steps().enumerate() {
            let by = plan.program.headings[k + 1] - plan.program.headings[k];
            match *step {
                // In the air the shorter way round.
                pocketry_motion::Move::Rapid { .. } => assert!(by.abs() <= std::f64::consts::PI + 1e-9),
                pocketry_motion::Move::Line { to, .. } => assert!(by.abs() < 1e-9 || from.xy() == to.xy()),
                pocketry_motion::Move::Arc { .. } => {
                    let Segment::Arc(arc) = step.plan_view(from.xy()) else { unreachable!() };
                    assert!((by - arc.sweep()).abs() < 1e-9);
                }
            }
        }
    }
}

#[test]
fn its_flat_side_lies_along_every_wall() {
    let pocket = region(&[&block(30.0, 20.0)]);
    let profile = tool("rect:8x3");
    let plan = plan_turning(&pocket, &profile, &job(&profile)).unwrap();
    let outermost: Vec<_> = plan.loops.iter().filter(|l| l.level == 0).collect();
    assert_eq!(outermost.len(), 1, "in the corners it backs off and turns");
    assert!((outermost[0].distance - 1.5).abs() < 1e-3);
    let is_along = |s: &&Segment| [s.start(), s.end()].iter().all(|p| (30.0 - p.x.abs()).min(20.0 - p.y.abs()) < 1.501);
    let length: f64 = outermost[0].segments.iter().filter(is_along).map(Segment::length).sum();
    assert!((length - 2.0 * (60.0 - 8.0 + 40.0 - 8.0)).abs() < 0.01, "{length}");
}

#[test]
fn what_cannot_be_done_is_said() {
    let profile = tool("rect:8x3");
    let narrow = region(&[&block(3.0, 3.0)]);
    let error = plan_turning(&narrow, &profile, &job(&profile)).unwrap_err();
    assert!(matches!(error, PlanError::ProfileDoesNotFit { .. }), "{error}");
}

/// It used to be cut no farther than the inner parallels lead.
#[test]
fn a_round_pocket_is_cut_as_near_to_its_wall_as_the_corners_let_it() {
    let profile = tool("rect:8x3");
    let round = region(&[&[[-5.0, 0.0, 1.0], [5.0, 0.0, 1.0]]]);
    let plan = plan_turning(&round, &profile, &job(&profile)).unwrap();
    // The corners' circle is that of the wall: 4² + (1.5 + 1.5)² = 5².
    let nearest = plan.loops.iter().map(|l| l.distance).fold(f64::INFINITY, f64::min);
    assert!((nearest - 3.5).abs() < 2e-3, "{nearest}");
}
