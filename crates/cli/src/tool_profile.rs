//! Tools of any cross-section: what `--tool-profile` says.

use crate::args::DrawingArgs;
use crate::console::figure;
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::job::plan_failure;
use pocketry_cam::{Plan, PlanError, PocketJob, inscribed_circle, plan_profile, plan_turning};
use pocketry_geom::{Region, ToolProfile, ToolShape};
use pocketry_verify::{ProgramError, Report, VerifyOptions, verify_profile, verify_turning};
use std::path::PathBuf;
use std::str::FromStr;

/// What was typed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ProfileArg {
    /// A word such as `rect:12x4`.
    Shape(ToolShape),
    /// A drawing of the outline, turned by so many radians.
    File(PathBuf, f64),
}

impl FromStr for ProfileArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some(file) = text.strip_prefix("file:") else {
            return text.parse().map(Self::Shape).map_err(|e: pocketry_geom::profile::ToolShapeError| e.to_string());
        };
        let turned = file.rsplit_once('@').and_then(|(f, d)| Some((f, d.trim().parse::<f64>().ok()?)));
        let (file, degrees) = turned.filter(|t| t.1.is_finite()).unwrap_or((file, 0.0));
        if file.is_empty() {
            Err("file: needs the name of a drawing".into())
        } else {
            Ok(Self::File(file.into(), degrees.to_radians()))
        }
    }
}

impl ProfileArg {
    /// The shape, read from its drawing where it is one.
    pub(crate) fn shape(&self, drawing_args: &DrawingArgs) -> Result<ToolShape, Failure> {
        match self {
            Self::Shape(shape) => Ok(shape.clone()),
            Self::File(path, turn) => {
                let args =
                    DrawingArgs { layer: Vec::new(), origin: crate::args::Origin::Drawing, ..drawing_args.clone() };
                let region = drawing::read(path, &args)?.region;
                let named = |e: &dyn std::fmt::Display| {
                    Failure::new(Exit::BadInput, "tool-profile", format!("{}: {e}", path.display()))
                };
                let [contour] = region.contours() else {
                    return Err(named(&pocketry_geom::profile::ProfileError::Several {
                        count: region.contours().len(),
                    }));
                };
                let profile = ToolProfile::new(contour.clone()).map_err(|e| named(&e))?;
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                let drawn = ToolShape::Drawn(name, profile);
                Ok(if *turn == 0.0 { drawn } else { ToolShape::Turned(Box::new(drawn), *turn) })
            }
        }
    }
}

/// A tool's cross-section as it counts for one job.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) shape: ToolShape,
    /// In the plane of the stock's top with the tip at the floor.
    pub(crate) profile: ToolProfile,
    /// Radius of the largest circle in it, mm.
    pub(crate) radius: f64,
    /// Whether it turns with the walls.
    pub(crate) turns: bool,
}

impl Section {
    /// The section for a pocket of this depth (mm); only tapered tools need one.
    pub(crate) fn at(shape: &ToolShape, turns: bool, depth: Option<f64>) -> Result<Self, Failure> {
        if shape.is_tapered() && depth.is_none() {
            let message = format!("the profile of {shape} depends on how deep it cuts: say --depth");
            return Err(Failure::arguments(message));
        }
        let profile = shape.section(depth.unwrap_or(0.0));
        let (_, radius) = inscribed_circle(&profile).map_err(|e| plan_failure(&e))?;
        Ok(Self { shape: shape.clone(), profile, radius, turns })
    }

    /// Plans a pocket for it.
    pub(crate) fn plan(&self, region: &Region, job: &PocketJob) -> Result<Plan, PlanError> {
        let planner = if self.turns { plan_turning } else { plan_profile };
        planner(region, &self.profile, job)
    }

    /// Judges a program for it.
    pub(crate) fn prove(&self, region: &Region, text: &str, options: &VerifyOptions) -> Result<Report, ProgramError> {
        let judge = if self.turns { verify_turning } else { verify_profile };
        judge(region, text, self.profile.contour(), options)
    }

    /// What the proof says, for people.
    pub(crate) fn said(&self, proof: &Report) -> String {
        let (depth, shape) = (figure(proof.gouge_depth()), &self.shape);
        if self.turns {
            return format!(
                "proven: no wall is entered by more than {depth} mm, everything cut that {shape} can reach along the walls and where \
                 it turns freely\n"
            );
        }
        format!(
            "proven: no wall is entered by more than {depth} mm, everything cut that {shape} can reach; it can't reach {} mm² of {} mm²\n",
            figure(proof.unreachable_area),
            figure(proof.region_area),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_files_are_told_apart() {
        assert_eq!("rect:12x4".parse(), Ok(ProfileArg::Shape(ToolShape::Rectangle(12.0, 4.0))));
        assert_eq!("file:tool.svg".parse(), Ok(ProfileArg::File("tool.svg".into(), 0.0)));
        assert_eq!("file:a@b.svg@90".parse(), Ok(ProfileArg::File("a@b.svg".into(), std::f64::consts::FRAC_PI_2)));
        assert!("file:".parse::<ProfileArg>().is_err() && "12x4".parse::<ProfileArg>().is_err());
    }
}
