//! `pocketry skeleton`.

use crate::args::SkeletonArgs;
use crate::console;
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::offset::Form;
use crate::output::write_or_print;
use pocketry_geom::offset::voronoi::EdgeCurve;
use pocketry_geom::skeleton::{EdgeId, Skeleton};
use pocketry_geom::{Region, Segment};
use pocketry_io::plot::{Look, Picture};
use serde::Serialize;

/// How far a drawn edge may lie from the true one, as a share of the region's size: less than a pixel.
const DRAWING_SHARE: f64 = 0.0002;

/// `{"units", "vertices": [[x, y, clearance], ...], "edges": [{"from", "to", "sites", "path"}, ...]}`
#[derive(Serialize)]
struct File {
    units: &'static str,
    vertices: Vec<[f64; 3]>,
    edges: Vec<Edge>,
}

#[derive(Serialize)]
struct Edge {
    /// Index of the vertex with the smaller clearance, then of the other.
    vertices: [u32; 2],
    /// Contour and segment of the two sites whose cells it parts, right and left of the way up.
    sites: [[u32; 2]; 2],
    /// Points `[x, y, bulge]` from one vertex to the other; the last bulge is 0.
    path: Vec<[f64; 3]>,
}

pub(crate) fn run(args: &SkeletonArgs) -> Result<(), Failure> {
    let form = Form::of(args.output.as_deref())?;
    let drawing = drawing::read(&args.input, &args.drawing)?;
    console::warnings(&drawing.warnings);
    let region = &drawing.region;
    let skeleton = Skeleton::build(region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e))?;
    let text = match form {
        Form::Svg => {
            let mut picture = Picture::of(region, args.input.display().to_string());
            picture.notes.push(format!(
                "{} sites, {} vertices, {} edges",
                skeleton.sites().len(),
                skeleton.vertices().len(),
                skeleton.edge_count()
            ));
            picture.add("skeleton", Look::Skeleton, paths(&skeleton, region));
            picture.to_svg()
        }
        Form::Json => to_json(&skeleton, region),
        Form::Dxf => return Err(Failure::arguments("a skeleton is written as .svg or .json")),
    };
    write_or_print(args.output.as_deref(), &text)
}

/// The edges as lines and arcs, near enough for a picture.
pub(crate) fn paths(skeleton: &Skeleton, region: &Region) -> Vec<Vec<Segment>> {
    let tolerance = DRAWING_SHARE * region.bbox().size();
    edges(skeleton).map(|e| EdgeCurve::new(skeleton, e).whole(true, tolerance)).collect()
}

/// One half-edge of every pair, the one that leads upwards.
fn edges(skeleton: &Skeleton) -> impl Iterator<Item = EdgeId> + '_ {
    (0..skeleton.half_edges().len() as EdgeId).step_by(2).map(|e| pocketry_geom::offset::voronoi::upward(skeleton, e))
}

fn to_json(skeleton: &Skeleton, region: &Region) -> String {
    let tolerance = DRAWING_SHARE * region.bbox().size();
    let site = |e: EdgeId| {
        let site = skeleton.sites()[skeleton.site(e) as usize];
        [site.contour, site.segment]
    };
    let edge = |e: EdgeId| Edge {
        vertices: [skeleton.origin(e), skeleton.target(e)],
        sites: [site(e), site(Skeleton::twin(e))],
        path: vertices(&EdgeCurve::new(skeleton, e).whole(true, tolerance)),
    };
    let file = File {
        units: "mm",
        vertices: skeleton.vertices().iter().map(|v| [v.point.x, v.point.y, v.clearance]).collect(),
        edges: edges(skeleton).map(edge).collect(),
    };
    // Numbers, strings and lists only: this can't fail.
    let mut text = serde_json::to_string(&file).unwrap_or_default();
    text.push('\n');
    text
}

fn vertices(path: &[Segment]) -> Vec<[f64; 3]> {
    let end = path.last().map(|s| [s.end().x, s.end().y, 0.0]);
    path.iter().map(Into::into).chain(end).collect()
}
