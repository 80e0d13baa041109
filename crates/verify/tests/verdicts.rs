//! Programs written by hand, right ones and wrong ones, and what the judge says of them.

mod common;

use common::{circle, program, rectangle, rectangle_with_boss, rectangular_loops};
use pocketry_geom::{Contour, Region};
use pocketry_verify::{PathControl, ProgramError, Report, VerifyOptions, verify};

const R: f64 = 3.0;

fn judge(region: &Region, text: &str) -> Report {
    verify(region, text, &VerifyOptions::new(R)).unwrap()
}

/// 40 × 20 mm with a tool of 6 mm: loops at 3, 5.7 and 8.4 mm.
fn right() -> String {
    program(&rectangular_loops(40.0, 20.0, &[3.0, 5.7, 8.4]))
}

/// 40 × 40 mm round a boss of radius 6 in the middle.
fn boss() -> (Region, Vec<String>) {
    let mut blocks = rectangular_loops(40.0, 40.0, &[3.0, 5.7, 8.4]);
    blocks.extend([9.0, 11.7, 14.4].map(|r| circle(20.0, 20.0, r)));
    (rectangle_with_boss(40.0, 40.0, 20.0, 20.0, 6.0), blocks)
}

#[track_caller]
fn refused(report: &Report, because: &str) {
    let complaints = report.complaints();
    assert!(complaints.iter().any(|c| c.contains(because)), "{because:?} is not among {complaints:?}");
    assert!(!report.is_proven());
}

#[test]
fn a_right_program_is_proven_with_its_figures() {
    let report = judge(&rectangle(40.0, 20.0), &right());
    assert_eq!(report.complaints(), Vec::<String>::new());
    assert_eq!((report.figures.retracts, report.figures.plunges, report.figures.arcs), (3, 3, 0));
    let loops: f64 = [3.0, 5.7, 8.4].iter().map(|d| 2.0 * (60.0 - 4.0 * d)).sum();
    assert!((report.figures.cut_length - loops - 3.0 * 5.0).abs() < 1e-9);
    assert_eq!(report.figures.lowest_z, -3.0);
    let corners = (4.0 - std::f64::consts::PI) * R * R;
    assert!((report.unreachable_area - corners).abs() < report.area_error.min(0.02), "{}", report.unreachable_area);
    assert_eq!(report.uncut_area, 0.0);
    assert!(report.gouge_depth() < 1e-5);
}

#[test]
fn a_right_program_round_a_boss_is_proven() {
    let (region, blocks) = boss();
    assert_eq!(judge(&region, &program(&blocks)).complaints(), Vec::<String>::new());
}

#[test]
fn a_gouge_of_a_hundredth_is_refused_where_it_is() {
    let text = program(&rectangular_loops(40.0, 20.0, &[2.99, 5.7, 8.4]));
    let report = judge(&rectangle(40.0, 20.0), &text);
    refused(&report, "mm into the wall");
    assert!((report.gouge_depth() - 0.01).abs() < 1e-5);
}

#[test]
fn a_gouge_into_a_boss_names_line_and_place() {
    let (region, mut blocks) = boss();
    blocks[6] = circle(20.05, 20.0, 9.0);
    let report = judge(&region, &program(&blocks));
    let gouge = report.gouge.unwrap();
    assert!((gouge.depth - 0.05).abs() < 1e-4, "{gouge:?}");
    assert!((gouge.at.x - 11.05).abs() < 0.05 && (gouge.at.y - 20.0).abs() < 0.5, "{gouge:?}");
    refused(&report, &format!("line {}", gouge.line));
}

#[test]
fn a_missing_loop_leaves_the_area_between_its_neighbours() {
    // Loops at 3 and 9.9 leave what lies between the outer loop's inner edge, 28 × 8, and the inner one's outer edge.
    let report = judge(&rectangle(40.0, 20.0), &program(&rectangular_loops(40.0, 20.0, &[3.0, 9.9])));
    refused(&report, "left uncut");
    let (c, r) = (report.budget.cover, R + report.budget.cover);
    let inner = 20.2 * 0.2 + 2.0 * 20.4 * r + std::f64::consts::PI * r * r;
    let expected = (28.0 - 2.0 * c) * (8.0 - 2.0 * c) - inner;
    assert!((report.uncut_area - expected).abs() < 1e-3, "{} {expected}", report.uncut_area);
}

#[test]
fn the_area_of_a_missed_middle_is_exact() {
    // One loop at 3 mm in 40 × 20: the middle 28 × 8 stays.
    let report = judge(&rectangle(40.0, 20.0), &program(&rectangular_loops(40.0, 20.0, &[3.0])));
    let c = report.budget.cover;
    assert!((report.uncut_area - (28.0 - 2.0 * c) * (8.0 - 2.0 * c)).abs() < 1e-3, "{}", report.uncut_area);
    assert_eq!(report.uncut_spots.len(), 1);
    assert!((report.uncut_spots[0].radius - 4.0).abs() < 0.01);
}

#[test]
fn a_pocket_left_out_is_uncut_as_a_whole() {
    let mut contours = rectangle(40.0, 20.0).contours().to_vec();
    contours.push(Contour::from_vertices(&[[50.0, 0.0, 0.0], [60.0, 0.0, 0.0], [60.0, 10.0, 0.0], [50.0, 10.0, 0.0]]));
    let region = Region::from_parts_unchecked(contours, vec![None, None]);
    let report = judge(&region, &right());
    refused(&report, "left uncut");
    let expected = 100.0 - (4.0 - std::f64::consts::PI) * R * R;
    assert!((report.uncut_area - expected).abs() < 0.1, "{}", report.uncut_area);
}

#[test]
fn a_program_without_cutting_is_refused() {
    let report = judge(&rectangle(40.0, 20.0), &program(&[]));
    refused(&report, "left uncut");
    assert!((report.uncut_area - report.reachable_area).abs() < 0.5);
}

#[test]
fn a_tool_that_fits_nowhere_has_nothing_to_cut() {
    let report = judge(&rectangle(40.0, 5.0), &program(&[]));
    assert_eq!((report.reachable_area, report.unreachable_area), (0.0, 200.0));
    assert!(report.notes().iter().any(|n| n.contains("fits nowhere")));
}

#[test]
fn a_channel_exactly_as_wide_as_the_tool_may_be_cut_or_not() {
    let region = rectangle(40.0, 6.0);
    let cut = program(&["G0 X3 Y3\nG1 Z-3 F200\nX37".into()]);
    assert_eq!(judge(&region, &cut).complaints(), Vec::<String>::new());
    assert_eq!(judge(&region, &program(&[])).complaints(), Vec::<String>::new());
}

#[test]
fn a_rapid_through_the_stock_is_refused() {
    let text = right().replacen("X37.0000 F600", "G0 X37.0000\nG1 F600", 1);
    refused(&judge(&rectangle(40.0, 20.0), &text), "rapid move(s) below");
    let text = right().replacen("G1 Z-3 F200", "G0 Z-3", 1);
    refused(&judge(&rectangle(40.0, 20.0), &text.replace("X37.0000 F600", "G1 X37.0000 F600")), "rapid move(s) below");
}

#[test]
fn moving_across_before_the_first_retract_is_refused() {
    let text = right().replacen("G0 Z10\n", "", 1);
    refused(&judge(&rectangle(40.0, 20.0), &text), "before the program has set a height");
}

#[test]
fn an_arc_about_a_wrong_centre_is_refused() {
    let (region, mut blocks) = boss();
    blocks[6] = blocks[6].replace("I-9.0000 J0", "I-8.9 J0.2");
    refused(&judge(&region, &program(&blocks)), "mm into the wall");
}

#[test]
fn an_arc_whose_radii_differ_is_an_error() {
    let text = program(&["G0 X10 Y10\nG1 Z-1 F100\nG2 X12 Y10 I0.9 J0".into()]);
    let error = verify(&rectangle(40.0, 20.0), &text, &VerifyOptions::new(R)).unwrap_err();
    assert!(matches!(error, ProgramError::Arc { line: 8, .. }), "{error}");
}

#[test]
fn wrong_units_are_refused() {
    refused(&judge(&rectangle(40.0, 20.0), &right().replace("G21", "G20")), "leaves the region");
}

#[test]
fn inches_mean_inches() {
    let inches = |blocks: &[String]| {
        let scale = |word: &str| match word.split_at(1) {
            (axis @ ("X" | "Y"), number) => format!("{axis}{:.7}", number.parse::<f64>().unwrap() / 25.4),
            _ => word.to_string(),
        };
        let line = |l: &str| l.split(' ').map(scale).collect::<Vec<_>>().join(" ");
        blocks.iter().map(|b| b.lines().map(line).collect::<Vec<_>>().join("\n")).collect::<Vec<_>>()
    };
    let text = program(&inches(&rectangular_loops(40.0, 20.0, &[3.0, 5.7, 8.4])));
    let text = text.replace("G21", "G20").replace("Z-3", "Z-0.1");
    assert_eq!(judge(&rectangle(40.0, 20.0), &text).complaints(), Vec::<String>::new());
}

#[test]
fn relative_coordinates_mean_the_same() {
    let text = program(&[
        "G0 X3 Y3\nG1 Z-3 F100\nG91 X34\nY14\nX-34\nY-14\nX2.7 Y2.7\nX28.6\nY8.6\nX-28.6\nY-8.6\nX2.7 Y2.7\nX23.2\nY3.2\nX-23.2\nY-3.2\nG90".into(),
    ]);
    assert_eq!(judge(&rectangle(40.0, 20.0), &text).complaints(), Vec::<String>::new());
}

#[test]
fn corners_cut_by_the_control_count() {
    let region = rectangle(40.0, 20.0);
    let with = |control: &str| judge(&region, &right().replace("G61", control));
    assert!(with("G64 P0.0005").is_proven());
    refused(&with("G64 P0.01"), "mm into the wall");
    refused(&with("G64 P0.01"), "left uncut");
    refused(&with("G64"), "round corners");
    refused(&with(""), "round corners");
    let options = VerifyOptions { path_control: PathControl::Exact, ..VerifyOptions::new(R) };
    assert!(verify(&region, &right().replace("G61", ""), &options).unwrap().is_proven());
}

#[test]
fn a_cut_corner_leaves_material() {
    // The outer loop turns its first corner by a line that cuts 0.1 mm off it.
    let text = right().replacen("X37.0000 F600\nY17.0000", "X36.9 F600\nX37 Y3.1\nY17.0000", 1);
    let report = judge(&rectangle(40.0, 20.0), &text);
    refused(&report, "left uncut");
    let spot = report.uncut_spots[0];
    assert!((spot.at.x - 39.0).abs() < 1.5 && (spot.at.y - 1.0).abs() < 1.5, "{spot:?}");
}

#[test]
fn stock_to_leave_is_kept_and_no_more() {
    let region = rectangle(40.0, 20.0);
    let options = VerifyOptions { stock_to_leave: 0.2, ..VerifyOptions::new(R) };
    let loops = program(&rectangular_loops(40.0, 20.0, &[3.2, 5.9, 8.6]));
    let report = verify(&region, &loops, &options).unwrap();
    assert_eq!(report.complaints(), Vec::<String>::new());
    let gouge = verify(&region, &right(), &options).unwrap();
    assert!((gouge.gouge_depth() - 0.2).abs() < 1e-5);
    refused(&verify(&region, &loops, &VerifyOptions::new(R)).unwrap(), "left uncut");
}

#[test]
fn the_floor_is_held_to_the_depth() {
    let region = rectangle(40.0, 20.0);
    let at = |depth| verify(&region, &right(), &VerifyOptions { depth: Some(depth), ..VerifyOptions::new(R) }).unwrap();
    assert!(at(3.0).is_proven());
    refused(&at(4.0), "only, the floor is at");
    refused(&at(2.0), "below the floor");
}

#[test]
fn only_the_last_depth_counts_as_cut() {
    let text = right().replacen("Z-3", "Z-2", 1);
    refused(&judge(&rectangle(40.0, 20.0), &text), "left uncut");
}

#[test]
fn a_path_outside_the_region_is_told_with_its_length() {
    let mut blocks = rectangular_loops(40.0, 20.0, &[3.0, 5.7, 8.4]);
    blocks.push("G0 X20 Y10\nG1 Z-3 F100\nY25".into());
    let report = judge(&rectangle(40.0, 20.0), &program(&blocks));
    refused(&report, "leaves the region");
    assert!((report.outside - 5.0).abs() < 1e-9);
}

#[test]
fn a_path_wholly_outside_is_noticed_without_touching_a_wall() {
    let mut blocks = rectangular_loops(40.0, 20.0, &[3.0, 5.7, 8.4]);
    blocks.push("G0 X60 Y10\nG1 Z-3 F100\nY15".into());
    let report = judge(&rectangle(40.0, 20.0), &program(&blocks));
    assert_eq!(report.gouge.map_or(0.0, |g| g.depth.floor()), 0.0);
    refused(&report, "leaves the region");
}

#[test]
fn unknown_codes_name_their_line() {
    for code in ["G41 D1", "G2.1 X1", "G81 Z-3 R2", "G10 L2", "G53 G0 Z0", "G18", "G28", "G92 X0", "M98 P1", "A3"] {
        let text = program(&[code.into()]);
        let error = verify(&rectangle(40.0, 20.0), &text, &VerifyOptions::new(R)).unwrap_err();
        assert!(error.to_string().starts_with("line 6:"), "{code}: {error}");
    }
}

/// A square pocket from the origin with a spike of this width downwards from the middle of its lower wall.
fn spiked(width: f64) -> Region {
    let (from, to) = (10.0 - 0.5 * width, 10.0 + 0.5 * width);
    let vertices = [[0.0, 0.0], [from, 0.0], [10.0, -15.0], [to, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
    let contour = Contour::from_vertices(&vertices.map(|[x, y]| [x, y, 0.0]));
    Region::from_parts_unchecked(vec![contour], vec![None])
}

/// A square pocket with a round island of radius 4 that touches its lower wall in the middle.
fn touched() -> Region {
    let mut contours = rectangle(30.0, 30.0).contours().to_vec();
    contours.push(Contour::from_vertices(&[[15.0, 0.0, -1.0], [15.0, 8.0, -1.0]]));
    Region::from_parts_unchecked(contours, vec![None, Some(0)])
}

/// Along the walls from one side of the touch to the other and back about the island (7 from its centre), then an arc
/// at 12 from it, then strokes over the rest.
fn touched_program() -> Vec<String> {
    // The centre that touches both the lower wall and the island lies 3 above the wall and 7 from the island's centre.
    let foot = 48.0_f64.sqrt();
    let far = 143.0_f64.sqrt();
    let mut blocks = vec![
        format!("G0 X{:.4} Y3\nG0 Z2\nG1 Z-3 F200\nX27 F600\nY27\nX3\nY3\nX{:.4}", 15.0 + foot, 15.0 - foot),
        format!("G2 X{:.4} Y3 I{foot:.4} J1\nG0 Z10", 15.0 + foot),
        format!("G0 X{:.4} Y3\nG0 Z2\nG1 Z-3 F200\nG2 X{:.4} Y3 I{far:.4} J1\nG0 Z10", 15.0 - far, 15.0 + far),
    ];
    for x in [3.0, 6.0, 10.0, 14.0, 18.0, 22.0, 27.0] {
        blocks.push(format!("G0 X{x} Y14\nG0 Z2\nG1 Z-3 F200\nY27 F600\nG0 Z10"));
    }
    blocks
}

#[test]
fn a_spike_that_closes_within_the_rounding_has_no_centres_behind_its_sides() {
    // Next to the tip the parallel of either side comes out behind the other and keeps its distance from both.
    for width in [1e-3, 2e-6, 2e-7, 2e-8, 2e-9, 2e-11] {
        let text = program(&rectangular_loops(20.0, 20.0, &[3.0, 5.5, 8.0]));
        let report = judge(&spiked(width), &text);
        assert_eq!(report.complaints(), Vec::<String>::new(), "spike {width} wide");
        assert!((report.reachable_area - 400.0 + (4.0 - std::f64::consts::PI) * R * R).abs() < report.area_error);
        for (wrong, because) in [(vec![3.0, 9.5], "left uncut"), (vec![3.05, 5.5, 8.0], "left uncut")] {
            refused(&judge(&spiked(width), &program(&rectangular_loops(20.0, 20.0, &wrong))), because);
        }
    }
}

#[test]
fn an_island_that_touches_the_wall_has_no_centres_behind_the_wall() {
    let region = touched();
    assert_eq!(judge(&region, &program(&touched_program())).complaints(), Vec::<String>::new());
    let mut without_arc = touched_program();
    without_arc.remove(2);
    refused(&judge(&region, &program(&without_arc)), "left uncut");
    let last = touched_program()[0].rsplit('\n').next().unwrap().to_owned();
    let (too_far, too_high) = (format!("X8.1218\n{last}"), format!("Y3.05\n{last}\nY3"));
    for (instead, because) in [(too_far, "into the wall"), (too_high, "left uncut")] {
        let mut blocks = touched_program();
        blocks[0] = blocks[0].replace(&format!("Y3\n{last}"), &format!("Y3\n{instead}"));
        refused(&judge(&region, &program(&blocks)), because);
    }
}

#[test]
fn what_is_left_round_a_swept_middle_is_told_without_its_hole() {
    let report = judge(&rectangle(40.0, 40.0), &program(&rectangular_loops(40.0, 40.0, &[3.0, 17.0, 19.0])));
    refused(&report, "left uncut in 1 place(s)");
    assert!(report.uncut_spots.iter().all(|s| s.area >= 0.0));
    let (c, r) = (report.budget.cover, R + report.budget.cover);
    let expected = (28.0 - 2.0 * c).powi(2) - 36.0 - 24.0 * r - std::f64::consts::PI * r * r;
    assert!((report.uncut_area - expected).abs() < 1e-3, "{} {expected}", report.uncut_area);
}

#[test]
fn what_can_not_be_reached_is_measured_in_spite_of_gaps_in_the_outline() {
    // Short pieces of the outline are lost at grazing angles: each gap closed for itself left out what lay between them all.
    let bay = |t: f64| 1.0 - 0.55 * (-((t - 1.5) / 0.25).powi(2)).exp();
    let ripple = |t: f64| 1.0 + 0.02 * (31.0 * t).sin() + 0.008 * (97.0 * t).cos() + 0.1 * (3.0 * t).sin();
    let at = |k: i32| {
        let t = std::f64::consts::TAU * f64::from(k) / 1500.0;
        let r = 80.0 * bay(t) * ripple(t);
        [r * t.cos(), r * t.sin(), 0.0]
    };
    let corners: Vec<[f64; 3]> = (0..1500).map(at).collect();
    let cavity = Region::from_parts_unchecked(vec![Contour::from_vertices(&corners)], vec![None]);
    let report = verify(&cavity, &right(), &VerifyOptions::new(10.0)).unwrap();
    assert!(report.area_error < 0.001 * report.region_area, "{}", report.area_error);
    assert!((0.01..0.03).contains(&(report.unreachable_area / report.region_area)), "{}", report.unreachable_area);
}
