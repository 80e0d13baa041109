//! Whole plans of small regions, judged by distances.

use pocketry_cam::{EntryKind, LinkKind, Plan, PlanError, PocketJob, Uncut, Warning, plan, quickest};
use pocketry_geom::distance::Boundary;
use pocketry_geom::repair::{self, RepairOptions};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Arc, Contour, Point, Region, Segment, point};
use pocketry_motion::{Direction, Move};

fn region(loops: &[&[[f64; 3]]]) -> Region {
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    repair::build(contours, &RepairOptions::default()).unwrap().region
}

fn planned(region: &Region, job: &PocketJob) -> Result<Plan, PlanError> {
    plan(region, &Skeleton::build(region).unwrap(), job)
}

fn job(diameter: f64) -> PocketJob {
    PocketJob::for_diameter(diameter)
}

/// The cutting moves as segments of the plane.
fn paths(plan: &Plan) -> Vec<Segment> {
    let moves = &plan.program.moves;
    let pairs = moves.windows(2).map(|w| (w[0].to().xy(), w[1]));
    pairs
        .filter(|(from, m)| !matches!(m, Move::Rapid { .. }) && *from != m.to().xy() || matches!(m, Move::Arc { .. }))
        .map(|(from, m)| match m {
            Move::Arc { to, center, ccw, .. } => {
                Segment::Arc(Arc { start: from, end: to.xy(), center, radius: from.distance(center), ccw })
            }
            _ => Segment::line(from, m.to().xy()),
        })
        .collect()
}

fn lifts(plan: &Plan, top: f64) -> usize {
    plan.program.moves.windows(2).filter(|w| w[0].to().z < top && w[1].to().z > top).count()
}

/// Walls are kept clear of, everything within reach is swept, lifts keep to their budget, rapids stay above.
fn assert_sound(region: &Region, plan: &Plan, job: &PocketJob) {
    let (walls, first, radius) = (Boundary::new(region), job.first_distance(), job.tool.radius());
    let paths = paths(plan);
    for p in &paths {
        assert!(walls.distance_to(p) > first - 1.01e-4, "{p:?}");
    }
    let bbox = region.bbox();
    let swept = |p: Point| paths.iter().any(|s| s.distance(p) <= radius + 1e-9);
    for k in 0..3600 {
        let (i, j) = (f64::from(k % 60) / 59.0, f64::from(k / 60) / 59.0);
        let p = point(bbox.min.x + i * bbox.width(), bbox.min.y + j * bbox.height());
        // Points at least r + q from the walls are reached by the tool's axis itself.
        if walls.signed_distance(p).abs() >= first && walls.contains(p) {
            assert!(swept(p), "{p:?} is left");
        }
    }
    let top = job.stock.top;
    assert!(lifts(plan, top) <= plan.control_vertices * plan.passes);
    assert_eq!(lifts(plan, top), plan.groups.len() * plan.passes);
    for w in plan.program.moves.windows(2) {
        if matches!(w[1], Move::Rapid { .. }) && w[0].to().xy() != w[1].to().xy() {
            assert!(w[0].to().z > top && w[1].to().z > top);
        }
    }
}

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 30.0, 0.0], [0.0, 30.0, 0.0]];

#[test]
fn a_rectangle_is_one_group_from_a_helix() {
    let (region, job) = (region(&[&SQUARE]), job(6.0));
    let plan = planned(&region, &job).unwrap();
    assert_sound(&region, &plan, &job);
    assert_eq!((plan.groups.len(), plan.passes, plan.warnings.len()), (1, 1, 0));
    assert!(matches!(plan.groups[0].entry, EntryKind::Helix { .. }));
    assert!(plan.loops.windows(2).all(|w| w[0].distance > w[1].distance), "innermost first");
    assert!((plan.loops.last().unwrap().distance - 3.0).abs() < 1e-12);
    assert!(plan.links[1..].iter().all(|l| l.kind == LinkKind::SideStep));
}

#[test]
fn climb_keeps_the_wall_to_the_right_and_conventional_to_the_left() {
    let region = region(&[&SQUARE]);
    for (direction, sign) in [(Direction::Climb, 1.0), (Direction::Conventional, -1.0)] {
        let job = PocketJob { direction, ..job(6.0) };
        let plan = planned(&region, &job).unwrap();
        assert_sound(&region, &plan, &job);
        assert!(plan.loops.iter().all(|l| sign * Contour::new(l.segments.clone()).area() > 0.0));
    }
}

#[test]
fn passes_are_equal_and_each_lifts_once() {
    let region = region(&[&SQUARE]);
    let mut job = job(6.0);
    (job.stock.depth, job.stepdown) = (10.0, 3.0);
    let plan = planned(&region, &job).unwrap();
    assert_sound(&region, &plan, &job);
    assert_eq!((plan.passes, lifts(&plan, 0.0)), (4, 4));
    let lowest = plan.program.moves.iter().map(|m| m.to().z).fold(0.0, f64::min);
    assert_eq!(lowest, -10.0);
}

#[test]
fn a_slot_as_wide_as_the_tool_is_ramped_along_its_middle() {
    let region = region(&[&[[0.0, 0.0, 0.0], [30.0, 0.0, 1.0], [30.0, 6.0, 0.0], [0.0, 6.0, 1.0]]]);
    for diameter in [6.0, 6.0001] {
        let job = job(diameter);
        let plan = planned(&region, &job).unwrap();
        assert_sound(&region, &plan, &job);
        assert_eq!(plan.loops.len(), 1);
        assert!(plan.loops[0].degenerate && plan.groups[0].entry == EntryKind::Ramp);
        let reach: Vec<f64> = plan.loops[0].segments.iter().map(|s| s.end().x).collect();
        assert!(reach.iter().any(|x| x.abs() < 1e-9) && reach.iter().any(|x| (x - 30.0).abs() < 1e-9));
    }
}

#[test]
fn a_hole_as_wide_as_the_tool_is_plunged_into_with_a_warning() {
    let region = region(&[&[[3.0, 0.0, 1.0], [-3.0, 0.0, 1.0]]]);
    let plan = planned(&region, &job(6.0)).unwrap();
    assert_eq!(plan.groups[0].entry, EntryKind::Plunge);
    assert!(matches!(plan.warnings[..], [Warning::Plunge { at }] if at.distance(Point::ORIGIN) < 1e-9));
}

#[test]
fn a_tool_that_fits_nowhere_is_told_what_would() {
    let region = region(&[&SQUARE]);
    let mut job = job(32.0);
    job.stock_to_leave = 1.0;
    match planned(&region, &job) {
        Err(PlanError::DoesNotFit { diameter, largest }) => {
            assert_eq!(diameter, 32.0);
            assert!((largest - 28.0).abs() < 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn stepovers_above_the_diameter_are_clamped() {
    let region = region(&[&SQUARE]);
    let job = PocketJob { stepover: 7.0, ..job(6.0) };
    let plan = planned(&region, &job).unwrap();
    assert_sound(&region, &plan, &job);
    assert_eq!(plan.stepover, 2.0 * (3.0 - 1e-4));
    assert_eq!(plan.warnings, vec![Warning::StepoverClamped { asked: 7.0, used: plan.stepover }]);
}

/// Whether every point with clearance of at least the tool's radius is swept.
fn leaves_nothing(region: &Region, plan: &Plan, radius: f64) -> bool {
    let (walls, paths, bbox) = (Boundary::new(region), paths(plan), region.bbox());
    (0..6400).all(|k| {
        let (i, j) = (f64::from(k % 80) / 79.0, f64::from(k / 80) / 79.0);
        let p = point(bbox.min.x + i * bbox.width(), bbox.min.y + j * bbox.height());
        !walls.contains(p) || walls.distance(p) < radius || paths.iter().any(|s| s.distance(p) <= radius + 1e-9)
    })
}

#[test]
fn corners_centres_and_necks_are_cleaned_up_at_any_stepover() {
    let funnel = [
        [0.0, 0.0, 0.0],
        [60.0, 17.0, 0.0],
        [120.0, 0.0, 0.0],
        [120.0, 60.0, 0.0],
        [60.0, 43.0, 0.0],
        [0.0, 60.0, 0.0],
    ];
    let disc = [[18.5, 0.0, 1.0], [-18.5, 0.0, 1.0]];
    for (shape, least) in [(&SQUARE[..], Uncut::Corner), (&funnel[..], Uncut::Neck), (&disc[..], Uncut::Center)] {
        let region = region(&[shape]);
        for share in [0.55, 0.75, 0.9, 0.999] {
            let job = PocketJob { stepover: share * 6.0, ..job(6.0) };
            let plan = planned(&region, &job).unwrap();
            assert_sound(&region, &plan, &job);
            assert!(leaves_nothing(&region, &plan, 3.0), "{least:?} at {share}");
        }
        let job = PocketJob { stepover: 5.6, ..job(6.0) };
        let plan = planned(&region, &job).unwrap();
        assert!(plan.cleanups.iter().any(|c| c.kind == least), "{least:?}: {:?}", plan.cleanups);
        let bare = planned(&region, &PocketJob { cleanup: false, ..job }).unwrap();
        // The entry's helix clears the disc's centre.
        let left = least == Uncut::Center || !leaves_nothing(&region, &bare, 3.0);
        assert!(bare.cleanups.is_empty() && left, "{least:?}");
        assert_eq!(lifts(&bare, 0.0), lifts(&plan, 0.0));
    }
}

/// A ring's middle is a circle of constant clearance, which clean-up walks in small steps: 19,000 moves once.
#[test]
fn the_middle_of_a_ring_takes_few_moves() {
    let circle = |r: f64| [[r, 0.0, 1.0], [-r, 0.0, 1.0]];
    let ring = region(&[&circle(20.0), &circle(15.86)]);
    let job = PocketJob { stepover: 0.18, ..job(0.24) };
    let plan = planned(&ring, &job).unwrap();
    assert!(leaves_nothing(&ring, &plan, 0.12));
    assert!(plan.program.moves.len() < 200, "{} moves", plan.program.moves.len());
}

/// At this size a tolerance in micrometres was never met, and each way along a parabola took 4,096 chords.
#[test]
fn ways_in_a_pocket_of_kilometres_take_few_moves() {
    let island = [[9e5, 4e5, 0.0], [1.1e6, 5.5e5, 0.0], [9.5e5, 6.5e5, 0.0]];
    let vast = region(&[&[[0.0, 0.0, 0.0], [2e6, 0.0, 0.0], [2e6, 1e6, 0.0], [0.0, 1e6, 0.0]], &island]);
    let plan = planned(&vast, &PocketJob { stepover: 4e4, ..job(1e5) }).unwrap();
    assert!(plan.program.moves.len() < 1000, "{} moves", plan.program.moves.len());
}

#[test]
fn up_to_the_radius_there_is_nothing_to_clean_up() {
    let job = PocketJob { stepover: 2.9, ..job(6.0) };
    assert!(planned(&region(&[&SQUARE]), &job).unwrap().cleanups.is_empty());
}

#[test]
fn the_quickest_stepover_beats_the_usual_one() {
    let (region, job) = (region(&[&SQUARE]), job(6.0));
    let time = |p: &Plan| p.program.figures(&job.feeds, &job.stock).machine_seconds;
    let best = quickest(&region, &Skeleton::build(&region).unwrap(), &job).unwrap();
    assert!(time(&best) <= time(&planned(&region, &job).unwrap()));
    assert!(leaves_nothing(&region, &best, 3.0));
}

#[test]
fn islands_are_reached_without_lifting() {
    let boss = |x: f64, y: f64| [[x + 3.0, y, 1.0], [x - 3.0, y, 1.0]];
    let bosses = [boss(14.0, 13.0), boss(30.0, 14.0), boss(47.0, 12.5)];
    let outer = [[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [60.0, 26.0, 0.0], [0.0, 26.0, 0.0]];
    let region = region(&[&outer, &bosses[0], &bosses[1], &bosses[2]]);
    let job = job(4.0);
    let plan = planned(&region, &job).unwrap();
    assert_sound(&region, &plan, &job);
    assert!(plan.links.iter().any(|l| l.kind == LinkKind::Medial));
    assert_eq!(plan.groups.iter().map(|g| g.pocket).max(), Some(0));
}

#[test]
fn a_neck_too_narrow_parts_the_pocket_and_one_too_small_a_chamber_is_named() {
    let dumbbell = [
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 8.0, 0.0],
        [30.0, 8.0, 0.0],
        [30.0, 0.0, 0.0],
        [50.0, 0.0, 0.0],
        [50.0, 20.0, 0.0],
        [30.0, 20.0, 0.0],
        [30.0, 12.0, 0.0],
        [20.0, 12.0, 0.0],
        [20.0, 20.0, 0.0],
        [0.0, 20.0, 0.0],
    ];
    let region = region(&[&dumbbell]);
    let plan = planned(&region, &job(6.0)).unwrap();
    assert_sound(&region, &plan, &job(6.0));
    assert_eq!(plan.groups.iter().map(|g| g.pocket).collect::<Vec<_>>(), vec![0, 1]);
    // With a tool just as wide as the neck, its middle is cut too.
    let plan = planned(&region, &job(4.0)).unwrap();
    assert_sound(&region, &plan, &job(4.0));
    let middle = point(25.0, 10.0);
    assert!(plan.loops.iter().flat_map(|l| &l.segments).any(|s| s.distance(middle) < 1e-9));
}

#[test]
fn plans_are_the_same_every_time() {
    let region = region(&[&SQUARE, &[[23.0, 15.0, 1.0], [17.0, 15.0, 1.0]]]);
    assert_eq!(planned(&region, &job(4.0)), planned(&region, &job(4.0)));
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let region = region(&[&SQUARE]);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(planned(&region, &job(bad)), Err(PlanError::Job { what: "tool diameter", .. })));
        let job = PocketJob { stepdown: bad, ..job(6.0) };
        assert!(matches!(planned(&region, &job), Err(PlanError::Job { what: "stepdown", .. })));
    }
    let tiny = PocketJob { stepover: 1e-9, ..job(6.0) };
    assert!(matches!(planned(&region, &tiny), Err(PlanError::Job { what: "stepover", .. })));
}

#[test]
fn clean_up_of_corners_is_entered_and_left_straight_on() {
    // The path to the middle hangs on a side that begins at one of the corners.
    let corners = [[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [75.0, 40.0, 0.0], [20.0, 50.0, 0.0], [0.0, 30.0, 0.0]];
    let plan = planned(&region(&[&corners]), &PocketJob { stepover: 9.8, ..job(10.0) }).unwrap();
    let at_corners: Vec<Point> = plan.cleanups.iter().filter(|c| c.kind == Uncut::Corner).map(|c| c.start).collect();
    assert_eq!(at_corners.len(), 5);
    let mut joints = 0;
    for l in &plan.loops {
        let next = l.segments.iter().cycle().skip(1);
        let near = |p: Point| at_corners.iter().any(|c| c.distance(p) < 4.0);
        for (before, after) in l.segments.iter().zip(next).filter(|(_, after)| near(after.start())) {
            joints += 1;
            assert!(before.end_tangent().dot(after.start_tangent()) > 1.0 - 1e-9, "{before:?} {after:?}");
        }
    }
    assert!(joints >= 5 * 6, "{joints}");
}

#[test]
fn a_group_starts_at_the_tip_of_a_long_clean_up_path_and_travels_it_once() {
    let wedge = region(&[&[[0.0, 0.0, 0.0], [140.0, 20.0, 0.0], [0.0, 40.0, 0.0]]]);
    for direction in [Direction::Climb, Direction::Conventional] {
        let job = PocketJob { stepover: 9.8, direction, ..job(10.0) };
        let plan = planned(&wedge, &job).unwrap();
        assert_sound(&wedge, &plan, &job);
        assert!(leaves_nothing(&wedge, &plan, 5.0));
        let link = &plan.links[0];
        assert_eq!((link.kind, link.segments[0].start()), (LinkKind::CleanUp, plan.groups[0].start));
        assert_eq!(link.segments.last().unwrap().end(), plan.loops[0].segments[0].start());
        let EntryKind::Helix { center, radius } = plan.groups[0].entry else { panic!("{:?}", plan.groups[0]) };
        let (out, along) = (center - plan.groups[0].start, link.segments[0].start_tangent());
        assert!((out.length() - radius).abs() < 1e-9 && out.dot(along).abs() < 1e-9, "the helix ends along the way");
        let way: f64 = link.segments.iter().map(Segment::length).sum();
        assert!(way > 5.0 && plan.cleanups.iter().any(|c| (c.length - way).abs() < 1e-9), "{way} {:?}", plan.cleanups);
    }
}

#[test]
fn loops_with_clean_up_are_closed() {
    let wedge = [[0.0, 0.0, 0.0], [90.0, 5.0, 0.0], [120.0, 50.0, 0.0], [40.0, 45.0, 0.6], [0.0, 40.0, 0.0]];
    for share in [0.6, 0.75, 0.9, 0.98] {
        for islands in [&[][..], &[[35.0, 22.0, 1.0], [25.0, 22.0, 1.0]][..]] {
            let loops: Vec<&[[f64; 3]]> = [&wedge[..], islands].into_iter().filter(|l| !l.is_empty()).collect();
            let (region, job) = (region(&loops), PocketJob { stepover: share * 6.0, ..job(6.0) });
            let plan = planned(&region, &job).unwrap();
            assert!(!plan.cleanups.is_empty() && leaves_nothing(&region, &plan, 3.0), "{share}");
            for l in &plan.loops {
                let next = l.segments.iter().cycle().skip(1);
                assert!(l.segments.iter().zip(next).all(|(a, b)| a.end() == b.start()), "{share}: {:?}", l.segments);
            }
        }
    }
}
