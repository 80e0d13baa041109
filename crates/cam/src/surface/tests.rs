use super::*;
use pocketry_geom::point;
use proptest::prelude::*;

fn mesh(triangles: &[[Corner; 3]]) -> Mesh {
    Mesh::weld(triangles, 0.0).mesh
}

/// The upper surface over a lattice of heights.
fn terrain(heights: &[Vec<f64>]) -> Mesh {
    let p = |i: usize, j: usize| [i as f64, j as f64, heights[i][j]];
    let cell = |i: usize, j: usize| [[p(i, j), p(i + 1, j), p(i + 1, j + 1)], [p(i, j), p(i + 1, j + 1), p(i, j + 1)]];
    let (n, m) = (heights.len() - 1, heights[0].len() - 1);
    mesh(&(0..n).flat_map(|i| (0..m).flat_map(move |j| cell(i, j))).collect::<Vec<_>>())
}

fn cutters() -> [Cutter; 4] {
    [Cutter::Flat, Cutter::Ball, Cutter::Bull { corner: 0.7 }, Cutter::Cone { angle: 1.2 }]
}

/// The tip's height by samples of every facet: never above the truth.
fn sampled(mesh: &Mesh, profile: &Profile, c: Point, samples: usize) -> f64 {
    let mut best = f64::NEG_INFINITY;
    for f in 0..mesh.facets().len() {
        let [a, b, d] = mesh.corners(f);
        for i in 0..=samples {
            for j in 0..=samples - i {
                let (s, t) = (i as f64 / samples as f64, j as f64 / samples as f64);
                let at = |k: usize| a[k] + s * (b[k] - a[k]) + t * (d[k] - a[k]);
                let rho = c.distance(point(at(0), at(1)));
                if rho <= profile.radius() {
                    best = best.max(at(2) - profile.height(rho));
                }
            }
        }
    }
    best + profile.below()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn heights_are_those_of_a_dense_sampling(
        heights in prop::collection::vec(prop::collection::vec(-1.5_f64..1.5, 5), 5),
        x in -0.5_f64..4.5, y in -0.5_f64..4.5, leave in prop::sample::select(vec![0.0, 0.3]),
    ) {
        let mesh = terrain(&heights);
        for cutter in cutters() {
            let surface = ClSurface::new(&mesh, cutter, 1.3, leave);
            let (exact, below) = (surface.height(point(x, y)), sampled(&mesh, &surface.profile, point(x, y), 60));
            prop_assert!(exact >= below - 1e-9, "{cutter:?}: {exact} below {below}");
            // Samples lie within 1/60 of any contact: the slopes there bound what they miss, the rim of the cutter apart.
            let grown = ClSurface::new(&mesh, cutter, 1.3 - 0.05, leave);
            let rim = sampled(&mesh, &surface.profile, point(x, y), 240).max(grown.height(point(x, y)) - 1.0);
            prop_assert!(exact <= rim.max(below) + 0.35, "{cutter:?}: {exact} above {rim}");
            prop_assert!(!surface.is_free(point(x, y), exact - 1e-9) && surface.is_free(point(x, y), exact + 1e-9));
        }
    }

    #[test]
    fn a_plane_is_cleared_by_what_its_slope_says(gx in -2.0_f64..2.0, gy in -2.0_f64..2.0) {
        let z = |x: f64, y: f64| [x, y, gx * x + gy * y];
        let mesh = mesh(&[[z(-50.0, -50.0), z(50.0, -50.0), z(0.0, 70.0)]]);
        let slope = gx.hypot(gy);
        for leave in [0.0, 0.4] {
            let secant = slope.hypot(1.0);
            let above = |cutter| ClSurface::new(&mesh, cutter, 3.0, leave).height(Point::ORIGIN);
            let leave = leave * secant;
            prop_assert!((above(Cutter::Flat) - (3.0 * slope + leave)).abs() < 1e-9);
            prop_assert!((above(Cutter::Ball) - (3.0 * (secant - 1.0) + leave)).abs() < 1e-9);
            let bull = above(Cutter::Bull { corner: 1.0 });
            prop_assert!((bull - (2.0 * slope + secant - 1.0 + leave)).abs() < 1e-9);
        }
    }
}

#[test]
fn a_cone_stands_on_its_tip_and_on_edges() {
    let ridge = mesh(&[
        [[-9.0, -9.0, 0.0], [9.0, 0.0, 0.0], [-9.0, 9.0, 0.0]],
        [[5.0, 1.0, 0.0], [5.0, 1.0, 4.0], [5.0, -1.0, 4.0]],
    ]);
    let cone = ClSurface::new(&ridge, Cutter::Cone { angle: std::f64::consts::FRAC_PI_2 }, 6.0, 0.0);
    assert_eq!(cone.height(Point::ORIGIN), 0.0);
    assert!((cone.height(point(3.0, 0.0)) - 2.0).abs() < 1e-12);
}

/// A block with a square pocket of vertical walls.
fn pocket() -> Mesh {
    let (a, b, low, high) = (10.0, 30.0, -8.0, 0.0);
    let quad = |p: [Corner; 4]| [[p[0], p[1], p[2]], [p[0], p[2], p[3]]];
    let at = |x: f64, y: f64, z: f64| [x, y, z];
    let mut out = Vec::new();
    let corners = [(a, a), (b, a), (b, b), (a, b)];
    let outer = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)];
    for k in 0..4 {
        let ((x0, y0), (x1, y1)) = (corners[k], corners[(k + 1) % 4]);
        let ((u0, v0), (u1, v1)) = (outer[k], outer[(k + 1) % 4]);
        out.extend(quad([at(u0, v0, high), at(u1, v1, high), at(x1, y1, high), at(x0, y0, high)]));
        out.extend(quad([at(x0, y0, high), at(x1, y1, high), at(x1, y1, low), at(x0, y0, low)]));
    }
    out.extend(quad(corners.map(|(x, y)| at(x, y, low))));
    mesh(&out)
}

#[test]
fn contours_of_a_pocket_are_its_walls_moved_in_by_the_radius() {
    let mesh = pocket();
    for (cutter, z, inset) in [
        (Cutter::Flat, -4.0, 3.0),
        (Cutter::Ball, -4.0, 3.0),
        (Cutter::Ball, -1.0, f64::sqrt(9.0 - 4.0)),
        (Cutter::Bull { corner: 1.0 }, -8.0, 3.0),
    ] {
        let surface = ClSurface::new(&mesh, cutter, 3.0, 0.0);
        let grid = HeightGrid::new(&surface, mesh.bbox(), 0.7);
        let region = grid.free_region(&surface, z, &|p| mesh.bbox().inflated(-4.0).contains(p)).unwrap();
        assert_eq!(region.contours().len(), 1, "{cutter:?}");
        let side = 20.0 - 2.0 * inset;
        assert!((region.area() - side * side).abs() < 0.2, "{cutter:?}: {} {}", region.area(), side * side);
        // The line lies on the walls' parallels within the tolerances, and never beyond them.
        for s in region.segments() {
            for k in 0..=4 {
                let p = s.at(f64::from(k) / 4.0);
                let off = [p.x - 10.0, 30.0 - p.x, p.y - 10.0, 30.0 - p.y].into_iter().fold(f64::INFINITY, f64::min);
                assert!(off > inset - 0.0021 && off < inset + 0.01, "{cutter:?} at {p:?}: {off}");
            }
        }
    }
}

#[test]
fn contours_around_a_pin_are_circles_within_tolerance() {
    let tip = [0.0, 0.0, 5.0];
    let base = |k: u32| {
        let turn = f64::from(k) * std::f64::consts::TAU / 12.0;
        [0.01 * turn.cos(), 0.01 * turn.sin(), 0.0]
    };
    let mesh = mesh(&(0..12).map(|k| [base(k), base(k + 1), tip]).collect::<Vec<_>>());
    let surface = ClSurface::new(&mesh, Cutter::Ball, 4.0, 0.0);
    let grid = HeightGrid::new(&surface, mesh.bbox().inflated(9.0), 0.5);
    for z in [1.5, 3.0, 4.5] {
        let rise: f64 = 4.0 - (5.0 - z);
        let radius = (16.0 - rise * rise).sqrt();
        let lines = grid.contours(&surface, z, &|_| true);
        assert_eq!(lines.len(), 2);
        let around =
            lines.iter().min_by(|a, b| a[0].distance(Point::ORIGIN).total_cmp(&b[0].distance(Point::ORIGIN))).unwrap();
        let middles = around.iter().zip(around.iter().cycle().skip(1)).map(|(a, b)| a.midpoint(*b));
        for p in around.iter().copied().chain(middles) {
            let off = p.distance(Point::ORIGIN) - radius;
            assert!(off.abs() < 0.004 + 0.01, "{z}: {off}");
        }
    }
}
