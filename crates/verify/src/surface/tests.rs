use super::*;
use std::fmt::Write as _;

/// A block of 40 × 40 × 10 mm with a step: x < 20 is 6 mm lower, joined by a wall.
fn step() -> Mesh {
    let quad = |a: Corner, b: Corner, c: Corner, d: Corner| [[a, b, c], [a, c, d]];
    let mut all = Vec::new();
    all.extend(quad([0.0, 0.0, -6.0], [20.0, 0.0, -6.0], [20.0, 40.0, -6.0], [0.0, 40.0, -6.0]));
    all.extend(quad([20.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 40.0, 0.0], [20.0, 40.0, 0.0]));
    all.extend(quad([20.0, 0.0, -6.0], [20.0, 0.0, 0.0], [20.0, 40.0, 0.0], [20.0, 40.0, -6.0]));
    Mesh::weld(&all, 0.0).mesh
}

/// A 45° slope up along x through the origin.
fn slope() -> Mesh {
    Mesh::weld(
        &[
            [[-50.0, -50.0, -50.0], [50.0, -50.0, 50.0], [50.0, 80.0, 50.0]],
            [[-50.0, -50.0, -50.0], [50.0, 80.0, 50.0], [-50.0, 80.0, -50.0]],
        ],
        0.0,
    )
    .mesh
}

fn options(cutter: Cutter) -> RoughOptions {
    let mut o = RoughOptions::new(cutter, 4.0, [0.0, 0.0, -10.0], [40.0, 40.0, 0.0]);
    o.levels = vec![-3.0, -5.9];
    o
}

/// Straight cuts along y at these places and heights.
fn program(cuts: &[(f64, f64)]) -> String {
    let mut text = "G21 G90 G94 G61 S1000 M3\nG0 Z5\n".to_owned();
    for (x, z) in cuts {
        let _ = write!(text, "G0 Z5\nG0 X{x} Y-8\nG1 Z{z} F600\nG1 Y48\nG0 Z5\n");
    }
    text + "M2\n"
}

#[test]
fn gouges_are_measured_along_the_normal() {
    for cutter in [Cutter::Flat, Cutter::Ball, Cutter::Bull { corner: 1.0 }] {
        // Into the wall by 0.05 mm, level with its foot or above it; a height would say 6 or 3 mm.
        for z in [-6.0, -3.0] {
            let reach: f64 = match cutter {
                Cutter::Ball if z == -3.0 => 16.0 - 1.0,
                _ => 16.0,
            };
            let x = 20.0 - reach.sqrt() + 0.05;
            let report = verify_rough(&step(), &program(&[(x, z)]), &options(cutter)).unwrap();
            if cutter == Cutter::Ball && z == -3.0 {
                // The wall's upper edge meets the ball below its equator, so the normal leans.
                assert!(report.gouge_depth() > 0.04 && report.gouge_depth() < 0.05, "{}", report.gouge_depth());
            } else {
                assert!((report.gouge_depth() - 0.05).abs() < 1e-3, "{cutter:?} {z}: {}", report.gouge_depth());
            }
            assert!(!report.is_proven());
        }
        let clear = verify_rough(&step(), &program(&[(16.0, -6.0)]), &options(cutter)).unwrap();
        assert!(clear.gouge_depth() < 1e-9, "{cutter:?}");
    }
}

#[test]
fn a_slope_is_gouged_by_what_lies_below_its_plane() {
    let half = f64::sqrt(0.5);
    for (cutter, touch) in [
        (Cutter::Flat, 4.0),
        (Cutter::Ball, 4.0 * (f64::sqrt(2.0) - 1.0)),
        (Cutter::Bull { corner: 1.0 }, 3.0 + f64::sqrt(2.0) - 1.0),
    ] {
        let mut o = options(cutter);
        o.stock_high[2] = 60.0;
        // The tip over x = -10 touches at z = -10 + touch.
        let text = program(&[(-10.0, -10.0 + touch - 0.1)]).replace("Z5", "Z70");
        let report = verify_rough(&slope(), &text, &o).unwrap();
        assert!((report.gouge_depth() - 0.1 * half).abs() < 1e-6, "{cutter:?}: {}", report.gouge_depth());
    }
}

#[test]
fn the_stock_to_leave_is_guarded_too() {
    let mut o = options(Cutter::Flat);
    o.stock_to_leave = 0.5;
    let report = verify_rough(&step(), &program(&[(15.7, -3.0)]), &o).unwrap();
    assert!(report.gouge_depth() == 0.0 && (report.into_stock() - 0.2).abs() < 1e-3);
    assert!(report.complaints()[0].contains("stock to leave"));
    assert!(verify_rough(&step(), &program(&[(15.49, -3.0)]), &o).unwrap().into_stock() < 1e-9);
}

#[test]
fn what_is_left_is_told_by_level() {
    let rows = |z: f64| -> Vec<(f64, f64)> { (0..6).map(|k| (16.0 - 3.5 * f64::from(k), z)).collect() };
    let both: Vec<(f64, f64)> = rows(-3.0).into_iter().chain(rows(-5.9)).collect();
    let judge = |cuts: &[(f64, f64)]| verify_rough(&step(), &program(cuts), &options(Cutter::Flat)).unwrap();
    let whole = judge(&both);
    assert!(whole.is_proven(), "{:?}", whole.complaints());
    let upper = judge(&rows(-3.0));
    assert!((upper.leftover_height() - 2.9).abs() < 1e-9, "{:?}", upper.leftover);
    assert_eq!(upper.levels[1].leftover.map(|l| l.height), Some(upper.leftover_height()));
    let gap: Vec<(f64, f64)> = both.iter().copied().filter(|c| c.0 != 5.5 && c.0 != 9.0).collect();
    assert!(judge(&gap).leftover_height() > 5.8);
}

#[test]
fn straight_descents_into_material_are_told() {
    let into = |text: &str| verify_rough(&step(), text, &options(Cutter::Flat)).unwrap().descent.map(|d| d.depth);
    assert_eq!(into(&program(&[(8.0, -3.0), (8.0, -5.9)])), None, "from outside the stock");
    let plunge = program(&[(8.0, -3.0), (8.0, -5.9)]).replacen("Y-8\nG1 Z-5.9", "Y20\nG1 Z-5.9", 1);
    assert!((into(&plunge).unwrap() - 2.9).abs() < 1e-9);
    assert!(
        (into(&plunge.replacen("X8.0 Y-8", "X20 Y-8", 1).replacen("X8 Y-8", "X20 Y-8", 1)).unwrap() - 5.9).abs() < 1e-9
    );
}

#[test]
fn rapid_moves_in_the_stock_are_found() {
    let text = program(&[(16.0, -6.0)]).replace("G1 Y48\n", "G0 Y48\n");
    let report = verify_rough(&step(), &text, &options(Cutter::Flat)).unwrap();
    assert!(report.complaints()[0].contains("rapid move"));
}
