//! The third contact of a pencil of disks: guess and verify in closed form, or search with a bracket.

use super::cycle::{Junction, closed_pencil_radius};
use super::element::{Carrier, Disk, Element};
use super::recursion::Scene;
use super::vertex;
use crate::point::{Point, Vec2};
use crate::tolerance::skeleton as tol;

/// What ends the skeleton edge between two cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// The third element.
    pub(super) element: u32,
    /// The disk that touches all three.
    pub(super) disk: Disk,
    /// Whether a closed form or, where it was searched for, a look at the whole boundary vouches for it.
    pub(super) vouched: bool,
}

/// The element between `a` and `b` that ends the skeleton edge between their cells.
pub(super) fn third_contact(scene: &Scene, (a, b): (u32, u32), parent: Disk) -> Contact {
    match guess_and_verify(scene, (a, b), parent) {
        Some((element, disk)) => Contact { element, disk, vouched: true },
        None => bracketed(scene, (a, b), parent),
    }
}

/// Start from a neighbour of `a` or `b`; each verification that finds a nearer element makes it the next guess.
/// `None` where a closed form fails.
fn guess_and_verify(scene: &Scene, (a, b): (u32, u32), parent: Disk) -> Option<(u32, Disk)> {
    let elements = &scene.cycle.elements;
    let (mut c, mut disk) = first_guess(scene, (a, b), parent)?;
    for _ in 0..tol::GUESSES {
        if is_same(disk, parent) {
            return Some((c, disk));
        }
        let bound = disk.radius - tol::EMPTY;
        let Some((hit, _)) = scene.heap.nearest(elements, (a + 1, b - 1), disk.center, bound) else {
            return Some((c, disk));
        };
        let hit = facing_neighbor(scene, (a, b), hit, disk);
        if hit == c {
            return None;
        }
        (c, disk) = touching_near(scene, (a, hit, b), parent)?;
    }
    None
}

fn first_guess(scene: &Scene, (a, b): (u32, u32), parent: Disk) -> Option<(u32, Disk)> {
    let elements = &scene.cycle.elements;
    let front = touching(scene, (a, a + 1, b), parent);
    if b - a == 2 {
        return front.map(|disk| (a + 1, disk));
    }
    match front {
        Some(disk) if elements[b as usize - 1].distance(disk.center) >= disk.radius - tol::EMPTY => Some((a + 1, disk)),
        _ => {
            // where the neighbours are arcs too tight for the disk, the vertices beyond them, or whatever lies nearest
            let nearest = || {
                let hit = scene.heap.nearest(elements, (a + 1, b - 1), parent.center, f64::INFINITY);
                hit.and_then(|(k, _)| touching_near(scene, (a, k, b), parent))
            };
            let guess = |k: u32| touching(scene, (a, k, b), parent).map(|disk| (k, disk));
            guess(b - 1)
                .or(front.map(|disk| (a + 1, disk)))
                .or_else(|| guess(a + 2))
                .or_else(|| guess(b - 2))
                .or_else(nearest)
        }
    }
}

/// Follow the wall from `c` to the element, still between `a` and `b` and within reach of the disk, whose extent holds
/// the foot of the disk's centre.
fn facing_neighbor(scene: &Scene, (a, b): (u32, u32), mut c: u32, disk: Disk) -> u32 {
    for _ in 0..tol::HOPS {
        let e = &scene.cycle.elements[c as usize];
        let (before, after) = e.overshoot(disk.center);
        if before <= tol::EXTENT && after <= tol::EXTENT {
            break;
        }
        let k =
            if e.is_left_at_start(disk.center) { scene.cycle.before_on_wall(c) } else { scene.cycle.after_on_wall(c) };
        let is_candidate = k > a && k < b;
        if !is_candidate || scene.cycle.elements[k as usize].distance(disk.center) > disk.radius + tol::REACH {
            break;
        }
        c = k;
    }
    c
}

/// Like [`touching`] for `c` or, where the disk leaves the extent of `c`, a neighbour of it on the wall.
fn touching_near(scene: &Scene, (a, c, b): (u32, u32, u32), parent: Disk) -> Option<(u32, Disk)> {
    if let Some(disk) = touching(scene, (a, c, b), parent) {
        return Some((c, disk));
    }
    [scene.cycle.before_on_wall(c), scene.cycle.after_on_wall(c)]
        .into_iter()
        .filter(|&k| k > a && k < b)
        .find_map(|k| touching(scene, (a, k, b), parent).map(|disk| (k, disk)))
}

fn is_same(a: Disk, b: Disk) -> bool {
    (a.radius - b.radius).abs() <= tol::SAME_DISK && (a.center - b.center).length_squared() <= tol::SAME_DISK.powi(2)
}

/// The first disk after the parent's that touches `a`, `c` and `b` in this order, each in its extent; `None` where the
/// closed form finds none that it can vouch for.
fn touching(scene: &Scene, (a, c, b): (u32, u32, u32), parent: Disk) -> Option<Disk> {
    let e = [a, c, b].map(|k| &scene.cycle.elements[k as usize]);
    if e[0].site == e[1].site || e[1].site == e[2].site {
        return None;
    }
    let mut spokes = spokes_among(scene, (a, c, b));
    if let Some((foot, normal, other)) = spokes.next() {
        if let Some((_, _, another)) = spokes.next() {
            let shared = [a, c, b].into_iter().find(|&k| k != other && k != another).unwrap_or(c);
            return between_spokes(e, &scene.cycle.elements[shared as usize]);
        }
        let other = &scene.cycle.elements[other as usize];
        let radius = other.pencil_radius(foot, normal);
        let disk = Disk { center: foot + normal * radius, radius };
        let limit = inside_limit(e);
        let fits = radius > tol::EMPTY && radius <= limit && radius.is_finite();
        return (fits && other.faces(disk.center, tol::EXTENT)).then_some(disk);
    }
    let mut best: Option<(f64, Disk)> = None;
    for candidate in vertex::touching_three(e).iter() {
        let (disk, error) = vertex::polish(e, candidate);
        if error > tol::RESIDUAL || disk.radius < 0.0 || disk.radius > tol::LARGEST_DISK {
            continue;
        }
        if !e.iter().all(|e| e.faces(disk.center, tol::EXTENT)) || contact_order(e, disk) < -tol::ORDER {
            continue;
        }
        let progress = advance(e[0], parent.center, disk.center) - advance(e[2], parent.center, disk.center);
        if progress >= -tol::FOOT && best.is_none_or(|(least, _)| progress < least) {
            best = Some((progress, disk));
        }
    }
    best.map(|(_, disk)| disk)
}

/// No disk inside the region is larger than the frame, nor one inside an arc larger than it.
fn inside_limit(e: [&Element; 3]) -> f64 {
    e.iter().filter(|e| e.carrier == Carrier::Inside).map(|e| -e.rho + tol::EMPTY).fold(tol::LARGEST_DISK, f64::min)
}

/// Where two of the three meet in a spoke: its foot, its normal and the third element.
fn spokes_among(scene: &Scene, (a, c, b): (u32, u32, u32)) -> impl Iterator<Item = (Point, Vec2, u32)> {
    let joined = [(c == a + 1, c, b), (b == c + 1, b, a), (a == 0 && b + 1 == scene.len(), 0, c)];
    joined.into_iter().filter_map(|(adjacent, junction, other)| match scene.cycle.junctions[junction as usize] {
        Junction::Spoke(_, normal) if adjacent => Some((scene.cycle.elements[junction as usize].start, normal, other)),
        _ => None,
    })
}

/// The two spokes of one element meet only if it is an arc seen from inside, and then in its centre; those of a reflex
/// vertex, of a line or of an arc seen from outside never do.
fn between_spokes(e: [&Element; 3], shared: &Element) -> Option<Disk> {
    let disk = Disk { center: shared.center, radius: -shared.rho };
    (shared.carrier == Carrier::Inside && vertex::residual(e, disk) <= tol::FOOT).then_some(disk)
}

/// Twice the signed area of the triangle of contacts: positive where they follow one another counter-clockwise.
fn contact_order(e: [&Element; 3], disk: Disk) -> f64 {
    let [p, q, r] = e.map(|e| e.normal_at(disk.center) * -disk.radius);
    (q - p).cross(r - p)
}

/// How far the foot on an element moves forward when a disk's centre goes from one place to another; a monotone
/// measure, not a length.
pub(super) fn advance(e: &Element, from: Point, to: Point) -> f64 {
    if e.is_line() {
        return (to - from).dot(e.along());
    }
    let (n0, n1) = (e.normal_at(from), e.normal_at(to));
    let scale = if e.rho == 0.0 { (to - e.center).length() } else { e.rho.abs() };
    if e.wide {
        // the shorter way between two feet may lead through the gap
        return scale * (e.turn_from_middle(n1) - e.turn_from_middle(n0));
    }
    let turn = if e.carrier == Carrier::Outside { n1.cross(n0) } else { n0.cross(n1) };
    // beyond a quarter turn the sine falls again
    scale * if n0.dot(n1) >= 0.0 { turn } else { (2.0 - turn.abs()).copysign(turn) }
}

/// A one-parameter family of disks, each touching `a` at a foot and, as far as it reaches, the closed `b`.
struct Pencil<'a> {
    walker: &'a Element,
    other: &'a Element,
    from: (Point, Vec2),
    to: (Point, Vec2),
    /// The turn of the normals between the two.
    turn: f64,
    limit: f64,
    parent: Disk,
}

impl<'a> Pencil<'a> {
    fn new(walker: &'a Element, other: &'a Element, parent: Disk, forward: bool) -> Self {
        let to = if forward { (walker.end, walker.n1) } else { (walker.start, walker.n0) };
        let (before, after) = walker.overshoot(parent.center);
        let (behind, ahead) = if forward { (before, after) } else { (after, before) };
        let from = if ahead > 0.0 {
            to
        } else if behind > 0.0 {
            if forward { (walker.start, walker.n0) } else { (walker.end, walker.n1) }
        } else {
            (walker.foot(parent.center), walker.normal_at(parent.center))
        };
        let turn = if walker.is_line() { 0.0 } else { signed_turn(walker, from.1, to.1, forward) };
        let limit = inside_limit([walker, other, other]);
        Self { walker, other, from, to, turn, limit, parent }
    }

    /// Whether the walk covers any ground.
    fn is_stuck(&self) -> bool {
        self.turn == 0.0 && (self.from.0 - self.to.0).length_squared() == 0.0
    }

    /// How far the foot is from where the walk starts, and the normal there.
    fn step_at(&self, t: f64) -> (Vec2, Vec2) {
        if self.walker.is_line() {
            return ((self.to.0 - self.from.0) * t, self.from.1);
        }
        let (sin, cos) = (0.5 * self.turn * t).sin_cos();
        let difference = (self.from.1.left() * cos - self.from.1 * sin) * (2.0 * sin);
        (difference * self.walker.rho, self.from.1 + difference)
    }

    fn disk_at(&self, t: f64) -> Disk {
        if t <= 0.0 {
            return self.parent;
        }
        let (base, (offset, n)) =
            if t >= 1.0 { (self.to.0, (Vec2::ZERO, self.to.1)) } else { (self.from.0, self.step_at(t)) };
        let radius = closed_pencil_radius(self.other, base, offset, n).min(self.limit);
        Disk { center: base + (offset + n * radius), radius }
    }
}

fn signed_turn(e: &Element, from: Vec2, to: Vec2, forward: bool) -> f64 {
    let clockwise = (e.carrier == Carrier::Outside) == forward;
    let angle = from.angle_to(to);
    if angle.abs() <= tol::FOOT {
        angle
    } else if clockwise && angle > 0.0 {
        angle - std::f64::consts::TAU
    } else if !clockwise && angle < 0.0 {
        angle + std::f64::consts::TAU
    } else {
        angle
    }
}

/// The search that always answers: walk the foot along `a` (or, where that has no room, back along `b`, or the radius
/// along their common spoke) and bisect on whatever the disk hits.
fn bracketed(scene: &Scene, (a, b): (u32, u32), parent: Disk) -> Contact {
    let (ea, eb) = (&scene.cycle.elements[a as usize], &scene.cycle.elements[b as usize]);
    let spoke = match scene.cycle.junctions[0] {
        Junction::Spoke(_, normal) if a == 0 && b + 1 == scene.len() => Some((ea.start, normal)),
        _ => None,
    };
    let limit = inside_limit([ea, eb, eb]);
    if let Some((foot, normal)) = spoke {
        let disk_at = |t: f64| Disk { center: foot + normal * (t * limit), radius: t * limit };
        return first_hit(scene, (a, b), disk_at, |_| f64::NEG_INFINITY, (a + 1, b - 1));
    }
    let along_a = Pencil::new(ea, eb, parent, true);
    if !along_a.is_stuck() {
        return first_hit(scene, (a, b), |t| along_a.disk_at(t), |d| eb.overshoot(d.center).0, (a + 1, b - 1));
    }
    let along_b = Pencil::new(eb, ea, parent, false);
    if !along_b.is_stuck() {
        return first_hit(scene, (a, b), |t| along_b.disk_at(t), |d| ea.overshoot(d.center).1, (b - 1, a + 1));
    }
    nearest_neighbor(scene, (a, b), parent)
}

/// Nowhere to go: the vertex coincides with the parent's, and the element nearest to its circle is the third.
fn nearest_neighbor(scene: &Scene, (a, b): (u32, u32), parent: Disk) -> Contact {
    let bound = f64::INFINITY;
    let hit = scene.heap.nearest(&scene.cycle.elements, (a + 1, b - 1), parent.center, bound);
    let element = hit.map_or(a + 1, |(k, _)| k);
    Contact { element, disk: parent, vouched: is_sound(scene, (a, element, b), parent) }
}

/// Whether a disk touches all three elements within their extents, in order, and nothing reaches into it.
fn is_sound(scene: &Scene, (a, c, b): (u32, u32, u32), disk: Disk) -> bool {
    let e = [a, c, b].map(|k| &scene.cycle.elements[k as usize]);
    vertex::residual(e, disk) <= tol::SOUND
        && e.iter().all(|e| e.faces(disk.center, tol::FOOT))
        && contact_order(e, disk) >= -tol::FOOT
        && scene
            .heap
            .nearest(&scene.cycle.elements, (0, scene.len() - 1), disk.center, disk.radius - tol::SOUND)
            .is_none()
}

/// The first disk of a family, `t` from 0 to 1, that touches an element between `a` and `b`. A disk whose foot has left
/// the element that doesn't lead the walk (by `overrun`) is one that `neighbor`, the next one there, has met; a walk
/// that meets nothing ends with `beyond`, the next one after the element that leads it.
fn first_hit(
    scene: &Scene,
    (a, b): (u32, u32),
    disk_at: impl Fn(f64) -> Disk,
    overrun: impl Fn(Disk) -> f64,
    (beyond, neighbor): (u32, u32),
) -> Contact {
    let elements = &scene.cycle.elements;
    let hit_at = |t: f64| {
        let disk = disk_at(t);
        let bound = disk.radius - tol::EMPTY;
        let hit = scene.heap.nearest(elements, (a + 1, b - 1), disk.center, bound).map(|(k, _)| k);
        hit.or((overrun(disk) > tol::EMPTY).then_some(neighbor))
    };
    let (low, mut high) = first_blocked(|t| hit_at(t).is_some());
    let mut found = None;
    for _ in 0..tol::GUESSES {
        let Some(hit) = hit_at(high).filter(|&k| found != Some(k)) else { break };
        let e = &elements[hit as usize];
        let depth = |t: f64| {
            let d = disk_at(t);
            let gap = e.distance(d.center) - d.radius;
            if hit == neighbor { gap.min(-overrun(d)) } else { gap }
        };
        high = first_touch(depth, low, high);
        found = Some(hit);
        if let Some((element, disk)) = verified(scene, (a, b), hit, disk_at(high), disk_at(0.0)) {
            return Contact { element, disk, vouched: true };
        }
    }
    let (element, disk) = owner(scene, (a, b), found.unwrap_or(beyond), disk_at(high));
    Contact { element, disk, vouched: is_sound(scene, (a, element, b), disk) }
}

/// The first of some samples from 0 to 1 that is blocked (or the last) and the one before it. Behind a wall a disk may be
/// empty again: bisection alone could end up there. Most walks end early, so the samples lie close there.
fn first_blocked(is_blocked: impl Fn(f64) -> bool) -> (f64, f64) {
    let sample = |k: u32| (f64::from(k) / f64::from(tol::SAMPLES)).powi(4);
    let first = (1..tol::SAMPLES).find(|&k| is_blocked(sample(k))).unwrap_or(tol::SAMPLES);
    (sample(first - 1), sample(first))
}

/// The disk in closed form that the bracket has come near to, if it is empty.
fn verified(scene: &Scene, (a, b): (u32, u32), hit: u32, near: Disk, parent: Disk) -> Option<(u32, Disk)> {
    let c = facing_neighbor(scene, (a, b), hit, near);
    let (c, disk) = touching_near(scene, (a, c, b), parent)?;
    let bound = disk.radius - tol::EMPTY;
    let hit = scene.heap.nearest(&scene.cycle.elements, (a + 1, b - 1), disk.center, bound);
    hit.is_none().then_some((c, disk))
}

/// The `t` at which `depth` falls to 0, by bisection: `depth(low) >= 0 > depth(high)`.
fn first_touch(depth: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if high - low <= tol::BISECTION || middle <= low || middle >= high {
            return low;
        }
        if depth(middle) < -tol::EMPTY {
            high = middle;
        } else {
            low = middle;
        }
    }
}

/// The element that owns the contact; the disk is refined on all three.
fn owner(scene: &Scene, (a, b): (u32, u32), hit: u32, disk: Disk) -> (u32, Disk) {
    let c = facing_neighbor(scene, (a, b), hit, disk);
    let e = [a, c, b].map(|k| &scene.cycle.elements[k as usize]);
    let (better, error) = vertex::polish(e, disk);
    let sound = error < vertex::residual(e, disk)
        && (better.center - disk.center).length() <= tol::FOOT
        && e.iter().all(|e| e.faces(better.center, tol::FOOT));
    (c, if sound { better } else { disk })
}
