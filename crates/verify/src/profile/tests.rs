use super::*;
use pocketry_geom::{Contour, Point, ToolShape, point};
use std::fmt::Write;

fn contour(points: &[(f64, f64)]) -> Contour {
    Contour::from_vertices(&points.iter().map(|&(x, y)| [x, y, 0.0]).collect::<Vec<_>>())
}

fn block(x0: f64, y0: f64, x1: f64, y1: f64) -> Contour {
    contour(&[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
}

fn region(contours: Vec<Contour>) -> Region {
    let parents = (0..contours.len()).map(|k| (k > 0).then_some(0)).collect();
    Region::from_parts_unchecked(contours, parents)
}

fn tool(word: &str) -> Contour {
    word.parse::<ToolShape>().unwrap().section(1.0).contour().clone()
}

/// A program that cuts along these closed loops.
fn program(loops: &[Vec<(f64, f64)>]) -> String {
    let mut text = "G21 G90 G17 G61\nM3 S1000\nG0 Z5\n".to_owned();
    for points in loops {
        let (x, y) = points[0];
        let _ = writeln!(text, "G0 X{x:.4} Y{y:.4}\nG1 Z-1 F100");
        for (x, y) in points[1..].iter().chain(&points[..1]) {
            let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} F100");
        }
        text += "G0 Z5\n";
    }
    text + "M2\n"
}

fn judge(region: &Region, tool: &Contour, loops: &[Vec<(f64, f64)>]) -> Report {
    verify_profile(region, &program(loops), tool, &VerifyOptions::new(0.0)).unwrap()
}

fn square(half: f64) -> Vec<(f64, f64)> {
    vec![(-half, -half), (half, -half), (half, half), (-half, half)]
}

#[test]
fn a_rectangle_is_cut_by_a_rectangle_into_its_corners() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0)]);
    let report = judge(&pocket, &tool("rect:12x4"), &[square(4.0)]);
    assert!(report.is_proven(), "{:?}", report.complaints());
    assert!(report.gouge_depth() <= report.budget.gouge);
}

#[test]
fn a_path_too_far_out_gouges_and_one_too_far_in_leaves_material() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0)]);
    let rect = tool("rect:12x4");
    let out = judge(&pocket, &rect, &[square(4.003)]);
    assert!(out.gouge_depth() > out.budget.gouge, "{:?}", out.gouge);
    let inside = judge(&pocket, &rect, &[square(3.996)]);
    assert!(!inside.covered && inside.gouge_depth() <= inside.budget.gouge, "{:?}", inside.complaints());
    let at = inside.uncut_spots[0].at;
    assert!(at.x.abs().max(at.y.abs()) > 3.9);
}

#[test]
fn deep_gouges_are_measured() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0)]);
    let report = judge(&pocket, &tool("rect:12x4"), &[square(4.5)]);
    assert!((report.gouge_depth() - 0.5).abs() < 0.1, "{:?}", report.gouge);
}

#[test]
fn the_middle_left_standing_is_found() {
    let pocket = region(vec![block(-20.0, -20.0, 20.0, 20.0)]);
    // 12 x 4: along the sides y = ±18 it cuts bands of 4, along x = ±14 bands of 12.
    let outer = vec![(-14.0, -18.0), (14.0, -18.0), (14.0, 18.0), (-14.0, 18.0)];
    let report = judge(&pocket, &tool("rect:12x4"), std::slice::from_ref(&outer));
    assert!(!report.covered && report.gouge_depth() <= report.budget.gouge);
    let at = report.uncut_spots[0].at;
    assert!(at.x.abs() <= 8.0 && at.y.abs() <= 16.0, "{at:?}");
    let mut loops = vec![outer];
    loops.extend((1..9).map(|k| {
        let (x, y) = (6.0, 18.0 - 2.0 * f64::from(k));
        vec![(-x, -y), (x, -y), (x, y), (-x, y)]
    }));
    let report = judge(&pocket, &tool("rect:12x4"), &loops);
    assert!(report.is_proven(), "{:?}", report.complaints());
}

#[test]
fn islands_swept_over_as_a_whole_are_found() {
    let island = block(-0.1, 3.9, 0.1, 4.1).reversed();
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0), island]);
    let report = judge(&pocket, &tool("rect:12x4"), &[square(4.0)]);
    assert!(report.gouge_depth() > 1.0, "{:?}", report.gouge);
}

#[test]
fn a_round_profile_is_judged_like_a_round_tool() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0), block(-1.0, -1.0, 1.0, 1.0).reversed()]);
    let loops = [square(1.0).iter().map(|&(x, y)| (x * 7.0, y * 3.0)).collect::<Vec<_>>(), square(3.9)];
    for (k, loops) in [&loops[..1], &loops[..]].into_iter().enumerate() {
        let text = program(loops);
        let as_round = crate::verify(&pocket, &text, &VerifyOptions::new(3.0)).unwrap();
        let as_profile = judge(&pocket, &tool("circle:6"), loops);
        let gouges = |r: &Report| r.gouge_depth() > r.budget.gouge;
        assert_eq!(gouges(&as_round), gouges(&as_profile), "{k}");
        assert!((as_round.gouge_depth() - as_profile.gouge_depth()).abs() < 0.02 || k == 0);
    }
}

#[test]
fn cutting_air_beside_the_region_is_no_pocket() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0)]);
    let away: Vec<_> = square(4.0).into_iter().map(|(x, y)| (x + 50.0, y)).collect();
    let report = judge(&pocket, &tool("rect:12x4"), &[away]);
    assert!(report.outside_line.is_some() && !report.covered);
}

#[test]
fn the_outline_of_a_sum_bounds_all_sums() {
    let arc = |x: f64, y: f64, u: f64, v: f64, bulge: f64| Segment::from_bulge(point(x, y), point(u, v), bulge);
    let pairs = [
        (arc(0.0, 0.0, 4.0, 0.0, 0.6), arc(1.0, 0.0, 0.0, 2.0, 0.9)),
        (arc(0.0, 0.0, 4.0, 1.0, -0.6), arc(1.0, 0.0, 0.0, 2.0, 0.9)),
        (arc(0.0, 0.0, 4.0, 1.0, 0.0), arc(1.0, 0.0, 0.0, 2.0, 1.0)),
        (arc(0.0, 0.0, 4.0, 1.0, 0.0), arc(1.0, 0.0, 0.0, 2.0, 0.0)),
    ];
    for (a, b) in pairs {
        let mut outline = Vec::new();
        outline.extend([a.translated(b.start().to_vec()), a.translated(b.end().to_vec())]);
        outline.extend([b.translated(a.start().to_vec()), b.translated(a.end().to_vec())]);
        sum::envelopes(&a, &b, &mut outline);
        // From outside, a ray towards the middle meets the outline no later than any sum.
        let middle = a.at(0.5) + b.at(0.5).to_vec();
        let sums: Vec<Point> = (0..=200)
            .flat_map(|i| (0..=200).map(move |j| a.at(f64::from(i) / 200.0) + b.at(f64::from(j) / 200.0).to_vec()))
            .collect();
        for k in 0..64 {
            let d = pocketry_geom::Vec2::from_angle(f64::from(k) * 0.1);
            let farthest = sums.iter().map(|p| (*p - middle).dot(d)).fold(f64::NEG_INFINITY, f64::max);
            let reached = outline.iter().flat_map(|s| (0..=400).map(|t| s.at(f64::from(t) / 400.0)));
            let outermost = reached.map(|p| (p - middle).dot(d)).fold(f64::NEG_INFINITY, f64::max);
            assert!((outermost - farthest).abs() < 1e-3, "{k}: {outermost} {farthest}");
        }
    }
}

#[test]
fn a_shrunk_outline_stays_within_the_depth() {
    for word in ["rect:12x4", "rounded:12x4r1", "polygon:3x10", "ellipse:12x4", "circle:6"] {
        let shape = Shape::new(&tool(word));
        let smaller = shape.shrunk(0.1);
        for (k, s) in smaller.iter().enumerate() {
            for t in 0..=10 {
                let depth = shape.depth(s.at(f64::from(t) / 10.0));
                assert!(depth > 0.0 && depth <= 0.1 + 1e-12, "{word} {k}: {depth}");
            }
        }
    }
}

/// A program for an 8 x 3 rectangle that turns with the walls of a rectangle of half sides `x` and `y`, in rounds so far from them.
fn rounds(x: f64, y: f64, distances: &[f64]) -> String {
    let mut text = "G21 G90 G17 G61\nM3 S1000\nG0 Z5\n".to_owned();
    let mut turns = 0.0;
    for d in distances {
        let (u, v) = (x - d, y - d);
        let free = *d > 4.3;
        // Where it cannot turn, it keeps half its length from the next wall.
        let (a, b) = if free { (u, v) } else { (x - 4.0, y - 4.0) };
        let sides = [[-a, -v, a, -v], [u, -b, u, b], [a, v, -a, v], [-u, b, -u, -b]];
        for (k, [x0, y0, x1, y1]) in sides.into_iter().enumerate() {
            let c = turns + 90.0 * k as f64;
            if free && k > 0 {
                let _ = writeln!(text, "G1 C{c}");
            } else {
                let _ = writeln!(text, "G0 Z5\nG0 X{x0} Y{y0} C{c}\nG1 Z-1 F100");
            }
            let _ = writeln!(text, "G1 X{x1} Y{y1}");
        }
        turns += 360.0;
        text += "G0 Z5\n";
    }
    text + "M2\n"
}

fn turning(region: &Region, text: &str) -> Report {
    verify_turning(region, text, &tool("rect:8x3"), &VerifyOptions::new(0.0)).unwrap()
}

const DISTANCES: [f64; 9] = [1.5, 2.8, 4.2, 4.4, 5.7, 7.0, 8.3, 9.6, 10.9];

#[test]
fn a_profile_that_turns_with_the_walls_is_proven() {
    let pocket = region(vec![block(-20.0, -12.0, 20.0, 12.0)]);
    let report = turning(&pocket, &rounds(20.0, 12.0, &DISTANCES));
    assert!(report.is_proven(), "{:?} {:?}", report.complaints(), report.uncut_spots);
    // A full turn more changes nothing; askew it gouges, and so it does where it turns too near a wall.
    let text = rounds(20.0, 12.0, &DISTANCES);
    assert!(turning(&pocket, &text.replace("C0\n", "C360\n")).is_proven());
    let askew = turning(&pocket, &text.replace("C0\n", "C0.1\n"));
    assert!(askew.gouge_depth() > askew.budget.gouge, "{:?}", askew.gouge);
    let early = turning(&pocket, &rounds(20.0, 12.0, &[1.5, 2.8, 4.2, 4.301, 5.7, 7.0, 8.3, 9.6, 10.9]));
    assert!(early.is_proven(), "{:?} {:?}", early.complaints(), early.uncut_spots);
}

#[test]
fn turning_on_the_spot_too_near_a_wall_gouges() {
    let pocket = region(vec![block(-20.0, -12.0, 20.0, 12.0)]);
    let at = |y: f64| format!("G21 G90 G17 G61\nM3 S1000\nG0 Z5\nG0 X0 Y{y} C0\nG1 Z-1 F100\nG1 C180\nG0 Z5\nM2\n");
    let reach = 4.0_f64.hypot(1.5);
    let free = turning(&pocket, &at(reach - 12.0));
    assert!(free.gouge_depth() <= free.budget.gouge, "{:?}", free.gouge);
    let near = turning(&pocket, &at(reach - 12.01));
    assert!(near.gouge_depth() > near.budget.gouge && near.gouge_depth() < 0.02, "{:?}", near.gouge);
}

#[test]
fn along_an_arc_its_corners_reach_farther_out_than_its_middle() {
    let (wall, tool_reach) = (20.0, (4.0_f64, 1.5_f64));
    let round = region(vec![Contour::from_vertices(&[[-wall, 0.0, 1.0], [wall, 0.0, 1.0]])]);
    let radius = (wall * wall - tool_reach.0 * tool_reach.0).sqrt() - tool_reach.1;
    let around = |r: f64, c: f64| {
        format!(
            "G21 G90 G17 G61\nM3 S1000\nG0 Z5\nG0 X{r} Y0 C90\nG1 Z-1 F100\nG3 X-{r} Y0 I-{r} J0 C{}\nX{r} Y0 I{r} J0 C{}\nG0 Z5\nM2\n",
            90.0 + c,
            90.0 + 2.0 * c
        )
    };
    let fits = turning(&round, &around(radius, 180.0));
    assert!(fits.gouge_depth() <= fits.budget.gouge, "{:?}", fits.gouge);
    let enters = turning(&round, &around(radius + 0.01, 180.0));
    assert!(enters.gouge_depth() > enters.budget.gouge && enters.gouge_depth() < 0.03, "{:?}", enters.gouge);
    // An axis that does not follow the arc sweeps more.
    let stays = turning(&round, &around(radius, 0.0));
    assert!(stays.gouge_depth() > 1.0, "{:?}", stays.gouge);
    let runs_off = turning(&round, &around(radius, 150.0));
    assert!(runs_off.gouge_depth() > runs_off.budget.gouge, "{:?}", runs_off.gouge);
}

#[test]
fn what_a_turning_profile_leaves_is_found() {
    let pocket = region(vec![block(-20.0, -12.0, 20.0, 12.0)]);
    let no_wall = turning(&pocket, &rounds(20.0, 12.0, &DISTANCES[1..]));
    assert!(!no_wall.covered && no_wall.gouge_depth() <= no_wall.budget.gouge, "{:?}", no_wall.complaints());
    let no_middle = turning(&pocket, &rounds(20.0, 12.0, &DISTANCES[..6]));
    assert!(!no_middle.covered);
    let short = rounds(20.0, 12.0, &DISTANCES).replacen("X16 Y-10.5", "X15.9 Y-10.5", 1);
    assert!(!turning(&pocket, &short).covered);
}

#[test]
fn a_tool_that_keeps_its_direction_has_no_c() {
    let pocket = region(vec![block(-20.0, -12.0, 20.0, 12.0)]);
    let text = rounds(20.0, 12.0, &DISTANCES);
    let error = verify_profile(&pocket, &text, &tool("rect:8x3"), &VerifyOptions::new(0.0)).unwrap_err();
    assert!(matches!(error, ProgramError::Turns { line: 9 }), "{error}");
    let unset = text.replace(" C0\n", "\n");
    let error = verify_turning(&pocket, &unset, &tool("rect:8x3"), &VerifyOptions::new(0.0)).unwrap_err();
    assert!(matches!(error, ProgramError::UnknownStart { .. }), "{error}");
}

#[test]
fn what_is_out_of_reach_is_measured() {
    let pocket = region(vec![block(-10.0, -6.0, 10.0, 6.0)]);
    let exact = judge(&pocket, &tool("rect:12x4"), &[square(4.0)]);
    assert!(exact.unreachable_area < 0.1 && exact.area_error < 40.0, "{exact:?}");
    let round = judge(
        &pocket,
        &tool("circle:4"),
        &[
            vec![(-8.0, -4.0), (8.0, -4.0), (8.0, 4.0), (-8.0, 4.0)],
            vec![(-6.0, 2.0), (6.0, 2.0), (6.0, -2.0), (-6.0, -2.0)],
            vec![(-4.0, 0.0), (4.0, 0.0)],
        ],
    );
    assert!(round.is_proven(), "{:?} {:?}", round.complaints(), round.uncut_spots);
    let corners = (4.0 - std::f64::consts::PI) * 4.0;
    assert!((round.unreachable_area - corners).abs() < 0.5, "{}", round.unreachable_area);
    assert!(round.area_error < 40.0, "{}", round.area_error);
}
