use super::*;
use crate::plan::LinkKind;
use crate::plan::testing::{block, region, tool};
use pocketry_geom::distance::Boundary;
use pocketry_geom::{Contour, Segment, Vec2, vec2};
use pocketry_motion::{FeedKind, Move, Stock};

fn disc(x: f64, y: f64, r: f64) -> [[f64; 3]; 2] {
    [[x - r, y, 1.0], [x + r, y, 1.0]]
}

fn job(profile: &ToolProfile, share: f64) -> PocketJob {
    let (_, radius) = inscribed_circle(profile).unwrap();
    let usual = PocketJob::for_diameter(2.0 * radius);
    PocketJob { stepover: share * radius, stock: Stock { top: 0.0, depth: 1.0 }, stepdown: 1.0, ..usual }
}

/// Paths at the floor.
fn floor(plan: &Plan) -> Vec<Segment> {
    let at_floor = plan.program.steps().filter(|(from, m)| from.z < -0.999 && m.to().z < -0.999);
    at_floor.map(|(from, m)| m.plan_view(from.xy())).filter(|s| s.start() != s.end()).collect()
}

/// Places of the tool along the path, at most `step` apart.
fn places(path: &[Segment], step: f64) -> Vec<Point> {
    let of = |s: &Segment| {
        let n = (s.length() / step).ceil() as u32 + 1;
        (0..=n).map(|k| s.at(f64::from(k) / f64::from(n))).collect::<Vec<_>>()
    };
    path.iter().flat_map(of).collect()
}

/// By brute force: how far the profile's outline leaves the region, and the points of a grid that some admissible place would cut and
/// the path does not.
fn judged(region: &Region, profile: &ToolProfile, plan: &Plan, grid: f64) -> (f64, Vec<Point>) {
    let walls = Boundary::new(region);
    let shape = Boundary::new(&Region::from_parts_unchecked(vec![profile.contour().clone()], vec![None]));
    let outline: Vec<Vec2> =
        profile.contour().segments.iter().flat_map(|s| (0..20).map(|k| s.at(f64::from(k) / 20.0).to_vec())).collect();
    let path = places(&floor(plan), 0.5 * grid);
    let outside = path.iter().flat_map(|p| outline.iter().map(|b| -walls.signed_distance(*p + *b))).fold(0.0, f64::max);
    let b = region.bbox();
    let grid_points = |margin: f64| {
        let (nx, ny) = ((b.width() / grid) as i32, (b.height() / grid) as i32);
        (0..=nx)
            .flat_map(move |i| (0..=ny).map(move |j| b.min + vec2(f64::from(i) + margin, f64::from(j) + margin) * grid))
            .collect::<Vec<_>>()
    };
    let admissible = |p: &Point| outline.iter().all(|b| walls.signed_distance(*p + *b) > 0.0);
    let good: Vec<Point> = grid_points(0.5).into_iter().filter(admissible).collect();
    let covers = |q: &Point, places: &[Point], margin: f64| {
        places.iter().any(|p| {
            (*q - *p).length() < profile.reach() + grid && shape.signed_distance((*q - *p).to_point()) > margin
        })
    };
    let uncut = grid_points(0.37).into_iter().filter(|q| covers(q, &good, 0.0) && !covers(q, &path, -0.6 * grid));
    (outside, uncut.collect())
}

fn check(region: &Region, word: &str, share: f64) -> Plan {
    let profile = tool(word);
    let job = job(&profile, share);
    let plan = plan_profile(region, &profile, &job).unwrap_or_else(|e| panic!("{word}: {e}"));
    assert_eq!(plan.program.check(&job.stock), Ok(()), "{word}");
    let (outside, uncut) = judged(region, &profile, &plan, 0.5);
    assert!(outside < 1e-4, "{word}: leaves the region by {outside}");
    assert!(uncut.is_empty(), "{word}: left uncut at {:?}", uncut[0]);
    plan
}

#[test]
fn nothing_is_left_and_no_wall_entered() {
    let plain = region(&[&block(10.0, 7.0)]);
    let island = region(&[&block(12.0, 10.0), &disc(1.0, 1.0, 2.0)]);
    let l = region(&[&[
        [0.0, 0.0, 0.0],
        [24.0, 0.0, 0.0],
        [24.0, 9.0, 0.0],
        [10.0, 9.0, 0.3],
        [10.0, 20.0, 0.0],
        [0.0, 20.0, 0.0],
    ]]);
    for word in ["rect:6x2", "rounded:6x3r1", "polygon:3x5", "ellipse:6x3", "circle:3", "rect:4x4@20"] {
        for r in [&plain, &island, &l] {
            check(r, word, 0.9);
        }
    }
    check(&plain, "rect:6x2", 1.0);
}

#[test]
fn profiles_that_are_not_convex_leave_nothing_either() {
    let notched =
        [[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 2.0, 0.0], [-2.0, 2.0, 0.0]];
    let profile = ToolProfile::new(Contour::from_vertices(&notched)).unwrap();
    let region = region(&[&block(10.0, 7.0)]);
    let plan = plan_profile(&region, &profile, &job(&profile, 0.9)).unwrap();
    let (outside, uncut) = judged(&region, &profile, &plan, 0.4);
    assert!(outside < 1e-4 && uncut.is_empty(), "{outside} {:?}", uncut.first());
}

#[test]
fn the_tool_lifts_only_where_the_tree_branches() {
    // Two chambers and a wide passage: the first loop is one, the inner ones are two.
    let chambers = region(&[&[
        [0.0, 0.0, 0.0],
        [14.0, 0.0, 0.0],
        [14.0, 4.0, 0.0],
        [20.0, 4.0, 0.0],
        [20.0, 0.0, 0.0],
        [34.0, 0.0, 0.0],
        [34.0, 14.0, 0.0],
        [20.0, 14.0, 0.0],
        [20.0, 10.0, 0.0],
        [14.0, 10.0, 0.0],
        [14.0, 14.0, 0.0],
        [0.0, 14.0, 0.0],
    ]]);
    let plan = check(&chambers, "rect:4x3", 0.9);
    assert_eq!(plan.groups.len(), 2);
    let plunges = plan.program.moves.iter().filter(|m| m.feed() == Some(FeedKind::Plunge)).count();
    assert_eq!(plunges, 2, "one descent a branch");
    let plain = check(&region(&[&block(10.0, 7.0)]), "rect:4x3", 0.9);
    assert_eq!(plain.groups.len(), 1);
    assert!(plain.links.iter().all(|l| l.kind == LinkKind::SideStep));
    assert!(plain.loops.len() > 2);
}

#[test]
fn loops_are_climbed_unless_asked_otherwise() {
    let plain = region(&[&block(10.0, 7.0)]);
    let profile = tool("rect:4x3");
    for (direction, sign) in
        [(pocketry_motion::Direction::Climb, 1.0), (pocketry_motion::Direction::Conventional, -1.0)]
    {
        let job = PocketJob { direction, ..job(&profile, 0.9) };
        let plan = plan_profile(&plain, &profile, &job).unwrap();
        let outermost = plan.loops.last().unwrap();
        assert!(sign * Contour::new(outermost.segments.clone()).area() > 0.0);
    }
}

#[test]
fn what_cannot_be_done_is_said() {
    let small = region(&[&block(3.0, 3.0)]);
    let profile = tool("rect:12x4");
    let error = plan_profile(&small, &profile, &job(&profile, 0.9)).unwrap_err();
    assert!(matches!(error, PlanError::ProfileDoesNotFit { .. }) && error.to_string().contains("12.000 x 4.000"));
    let plain = region(&[&block(20.0, 7.0)]);
    let wide = plan_profile(&plain, &profile, &job(&profile, 1.7)).unwrap();
    assert!(matches!(wide.warnings[..], [Warning::ProfileStepoverClamped { .. }, ..]));
    let leave = PocketJob { stock_to_leave: 0.1, ..job(&profile, 0.9) };
    assert!(matches!(plan_profile(&plain, &profile, &leave), Err(PlanError::Job { .. })));
}

#[test]
fn every_pass_goes_over_every_loop() {
    let plain = region(&[&block(10.0, 7.0)]);
    let profile = tool("rect:4x3");
    let one = job(&profile, 0.9);
    let three = PocketJob { stock: Stock { top: 0.0, depth: 3.0 }, ..one.clone() };
    let cuts = |job: &PocketJob| {
        let plan = plan_profile(&plain, &profile, job).unwrap();
        plan.program.moves.iter().filter(|m| matches!(m, Move::Line { feed: FeedKind::Cut, .. })).count()
    };
    assert_eq!(cuts(&three), 3 * cuts(&one));
}

/// Once a way across a wall: what came of one part hung on another, which none of a few points of its outline seemed to lie in.
#[test]
fn parts_hang_on_the_part_they_come_from() {
    let rings = |k: i32| {
        let x = 30.0 * f64::from(k);
        [[x, 0.0, 0.0], [x + 20.0, 0.0, 0.0], [x + 12.0, 24.0, 0.0], [x + 8.0, 24.0, 0.0]]
    };
    let all: Vec<[[f64; 3]; 4]> = (0..5).map(rings).collect();
    let region = region(&all.iter().map(|r| &r[..]).collect::<Vec<_>>());
    let profile = tool("rect:4x2");
    let plan = plan_profile(&region, &profile, &job(&profile, 0.9)).unwrap();
    let inside = |cut: &crate::plan::PlannedLoop| (cut.segments[0].start().x / 30.0).floor() as usize;
    for pocket in 0..5 {
        let groups: Vec<usize> = plan.loops.iter().filter(|l| inside(l) == pocket).map(|l| l.group).collect();
        assert!(groups.len() > 3 && groups.iter().all(|g| *g == groups[0]), "{pocket}: {groups:?}");
    }
    assert!(plan.links.iter().flat_map(|l| &l.segments).all(|s| s.length() < 4.0));
}

/// Area of the squares of a grid whose middles lie in the region and are covered nowhere on the path, mm².
fn left_standing(region: &Region, profile: &ToolProfile, path: &[Segment], grid: f64) -> f64 {
    let shape = Boundary::new(&Region::from_parts_unchecked(vec![profile.contour().clone()], vec![None]));
    let covers = |q: Point, way: &Segment| {
        let seen = Segment::line((q - way.start()).to_point(), (q - way.end()).to_point());
        shape.contains(seen.start()) || shape.distance_to(&seen) == 0.0
    };
    let b = region.bbox();
    let (columns, rows) = ((b.width() / grid) as u32, (b.height() / grid) as u32);
    let at = |i: u32, j: u32| b.min + vec2(f64::from(i) + 0.5, f64::from(j) + 0.5) * grid;
    let points = (0..columns).flat_map(|i| (0..rows).map(move |j| at(i, j)));
    let left = points.filter(|&q| region.contains(q) && !path.iter().any(|way| covers(q, way))).count();
    left as f64 * grid * grid
}

/// Figure 4 of the paper: a rectangle is cut as a whole by a rectangular tool, and but for its corners by a round one of the same width.
#[test]
fn figure_4_a_rectangular_tool_cuts_corners_that_a_round_one_leaves() {
    let rectangle = region(&[&block(30.0, 18.0)]);
    let left = |word: &str| {
        let profile = tool(word);
        let plan = plan_profile(&rectangle, &profile, &job(&profile, 0.9)).unwrap();
        left_standing(&rectangle, &profile, &floor(&plan), 0.2)
    };
    assert_eq!(left("rect:12x8"), 0.0);
    let corners = (4.0 - std::f64::consts::PI) * 16.0;
    assert!((left("circle:8") - corners).abs() < 0.05 * corners, "{} {corners}", left("circle:8"));
}
