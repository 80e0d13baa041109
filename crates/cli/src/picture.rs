//! The picture of a job.

use crate::console::{duration, figure};
use crate::job::Proven;
use crate::skeleton;
use pocketry_cam::{LinkKind, Plan};
use pocketry_geom::{Region, Segment};
use pocketry_io::plot::{Look, Picture, Spot};
use pocketry_motion::{FeedKind, Move, Program};

/// Walls, skeleton (on request), loops in the order of cutting, links, entries, rapids and uncut places.
pub(crate) fn of_job(name: &str, region: &Region, job: &Proven, with_skeleton: bool) -> Picture {
    let mut picture = Picture::of(region, name);
    picture.notes = notes(job);
    if let Some(skeleton) = job.skeleton.as_ref().filter(|_| with_skeleton) {
        picture.add("skeleton", Look::Skeleton, skeleton::paths(skeleton, region));
    }
    add_loops(&mut picture, &job.plan);
    let links = |wanted: fn(LinkKind) -> bool| {
        job.plan.links.iter().filter(|l| wanted(l.kind)).map(|l| l.segments.clone()).collect::<Vec<_>>()
    };
    picture.add("link", Look::Link, links(|kind| kind != LinkKind::Entry));
    picture.add("entry", Look::Entry, links(|kind| kind == LinkKind::Entry));
    picture.add("entry", Look::Entry, paths(&job.plan.program, |m| m.feed() == Some(FeedKind::Ramp)));
    picture.add("rapid", Look::Rapid, paths(&job.plan.program, |m| m.feed().is_none()));
    if let (Some(section), Some(group)) = (&job.setup.profile, job.plan.groups.first()) {
        let turned = job.plan.program.headings.first().copied().unwrap_or(0.0);
        let tool = section.profile.rotated(turned).contour().translated(group.start.to_vec());
        picture.add("tool at its first entry", Look::Thin, vec![tool.segments]);
    }
    let uncut = |s: &pocketry_verify::Spot| Spot { at: s.at, radius: s.radius, name: "left uncut".to_owned() };
    picture.spots.extend(job.proof.uncut_spots.iter().map(uncut));
    picture
}

fn notes(job: &Proven) -> Vec<String> {
    let (setup, figures) = (&job.setup.job, &job.figures);
    vec![format!(
        "tool {}, stepover {} mm, depth {} mm in {} passes; {} loops, {:.0} mm of cutting, {} retracts, about {}",
        job.setup.tool_name(),
        figure(job.plan.stepover),
        figure(setup.stock.depth),
        job.plan.passes,
        job.plan.loops.len(),
        figures.cut_length,
        figures.retracts,
        duration(figures.machine_seconds),
    )]
}

fn add_loops(picture: &mut Picture, plan: &Plan) {
    let last = plan.loops.len().saturating_sub(1).max(1) as f64;
    for (k, cut) in plan.loops.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
}

/// The moves of one kind as seen from above, runs of them joined.
fn paths(program: &Program, wanted: impl Fn(&Move) -> bool) -> Vec<Vec<Segment>> {
    let mut paths: Vec<Vec<Segment>> = Vec::new();
    let mut joined = false;
    for (from, step) in program.steps() {
        if !wanted(step) {
            joined = false;
            continue;
        }
        if from.xy() != step.to().xy() || matches!(step, Move::Arc { .. }) {
            let segment = step.plan_view(from.xy());
            match paths.last_mut().filter(|_| joined) {
                Some(path) => path.push(segment),
                None => paths.push(vec![segment]),
            }
            joined = true;
        }
    }
    paths
}
