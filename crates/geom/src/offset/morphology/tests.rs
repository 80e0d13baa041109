//! Erosions against closed forms, the exact engine, an independent Minkowski sum, and brute force.

use super::*;
use crate::distance::Boundary;
use crate::offset::voronoi::VoronoiOffsetter;
use crate::offset::{OffsetOptions, morphology::eroded};
use crate::point::point;
use crate::profile::convex_sum;
use crate::repair::{RepairOptions, build};
use crate::segment::Arc;
use crate::skeleton::Skeleton;
use clipper2_rust::clipper::{difference_64, union_64, xor_64};
use clipper2_rust::core::{FillRule, Paths64, Point64, area};
use clipper2_rust::minkowski::minkowski_sum;
use pocketry_testkit::shapes;

type Loop = Vec<[f64; 3]>;

fn region(loops: &[Loop]) -> Region {
    build(loops.iter().map(|l| Contour::from_vertices(l)).collect(), &RepairOptions::default()).unwrap().region
}

fn block(width: f64, height: f64) -> Loop {
    let (x, y) = (0.5 * width, 0.5 * height);
    vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]]
}

fn profile(vertices: &[[f64; 3]]) -> Contour {
    Contour::from_vertices(vertices)
}

fn moved(of: Loop, [x, y]: [f64; 2]) -> Loop {
    of.into_iter().map(|v| [v[0] + x, v[1] + y, v[2]]).collect()
}

/// Regions with lines, arcs and islands, about the origin.
fn examples() -> Vec<Vec<Loop>> {
    let ring = vec![shapes::circle(20.0, [0.0; 2]), shapes::circle(6.0, [3.0, 1.0])];
    let plate = vec![
        shapes::rounded_rectangle(60.0, 40.0, 5.0),
        shapes::ngon(6, 5.0, [42.0, 14.0]),
        shapes::circle(4.0, [15.0, 22.0]),
    ];
    vec![
        ring,
        plate,
        vec![shapes::gear(9, 12.0, 20.0)],
        vec![shapes::comb(4, 12.0)],
        shapes::smooth_with_islands(300, true),
    ]
}

#[test]
fn a_rectangle_by_a_rectangle_is_a_rectangle() {
    let places = eroded(&region(&[block(40.0, 20.0)]), &profile(&block(12.0, 4.0)), Point::ORIGIN).unwrap();
    assert!((places.area() - 28.0 * 16.0).abs() < 1e-4, "{}", places.area());
    assert_eq!(places.contours()[0].segments.len(), 4);
    // With an island of 4 by 4 the places around it are a hole of 16 by 8.
    let places =
        eroded(&region(&[block(40.0, 20.0), block(4.0, 4.0)]), &profile(&block(12.0, 4.0)), Point::ORIGIN).unwrap();
    assert!((places.area() - (28.0 * 16.0 - 16.0 * 8.0)).abs() < 1e-4, "{}", places.area());
    assert_eq!(places.contours().len(), 2);
}

#[test]
fn a_slot_just_as_wide_as_the_profile_and_a_region_too_small_hold_no_place() {
    for height in [4.0, 3.0] {
        let places = eroded(&region(&[block(40.0, height)]), &profile(&block(12.0, 4.0)), Point::ORIGIN).unwrap();
        assert!(places.contours().is_empty());
    }
}

#[test]
fn a_place_hardly_wider_than_the_profile_stays() {
    // A pocket of 100 mm in which the tool has 4 µm to go, whose area is far below a millionth of the pocket's.
    let loops = [block(100.0, 40.0), moved(block(12.004, 4.004), [0.0, 60.0])];
    let places = eroded(&region(&loops), &profile(&block(12.0, 4.0)), Point::ORIGIN).unwrap();
    assert_eq!(places.contours().len(), 2);
}

/// Once no place at all: both walls' traces met exactly where one of them begins.
#[test]
fn a_rectangle_in_a_rectangle_has_places_however_tight() {
    for share in [0.3, 0.71, 0.9, 0.99, 0.9999] {
        // Another pocket, so that the tight one does not lie about the origin.
        let loops = [block(37.5, 50.0 / 3.0), moved(block(75.0, 20.0), [5.0, 40.0])];
        let tool = block(share * 37.5, share * 50.0 / 3.0);
        let places = eroded(&region(&loops), &profile(&tool), Point::ORIGIN).unwrap();
        let (w, h) = (share * 37.5, share * 50.0 / 3.0);
        let expected = (37.5 - w) * (50.0 / 3.0 - h) + (75.0 - w) * (20.0 - h);
        assert!((places.area() - expected).abs() < 1e-3, "{share}: {} instead of {expected}", places.area());
    }
}

/// An arrow whose reflex corners lie above one another, where the traces of a rectangle's edge fall on one line.
fn arrow() -> Loop {
    [[0.0, 9.0], [14.0, 9.0], [14.0, 0.0], [30.0, 15.0], [14.0, 30.0], [14.0, 21.0], [0.0, 21.0]]
        .iter()
        .map(|[x, y]| [*x, *y, 0.0])
        .collect()
}

/// Once nothing: the longest part of a chain that led nowhere was buried, and the free ones before it were not looked at.
#[test]
fn traces_on_one_line_lose_no_places() {
    for width in [2.0, 6.0, 9.0, 12.0] {
        let tool = profile(&block(width, 0.5 * width));
        let (plain, straight) = (region(&[arrow()]), region(&[block(14.0, 12.0)]));
        let places = eroded(&plain, &tool, Point::ORIGIN).unwrap();
        let shaft = eroded(&straight, &tool, Point::ORIGIN).unwrap();
        assert_eq!(places.contours().len(), 1, "{width}");
        assert!(places.area() > shaft.area() + 20.0, "{width}: {}", places.area());
    }
}

#[test]
fn an_erosion_of_an_erosion_is_one_by_the_sum() {
    let tools = [block(3.0, 1.5), shapes::ngon(5, 1.1, [0.0; 2]), shapes::rounded_rectangle(3.0, 1.5, 0.4)];
    let tools = tools.map(|t| {
        let b = profile(&t).bbox().center();
        profile(&t).translated(-b.to_vec())
    });
    for (k, loops) in examples().into_iter().chain([vec![arrow()]]).enumerate() {
        for (j, tool) in tools.iter().enumerate() {
            let region = region(&loops);
            let once = eroded(&region, &convex_sum(tool, tool), Point::ORIGIN).unwrap();
            let twice = eroded(&eroded(&region, tool, Point::ORIGIN).unwrap(), tool, Point::ORIGIN).unwrap();
            assert_eq!(once.contours().len(), twice.contours().len(), "{k} by {j}");
            assert!((once.area() - twice.area()).abs() < 1e-3, "{k} by {j}: {} {}", once.area(), twice.area());
        }
    }
}

/// Once refused: a joint of arcs with six decimals bends back where the walls are parallel to an edge of the profile.
#[test]
fn slight_notches_along_an_edge_are_passed_over() {
    for bend in [1e-7, 1e-6, 3e-6] {
        // An island of two arcs to the left whose joint is a notch.
        let (sin, cos) = (0.3_f64 - bend).sin_cos();
        let (low, high) = ([10.0 * (1.0 - cos), -10.0 * sin], [10.0 * (1.0 - cos), 10.0 * sin]);
        let bulge = -(0.25 * 0.3_f64).tan();
        let island = vec![[low[0], low[1], bulge], [0.0, 0.0, bulge], [high[0], high[1], 0.0]];
        let region = region(&[moved(block(60.0, 40.0), [3.0, 1.0]), island]);
        let places = eroded(&region, &profile(&block(3.0, 1.5)), Point::ORIGIN).unwrap();
        assert_eq!(places.contours().len(), 2, "{bend}");
    }
}

/// Of a copper layer: arcs of 13 µm and a radius of 5 m next to one of 4 mm. Crossings were off by a tenth of a micrometre there,
/// and the outline closed only with corners moved by 30 µm.
#[test]
fn arcs_that_are_hardly_more_than_their_chords_are_lines() {
    let trace = [
        [26.846_015_6, 38.383_588, 0.032_736_546],
        [27.197_724_3, 38.031_878_3, -6.56e-07],
        [27.207_558_9, 38.023_253_7, -6.56e-07],
        [27.218_435, 38.015_986_5, -6.56e-07],
        [27.230_166_7, 38.010_201, -6.56e-07],
        [27.242_553_1, 38.005_996_4, -6.56e-07],
        [30.0, 30.0, 0.0],
        [20.0, 30.0, 0.0],
    ];
    for turn in 0..40 {
        let (sin, cos) = f64::from(turn).sin_cos();
        let turned = trace.iter().map(|&[x, y, bulge]| [cos * x - sin * y, sin * x + cos * y, bulge]).collect();
        let region = region(&[block(312.0, 104.0), turned]);
        let walls = Boundary::new(&region);
        let places = eroded(&region, &profile(&shapes::circle(0.02238, [0.0; 2])), Point::ORIGIN).unwrap();
        for s in places.segments() {
            let off = walls.signed_distance(s.at(0.5)) - 0.02238;
            assert!(off.abs() < 1e-7, "{turn}: off by {off} at {:?}", s.at(0.5));
        }
    }
}

#[test]
fn a_circle_of_a_single_arc_is_no_flat_one() {
    let (start, center) = (point(10.0, 0.0), Point::ORIGIN);
    let whole = Contour::new(vec![Segment::Arc(Arc { start, end: start, center, radius: 10.0, ccw: true })]);
    let region = Region::from_parts_unchecked(vec![whole], vec![None]);
    let places = eroded(&region, &profile(&shapes::circle(3.0, [0.0; 2])), Point::ORIGIN).unwrap();
    assert!((places.area() - std::f64::consts::PI * 49.0).abs() < 1e-4, "{}", places.area());
}

/// Of a glyph: an edge that slides over the joint of two arcs leaves the second one, very flat, by a hundred-millionth of a millimetre.
#[test]
fn an_edge_slides_from_a_bend_to_a_flat_arc() {
    let outline = vec![
        [60.0, 11.85, 0.0],
        [45.09, 11.85, -0.045_262_25],
        [45.068_794, 11.61622, -0.157_725_25],
        [44.9625, 11.41875, -0.142_796_605],
        [44.757_808, 11.312_068, -0.031_376_892],
        [44.52, 11.28, 0.000_513_078],
        [42.809_672, 11.278_245, 0.0],
        [-60.0, 11.2, 0.0],
        [-60.0, -12.0, 0.0],
        [60.0, -12.0, 0.0],
    ];
    let tool = profile(&block(0.3867, 0.19335));
    for k in 0..20 {
        let region = region(&[moved(outline.clone(), [0.0, 0.1 * f64::from(k)])]);
        assert_eq!(eroded(&region, &tool, Point::ORIGIN).map(|p| p.contours().len()), Ok(1), "{k}");
    }
}

#[test]
fn the_reference_point_may_lie_anywhere() {
    let away = moved(block(12.0, 4.0), [100.0, -7.0]);
    let places = eroded(&region(&[block(40.0, 20.0)]), &profile(&away), point(100.0, -7.0)).unwrap();
    assert!((places.area() - 28.0 * 16.0).abs() < 1e-4);
    assert!(places.bbox().center().distance(point(-100.0, 7.0)) < 1e-6);
}

#[test]
fn a_circle_agrees_with_the_exact_engine() {
    for (k, loops) in examples().iter().enumerate() {
        let region = region(loops);
        let (skeleton, walls) = (Skeleton::build(&region).unwrap(), Boundary::new(&region));
        let offsetter = VoronoiOffsetter::new(&skeleton);
        let size = region.bbox().size();
        for radius in [0.02, 0.05].map(|share| share * size) {
            let places = eroded(&region, &profile(&shapes::circle(radius, [0.0; 2])), Point::ORIGIN).unwrap();
            let exact = offsetter.offset(radius, &OffsetOptions::default()).unwrap();
            let area: f64 = exact.loops.iter().map(|l| l.contour.area()).sum();
            assert!((places.area() - area).abs() < 1e-6 * size * size, "{k}: {} instead of {area}", places.area());
            assert_eq!(places.contours().len(), exact.loops.len(), "{k}");
            for s in places.segments() {
                for p in [s.start(), s.at(0.5)] {
                    let off = walls.signed_distance(p) - radius;
                    assert!(off.abs() < 1e-6 * size, "{k}: off by {off} at {p:?}");
                }
            }
        }
    }
}

/// Points on a grid of a ten-thousandth of a millimetre.
fn on_grid(contours: &[Contour]) -> Paths64 {
    let grid = |p: Point| Point64::new((p.x * 1e4).round() as i64, (p.y * 1e4).round() as i64);
    contours.iter().map(|c| c.segments.iter().map(|s| grid(s.start())).collect()).collect()
}

#[test]
fn convex_polygons_agree_with_an_independent_minkowski_sum() {
    let polygons = [
        vec![block(40.0, 24.0), shapes::ngon(7, 4.0, [-6.0, 1.0]), shapes::ngon(5, 3.0, [9.0, -3.0])],
        vec![shapes::comb(4, 12.0)],
        vec![arrow()],
        shapes::smooth_with_islands(200, false),
        vec![shapes::polar(90, |t| 20.0 + 6.0 * (5.0 * t).cos())],
    ];
    let profiles = [block(3.0, 1.5), shapes::ngon(3, 1.7, [0.0; 2]), moved(shapes::ngon(8, 1.1, [0.0; 2]), [0.4, 0.2])];
    for (k, loops) in polygons.iter().enumerate() {
        for (j, tool) in profiles.iter().enumerate() {
            let region = region(loops);
            let places = eroded(&region, &profile(tool), Point::ORIGIN).unwrap();
            let reflected: Loop = tool.iter().map(|v| [-v[0], -v[1], 0.0]).collect();
            let pattern = on_grid(&[profile(&reflected)]).remove(0);
            let walls = on_grid(region.contours());
            let blocked: Paths64 = walls.iter().flat_map(|wall| minkowski_sum(&pattern, wall, true)).collect();
            let theirs = difference_64(&walls, &blocked, FillRule::NonZero);
            let differ = xor_64(&on_grid(places.contours()), &theirs, FillRule::NonZero);
            let off: f64 = differ.iter().map(area).sum::<f64>() * 1e-8;
            let length: f64 = places.segments().map(Segment::length).sum();
            assert!(off <= 3e-4 * (1.0 + length), "{k} by {j}: {off} mm2 differ");
            assert!(places.area() > 1.0 || k == 1, "{k} by {j}");
        }
    }
}

#[test]
fn hollow_profiles_agree_with_brute_force() {
    let l_shape: Loop = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.5], [1.5, 1.5], [1.5, 5.0], [0.0, 5.0]]
        .iter()
        .map(|v| [v[0], v[1], 0.0])
        .collect();
    let bean: Loop = vec![[-2.0, 0.0, 0.9], [2.0, 0.0, 0.9], [1.0, 0.0, -0.8], [-1.0, 0.0, 0.9]];
    for (j, (tool, inside)) in [(l_shape, point(0.7, 0.7)), (bean, point(0.0, -1.4))].into_iter().enumerate() {
        for (k, loops) in examples().iter().take(3).enumerate() {
            let (region, tool) = (region(loops), profile(&tool));
            let places = eroded(&region, &tool, inside).unwrap();
            let (walls, outline) = (Boundary::new(&region), Boundary::new(&places));
            let rim: Vec<Point> =
                tool.segments.iter().flat_map(|s| (0..60).map(|q| s.at(f64::from(q) / 60.0))).collect();
            let bbox = region.bbox();
            let mut judged = 0;
            for q in 0..2500_u32 {
                let share = |n: u32| (f64::from(n) + 0.307) / 50.0;
                let p = point(bbox.min.x + share(q % 50) * bbox.width(), bbox.min.y + share(q / 50) * bbox.height());
                let margin = rim.iter().map(|r| walls.signed_distance(p + r.to_vec())).fold(f64::INFINITY, f64::min);
                // Islands in the profile are seen by its rim as it passes over them.
                if margin.abs() > 0.3 {
                    let swallowed = region.contours().iter().skip(1).any(|c| {
                        Region::from_parts_unchecked(vec![tool.translated(p.to_vec())], vec![None])
                            .contains(c.segments[0].start())
                    });
                    let free = margin > 0.0 && !swallowed;
                    let inside = !places.contours().is_empty() && outline.contains(p);
                    assert_eq!(inside, free, "{k} by {j} at {p:?}: margin {margin}");
                    judged += 1;
                }
            }
            assert!(judged > 1000);
        }
    }
}

#[test]
fn turned_mirrored_and_moved_together_nothing_changes() {
    let tool: Loop = vec![[-1.5, -1.0, 0.0], [2.0, -1.0, 0.2], [1.0, 1.5, 0.0]];
    let maps: [fn([f64; 3]) -> [f64; 3]; 3] =
        [|[x, y, b]| [-y, x, b], |[x, y, b]| [-x, y, -b], |[x, y, b]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, b]];
    for loops in examples() {
        let all = |map: fn([f64; 3]) -> [f64; 3], l: &Loop| -> Loop { l.iter().copied().map(map).collect() };
        let plain = eroded(&region(&loops), &profile(&tool), Point::ORIGIN).unwrap();
        for (k, map) in maps.into_iter().enumerate() {
            let loops: Vec<Loop> = loops.iter().map(|l| all(map, l)).collect();
            let mut tool = all(map, &tool);
            if k == 1 {
                // A mirrored contour runs the other way round: bulges go with the edges that leave.
                let n = tool.len();
                tool =
                    (0..n).map(|v| [tool[n - 1 - v][0], tool[n - 1 - v][1], -tool[(2 * n - 2 - v) % n][2]]).collect();
            }
            let turned = eroded(&region(&loops), &profile(&tool), Point::ORIGIN).unwrap();
            let size = region(&loops).bbox().size();
            assert!(
                (turned.area() - plain.area()).abs() < 1e-7 * size * size,
                "{k}: {} {}",
                turned.area(),
                plain.area()
            );
        }
    }
}

/// What differs from a Minkowski sum of walls and profile, mm², and the length of the outline.
fn difference_to_sum(region: &Region, tool: &Loop, dilation: &Region) -> (f64, f64) {
    let pattern = on_grid(&[profile(tool)]).remove(0);
    let walls = on_grid(region.contours());
    let rim: Paths64 = walls.iter().flat_map(|wall| minkowski_sum(&pattern, wall, true)).collect();
    let theirs = union_64(&walls, &rim, FillRule::NonZero);
    let differ = xor_64(&on_grid(dilation.contours()), &theirs, FillRule::NonZero);
    (differ.iter().map(area).sum::<f64>().abs() * 1e-8, dilation.segments().map(Segment::length).sum())
}

#[test]
fn dilations_agree_with_an_independent_minkowski_sum() {
    let polygons = [
        vec![block(40.0, 24.0), shapes::ngon(7, 4.0, [-6.0, 1.0]), shapes::ngon(5, 1.0, [9.0, -3.0])],
        vec![shapes::comb(4, 12.0)],
        vec![arrow()],
        vec![block(10.0, 10.0), moved(block(6.0, 6.0), [20.0, 0.0])],
        shapes::smooth_with_islands(200, false),
    ];
    let profiles = [block(3.0, 1.5), shapes::ngon(3, 1.7, [0.0; 2]), moved(shapes::ngon(8, 1.1, [0.0; 2]), [0.4, 0.2])];
    for (k, loops) in polygons.iter().enumerate() {
        for (j, tool) in profiles.iter().enumerate() {
            let region = region(loops);
            let sum = dilated(&region, &profile(tool), Point::ORIGIN).unwrap();
            let (off, length) = difference_to_sum(&region, tool, &sum);
            assert!(off <= 3e-4 * (1.0 + length), "{k} by {j}: {off} mm2 differ");
        }
    }
}

#[test]
fn an_opening_is_what_the_tool_can_cut_and_a_closing_fills_what_it_cannot() {
    let plate = region(&[block(40.0, 20.0)]);
    // A round tool leaves its square's corners, a square one nothing.
    let round = opened(&plate, &profile(&shapes::circle(3.0, [0.0; 2])), Point::ORIGIN).unwrap();
    let corners = 9.0 * (4.0 - std::f64::consts::PI);
    assert!((round.area() - (800.0 - corners)).abs() < 1e-3, "{}", round.area());
    let square = opened(&plate, &profile(&block(6.0, 6.0)), Point::ORIGIN).unwrap();
    assert!((square.area() - 800.0).abs() < 1e-3, "{}", square.area());
    // A slit of 2 mm between two blocks is filled by what does not fit in it.
    let blocks = region(&[block(10.0, 10.0), moved(block(10.0, 10.0), [12.0, 0.0])]);
    let closing = closed(&blocks, &profile(&block(4.0, 4.0)), Point::ORIGIN).unwrap();
    assert_eq!(closing.contours().len(), 1);
    assert!((closing.area() - 220.0).abs() < 1e-3, "{}", closing.area());
    let open = closed(&blocks, &profile(&block(1.0, 1.0)), Point::ORIGIN).unwrap();
    assert!((open.area() - 200.0).abs() < 1e-3, "{}", open.area());
}

#[test]
fn openings_lie_in_and_closings_about_the_region_and_twice_is_once() {
    let tool = profile(&[[-1.5, -1.0, 0.0], [2.0, -1.0, 0.2], [1.0, 1.5, 0.0]]);
    for (k, loops) in examples().iter().enumerate() {
        let region = region(loops);
        let once = opened(&region, &tool, Point::ORIGIN).unwrap();
        let around = closed(&region, &tool, Point::ORIGIN).unwrap();
        let (walls, off) = (Boundary::new(&region), 1e-5 * region.bbox().size());
        assert!(once.segments().all(|s| walls.signed_distance(s.at(0.5)) > -off), "{k}");
        let rim = Boundary::new(&around);
        assert!(region.segments().all(|s| rim.signed_distance(s.at(0.5)) > -off), "{k}");
        assert!(once.area() < region.area() + off && region.area() < around.area() + off, "{k}");
        let twice = opened(&once, &tool, Point::ORIGIN).unwrap();
        assert!((twice.area() - once.area()).abs() < 1e-2, "{k}: {} {}", once.area(), twice.area());
    }
}
