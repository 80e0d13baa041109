//! Verdicts do not hang on where the part lies; a spoilt program is refused.

use pocketry_geom::{Arc, Contour, Point, Region, Segment, Vec2, vec2};
use pocketry_verify::{Report, VerifyOptions, verify};
use proptest::prelude::*;
use std::fmt::Write;

const R: f64 = 2.0;

/// A motion of the plane.
#[derive(Clone, Copy, Debug)]
struct Place {
    angle: f64,
    by: Vec2,
}

impl Place {
    const HOME: Self = Self { angle: 0.0, by: Vec2::ZERO };

    fn of(self, p: Point) -> Point {
        p.to_vec().rotated(self.angle).to_point() + self.by
    }

    fn of_segment(self, s: &Segment) -> Segment {
        match *s {
            Segment::Line(l) => Segment::line(self.of(l.start), self.of(l.end)),
            Segment::Arc(a) => {
                let (start, end, center) = (self.of(a.start), self.of(a.end), self.of(a.center));
                Segment::Arc(Arc { start, end, center, ..a })
            }
        }
    }
}

fn place() -> impl Strategy<Value = Place> {
    (0.0..6.3, -500.0..500.0, -500.0..500.0).prop_map(|(angle, x, y)| Place { angle, by: vec2(x, y) })
}

/// A stadium of this half-length and radius about the origin.
fn stadium(half: f64, radius: f64) -> Contour {
    let corner = |x: f64, y: f64, bulge: f64| [x * half, y * radius, bulge];
    Contour::from_vertices(&[
        corner(-1.0, -1.0, 0.0),
        corner(1.0, -1.0, 1.0),
        corner(1.0, 1.0, 0.0),
        corner(-1.0, 1.0, 1.0),
    ])
}

/// A stadium-shaped track round a stadium-shaped island.
fn region(place: Place) -> Region {
    let contours = [stadium(15.0, 20.0), stadium(15.0, 8.0).reversed()];
    let moved = |c: &Contour| Contour::new(c.segments.iter().map(|s| place.of_segment(s)).collect());
    Region::from_parts_unchecked(contours.iter().map(moved).collect(), vec![None, Some(0)])
}

/// The loops of the track: distances 2, 3.8, 5.6 from either wall.
fn loops() -> Vec<Contour> {
    [18.0, 16.2, 14.4, 13.6, 11.8, 10.0].map(|r| stadium(15.0, r)).to_vec()
}

fn text(loops: &[Contour], place: Place) -> String {
    let mut out = String::from("G21 G17 G90 G91.1 G94\nG61\nS1000 M3\nG0 Z5\nF300\n");
    for contour in loops {
        let start = place.of(contour.segments[0].start());
        writeln!(out, "G0 X{:.5} Y{:.5}\nG1 Z-1", start.x, start.y).unwrap();
        for segment in contour.segments.iter().map(|s| place.of_segment(s)) {
            let end = segment.end();
            match segment {
                Segment::Line(_) => writeln!(out, "G1 X{:.5} Y{:.5}", end.x, end.y).unwrap(),
                Segment::Arc(a) => {
                    let (center, code) = (a.center - a.start, if a.ccw { 3 } else { 2 });
                    writeln!(out, "G{code} X{:.5} Y{:.5} I{:.5} J{:.5}", end.x, end.y, center.x, center.y).unwrap();
                }
            }
        }
        out.push_str("G0 Z5\n");
    }
    out + "M2\n"
}

fn judge(region: &Region, text: &str) -> Report {
    verify(region, text, &VerifyOptions::new(R)).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_verdict_moves_along(place in place()) {
        let report = judge(&region(place), &text(&loops(), place));
        prop_assert_eq!(report.complaints(), Vec::<String>::new());
        prop_assert!(report.unreachable_area < report.area_error);
    }

    #[test]
    fn a_lost_loop_is_found_with_the_same_area_anywhere(place in place(), lost in 0usize..6) {
        let mut fewer = loops();
        fewer.remove(lost);
        let there = judge(&region(place), &text(&fewer, place));
        let home = judge(&region(Place::HOME), &text(&fewer, Place::HOME));
        // The gap beside the wall or between the loops at 14.4 and 13.6 is wider than the tool reaches only at the walls.
        prop_assert_eq!(there.is_proven(), home.is_proven());
        prop_assert_eq!(there.is_proven(), lost != 0 && lost != 5);
        prop_assert!((there.uncut_area - home.uncut_area).abs() < 0.05);
    }

    #[test]
    fn a_number_changed_by_five_hundredths_is_refused(
        place in place(), pick in any::<prop::sample::Index>(), up in any::<bool>(),
    ) {
        let good = text(&loops(), place);
        // Only the loops at the walls decide (the others overlap), and of these the ends of lines: they shift the arc
        // that follows. An arc that ends a little farther along its tangent does no harm.
        let wall = text(&[loops()[0].clone(), loops()[5].clone()], place);
        let decisive: Vec<String> = wall.lines().filter(|l| l.starts_with("G1 X")).map(String::from).collect();
        let line = pick.get(&decisive);
        let x = line.split(' ').find(|w| w.starts_with('X')).unwrap();
        let moved = x[1..].parse::<f64>().unwrap() + if up { 0.05 } else { -0.05 };
        let bad = good.replacen(line.as_str(), &line.replacen(x, &format!("X{moved:.5}"), 1), 1);
        prop_assert_ne!(&bad, &good);
        let verdict = verify(&region(place), &bad, &VerifyOptions::new(R));
        prop_assert!(verdict.is_err() || !verdict.unwrap().is_proven());
    }

    #[test]
    fn a_shift_of_the_whole_program_is_refused(place in place(), angle in 0.0..6.3) {
        let shifted = Place { by: place.by + Vec2::from_angle(angle) * 0.01, ..place };
        let report = judge(&region(place), &text(&loops(), shifted));
        prop_assert!((report.gouge_depth() - 0.01).abs() < 1e-4, "{}", report.gouge_depth());
        prop_assert!(!report.is_proven());
    }

    #[test]
    fn any_text_is_read_or_refused(text in "([GMXYZIJRFPSTN][0-9.+-]{0,5}[ \n]?){0,60}") {
        let _ = verify(&region(Place::HOME), &text, &VerifyOptions::new(R));
    }
}
