//! From the draft over elements to the skeleton over sites: join the pieces at bridges, contract edges within one cell,
//! close the cells, split edges at apexes.

use super::cycle::{Cycle, Junction};
use super::element::Element;
use super::recursion::Draft;
use super::search::advance;
use super::topology::{EdgeId, HalfEdge, NONE, Vertex, VertexId};
use crate::point::{Point, Vec2};
use crate::tolerance::skeleton as tol;

/// A finished component in the construction's frame; `first` is per site of the pocket.
#[derive(Debug, Default)]
pub(super) struct Component {
    pub(super) vertices: Vec<Vertex>,
    pub(super) half_edges: Vec<HalfEdge>,
    pub(super) first: Vec<EdgeId>,
}

/// Turn a draft into a component. `sites[k]` is the whole element of site `k`; `convex[v]` tells of boundary vertex `v`
/// whether it is a corner.
pub(super) fn assemble(cycle: &Cycle, mut draft: Draft, sites: &[Element], convex: &[bool]) -> Component {
    let mut dropped = join_bridges(cycle, &mut draft);
    for half_edge in &mut draft.half_edges {
        half_edge.site = cycle.elements[half_edge.site as usize].site;
    }
    let first = close_cells(cycle, &mut draft, sites.len());
    contract_inner_edges(&mut draft, &mut dropped);
    let mut component = compact(draft, &dropped, first);
    split_at_apexes(&mut component, sites, convex);
    component
}

/// Each bridge crosses one skeleton edge, which the recursion saw as two; make them one again. Returns the pairs of
/// half-edges that are no longer used.
fn join_bridges(cycle: &Cycle, draft: &mut Draft) -> Vec<bool> {
    let mut dropped = vec![false; draft.half_edges.len() / 2];
    let mut renamed = vec![NONE; if cycle.bridges.is_empty() { 0 } else { draft.half_edges.len() }];
    for &(entry, exit) in &cycle.crossings {
        // one edge runs along the wall up to the bridge and on along the island, the other one back
        let (arriving, leaving) = (draft.last[entry as usize - 1], draft.first[exit as usize]);
        let (back, away) = (draft.last[exit as usize - 1], draft.first[entry as usize]);
        draft.half_edges[arriving as usize].next = draft.half_edges[leaving as usize].next;
        draft.half_edges[away as usize].origin = draft.half_edges[back as usize].origin;
        renamed[back as usize] = away;
        dropped[back as usize / 2] = true;
    }
    if !renamed.is_empty() {
        for half_edge in &mut draft.half_edges {
            if half_edge.next != NONE && renamed[half_edge.next as usize] != NONE {
                half_edge.next = renamed[half_edge.next as usize];
            }
        }
        for last in &mut draft.last {
            if renamed[*last as usize] != NONE {
                *last = renamed[*last as usize];
            }
        }
    }
    dropped
}

/// The first half-edge of each site's cell; the last one is linked to it.
fn close_cells(cycle: &Cycle, draft: &mut Draft, sites: usize) -> Vec<EdgeId> {
    let n = cycle.elements.len();
    let is_cut = |k: usize| matches!(cycle.junctions[k % n], Junction::Bridge(_));
    let mut first = vec![NONE; sites];
    for (k, e) in cycle.elements.iter().enumerate() {
        if !is_cut(k) {
            first[e.site as usize] = draft.first[k];
        }
    }
    for (k, e) in cycle.elements.iter().enumerate() {
        if !is_cut(k + 1) {
            draft.half_edges[draft.last[k] as usize].next = first[e.site as usize];
        }
    }
    first
}

/// An edge between two pieces of one site has no length: its vertices are one.
fn contract_inner_edges(draft: &mut Draft, dropped: &mut [bool]) {
    let inner: Vec<u32> = (0..dropped.len() as u32)
        .filter(|&pair| {
            let pair = pair as usize;
            !dropped[pair] && draft.half_edges[2 * pair].site == draft.half_edges[2 * pair + 1].site
        })
        .collect();
    if inner.is_empty() {
        return;
    }
    let mut previous = vec![NONE; draft.half_edges.len()];
    for (k, half_edge) in draft.half_edges.iter().enumerate() {
        if !dropped[k / 2] && half_edge.next != NONE {
            previous[half_edge.next as usize] = k as u32;
        }
    }
    let mut merged: Vec<VertexId> = (0..draft.vertices.len() as u32).collect();
    for pair in inner {
        let (here, there) =
            (draft.half_edges[2 * pair as usize].origin, draft.half_edges[2 * pair as usize + 1].origin);
        let (root, other) = (find(&mut merged, here), find(&mut merged, there));
        merged[other as usize] = root;
        for h in [2 * pair, 2 * pair + 1] {
            let (before, after) = (previous[h as usize], draft.half_edges[h as usize].next);
            if before != NONE {
                draft.half_edges[before as usize].next = after;
            }
            if after != NONE {
                previous[after as usize] = before;
            }
        }
        dropped[pair as usize] = true;
    }
    for half_edge in &mut draft.half_edges {
        if half_edge.origin != NONE {
            half_edge.origin = find(&mut merged, half_edge.origin);
        }
    }
}

fn find(parents: &mut [VertexId], mut v: VertexId) -> VertexId {
    while parents[v as usize] != v {
        parents[v as usize] = parents[parents[v as usize] as usize];
        v = parents[v as usize];
    }
    v
}

/// Leave out what was dropped and number the rest anew.
fn compact(draft: Draft, dropped: &[bool], first: Vec<EdgeId>) -> Component {
    if !dropped.contains(&true) {
        return Component { vertices: draft.vertices, half_edges: draft.half_edges, first };
    }
    let mut pair_name = vec![NONE; dropped.len()];
    let mut used = vec![false; draft.vertices.len()];
    let mut count = 0;
    for (pair, gone) in dropped.iter().enumerate() {
        if !gone {
            pair_name[pair] = count;
            count += 1;
            for h in [2 * pair, 2 * pair + 1] {
                used[draft.half_edges[h].origin as usize] = true;
            }
        }
    }
    let mut vertex_name = vec![NONE; used.len()];
    let mut vertices = Vec::with_capacity(used.len());
    for (v, used) in used.iter().enumerate() {
        if *used {
            vertex_name[v] = vertices.len() as u32;
            vertices.push(draft.vertices[v]);
        }
    }
    let edge_name = |h: EdgeId| if h == NONE { NONE } else { 2 * pair_name[h as usize / 2] + (h & 1) };
    let kept = draft.half_edges.iter().enumerate().filter(|(k, _)| !dropped[k / 2]);
    let half_edges = kept
        .map(|(_, h)| HalfEdge { origin: vertex_name[h.origin as usize], next: edge_name(h.next), site: h.site })
        .collect();
    Component { vertices, half_edges, first: first.into_iter().map(edge_name).collect() }
}

/// Split edges where the clearance has an extremum between their ends, so that it is monotone along every edge.
fn split_at_apexes(component: &mut Component, sites: &[Element], convex: &[bool]) {
    let mut previous = vec![NONE; component.half_edges.len()];
    for (k, half_edge) in component.half_edges.iter().enumerate() {
        previous[half_edge.next as usize] = k as EdgeId;
    }
    for pair in 0..component.half_edges.len() / 2 {
        let (a, b) = (component.half_edges[2 * pair], component.half_edges[2 * pair + 1]);
        let (v0, v1) = (component.vertices[a.origin as usize], component.vertices[b.origin as usize]);
        let is_spoke = |v: VertexId| convex.get(v as usize).is_some_and(|c| !c);
        let (ea, eb) = (&sites[a.site as usize], &sites[b.site as usize]);
        if is_spoke(a.origin) && is_spoke(b.origin) {
            // a disc: the two spokes of its joints meet in its centre
            let center = Vertex { point: ea.center, clearance: ea.rho.abs() };
            insert_vertex(component, &mut previous, 2 * pair as u32, center);
        } else if !is_spoke(a.origin) && !is_spoke(b.origin) {
            let mut at = 2 * pair as u32;
            for apex in apexes(ea, eb, v0, v1).into_iter().flatten() {
                at = insert_vertex(component, &mut previous, at, apex);
            }
        }
    }
}

/// Split a half-edge (and its twin) at a new vertex; the result is the half that goes on from there.
fn insert_vertex(component: &mut Component, previous: &mut Vec<EdgeId>, h: EdgeId, vertex: Vertex) -> EdgeId {
    let v = component.vertices.len() as VertexId;
    component.vertices.push(vertex);
    let edges = &mut component.half_edges;
    let (twin, rest) = (h ^ 1, edges.len() as EdgeId);
    let (after, before) = (edges[h as usize].next, previous[twin as usize]);
    let (site, other, end) = (edges[h as usize].site, edges[twin as usize].site, edges[twin as usize].origin);
    edges.push(HalfEdge { origin: v, next: after, site });
    edges.push(HalfEdge { origin: end, next: twin, site: other });
    edges[h as usize].next = rest;
    edges[twin as usize].origin = v;
    edges[before as usize].next = rest ^ 1;
    previous.extend([h, before]);
    previous[after as usize] = rest;
    previous[twin as usize] = rest ^ 1;
    let first = &mut component.first[other as usize];
    if *first == twin {
        *first = rest ^ 1;
    }
    rest
}

/// The apexes of the bisector of two elements strictly between two of its points, in order: there the two contacts
/// lie opposite one another.
fn apexes(a: &Element, b: &Element, v0: Vertex, v1: Vertex) -> [Option<Vertex>; 2] {
    let mut found = [None, None];
    let is_short = (v1.point - v0.point).length() <= tol::FOOT;
    if is_short || (a.is_line() && b.is_line()) {
        return found;
    }
    let feet = opposite_feet(a, b);
    for (foot, n) in feet.into_iter().flatten() {
        // half the gap between the two contacts: well conditioned even where the centres all but coincide
        let opposite = if b.is_line() { b.start } else { b.foot_with_normal(-n) };
        let radius = 0.5 * (opposite - foot).dot(n);
        let point = foot + n * radius;
        let extreme = radius < v0.clearance.min(v1.clearance) - tol::LEVEL
            || radius > v0.clearance.max(v1.clearance) + tol::LEVEL;
        let between = [(a, v0, v1), (b, v1, v0)]
            .iter()
            .all(|(e, from, to)| advance(e, from.point, point) > 0.0 && advance(e, point, to.point) > 0.0);
        let touches = [a, b].iter().all(|e| (e.gap(point) - radius).abs() <= tol::FOOT && e.faces(point, tol::FOOT));
        if radius > tol::EMPTY && touches && extreme && between {
            found[usize::from(found[0].is_some())] = Some(Vertex { point, clearance: radius });
        }
    }
    if let [Some(x), Some(y)] = found
        && advance(a, x.point, y.point) < 0.0
    {
        found.swap(0, 1);
    }
    found
}

/// The feet on `a`, with their normals, at which a disk can touch `b` on the opposite side.
fn opposite_feet(a: &Element, b: &Element) -> [Option<(Point, Vec2)>; 2] {
    if a.is_line() {
        return [Some((a.foot(b.center), a.n0)), None];
    }
    if b.is_line() {
        return [Some((a.foot_with_normal(-b.n0), -b.n0)), None];
    }
    let axis = b.center - a.center;
    let length = axis.length();
    if length <= tol::EMPTY {
        return [None, None];
    }
    let n = axis / length;
    [Some((a.foot_with_normal(n), n)), Some((a.foot_with_normal(-n), -n))]
}
