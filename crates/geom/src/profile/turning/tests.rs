use super::*;
use crate::contour::Contour;
use crate::repair::{RepairOptions, build};
use crate::{Region, ToolShape};
use proptest::prelude::*;

fn region(loops: &[&[[f64; 3]]]) -> Region {
    let loops = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    build(loops, &RepairOptions::default()).unwrap().region
}

fn tool(word: &str) -> ToolProfile {
    word.parse::<ToolShape>().unwrap().section(1.0)
}

fn block(x: f64, y: f64) -> Contour {
    Contour::from_vertices(&[[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]])
}

fn courses(runs: &[Run]) -> Vec<Course> {
    runs.iter().flat_map(|r| r.courses.clone()).collect()
}

/// How deep walls come into the profile at a place, by samples of its outline and of the walls.
fn entered(walls: &Boundary, profile: &ToolProfile, at: Point, angle: f64) -> f64 {
    let placed = profile.rotated(angle);
    let outside = placed.contour().segments.iter().flat_map(|s| (0..40).map(|k| s.at(f64::from(k) / 40.0)));
    let outline = outside.map(|b| -walls.signed_distance(at + b.to_vec())).fold(f64::NEG_INFINITY, f64::max);
    let shape = Boundary::new(&Region::from_parts_unchecked(vec![placed.contour().clone()], vec![None]));
    let points = walls.segments().iter().flat_map(|s| (0..40).map(|k| s.at(f64::from(k) / 40.0)));
    let inside = points.map(|w| shape.signed_distance((w - at).to_point())).fold(f64::NEG_INFINITY, f64::max);
    outline.max(inside)
}

#[test]
fn along_a_straight_wall_it_ends_where_it_meets_the_next_one() {
    let pocket = region(&[&[[-20.0, -10.0, 0.0], [20.0, -10.0, 0.0], [20.0, 10.0, 0.0], [-20.0, 10.0, 0.0]]]);
    let walls = Boundary::new(&pocket);
    let turning = Turning::new(&walls, &tool("rect:12x4"), 0.0);
    assert_eq!(turning.touch_distance(), 2.0);
    let runs = turning.runs(&block(18.0, 8.0).segments);
    assert_eq!(runs.len(), 4, "there is no room to turn in a corner");
    let bottom = runs.iter().find(|r| r.courses[0].path.start().y == -8.0).unwrap();
    assert!((bottom.courses[0].path.start().x + 14.0).abs() < 1e-6);
    assert!((bottom.courses[0].path.end().x - 14.0).abs() < 1e-6);
    assert_eq!((bottom.courses[0].from, bottom.courses[0].to), (0.0, 0.0));
}

#[test]
fn it_turns_on_the_spot_where_there_is_room() {
    let pocket = region(&[&[[-20.0, -20.0, 0.0], [20.0, -20.0, 0.0], [20.0, 20.0, 0.0], [-20.0, 20.0, 0.0]]]);
    let walls = Boundary::new(&pocket);
    let runs = Turning::new(&walls, &tool("rect:12x4"), 0.0).runs(&block(12.0, 12.0).segments);
    assert!(runs.len() == 1 && runs[0].is_closed(), "{runs:?}");
    let all = courses(&runs);
    assert!(all.windows(2).all(|w| w[0].to == w[1].from), "no jumps: {all:?}");
    assert!((all[all.len() - 1].to - all[0].from - TAU).abs() < 1e-9);
}

#[test]
fn around_an_island_it_turns_as_the_arc_does() {
    let island = [[-5.0, 0.0, 1.0], [5.0, 0.0, 1.0]];
    let pocket = region(&[&[[-40.0, -40.0, 0.0], [40.0, -40.0, 0.0], [40.0, 40.0, 0.0], [-40.0, 40.0, 0.0]], &island]);
    let walls = Boundary::new(&pocket);
    let around = Contour::from_vertices(&[[-7.0, 0.0, -1.0], [7.0, 0.0, -1.0]]);
    let runs = Turning::new(&walls, &tool("rect:12x4"), 0.0).runs(&around.segments);
    assert!(runs.len() == 1 && runs[0].is_closed());
    let all = courses(&runs);
    assert!((all[all.len() - 1].to - all[0].from + TAU).abs() < 1e-9, "clockwise: {all:?}");
}

#[test]
fn within_a_round_wall_a_flat_side_fits_nowhere() {
    let pocket = region(&[&[[-20.0, 0.0, 1.0], [20.0, 0.0, 1.0]]]);
    let walls = Boundary::new(&pocket);
    let parallel = Contour::from_vertices(&[[-18.0, 0.0, 1.0], [18.0, 0.0, 1.0]]);
    assert!(Turning::new(&walls, &tool("rect:12x4"), 0.0).runs(&parallel.segments).is_empty());
    // Its corners lie on the wall where the middle of the flat side is √(20² − 6²) from the centre.
    let r = (20.0_f64 * 20.0 - 36.0).sqrt() - 2.0 - 1e-6;
    let inner = Contour::from_vertices(&[[-r, 0.0, 1.0], [r, 0.0, 1.0]]);
    assert_eq!(Turning::new(&walls, &tool("rect:12x4"), 0.0).runs(&inner.segments).len(), 1);
}

/// Once lost: places nearer to the next wall than the profile reaches towards its own.
#[test]
fn a_slender_profile_goes_farther_into_corners_than_an_offset_does() {
    let pocket = region(&[&[[-20.0, -10.0, 0.0], [20.0, -10.0, 0.0], [20.0, 10.0, 0.0], [-20.0, 10.0, 0.0]]]);
    let walls = Boundary::new(&pocket);
    let runs = Turning::new(&walls, &tool("rect:2x6"), 0.0).wall_runs(&pocket);
    assert_eq!(runs.len(), 4);
    let lengths: Vec<f64> = runs.iter().map(|r| r.courses.iter().map(|c| c.path.length()).sum()).collect();
    assert!(lengths.iter().all(|l| (l - 38.0).abs() < 1e-6 || (l - 18.0).abs() < 1e-6), "{lengths:?}");
}

proptest! {
    /// By brute force: what is kept enters no wall, and what is dropped does.
    #[test]
    fn runs_are_what_enters_no_wall(
        (x, y, r) in (-8.0..8.0_f64, -5.0..5.0_f64, 0.5..3.0_f64),
        bulge in -0.1..0.4_f64,
        kind in 0..4_usize,
    ) {
        let outer = [[-16.0, -12.0, bulge], [16.0, -12.0, 0.0], [16.0, 12.0, 0.0], [-16.0, 12.0, 0.0]];
        let pocket = region(&[&outer, &[[x - r, y, 1.0], [x + r, y, 1.0]]]);
        let walls = Boundary::new(&pocket);
        let profile = tool(["rect:8x3", "rounded:8x4r1", "polygon:3x6", "ellipse:8x3"][kind]);
        let turning = Turning::new(&walls, &profile, 0.0);
        // Any path will do, if not a parallel.
        let path = Contour::from_vertices(&[[-11.0, -8.0, 0.3], [11.0, -8.0, 0.0], [10.0, 8.0, -0.2], [-11.0, 8.0, 0.1]]);
        for segment in &path.segments {
            let whole = along(segment);
            let kept = turning.free(&whole);
            for k in 0..=60 {
                let t = (f64::from(k) + 0.31) / 61.0;
                let (at, angle) = (segment.at(t), whole.from + t * (whole.to - whole.from));
                let deep = entered(&walls, &profile, at, angle);
                let is_kept = kept.iter().any(|c| {
                    let length = c.path.length();
                    c.path.distance(at) < 1e-6 && length > 0.0
                });
                // Samples miss what is shallow.
                if is_kept {
                    prop_assert!(deep < 1e-6, "{segment:?} {t}: {deep}");
                } else {
                    prop_assert!(deep > -0.2, "{segment:?} {t}: {deep} {kept:?}");
                }
            }
        }
    }
}

/// The tip was passed over, and with it the way around: between tangents that come back the turn has either sign.
#[test]
fn it_goes_around_the_tip_where_two_tangent_walls_end() {
    let half = [[6.25, 50.0, -0.414_213_562], [50.0, 93.75, -1.0], [50.0, 50.0, 1.0], [50.0, 6.25, -0.414_213_562]];
    let pocket = region(&[&[[50.0, 100.0, 1.0], [50.0, 0.0, 1.0]], &half]);
    let walls = Boundary::new(&pocket);
    let runs = Turning::new(&walls, &tool("rect:6x3"), 1e-3).wall_runs(&pocket);
    let beside_the_tip = point(50.0 + 1.501, 6.25);
    assert!(is_visited(&runs, beside_the_tip, -0.5 * PI, 1e-6));
}

/// Whether some place of the runs is this one, within lengths and angles that samples resolve.
fn is_visited(runs: &[Run], at: Point, angle: f64, near: f64) -> bool {
    runs.iter().flat_map(|r| &r.courses).any(|c| {
        let places = (0..=16).map(|k| f64::from(k) / 16.0);
        let turned = |t: f64| ((angle - c.direction(t) + PI).rem_euclid(TAU) - PI).abs();
        c.path.distance(at) < near && places.map(turned).fold(f64::INFINITY, f64::min) < 0.1
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// By brute force: along walls the profile goes as near to them as it fits, and enters none; on the ways between runs neither.
    #[test]
    fn wall_runs_are_as_near_to_walls_as_it_fits(
        (x, y, r) in (-8.0..8.0_f64, -5.0..5.0_f64, 0.5..3.0_f64),
        (bulge, skew) in (-0.1..0.4_f64, -4.0..4.0_f64),
        kind in 0..4_usize,
    ) {
        let outer = [[-16.0, -12.0, bulge], [16.0, -12.0, 0.0], [16.0 + skew, 12.0, 0.0], [-16.0, 12.0 + skew, 0.0]];
        let pocket = region(&[&outer, &[[x - r, y, 1.0], [x + r, y, 1.0]]]);
        let walls = Boundary::new(&pocket);
        let profile = tool(["rect:8x3", "rounded:8x4r1", "polygon:3x6", "ellipse:8x3"][kind]);
        let turning = Turning::new(&walls, &profile, 1e-3);
        let runs = turning.wall_runs(&pocket);
        for course in runs.iter().flat_map(|r| &r.courses) {
            for t in [0.0, 0.37, 0.83] {
                let at = if course.path.length() > 0.0 { course.path.at(t) } else { course.path.start() };
                let deep = entered(&walls, &profile, at, course.direction(t));
                prop_assert!(deep < 1e-6, "{course:?} {t}: {deep}");
            }
        }
        for (wall, k) in pocket.segments().flat_map(|wall| (1..6).map(move |k| (wall, k))) {
            let share = f64::from(k) / 6.1;
            let angle = along(wall).direction(share);
            let away = Vec2::from_angle(angle).left();
            let heights = (0..60).map(|k| turning.touch_distance() + 0.05 * f64::from(k));
            let mut places = heights.map(|h| (h, wall.at(share) + away * h));
            let lowest = places.find(|&(h, at)| walls.distance(at) < h - 1e-3 || entered(&walls, &profile, at, angle) < -0.02);
            if let Some((h, at)) = lowest.filter(|&(h, at)| walls.distance(at) > h - 1e-3) {
                prop_assert!(is_visited(&runs, at, angle, 0.2), "{h} from {wall:?} at {at:?}, {angle}");
            }
        }
    }
}
