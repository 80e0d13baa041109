//! `pocketry info`.

use crate::args::InfoArgs;
use crate::console::{self, figure};
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::output::print;
use crate::toolbox::{self, ToolInfo};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{BBox, Contour, Segment};
use pocketry_io::import::Drawing;
use serde::Serialize;
use std::fmt::Write;

/// More contours than this are counted instead of listed.
const MOST_LISTED: usize = 40;

/// Lengths in mm, areas in mm².
#[derive(Serialize)]
struct Info {
    units: String,
    width: f64,
    height: f64,
    lower_left: [f64; 2],
    area: f64,
    pockets: usize,
    /// Diameter of the largest tool that fits somewhere.
    largest_tool: f64,
    contours: Vec<ContourInfo>,
    tools: Vec<ToolInfo>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct ContourInfo {
    island: bool,
    lines: usize,
    arcs: usize,
    length: f64,
    /// Of what it encloses.
    area: f64,
    width: f64,
    height: f64,
    lower_left: [f64; 2],
}

pub(crate) fn run(args: &InfoArgs) -> Result<(), Failure> {
    let drawing = drawing::read(&args.input, &args.drawing)?;
    let skeleton = Skeleton::build(&drawing.region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e))?;
    let tools = toolbox::table(&drawing, &skeleton, &args.tools)?;
    let info = Info::of(&drawing, &skeleton, tools);
    if args.json {
        let text = serde_json::to_string_pretty(&info).unwrap_or_default();
        return print(&(text + "\n"));
    }
    console::warnings(&info.warnings);
    print(&info.to_text())
}

impl Info {
    fn of(drawing: &Drawing, skeleton: &Skeleton, tools: Vec<ToolInfo>) -> Self {
        let region = &drawing.region;
        let (width, height, lower_left) = extents(region.bbox());
        let largest = skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
        Self {
            units: drawing.units.to_string(),
            width,
            height,
            lower_left,
            area: region.area(),
            pockets: region.pockets().len(),
            largest_tool: 2.0 * largest,
            contours: region.contours().iter().map(ContourInfo::of).collect(),
            tools,
            warnings: drawing.warnings.iter().map(ToString::to_string).collect(),
        }
    }

    fn to_text(&self) -> String {
        let mut text = String::new();
        let [x, y] = self.lower_left;
        let _ = writeln!(
            text,
            "size          {} × {} mm, lower left at X{} Y{}",
            figure(self.width),
            figure(self.height),
            figure(x),
            figure(y)
        );
        let _ = writeln!(text, "drawn in      {}", self.units);
        let _ = writeln!(text, "pockets       {}", self.pockets);
        let _ = writeln!(text, "area          {} mm²", figure(self.area));
        let _ = writeln!(text, "largest tool  {} mm", figure(self.largest_tool));
        let _ = writeln!(text, "contours      {}", self.contours.len());
        for contour in self.contours.iter().take(MOST_LISTED) {
            contour.write(&mut text);
        }
        if self.contours.len() > MOST_LISTED {
            let _ = writeln!(text, "  and {} more", self.contours.len() - MOST_LISTED);
        }
        toolbox::write(&self.tools, &mut text);
        text
    }
}

impl ContourInfo {
    fn of(contour: &Contour) -> Self {
        let (width, height, lower_left) = extents(contour.bbox());
        let arcs = contour.segments.iter().filter(|s| matches!(s, Segment::Arc(_))).count();
        Self {
            island: contour.area() < 0.0,
            lines: contour.segments.len() - arcs,
            arcs,
            length: contour.length(),
            area: contour.area().abs(),
            width,
            height,
            lower_left,
        }
    }

    fn write(&self, text: &mut String) {
        let kind = if self.island { "island" } else { "outer " };
        let _ = writeln!(
            text,
            "  {kind}  {} lines, {} arcs, {} × {} mm at X{} Y{}, area {} mm²",
            self.lines,
            self.arcs,
            figure(self.width),
            figure(self.height),
            figure(self.lower_left[0]),
            figure(self.lower_left[1]),
            figure(self.area)
        );
    }
}

fn extents(b: BBox) -> (f64, f64, [f64; 2]) {
    (b.width(), b.height(), [b.min.x, b.min.y])
}
