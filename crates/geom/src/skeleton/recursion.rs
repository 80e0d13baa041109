//! The third-contact recursion: from the cycle of elements to the skeleton's vertices and edges.
//!
//! Every junction of the cycle starts one skeleton edge, so the skeleton's dual is a triangulation of the cycle: exactly
//! `n - 2` triangles, islands included, whatever the rounding. For a dual edge `(a, b)` with the elements between them
//! the next vertex is the first disk of the pencil touching `a` and `b`, from the parent's disk on, that touches some
//! `c` between them; `(a, c)` and `(c, b)` are left to do, on an explicit stack.

use super::boxes::BoxHeap;
use super::cycle::{Cycle, Junction};
use super::element::Disk;
use super::search;
use super::topology::{EdgeId, HalfEdge, NONE, Vertex, VertexId};
use crate::point::Point;

/// The half-edges of one cycle's skeleton, in the construction's frame; sites are still elements of the cycle.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) vertices: Vec<Vertex>,
    pub(super) half_edges: Vec<HalfEdge>,
    /// Per element: the half-edge that leaves the vertex where the element starts.
    pub(super) first: Vec<EdgeId>,
    /// Per element: the half-edge that arrives where it ends.
    pub(super) last: Vec<EdgeId>,
    /// Vertices that nothing vouches for.
    pub(super) doubts: u32,
}

/// A dual edge: the elements between `a` and `b` are still to be connected.
#[derive(Clone, Copy, Debug)]
struct Task {
    a: u32,
    b: u32,
    /// The half-edge on the side of `a`; it leaves the parent's vertex.
    out: EdgeId,
    parent: Disk,
}

/// What the searches of one cycle work on.
#[derive(Debug)]
pub(super) struct Scene<'a> {
    pub(super) cycle: &'a Cycle,
    pub(super) heap: BoxHeap,
}

impl Scene<'_> {
    /// Number of elements.
    pub(super) fn len(&self) -> u32 {
        self.cycle.elements.len() as u32
    }

    /// The boundary vertex at which a junction's skeleton edge starts.
    fn corner_at(&self, junction: u32) -> VertexId {
        match self.cycle.junctions[junction as usize] {
            Junction::Convex(v) | Junction::Spoke(v, _) => v,
            // no vertex of its own: the two sides of a bridge are joined later
            Junction::Bridge(_) => NONE,
        }
    }

    /// The place and radius at which a junction's skeleton edge starts.
    fn start_disk(&self, junction: u32) -> Disk {
        match self.cycle.junctions[junction as usize] {
            Junction::Bridge(k) => self.cycle.bridges[k as usize],
            _ => Disk { center: self.cycle.elements[junction as usize].start, radius: 0.0 },
        }
    }
}

/// Run the recursion. `corners[v]` is the place of boundary vertex `v`; these become the first vertices.
pub(super) fn run(cycle: &Cycle, corners: &[Point]) -> Draft {
    let scene = Scene { cycle, heap: BoxHeap::new(&cycle.elements) };
    let n = scene.len();
    let mut draft = Draft::with_capacity(corners, n as usize);
    let root = draft.add_edge(scene.corner_at(0), 0, n - 1);
    draft.first[0] = root;
    draft.last[n as usize - 1] = root ^ 1;
    let mut stack = vec![Task { a: 0, b: n - 1, out: root, parent: scene.start_disk(0) }];
    while let Some(task) = stack.pop() {
        let Task { a, b, out, parent } = task;
        if b == a + 1 {
            draft.half_edges[out as usize ^ 1].origin = scene.corner_at(b);
            draft.first[b as usize] = out ^ 1;
            draft.last[a as usize] = out;
            continue;
        }
        let search::Contact { element: c, disk, vouched } = search::third_contact(&scene, (a, b), parent);
        draft.doubts += u32::from(!vouched);
        let vertex = draft.add_vertex(disk);
        draft.half_edges[out as usize ^ 1].origin = vertex;
        let (left, right) = (draft.add_edge(vertex, a, c), draft.add_edge(vertex, c, b));
        draft.half_edges[out as usize].next = left;
        draft.half_edges[left as usize ^ 1].next = right;
        draft.half_edges[right as usize ^ 1].next = out ^ 1;
        stack.push(Task { a: c, b, out: right, parent: disk });
        stack.push(Task { a, b: c, out: left, parent: disk });
    }
    draft
}

impl Draft {
    fn with_capacity(corners: &[Point], elements: usize) -> Self {
        let mut vertices = Vec::with_capacity(corners.len() + elements);
        vertices.extend(corners.iter().map(|&point| Vertex { point, clearance: 0.0 }));
        Self {
            vertices,
            half_edges: Vec::with_capacity(4 * elements),
            first: vec![NONE; elements],
            last: vec![NONE; elements],
            doubts: 0,
        }
    }

    fn add_vertex(&mut self, disk: Disk) -> VertexId {
        // where islands touch, rounding may leave a vertex a unit behind the wall
        self.vertices.push(Vertex { point: disk.center, clearance: disk.radius.max(0.0) });
        self.vertices.len() as VertexId - 1
    }

    /// The edge from `origin` between elements `a` and `b`; the half-edge on the side of `a` leaves `origin`.
    fn add_edge(&mut self, origin: VertexId, a: u32, b: u32) -> EdgeId {
        let id = self.half_edges.len() as EdgeId;
        self.half_edges.push(HalfEdge { origin, next: NONE, site: a });
        self.half_edges.push(HalfEdge { origin: NONE, next: NONE, site: b });
        id
    }
}
