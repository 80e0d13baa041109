use super::*;
use pocketry_geom::{Segment, point};
use pocketry_motion::{Cutter, Move, Stock};

/// The triangles of a box, facing outwards.
fn cuboid(low: [f64; 3], high: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let c = |k: usize| [0, 1, 2].map(|a| if k >> a & 1 == 1 { high[a] } else { low[a] });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads.iter().flat_map(|q| [[c(q[0]), c(q[1]), c(q[2])], [c(q[0]), c(q[2]), c(q[3])]]).collect()
}

fn quiet(_: usize, _: usize) {}

#[test]
fn a_boss_is_entered_from_outside_the_stock_and_cut_to_its_foot() {
    let mut boss = cuboid([0.0, 0.0, -10.0], [60.0, 50.0, -9.0]);
    boss.extend(cuboid([20.0, 15.0, -9.0], [40.0, 35.0, 0.0]));
    let mesh = Mesh::weld(&boss, 0.0).mesh;
    let stock = Block::around(&mesh, 0.0);
    let job = RoughJob { stepdown: 3.0, ..RoughJob::new(8.0, Cutter::Flat, stock) };
    let plan = rough(&mesh, &job, &quiet).unwrap();
    assert_eq!(plan.levels.len(), 3, "nothing is left to cut at the stock's bottom");
    plan.program.check(&Stock { top: 0.0, depth: 10.0 }).unwrap();
    let mut cut: Vec<(f64, Segment)> = Vec::new();
    for (from, step) in plan.program.steps() {
        let to = step.to();
        if step.feed().is_some() && to.z < from.z {
            assert_eq!(from.xy(), to.xy(), "neither helix nor ramp is needed");
            let cleared = |(z, path): &(f64, Segment)| *z <= to.z && path.distance(to.xy()) < 1e-3;
            assert!(stock.distance(to.xy()) >= 4.0 || cut.iter().any(cleared), "entered uncut stock at {to:?}");
        }
        cut.push((to.z, step.plan_view(from.xy())));
    }
}

#[test]
fn a_cavity_is_entered_by_helix_and_its_surroundings_are_let_alone() {
    let mut cavity = cuboid([0.0, 0.0, -10.0], [60.0, 50.0, 0.0]);
    let mut hollow = cuboid([10.0, 10.0, -6.0], [50.0, 40.0, 0.0]);
    for t in &mut hollow {
        t.swap(1, 2);
    }
    // The top of the hollow is open.
    hollow.retain(|t| t.iter().any(|c| c[2] < 0.0));
    cavity.retain(|t| t.iter().any(|c| c[2] < 0.0));
    cavity.extend(hollow);
    let frame = [[0.0, 0.0], [60.0, 0.0], [60.0, 50.0], [0.0, 50.0]];
    let rim = [[10.0, 10.0], [50.0, 10.0], [50.0, 40.0], [10.0, 40.0]];
    for k in 0..4 {
        let at = |c: [f64; 2]| [c[0], c[1], 0.0];
        let (a, b, c, d) = (at(frame[k]), at(frame[(k + 1) % 4]), at(rim[(k + 1) % 4]), at(rim[k]));
        cavity.extend([[a, b, c], [a, c, d]]);
    }
    let mesh = Mesh::weld(&cavity, 0.0).mesh;
    assert!(mesh.flaws().is_sound());
    let job = RoughJob {
        stepdown: 3.0,
        stock_to_leave: 0.5,
        ..RoughJob::new(8.0, Cutter::Bull { corner: 1.0 }, Block::around(&mesh, 0.0))
    };
    let plan = rough(&mesh, &job, &quiet).unwrap();
    assert_eq!(plan.levels.len(), 2);
    let deepest = plan.program.moves.iter().map(|m| m.to().z).fold(0.0, f64::min);
    assert_eq!(deepest, -5.0, "the last level that keeps the stock to leave: levels are 2.5 mm apart");
    assert!(plan.program.moves.iter().any(|m| matches!(m, Move::Arc { .. })));
    let middle = point(30.0, 25.0);
    for m in &plan.program.moves {
        let p = m.to().xy();
        assert!((p.x - middle.x).abs() <= 15.5 && (p.y - middle.y).abs() <= 10.5, "{p:?}");
    }
}

#[test]
fn a_stepover_above_the_radius_is_clamped_to_it() {
    let mut boss = cuboid([0.0, 0.0, -10.0], [60.0, 50.0, -9.0]);
    boss.extend(cuboid([20.0, 15.0, -9.0], [40.0, 35.0, 0.0]));
    let mesh = Mesh::weld(&boss, 0.0).mesh;
    let job = RoughJob { stepover: 4.0, ..RoughJob::new(8.0, Cutter::Flat, Block::around(&mesh, 8.0)) };
    let wide = rough(&mesh, &RoughJob { stepover: 7.5, ..job }, &quiet).unwrap();
    assert_eq!(wide.stepover, 4.0);
    assert_eq!(wide.program, rough(&mesh, &job, &quiet).unwrap().program);
}

/// Loops of every engine cover the floor around a boss; ways stay clear of it.
#[test]
fn every_engine_leaves_nothing_around_a_boss() {
    let mut boss = cuboid([0.0, 0.0, -4.0], [60.0, 50.0, -3.0]);
    boss.extend(cuboid([20.0, 15.0, -3.0], [40.0, 35.0, 0.0]));
    // A thin wall: long mitres of the boss's corners would reach through it.
    boss.extend(cuboid([8.0, 5.0, -3.0], [9.0, 45.0, 0.0]));
    let mesh = Mesh::weld(&boss, 0.0).mesh;
    for engine in [Engine::Voronoi, Engine::Pairwise, Engine::Bisector] {
        let job = RoughJob { stepdown: 3.0, engine, ..RoughJob::new(6.0, Cutter::Flat, Block::around(&mesh, 0.0)) };
        let plan = rough(&mesh, &job, &quiet).unwrap();
        let level = &plan.levels[0];
        let steps: Vec<Segment> = plan.program.steps().map(|(from, m)| m.plan_view(from.xy())).collect();
        let cut: Vec<Segment> = plan
            .program
            .steps()
            .zip(steps)
            .filter(|((from, m), _)| from.z == level.z && m.to().z == level.z)
            .map(|s| s.1)
            .collect();
        for k in 0..=60 * 50 {
            let p = point(f64::from(k % 61), f64::from(k / 61));
            let wanted = level.region.contains(p) && cut.iter().all(|s| s.distance(p) > 3.0);
            assert!(!wanted, "{engine:?}: {p:?} is uncut");
        }
        let walls = pocketry_geom::distance::Boundary::new(&level.region);
        for s in &cut {
            assert!(walls.contains(s.start()) && walls.distance_to(s) > 1e-3, "{engine:?}: {s:?} leaves the region");
        }
    }
}

#[test]
fn jobs_that_make_no_sense_are_refused() {
    let mesh = Mesh::weld(&cuboid([0.0; 3], [10.0; 3]), 0.0).mesh;
    let stock = Block::around(&mesh, 0.0);
    let good = RoughJob::new(4.0, Cutter::Flat, stock);
    assert!(matches!(rough(&mesh, &good, &quiet), Err(RoughError::NothingToCut { .. })));
    for bad in [
        RoughJob { cutter: Cutter::Bull { corner: 3.0 }, ..good },
        RoughJob { stepdown: 0.0, ..good },
        RoughJob { stepdown: 1e-7, ..good },
        RoughJob { cell: 1e-6, ..good },
        RoughJob { stock_to_leave: f64::NAN, ..good },
        RoughJob { stock: Block { low: [0.0; 3], high: [0.0; 3] }, ..good },
    ] {
        assert!(rough(&mesh, &bad, &quiet).is_err(), "{bad:?}");
    }
}
