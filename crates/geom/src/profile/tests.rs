use super::*;
use crate::point::{point, vec2};
use std::f64::consts::{FRAC_PI_2, PI};

fn shape(word: &str) -> ToolShape {
    word.parse().unwrap_or_else(|e| panic!("{word}: {e}"))
}

fn section(word: &str) -> ToolProfile {
    shape(word).section(1.0)
}

#[test]
fn words_make_profiles_of_the_right_area() {
    let areas = [
        ("circle:6", 9.0 * PI),
        ("rect:12x4", 48.0),
        ("rounded:12x4r1", 48.0 - 4.0 + PI),
        ("stadium:12x4", 8.0 * 4.0 + 4.0 * PI),
        ("stadium:4x12", 8.0 * 4.0 + 4.0 * PI),
        ("rounded:4x4r2", 4.0 * PI),
        ("polygon:6x10", 1.5 * 3.0_f64.sqrt() * 25.0),
        ("polygon:4x2", 2.0),
        (" circle : 6 ", 9.0 * PI),
        ("rect:12x4@30", 48.0),
    ];
    for (word, area) in areas {
        let profile = section(word.trim());
        assert!((profile.area() - area).abs() < 1e-9, "{word}: {} {area}", profile.area());
        assert!(profile.is_convex(), "{word}");
        assert!(ToolProfile::new(profile.contour().clone()).is_ok(), "{word}");
    }
}

#[test]
fn an_ellipse_lies_within_the_fit_tolerance() {
    for (a, b) in [(12.0, 4.0), (4.0, 12.0), (100.0, 1.0), (6.0, 6.0), (6.0, 5.999)] {
        let profile = ToolProfile::ellipse(a, b);
        assert!(profile.is_convex());
        for s in &profile.contour().segments {
            for k in 0..=20 {
                let p = s.at(f64::from(k) / 20.0);
                let (x, y) = (2.0 * p.x / a, 2.0 * p.y / b);
                let off = (x * x + y * y - 1.0) / (2.0 * (2.0 * x / a).hypot(2.0 * y / b));
                assert!(off.abs() < 1.2 * crate::tolerance::FIT, "{a} {b}: {off}");
            }
        }
        assert!((profile.area() - 0.25 * PI * a * b).abs() < 2.0 * (a + b) * crate::tolerance::FIT);
    }
}

#[test]
fn support_and_reach_are_extremes() {
    let stadium = section("stadium:12x4");
    assert!((stadium.support(vec2(1.0, 0.0)) - 6.0).abs() < 1e-12);
    assert!((stadium.support(vec2(0.0, 1.0)) - 2.0).abs() < 1e-12);
    assert!((stadium.reach() - 6.0).abs() < 1e-12);
    let rect = section("rect:12x4");
    assert!((rect.reach() - 40.0_f64.sqrt()).abs() < 1e-12);
    let turned = rect.rotated(FRAC_PI_2);
    assert!((turned.support(vec2(0.0, 1.0)) - 6.0).abs() < 1e-12);
    let d = Vec2::from_angle(0.3);
    let sampled = stadium.contour().segments.iter().flat_map(|s| (0..=1000).map(|k| s.at(f64::from(k) / 1000.0)));
    let most = sampled.map(|p| p.to_vec().dot(d)).fold(f64::NEG_INFINITY, f64::max);
    assert!((stadium.support(d) - most).abs() < 1e-5);
}

#[test]
fn tapered_tools_grow_with_depth() {
    let cone = shape("cone:90x6");
    assert!(cone.is_tapered() && !shape("circle:3").is_tapered());
    assert!((cone.section(1.0).reach() - 1.0).abs() < 1e-12);
    assert!((cone.section(9.0).reach() - 3.0).abs() < 1e-12);
    let ball = shape("ball:10");
    assert!((ball.section(2.0).reach() - 4.0).abs() < 1e-12);
    assert!((ball.section(7.0).reach() - 5.0).abs() < 1e-12);
}

#[test]
fn words_are_written_as_they_are_read() {
    for word in ["circle:6", "rect:12x4", "rounded:12x4r1", "stadium:12x4", "ellipse:9x3.5", "polygon:6x10", "ball:6"] {
        assert_eq!(shape(word).to_string(), word);
    }
    assert_eq!(shape(&shape("cone:60x8").to_string()), shape("cone:60x8"));
}

#[test]
fn bad_words_say_what_is_expected() {
    let said = |word: &str| word.parse::<ToolShape>().unwrap_err().to_string();
    assert!(said("square:3").contains("rect:WxH"));
    assert!(said("6").contains("circle:D"));
    assert!(said("rect:12").contains("rect:12x4"));
    assert!(said("rect:0x4").contains("width x height"));
    assert!(said("rect:-1x4").contains("width x height"));
    assert!(said("rect:nanx4").contains("width x height"));
    assert!(said("circle:inf").contains("a diameter"));
    assert!(said("polygon:2x4").contains("3 to 1000"));
    assert!(said("rounded:12x4").contains("corner radius"));
    assert!(said("rounded:12x4r3").contains("2 mm at most"));
    assert!(said("cone:180").contains("below 180"));
    assert!(said("rect:12x4@x").contains("degrees"));
}

#[test]
fn drawn_profiles_are_checked() {
    let l = [[-1.0, -1.0, 0.0], [4.0, -1.0, 0.0], [4.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 5.0, 0.0], [-1.0, 5.0, 0.0]];
    let profile = ToolProfile::new(Contour::from_vertices(&l).reversed()).unwrap();
    assert!((profile.area() - 18.0).abs() < 1e-12 && !profile.is_convex());
    let away = Contour::from_vertices(&l).translated(vec2(3.0, 3.0));
    assert!(matches!(ToolProfile::new(away.clone()), Err(ProfileError::Reference { .. })));
    assert!(ToolProfile::new(away).unwrap_err().to_string().contains("X0 Y0"));
    let bow = [[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]];
    assert!(matches!(ToolProfile::new(Contour::from_vertices(&bow)), Err(ProfileError::Outline(_))));
    let flat = Contour::new(vec![Segment::line(point(0.0, 0.0), point(1.0, 0.0))]);
    assert!(ToolProfile::new(flat).is_err());
}

#[test]
fn sums_of_convex_contours_reach_as_far_as_both_together() {
    let words =
        ["circle:6", "rect:12x4", "rounded:12x4r1", "stadium:4x12", "polygon:3x5", "rect:12x4@30", "polygon:7x3@11"];
    for (first, second) in words.iter().flat_map(|a| words.iter().map(move |b| (a, b))) {
        let (a, b) = (section(first), section(second));
        let sum = ToolProfile { contour: convex_sum(a.contour(), b.contour()) };
        assert!(sum.is_convex(), "{first} + {second}");
        for k in 0..100 {
            let u = Vec2::from_angle(0.063 * f64::from(k));
            let off = sum.support(u) - a.support(u) - b.support(u);
            assert!(off.abs() < 1e-12, "{first} + {second}: off by {off}");
        }
    }
}

#[test]
fn a_sum_of_like_rectangles_is_a_rectangle_again() {
    let sum = convex_sum(section("rect:12x4").contour(), section("rect:3x1").contour());
    assert_eq!(sum.segments.len(), 4);
    assert!((sum.area() - 75.0).abs() < 1e-12);
    let arcs = convex_sum(section("circle:6").contour(), section("circle:2").contour());
    assert_eq!(arcs.segments.iter().filter(|s| matches!(s, Segment::Line(_))).count(), 0);
}
