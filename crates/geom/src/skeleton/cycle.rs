//! The boundary of one pocket as a single cycle of elements: islands are joined to it by bridges.
//!
//! From each island's outermost point in a fixed direction a disk grows that way until it touches something else. It
//! can't touch its own island, and its contact lies further out, so the bridges form a tree. The direction is one that
//! drawings have no edges along, so that the bridges seldom end at joints. Each bridge runs from the point over the
//! disk's centre to the contact; walking round the outer contour and, at every bridge, round the island behind it gives
//! one cycle. Both elements at a bridge are cut there, even into pieces of zero extent, so that no owner of an end has
//! to be guessed; the pieces are joined again when the skeleton is assembled.

use super::boxes::BoxHeap;
use super::element::{Carrier, Disk, Element};
use crate::point::{Point, Vec2, vec2};
use crate::tolerance::skeleton as tol;

/// What lies between an element of the cycle and the one before it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Junction {
    /// A convex corner at this boundary vertex.
    Convex(u32),
    /// A spoke from this boundary vertex along this normal.
    Spoke(u32, Vec2),
    /// One side of a bridge.
    Bridge(u32),
}

/// The boundary of a pocket before its islands are joined to it: the outer ring first, ring by ring in one array.
#[derive(Debug, Default)]
pub(super) struct Rings {
    /// Whole elements; element `k` is site `k` of the pocket.
    pub(super) elements: Vec<Element>,
    /// `junctions[k]` lies at the start of element `k`.
    pub(super) junctions: Vec<Junction>,
    /// First element of each ring, and the end.
    pub(super) starts: Vec<u32>,
}

/// One closed cycle of elements.
#[derive(Debug, Default)]
pub(super) struct Cycle {
    pub(super) elements: Vec<Element>,
    /// `junctions[k]` lies between element `k - 1` and element `k`.
    pub(super) junctions: Vec<Junction>,
    /// The disk of each bridge.
    pub(super) bridges: Vec<Disk>,
    /// For each bridge the first element behind it and the first one after the way back over it.
    pub(super) crossings: Vec<(u32, u32)>,
}

/// Directions of bridges, one an attempt: of length 1 exactly, and askew to what people draw.
const OUT: [Vec2; 4] = [vec2(-0.936, -0.352), vec2(0.8432, -0.5376), vec2(0.28, 0.96), vec2(-0.352, 0.936)];

/// A foot on an element with the inner normal there.
type Foot = (Point, Vec2);

/// A place where an element is cut.
#[derive(Clone, Copy, Debug)]
struct Cut {
    element: u32,
    along: f64,
    foot: Foot,
    island: u32,
}

impl Cycle {
    /// The cycle of an outer ring and its islands. Each `attempt` begins at another corner and bridges another way.
    pub(super) fn new(rings: &Rings, attempt: usize) -> Self {
        let first = rings.clear_corner(attempt);
        if rings.starts.len() != 2 {
            let mut cycle = Bridging::new(rings, first as u32, OUT[attempt % OUT.len()]).into_cycle();
            cycle.note_crossings();
            return cycle;
        }
        Self { elements: turned(&rings.elements, first), junctions: turned(&rings.junctions, first), ..Self::default() }
    }

    fn note_crossings(&mut self) {
        self.crossings = vec![(u32::MAX, u32::MAX); self.bridges.len()];
        for (k, junction) in self.junctions.iter().enumerate() {
            if let Junction::Bridge(bridge) = *junction {
                let (entry, exit) = &mut self.crossings[bridge as usize];
                *if *entry == u32::MAX { entry } else { exit } = k as u32;
            }
        }
    }

    /// The element before this one along the wall: across a bridge, the other piece of what the bridge cut.
    pub(super) fn before_on_wall(&self, k: u32) -> u32 {
        let n = self.elements.len() as u32;
        match self.junctions[k as usize] {
            Junction::Bridge(bridge) => {
                let (entry, exit) = self.crossings[bridge as usize];
                if k == entry { exit - 1 } else { entry - 1 }
            }
            _ => (k + n - 1) % n,
        }
    }

    /// The element after this one along the wall.
    pub(super) fn after_on_wall(&self, k: u32) -> u32 {
        let next = (k + 1) % self.elements.len() as u32;
        match self.junctions[next as usize] {
            Junction::Bridge(bridge) => {
                let (entry, exit) = self.crossings[bridge as usize];
                if next == entry { exit } else { entry }
            }
            _ => next,
        }
    }
}

impl Rings {
    /// The element of the outer ring at which the cycle starts: the recursion's root is best conditioned at a corner
    /// near 90°. Later attempts take the next best ones.
    fn clear_corner(&self, attempt: usize) -> usize {
        let end = self.starts[1] as usize;
        let quality = |k: usize| match self.junctions[k] {
            Junction::Convex(_) => 1.0 + self.elements[(k + end - 1) % end].n1.cross(self.elements[k].n0),
            Junction::Spoke(..) | Junction::Bridge(_) => 0.0,
        };
        if attempt == 0 {
            return (0..end).max_by(|&i, &j| quality(i).total_cmp(&quality(j))).unwrap_or(0);
        }
        let mut order: Vec<usize> = (0..end).collect();
        order.sort_by(|&i, &j| quality(j).total_cmp(&quality(i)).then(j.cmp(&i)));
        order[attempt % end]
    }
}

/// The items from `first` round to the one before it.
fn turned<T: Copy>(items: &[T], first: usize) -> Vec<T> {
    [&items[first..], &items[..first]].concat()
}

/// The rings of a pocket and the cuts between them.
struct Bridging<'a> {
    rings: &'a Rings,
    /// The element at which the outer ring's tour starts.
    corner: u32,
    /// The direction in which islands reach out.
    out: Vec2,
    /// Per island: where its tour starts.
    doors: Vec<Cut>,
    /// Cuts by other islands, sorted by element and along it.
    cuts: Vec<Cut>,
    disks: Vec<Disk>,
}

impl<'a> Bridging<'a> {
    fn new(rings: &'a Rings, corner: u32, out: Vec2) -> Self {
        let heap = BoxHeap::new(&rings.elements);
        let mut this = Self { rings, corner, out, doors: Vec::new(), cuts: Vec::new(), disks: Vec::new() };
        for island in 0..rings.starts.len() as u32 - 2 {
            this.bridge(&heap, island);
        }
        this.cuts.sort_by(|a, b| a.element.cmp(&b.element).then(a.along.total_cmp(&b.along)));
        this
    }

    fn ring_of(&self, island: u32) -> std::ops::Range<u32> {
        self.rings.starts[island as usize + 1]..self.rings.starts[island as usize + 2]
    }

    /// Grow the disk of one island and note the cuts at both of its contacts.
    fn bridge(&mut self, heap: &BoxHeap, island: u32) {
        let ring = self.ring_of(island);
        let (element, foot) = self.outermost(ring.clone());
        let all = (0, self.rings.elements.len() as u32 - 1);
        let at = |radius: f64| Disk { center: foot.0 + foot.1 * radius, radius };
        let mut disk = at(tol::FIRST_PROBE);
        let mut contact = None;
        loop {
            let own = |k: u32| ring.contains(&k);
            let bound = disk.radius - tol::EMPTY;
            let hit = heap.nearest_but(&self.rings.elements, all, disk.center, bound, own);
            match (hit, contact) {
                (None, Some(_)) => break,
                (None, None) if disk.radius > tol::LARGEST_DISK => break,
                (None, None) => disk = at(2.0 * disk.radius),
                (Some((k, _)), _) => {
                    // a disk that is still too large may reach over one wall to the back of another
                    let e = &self.rings.elements[k as usize];
                    let reach = |e: &Element| closed_pencil_radius(e, foot.0, Vec2::ZERO, foot.1);
                    let radius = reach(e).min(reach(&e.flipped()));
                    let stuck = contact.is_some() && radius >= disk.radius;
                    contact = Some(k);
                    if stuck {
                        break;
                    }
                    disk = at(radius.min(disk.radius));
                }
            }
        }
        let contact = self.owner(contact.unwrap_or(0), disk.center);
        let e = &self.rings.elements[contact as usize];
        let other = clamped_foot(e, disk.center);
        self.doors.push(Cut { element, along: along(&self.rings.elements[element as usize], foot), foot, island });
        self.cuts.push(Cut { element: contact, along: along(e, other), foot: other, island });
        self.disks.push(disk);
    }

    /// The outermost point of a ring, on the element that owns the normal there.
    fn outermost(&self, ring: std::ops::Range<u32>) -> (u32, Foot) {
        let start = self.rings.elements[ring.start as usize].start;
        let out = self.out;
        let (mut best, mut reach) = ((ring.start, (start, out)), f64::NEG_INFINITY);
        for k in ring {
            let e = &self.rings.elements[k as usize];
            let mut offer = |foot: Foot, bonus: f64| {
                let far = foot.0.to_vec().dot(out) + bonus;
                if far > reach {
                    (best, reach) = ((k, foot), far);
                }
            };
            match e.carrier {
                Carrier::Outside if e.covers(out) => offer((e.foot_with_normal(out), out), tol::EMPTY),
                _ => {
                    offer((e.start, e.n0), 0.0);
                    offer((e.end, e.n1), 0.0);
                }
            }
        }
        best
    }

    /// The element that owns the contact of a disk with `hit`: at an end it may be the reflex vertex there.
    fn owner(&self, hit: u32, center: Point) -> u32 {
        let e = &self.rings.elements[hit as usize];
        let (before, after) = e.overshoot(center);
        if before <= 0.0 && after <= 0.0 {
            return hit;
        }
        let ring = self.rings.starts.partition_point(|&s| s <= hit) - 1;
        let (first, end) = (self.rings.starts[ring], self.rings.starts[ring + 1]);
        let previous = if hit == first { end - 1 } else { hit - 1 };
        let next = if hit + 1 == end { first } else { hit + 1 };
        let over = |k: u32| {
            let (before, after) = self.rings.elements[k as usize].overshoot(center);
            before.max(after)
        };
        let neighbor = if e.is_left_at_start(center) { previous } else { next };
        if over(neighbor) < before.max(after) { neighbor } else { hit }
    }

    /// Walk round everything.
    fn into_cycle(self) -> Cycle {
        let mut cycle = Cycle { bridges: self.disks.clone(), ..Cycle::default() };
        let mut walk: Vec<std::vec::IntoIter<Step>> = vec![self.tour(0).into_iter()];
        while let Some(steps) = walk.last_mut() {
            match steps.next() {
                Some(Step::Piece(element, junction)) => {
                    cycle.elements.push(element);
                    cycle.junctions.push(junction);
                }
                Some(Step::Island(island)) => walk.push(self.tour(island + 1).into_iter()),
                None => {
                    walk.pop();
                }
            }
        }
        cycle
    }

    /// The steps round one ring: from its door if it is an island.
    fn tour(&self, ring: u32) -> Vec<Step> {
        let (first, end) = (self.rings.starts[ring as usize], self.rings.starts[ring as usize + 1]);
        let Some(door) = ring.checked_sub(1).map(|island| &self.doors[island as usize]) else {
            return (self.corner..end).chain(first..self.corner).flat_map(|k| self.pieces(k, None, None)).collect();
        };
        let mut steps = self.pieces(door.element, Some(door), None);
        let rest = (door.element + 1..end).chain(first..door.element);
        steps.extend(rest.flat_map(|k| self.pieces(k, None, None)));
        steps.extend(self.pieces(door.element, None, Some(door)));
        steps
    }

    /// The pieces of one element and the islands between them, from a door or up to it.
    fn pieces(&self, element: u32, from: Option<&Cut>, to: Option<&Cut>) -> Vec<Step> {
        let e = &self.rings.elements[element as usize];
        let mut foot = from.map_or((e.start, e.n0), |door| door.foot);
        let mut junction = from.map_or(self.rings.junctions[element as usize], |door| Junction::Bridge(door.island));
        let low = self.cuts.partition_point(|c| c.element < element);
        let high = self.cuts.partition_point(|c| c.element <= element);
        let wanted = |c: &&Cut| from.is_none_or(|d| c.along > d.along) && to.is_none_or(|d| c.along <= d.along);
        let mut steps = Vec::new();
        for cut in self.cuts[low..high].iter().filter(wanted) {
            steps.push(Step::Piece(e.piece(foot, cut.foot), junction));
            steps.push(Step::Island(cut.island));
            (foot, junction) = (cut.foot, Junction::Bridge(cut.island));
        }
        let whole = steps.is_empty() && from.is_none() && to.is_none();
        let last = if whole { *e } else { e.piece(foot, to.map_or((e.end, e.n1), |door| door.foot)) };
        steps.push(Step::Piece(last, junction));
        steps
    }
}

/// What a walk round the boundary meets.
enum Step {
    Piece(Element, Junction),
    Island(u32),
}

/// How far along an element a foot lies; only the order matters.
fn along(e: &Element, foot: Foot) -> f64 {
    if e.is_line() { (foot.0 - e.start).dot(e.along()) } else { e.turn_to(foot.1) }
}

/// The foot of a disk's centre, held within the element's extent.
fn clamped_foot(e: &Element, center: Point) -> Foot {
    let (before, after) = e.overshoot(center);
    if before > 0.0 && before >= after {
        (e.start, e.n0)
    } else if after > 0.0 {
        (e.end, e.n1)
    } else {
        (e.foot(center), e.normal_at(center))
    }
}

/// Radius of the disk that touches a curve at `base + offset` with normal `n` and the closed element.
pub(super) fn closed_pencil_radius(e: &Element, base: Point, offset: Vec2, n: Vec2) -> f64 {
    let radius = e.pencil_radius_near(base, offset, n);
    if radius >= -tol::EMPTY && radius.is_finite() && e.faces(base + (offset + n * radius), tol::EMPTY) {
        return radius.max(0.0);
    }
    let to_point = |p: Point| {
        let w = p - base - offset;
        let reach = w.dot(n);
        if reach > 0.0 { 0.5 * w.length_squared() / reach } else { f64::INFINITY }
    };
    to_point(e.start).min(to_point(e.end))
}
