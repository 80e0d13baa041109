//! Edges split where they meet, so that any two pieces share only ends.

use super::Edge;
use super::clean::with_ends;
use super::contacts::Contacts;
use super::report::Note;
use crate::intersect::Closeness;
use crate::point::Point;
use crate::segment::Segment;
use std::collections::HashSet;

/// A piece of an edge between two vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Its geometry; its ends are the vertices' points exactly.
    pub(super) segment: Segment,
    /// The loop that it comes from.
    pub(super) contour: u32,
    /// The vertex where it starts.
    pub(super) from: u32,
    /// The vertex where it ends.
    pub(super) to: u32,
}

/// Vertices by name; only the representative of merged ones is used.
struct Vertices {
    points: Vec<Point>,
    parent: Vec<u32>,
}

impl Vertices {
    fn find(&mut self, mut v: u32) -> u32 {
        while self.parent[v as usize] != v {
            let up = self.parent[self.parent[v as usize] as usize];
            self.parent[v as usize] = up;
            v = up;
        }
        v
    }

    /// The smaller name stays.
    fn merge(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    fn add(&mut self, p: Point) -> u32 {
        let name = self.points.len() as u32;
        self.points.push(p);
        self.parent.push(name);
        name
    }
}

/// The pieces of all edges, those that cover each other left out in pairs.
pub(super) fn pieces(
    edges: &[Edge],
    next: &[u32],
    contacts: Contacts,
    closeness: Closeness,
    notes: &mut Vec<Note>,
) -> (Vec<Piece>, usize) {
    let mut points: Vec<Point> = edges.iter().map(|e| e.segment.start()).collect();
    points.extend(&contacts.places);
    let parent = (0..points.len() as u32).collect();
    let mut vertices = Vertices { points, parent };
    contacts.merges.iter().for_each(|&(a, b)| vertices.merge(a, b));
    let cuts = sorted_cuts(edges, next, contacts.cuts, &mut vertices, closeness.touch);
    let mut touched = vec![false; edges.len()];
    contacts.touched.iter().for_each(|&e| touched[e as usize] = true);
    let mut pieces = Vec::with_capacity(edges.len() + cuts.len());
    let mut suspects = Vec::new();
    let mut cut = cuts.into_iter().peekable();
    for (k, edge) in edges.iter().enumerate() {
        let mut at = k as u32;
        let mut rest = edge.segment;
        let first = pieces.len();
        while let Some((_, v)) = cut.next_if(|&(e, _)| e as usize == k) {
            if vertices.find(v) != vertices.find(at) {
                let (before, after) = rest.split_at(vertices.points[v as usize]);
                add_piece(&mut pieces, &mut vertices, before, edge.contour, at, v);
                (at, rest) = (v, after);
            }
        }
        let is_whole = at == k as u32;
        if vertices.find(at) != vertices.find(next[k]) {
            add_piece(&mut pieces, &mut vertices, rest, edge.contour, at, next[k]);
        } else if is_whole {
            add_turn(&mut pieces, &mut vertices, rest, edge.contour, at);
        }
        if touched[k] {
            suspects.extend(first..pieces.len());
        }
    }
    let crossings: HashSet<u32> = contacts.crossings.iter().map(|&v| vertices.find(v)).collect();
    cancel(&mut pieces, suspects, &crossings, closeness, notes);
    (pieces, vertices.points.len())
}

/// Cuts in order along each edge, near ones merged, with one another and with the edge's ends.
fn sorted_cuts(
    edges: &[Edge],
    next: &[u32],
    cuts: Vec<(u32, u32)>,
    vertices: &mut Vertices,
    touch: f64,
) -> Vec<(u32, u32)> {
    let mut along: Vec<(u32, f64, u32)> = cuts
        .into_iter()
        .map(|(e, v)| (e, way_along(&edges[e as usize].segment, vertices.points[v as usize]), v))
        .collect();
    along.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    let near = |v: &Vertices, a: u32, b: u32| v.points[a as usize].distance(v.points[b as usize]) <= 2.0 * touch;
    for k in 0..along.len() {
        let (e, _, v) = along[k];
        let before = if k > 0 && along[k - 1].0 == e { along[k - 1].2 } else { e };
        for other in [before, next[e as usize]] {
            if near(vertices, other, v) {
                vertices.merge(other, v);
            }
        }
    }
    along.into_iter().map(|(e, _, v)| (e, v)).collect()
}

/// A number that grows along the segment.
fn way_along(segment: &Segment, p: Point) -> f64 {
    match segment {
        Segment::Line(l) => (p - l.start).dot(l.end - l.start),
        Segment::Arc(a) => {
            let turn = (a.start - a.center).angle_to(p - a.center);
            let way = if a.ccw { turn } else { -turn };
            let near_start = p.distance_squared(a.start) < p.distance_squared(a.end);
            if way < 0.0 && !near_start || way < -std::f64::consts::FRAC_PI_2 {
                way + std::f64::consts::TAU
            } else {
                way
            }
        }
    }
}

/// Adds a piece between two different vertices, its ends moved there.
fn add_piece(out: &mut Vec<Piece>, vertices: &mut Vertices, segment: Segment, contour: u32, from: u32, to: u32) {
    let (from, to) = (vertices.find(from), vertices.find(to));
    let (start, end) = (vertices.points[from as usize], vertices.points[to as usize]);
    out.push(Piece { segment: with_ends(segment, start, end), contour, from, to });
}

/// Adds the halves of an arc whose ends have become one vertex, unless all of it has shrunk to that.
fn add_turn(out: &mut Vec<Piece>, vertices: &mut Vertices, segment: Segment, contour: u32, vertex: u32) {
    if let Segment::Arc(a) = segment {
        let middle = segment.at(0.5);
        if middle.distance(a.start) > a.radius {
            let half = vertices.add(middle);
            let (before, after) = segment.split_at(middle);
            add_piece(out, vertices, before, contour, vertex, half);
            add_piece(out, vertices, after, contour, half, vertex);
        }
    }
}

/// Leaves out pieces that cover each other or bound a narrow lens at a crossing, two by two (even-odd), and says so.
fn cancel(
    pieces: &mut Vec<Piece>,
    mut suspects: Vec<usize>,
    crossings: &HashSet<u32>,
    closeness: Closeness,
    notes: &mut Vec<Note>,
) {
    let ends = |p: &Piece| (p.from.min(p.to), p.from.max(p.to));
    suspects.sort_by_key(|&k| (ends(&pieces[k]), k));
    let mut gone = vec![false; pieces.len()];
    for (n, &i) in suspects.iter().enumerate() {
        if gone[i] {
            continue;
        }
        let middle = pieces[i].segment.at(0.5);
        let is_lens = crossings.contains(&pieces[i].from) || crossings.contains(&pieces[i].to);
        let reach = if is_lens { 2.0 * closeness.lens } else { 4.0 * closeness.touch };
        let twin = suspects[n + 1..]
            .iter()
            .copied()
            .take_while(|&j| ends(&pieces[j]) == ends(&pieces[i]))
            .find(|&j| !gone[j] && pieces[j].segment.distance(middle) <= reach);
        if let Some(j) = twin {
            gone[i] = true;
            gone[j] = true;
            let (first, second, at) = (pieces[i].contour, pieces[j].contour, pieces[i].segment.start());
            notes.push(if is_lens {
                Note::Overlap { first, second, at, length: pieces[i].segment.length() }
            } else if first == second {
                Note::Spike { contour: first, at }
            } else {
                Note::Shared { first, second, at }
            });
        }
    }
    zero_area_notes(pieces, &gone, notes);
    let mut k = 0;
    pieces.retain(|_| {
        k += 1;
        !gone[k - 1]
    });
}

/// A loop all of whose pieces run back on themselves encloses nothing: one note instead of many.
fn zero_area_notes(pieces: &[Piece], gone: &[bool], notes: &mut Vec<Note>) {
    let spiked: std::collections::BTreeSet<u32> =
        notes.iter().filter_map(|n| if let Note::Spike { contour, .. } = n { Some(*contour) } else { None }).collect();
    if spiked.is_empty() {
        return;
    }
    let mut alive = std::collections::BTreeSet::new();
    for (k, p) in pieces.iter().enumerate() {
        if !gone[k] {
            alive.insert(p.contour);
        }
    }
    for contour in spiked.into_iter().filter(|c| !alive.contains(c)) {
        let at = pieces.iter().find(|p| p.contour == contour).map_or(Point::ORIGIN, |p| p.segment.start());
        notes.retain(|n| !matches!(n, Note::Spike { contour: c, .. } if *c == contour));
        notes.push(Note::ZeroArea { contour, at });
    }
}
