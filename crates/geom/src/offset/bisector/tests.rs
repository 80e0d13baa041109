use super::*;
use crate::repair::{RepairOptions, build};

fn region(loops: &[&[[f64; 2]]]) -> Region {
    let contour = |l: &&[[f64; 2]]| Contour::from_vertices(&l.iter().map(|v| [v[0], v[1], 0.0]).collect::<Vec<_>>());
    build(loops.iter().map(contour).collect(), &RepairOptions::default()).unwrap().region
}

#[test]
fn a_convex_contour_with_one_valid_edge_has_no_offset_beyond_its_depth() {
    let corners = [[201.874332, 34.462776], [202.088337, 34.604283], [202.088337, 34.402494], [201.91706, 34.281151]];
    let offsets = BisectorEngine::default().offsets(&region(&[&corners]), &[0.10415], &OffsetOptions::default());
    assert!(offsets.unwrap()[0].loops.is_empty());
}
