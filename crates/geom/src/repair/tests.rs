use super::*;
use crate::point::point;

fn square(x: f64, y: f64, side: f64) -> Contour {
    Contour::from_vertices(&[[x, y, 0.0], [x + side, y, 0.0], [x + side, y + side, 0.0], [x, y + side, 0.0]])
}

fn heal(loops: Vec<Contour>) -> Healed {
    build(loops, &RepairOptions::default()).unwrap()
}

#[test]
fn nested_squares_alternate() {
    let loops: Vec<Contour> = (0..5).map(|k| square(f64::from(k), f64::from(k), 20.0 - 2.0 * f64::from(k))).collect();
    let healed = heal(loops);
    assert!(healed.notes.is_empty());
    assert_eq!(healed.region.parents(), [None, Some(0), None, Some(2), None]);
    assert!((healed.region.area() - (400.0 - 324.0 + 256.0 - 196.0 + 144.0)).abs() < 1e-9);
}

#[test]
fn a_bowtie_is_refused_where_it_crosses() {
    let bowtie = Contour::from_vertices(&[[0.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let error = build(vec![square(-5.0, -5.0, 20.0), bowtie], &RepairOptions::default()).unwrap_err();
    assert_eq!(error, RegionError::Crossing { first: 1, second: 1, at: point(1.0, 1.0) });
}

fn refuse(loops: Vec<Contour>) -> RegionError {
    build(loops, &RepairOptions::default()).unwrap_err()
}

fn contour(vertices: &[[f64; 3]]) -> Contour {
    Contour::from_vertices(vertices)
}

fn circle(x: f64, y: f64, r: f64) -> Contour {
    contour(&[[x - r, y, 1.0], [x + r, y, 1.0]])
}

fn rectangle() -> Contour {
    contour(&[[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [100.0, 60.0, 0.0], [0.0, 60.0, 0.0]])
}

/// How often the most visited corner of the region is passed.
fn passages(region: &Region) -> usize {
    let mut seen = std::collections::HashMap::new();
    for s in region.segments() {
        *seen.entry([s.start().x.to_bits(), s.start().y.to_bits()]).or_insert(0) += 1;
    }
    seen.into_values().max().unwrap_or(0)
}

#[test]
fn an_island_tangent_to_the_wall_becomes_part_of_the_outer_contour() {
    for depth in [0.0, 1e-12, -1e-12] {
        let healed = heal(vec![rectangle(), circle(30.0, 10.0 - depth, 10.0)]);
        let area = 6000.0 - 100.0 * std::f64::consts::PI;
        assert_eq!(healed.region.contours().len(), 1);
        assert_eq!(passages(&healed.region), 2);
        assert!((healed.region.area() - area).abs() < 1e-6);
        assert!(matches!(healed.notes[..], [Note::Touch { first: 0, second: 1, .. }]));
    }
}

#[test]
fn a_gap_of_a_nanometre_stays_and_an_overlap_of_one_is_closed() {
    let gap = heal(vec![rectangle(), circle(30.0, 10.0 + 1e-6, 10.0)]);
    assert_eq!((gap.region.contours().len(), gap.notes.len()), (2, 0));
    let overlap = heal(vec![rectangle(), circle(30.0, 10.0 - 1e-6, 10.0)]);
    assert_eq!((overlap.region.contours().len(), passages(&overlap.region)), (1, 1));
    assert!(matches!(overlap.notes[..], [Note::Overlap { first: 0, second: 1, .. }]));
    assert!(matches!(
        refuse(vec![rectangle(), circle(30.0, 9.9, 10.0)]),
        RegionError::Crossing { first: 0, second: 1, .. }
    ));
}

#[test]
fn two_islands_that_touch_are_one_contour() {
    let healed = heal(vec![rectangle(), circle(30.0, 30.0, 10.0), circle(50.0, 30.0, 10.0)]);
    assert_eq!(healed.region.parents(), [None, Some(0)]);
    assert_eq!(passages(&healed.region), 2);
}

#[test]
fn a_corner_on_an_edge_splits_the_edge() {
    let diamond = contour(&[[50.0, 0.0, 0.0], [60.0, 20.0, 0.0], [50.0, 40.0, 0.0], [40.0, 20.0, 0.0]]);
    let healed = heal(vec![rectangle(), diamond]);
    assert_eq!(healed.region.contours().len(), 1);
    assert_eq!(healed.region.edge_count(), 9);
    assert_eq!(healed.region.area(), 5600.0);
}

#[test]
fn a_loop_that_touches_itself_becomes_two_pockets() {
    let eight = contour(&[
        [0.0, 0.0, 0.0],
        [50.0, 30.0, 0.0],
        [100.0, 0.0, 0.0],
        [100.0, 60.0, 0.0],
        [50.0, 30.0, 0.0],
        [0.0, 60.0, 0.0],
    ]);
    let healed = heal(vec![eight]);
    assert_eq!(healed.region.parents(), [None, None]);
    assert_eq!(healed.region.area(), 3000.0);
    assert!(matches!(healed.notes[..], [Note::Touch { first: 0, second: 0, at }] if at == point(50.0, 30.0)));
}

#[test]
fn an_island_between_two_walls_parts_the_pocket() {
    let wall = contour(&[[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [100.0, 40.0, 0.0], [0.0, 40.0, 0.0]]);
    let healed = heal(vec![wall, circle(50.0, 20.0, 20.0)]);
    assert_eq!(healed.region.parents(), [None, None]);
    assert!((healed.region.area() - (4000.0 - 400.0 * std::f64::consts::PI)).abs() < 1e-9);
}

#[test]
fn a_spike_is_cut_off() {
    let spiked = contour(&[
        [0.0, 0.0, 0.0],
        [60.0, 0.0, 0.0],
        [60.0, 40.0, 0.0],
        [30.0, 40.0, 0.0],
        [30.0, 60.0, 0.0],
        [30.0, 40.0, 0.0],
        [0.0, 40.0, 0.0],
    ]);
    let healed = heal(vec![spiked]);
    assert_eq!(healed.region.area(), 2400.0);
    assert!(matches!(healed.notes[..], [Note::Spike { contour: 0, .. }]));
}

#[test]
fn a_spike_that_returns_only_half_way_is_cut_off() {
    let spiked = contour(&[
        [0.0, 0.0, 0.0],
        [60.0, 0.0, 0.0],
        [60.0, 40.0, 0.0],
        [30.0, 40.0, 0.0],
        [30.0, 60.0, 0.0],
        [30.0, 20.0, 0.0],
        [0.0, 20.0, 0.0],
    ]);
    let healed = heal(vec![spiked]);
    assert_eq!(healed.region.area(), 1800.0);
    assert_eq!(healed.region.contours().len(), 1);
}

#[test]
fn loops_without_area_are_dropped_or_refused() {
    let flat = || contour(&[[10.0, 10.0, 0.0], [40.0, 10.0, 0.0], [25.0, 10.0, 0.0]]);
    let healed = heal(vec![rectangle(), flat()]);
    assert_eq!(healed.region.area(), 6000.0);
    assert!(matches!(healed.notes[..], [Note::ZeroArea { contour: 1, .. }]), "{:?}", healed.notes);
    assert!(matches!(refuse(vec![flat()]), RegionError::Nothing { loops: 1, .. }));
    assert!(matches!(refuse(vec![]), RegionError::Nothing { loops: 0, .. }));
    assert!(matches!(refuse(vec![contour(&[[1.0, 1.0, 0.0]; 8])]), RegionError::Nothing { .. }));
}

#[test]
fn loops_drawn_twice_are_used_once() {
    let slot = |k: usize| {
        let mut v = vec![[0.0, -15.0, 0.0], [80.0, -15.0, 1.0], [80.0, 15.0, 0.0], [0.0, 15.0, 1.0]];
        v.rotate_left(k);
        contour(&v)
    };
    for twin in [slot(0), slot(2), slot(1).reversed(), slot(3).translated(crate::vec2(1e-7, 0.0))] {
        let healed = heal(vec![slot(0), twin]);
        assert!((healed.region.area() - (2400.0 + 225.0 * std::f64::consts::PI)).abs() < 1e-6);
        assert!(matches!(healed.notes[..], [Note::Duplicate { contour: 1, kept: 0, .. }]));
    }
    let quarters: Vec<[f64; 3]> = [(10.0, 0.0), (0.0, 10.0), (-10.0, 0.0), (0.0, -10.0)]
        .map(|(x, y)| [x, y, std::f64::consts::FRAC_PI_8.tan()])
        .into();
    assert_eq!(heal(vec![circle(0.0, 0.0, 10.0), contour(&quarters)]).notes.len(), 1);
}

#[test]
fn a_corner_shared_with_the_wall_is_no_wall() {
    let q = std::f64::consts::FRAC_PI_8.tan();
    let wall = contour(&[
        [10.0, 0.0, 0.0],
        [90.0, 0.0, q],
        [100.0, 10.0, 0.0],
        [100.0, 50.0, q],
        [90.0, 60.0, 0.0],
        [10.0, 60.0, q],
        [0.0, 50.0, 0.0],
        [0.0, 10.0, q],
    ]);
    let island = contour(&[
        [10.0, 0.0, 0.0],
        [20.0, 0.0, q],
        [30.0, 10.0, 0.0],
        [30.0, 20.0, q],
        [20.0, 30.0, 0.0],
        [10.0, 30.0, q],
        [0.0, 20.0, 0.0],
        [0.0, 10.0, q],
    ]);
    let healed = heal(vec![wall, island]);
    assert!((healed.region.area() - 5100.0).abs() < 1e-6, "{}", healed.region.area());
    assert_eq!(healed.region.contours().len(), 1);
    assert!(healed.notes.iter().all(|n| matches!(n, Note::Shared { first: 0, second: 1, .. })));
}

#[test]
fn numbers_no_drawing_has_are_refused_where_they_are() {
    let bad = |x: f64| contour(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [x, 1.0, 0.0]]);
    assert_eq!(refuse(vec![rectangle(), bad(f64::NAN)]), RegionError::NotFinite { contour: 1, vertex: 1 });
    assert!(matches!(refuse(vec![bad(f64::INFINITY)]), RegionError::NotFinite { contour: 0, .. }));
    assert!(matches!(refuse(vec![bad(1e300)]), RegionError::Absurd { .. } | RegionError::NotFinite { .. }));
    assert!(matches!(refuse(vec![rectangle().translated(crate::vec2(1e15, 0.0))]), RegionError::Absurd { .. }));
    let arc = |bulge: f64| contour(&[[0.0, 0.0, bulge], [100.0, 0.0, 0.0], [100.0, 60.0, 0.0]]);
    assert!(matches!(refuse(vec![arc(f64::NAN)]), RegionError::NotFinite { .. }));
    assert!(matches!(refuse(vec![arc(1e12)]), RegionError::Absurd { .. }));
    assert!(matches!(refuse(vec![square(0.0, 0.0, 1e-12)]), RegionError::TooSmall { .. }));
    let open = Contour::new(rectangle().segments[..3].to_vec());
    assert!(matches!(refuse(vec![open]), RegionError::Open { contour: 0, .. }));
}

#[test]
fn edges_without_length_are_dropped() {
    let mut doubled = rectangle();
    let corner = doubled.segments[1].start();
    doubled.segments.insert(1, Segment::line(corner, corner));
    let healed = heal(vec![doubled]);
    assert_eq!((healed.region.edge_count(), healed.notes.len()), (4, 1));
}

#[test]
fn a_full_circle_is_halved_and_arcs_of_one_circle_share_it() {
    let at = point(10.0, 0.0);
    let full = Contour::new(vec![Segment::Arc(crate::Arc {
        start: at,
        end: at,
        center: point(0.0, 0.0),
        radius: 10.0,
        ccw: false,
    })]);
    let healed = heal(vec![full]);
    assert_eq!(healed.region.edge_count(), 2);
    assert!((healed.region.area() - 100.0 * std::f64::consts::PI).abs() < 1e-9);
    let n = 7;
    let vertex = |k: usize| {
        let t = 0.3 + std::f64::consts::TAU * k as f64 / f64::from(n);
        [20.0 + 10.0 * t.cos(), 5.0 + 10.0 * t.sin(), (std::f64::consts::FRAC_PI_2 / f64::from(n)).tan()]
    };
    let healed = heal(vec![contour(&(0..n as usize).map(vertex).collect::<Vec<_>>())]);
    let circles: std::collections::HashSet<String> = healed
        .region
        .segments()
        .map(|s| if let Segment::Arc(a) = s { format!("{:?} {:?}", a.center, a.radius) } else { String::new() })
        .collect();
    assert_eq!(circles.len(), 1);
}

#[test]
fn messages_count_from_one_and_name_the_place() {
    let error = refuse(vec![rectangle(), circle(30.0, 5.0, 10.0)]).to_string();
    assert!(error.starts_with("contours 1 and 2 cross each other at ("), "{error}");
    let note = heal(vec![rectangle(), circle(30.0, 10.0, 10.0)]).notes[0].to_string();
    assert_eq!(note, "contours 1 and 2 touch at (30.0000, 0.0000): taken as they are");
}

#[test]
fn a_joint_of_two_arcs_on_the_inside_of_a_third_cuts_it_once() {
    let upright = contour(&[[62.5, 25.0, -1.0], [62.5, 12.5, -1.0]]);
    for loops in [vec![circle(75.0, 18.75, 6.25), upright.clone()], vec![upright, circle(75.0, 18.75, 6.25)]] {
        let healed = heal(loops);
        assert_eq!(healed.region.edge_count(), 5);
        assert!((healed.region.area() - 2.0 * 6.25_f64.powi(2) * std::f64::consts::PI).abs() < 1e-9);
        assert_eq!(healed.region.parents(), [None, None]);
    }
}

#[test]
fn an_arc_that_leaves_the_leftmost_corner_along_a_wall_does_not_turn_the_region_inside_out() {
    let b = -0.414_213_562_373_095_03;
    let healed = heal(vec![contour(&[[2.0, 5.0, -1.0], [2.0, 0.0, 0.0], [2.0, 5.0, b], [3.0, 4.0, b]])]);
    assert!(healed.region.contains(point(3.5, 2.5)) && !healed.region.contains(point(2.5, 4.5)));
    assert_eq!(healed.region.parents(), [None]);
}

#[test]
fn a_wall_that_leans_left_by_a_rounding_error_does_not_turn_the_region_inside_out() {
    let next =
        |x: f64, steps: i32| (0..steps.abs()).fold(x, |x, _| if steps > 0 { x.next_up() } else { x.next_down() });
    let b = (std::f64::consts::PI / 8.0).tan();
    for corner in -3..=3 {
        for far in -3..=3 {
            for bulge in [b, b * (1.0 - 1e-7), b * (1.0 + 1e-7)] {
                let (x0, x1) = (next(38.3, corner), next(38.3, far));
                let bottom = [[46.6, 5.0, 0.0], [80.0, 5.0, 0.0]];
                let rounded =
                    [bottom[0], bottom[1], [80.0, 55.0, 0.0], [46.6, 55.0, bulge], [x0, 46.7, 0.0], [x1, 13.3, bulge]];
                let healed = heal(vec![contour(&rounded)]);
                assert!(healed.region.area() > 0.0, "{corner} {far} {bulge}");
            }
        }
    }
}

/// Once an overflow: the centre of a nearly straight arc lay in a cell whose number has no neighbour above.
#[test]
fn an_arc_whose_centre_is_beyond_all_counting_is_a_flat_wall() {
    for bulge in [1e-8, -1e-8, 3e-9] {
        let loops = vec![contour(&[[0.0, 0.0, bulge], [900.0, 0.0, 0.0], [900.0, 900.0, 0.0], [0.0, 900.0, 0.0]])];
        assert!((heal(loops).region.area() - 810_000.0).abs() < 0.01);
    }
}

/// Once inside out: both ends of the short arc counted as its leftmost point, and the wrong one was taken.
#[test]
fn a_short_arc_of_a_large_circle_at_the_leftmost_corner_decides_by_its_nearer_end() {
    let (corner, beside) = ([0.0, 0.0], [0.25, -0.0001]);
    let [x, y] = corner;
    let down = [[x, y, 0.0], [0.5, -2.0, 0.0], [6.0, -2.0, 0.0], [6.0, -0.0001, 0.0]];
    for bulge in [-2e-4, 2e-4] {
        let loops = vec![contour(&[&down[..], &[[beside[0], beside[1], bulge]]].concat())];
        assert!(heal(loops).region.area() > 0.0, "{bulge}");
    }
}
