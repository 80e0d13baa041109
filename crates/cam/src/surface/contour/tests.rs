//! Lines are simple whatever the surface answers, and the same wherever the grid lies.

use super::*;
use pocketry_geom::distance::Boundary;
use pocketry_geom::mesh::{Corner, Mesh};
use pocketry_geom::predicates::orientation;
use pocketry_geom::{BBox, point, vec2};
use pocketry_motion::Cutter;
use proptest::prelude::*;

/// Distance of the grids' nodes, mm.
const CELL: f64 = 0.5;

/// A block with a wavy top and upright sides, `[x, y, z]` from 0 to `size`, -20 and about -4.
fn waves(size: f64, count: usize) -> Vec<[Corner; 3]> {
    let place = |k: usize| k as f64 * size / count as f64;
    let top = |i: usize, j: usize| -4.0 + 3.0 * (0.35 * place(i)).sin() * (0.3 * place(j) + 0.4).cos();
    let at = |i: usize, j: usize| [place(i), place(j), top(i, j)];
    let foot = |[x, y, _]: Corner| [x, y, -20.0];
    let mut out = Vec::new();
    let mut quad = |a: Corner, b: Corner, c: Corner, d: Corner| out.extend([[a, b, c], [a, c, d]]);
    for i in 0..count {
        for j in 0..count {
            quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
        let sides = [
            (at(i, 0), at(i + 1, 0)),
            (at(count, i), at(count, i + 1)),
            (at(i + 1, count), at(i, count)),
            (at(0, i + 1), at(0, i)),
        ];
        for (a, b) in sides {
            quad(foot(a), foot(b), b, a);
        }
    }
    let corners = [at(0, 0), at(0, count), at(count, count), at(count, 0)].map(foot);
    quad(corners[0], corners[1], corners[2], corners[3]);
    out
}

/// The free ground around and over the waves: on a grid of 0.5 mm that starts `off` to the left of and below the model's box,
/// as far as the plate of the machine goes, which turns and moves with the model.
fn free(model: &[[Corner; 3]], z: f64, off: f64, onto_plate: &(dyn Fn(Point) -> Point + Sync)) -> Region {
    let mesh = Mesh::weld(model, 0.0).mesh;
    let surface = ClSurface::new(&mesh, Cutter::Bull { corner: 2.0 }, 5.0, 0.5);
    let bbox = mesh.bbox();
    let bounds = BBox::of(bbox.min - vec2(off, off), bbox.max + vec2(7.0, 7.0));
    let grid = HeightGrid::new(&surface, bounds, CELL);
    let plate = BBox::of(point(-6.3, -6.3), point(36.3, 36.3));
    let region = grid.free_region(&surface, z, &|p| plate.contains(onto_plate(p))).unwrap();
    on_free_ground(&region, |p| surface.is_free(p, z) && plate.contains(onto_plate(p)));
    region
}

/// Fails where a boundary lies farther within what is taken than it may.
fn on_free_ground(region: &Region, is_free: impl Fn(Point) -> bool) {
    let near = 1.01 * (CONTOUR + SIMPLIFY);
    for s in region.segments() {
        for p in (0..8).map(|k| s.at(f64::from(k) / 8.0)) {
            let around = (0..32).map(|k| f64::from(k) * std::f64::consts::TAU / 32.0);
            let mut around = around.map(|t| p + vec2(t.cos(), t.sin()) * near);
            assert!(is_free(p) || around.any(&is_free), "{p:?} is taken");
        }
    }
}

/// Fails where a disk as wide as two cells is free in one region, moved, and not in the other: only what is narrower may be lost.
fn holds(
    a: &Region,
    in_a: impl Fn(Point) -> Point,
    b: &Region,
    in_b: impl Fn(Point) -> Point,
) -> Result<(), TestCaseError> {
    let (walls, others) = (Boundary::new(a), Boundary::new(b));
    let places =
        (0..60).flat_map(|i| (0..60).map(move |j| point(0.71 * f64::from(i) - 6.2, 0.71 * f64::from(j) - 6.2)));
    for (p, q) in places.map(|p| (in_a(p), in_b(p))).filter(|&(p, _)| a.contains(p)) {
        let room = walls.distance(p);
        if room > CELL {
            prop_assert!(b.contains(q), "{q:?} is not free");
            prop_assert!(others.distance(q) > room - 2.0 * (CONTOUR + SIMPLIFY), "{q:?} has less room than {room}");
        }
    }
    Ok(())
}

/// Sides stand where the grown cutter's rim, 5.5 mm from its axis, meets them: at -5.5 and 35.5.
#[test]
fn a_wall_right_along_the_middle_of_cells_crosses_no_other_line() {
    let model = waves(30.0, 12);
    for z in [-18.0, -6.0, -2.0] {
        let plain = free(&model, z, 6.9, &|p| p);
        // The wall along the middle of cells, along nodes, and next to either.
        for off in [6.75, 7.0, 6.75 + 1e-4, 6.75 - 1e-13, 7.0 + 1e-13, 7.0 - 1e-4] {
            let region = free(&model, z, off, &|p| p);
            holds(&plain, |p| p, &region, |p| p).unwrap();
            holds(&region, |p| p, &plain, |p| p).unwrap();
        }
    }
}

/// A wall just left of a column of nodes bulges over it, into cells through which the wall on the other side of a valley runs.
#[test]
fn a_wall_that_bulges_into_the_cells_of_another_one_keeps_its_bulge() {
    free(&waves(30.0, 8), -3.908_081_247_110_394_5, 6.75, &|p| p);
}

/// An arc that runs out into a straight line: hardly off its chord in the middle, but at a quarter.
#[test]
fn a_line_that_bends_beside_the_middle_of_its_chord_is_followed() {
    free(&waves(30.0, 8), -5.089_468_167_463_877_5, 6.75, &|p| p);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn free_ground_moves_turns_and_mirrors_with_the_model(
        z in -19.0_f64..-1.5, off in 6.5_f64..7.5, dx in -0.5_f64..0.5, dy in -0.5_f64..0.5, turn in 0_u32..4, mirror: bool,
    ) {
        let model = waves(30.0, 8);
        let plain = free(&model, z, 6.75, &|p| p);
        // By right angles: others don't let the plate's sides be found as exactly.
        let turned = |p: Point| (0..turn).fold(p, |p, _| point(-p.y, p.x));
        let back = |p: Point| (0..turn).fold(p, |p, _| point(p.y, -p.x));
        let flip = |p: Point| if mirror { point(-p.x, p.y) } else { p };
        let there = |p: Point| turned(flip(p)) + vec2(dx, dy);
        let home = |p: Point| flip(back(p - vec2(dx, dy)));
        let moved: Vec<[Corner; 3]> = model.iter().map(|t| {
            let [a, b, c] = t.map(|[x, y, z]| { let p = there(point(x, y)); [p.x, p.y, z] });
            if mirror { [a, c, b] } else { [a, b, c] }
        }).collect();
        let other = free(&moved, z, off, &home);
        holds(&plain, |p| p, &other, there)?;
        holds(&other, there, &plain, |p| p)?;
    }

    /// Rooms keep lines apart even if every answer is a toss.
    #[test]
    fn lines_are_simple_whatever_the_surface_answers(seed: u64, step in 0.05_f64..2.0, bias in 0.2_f64..0.8) {
        let mesh = Mesh::weld(&[[[0.0, 0.0, -9.0], [1.0, 0.0, -9.0], [0.0, 1.0, -9.0]]], 0.0).mesh;
        let surface = ClSurface::new(&mesh, Cutter::Flat, 1.0, 0.0);
        let grid = HeightGrid::new(&surface, BBox::of(Point::ORIGIN, point(7.0 * step, 7.0 * step)), step);
        let toss = |p: Point| {
            let mix = (p.x.to_bits() ^ p.y.to_bits().rotate_left(17) ^ seed).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let mix = (mix ^ (mix >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            ((mix >> 40) as f64) < bias * f64::from(1 << 24)
        };
        let lines = grid.contours(&surface, 0.0, &toss);
        let chords: Vec<(usize, [Point; 2])> = lines.iter().enumerate()
            .flat_map(|(k, l)| l.iter().zip(l.iter().cycle().skip(1)).map(move |(&a, &b)| (k, [a, b])))
            .collect();
        for (n, (k, [a, b])) in chords.iter().enumerate() {
            for (m, [c, d]) in &chords[n + 1..] {
                prop_assert!(!touch([*a, *b], [*c, *d]), "lines {k} and {m} at {a:?} and {c:?}");
            }
        }
        prop_assert!(grid.free_region(&surface, 0.0, &toss).is_ok());
    }
}

/// Whether two chords have a point in common other than an end of both.
fn touch([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let sides = [orientation(a, b, c), orientation(a, b, d), orientation(c, d, a), orientation(c, d, b)];
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    if apart(sides[0], sides[1]) || apart(sides[2], sides[3]) {
        return false;
    }
    if sides == [0.0; 4] {
        let boxes = |p: f64, q: f64, r: f64, s: f64| p.max(q) > r.min(s) && r.max(s) > p.min(q);
        return boxes(a.x, b.x, c.x, d.x) || boxes(a.y, b.y, c.y, d.y);
    }
    // Successive chords share an end.
    !(a == c || a == d || b == c || b == d)
}
