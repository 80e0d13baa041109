//! Stars, gears, combs and labyrinths; extreme angles; copies.

use crate::corpus::compare;
use pocketry_testkit::corpus::region;
use pocketry_testkit::shapes;

#[test]
fn simple_shapes_agree_with_the_definition() {
    for loops in [vec![shapes::comb(5, 20.0)], vec![shapes::ngon(7, 10.0, [0.0; 2])], shapes::smooth_with_islands(400, false)] {
        let outcome = compare(&region(&loops).unwrap(), &[0.1, 0.4, 0.5, 0.7, 2.0]);
        assert_eq!(outcome.wrong, Vec::<String>::new());
    }
}
