//! Arguments of `uchain plan`.

use clap::{Args, ValueHint};
use uchain_sim::mission::chain::UAVS_MAX;

use crate::flags::{Out, Say, Sets};

const BASE: &str = "Where the base station stands (short for --set 'chain.base_m=[X, Y]')";
const HEADING: &str = "Direction of the tunnel at the base (short for --set chain.heading_deg=DEG)";
const GOAL: &str = "The deepest place the head may be sent to (short for --set 'chain.goal_m=[X, Y]')";

const EXAMPLES: &str = "\
Examples:
  uchain plan corner
  uchain plan ./mine.toml --to 12 --uavs 6 --set takeoff.s_min_db=65
  uchain plan basement.yaml --base=-50.15,34.03 --goal=-3,25.7 --speed 0.1

A bare ROS map (map_server's yaml) needs --base and --goal, in the map's own frame; everything else
has a default. Writes plan.json and plan.png.
";

/// One plan.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: plans/<scenario or file>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the whole plan as JSON on stdout, and nothing else there")))]
pub(crate) struct Plan {
    /// Name of a built-in scenario, path of a scenario file, or of a ROS map (ends in .yaml)
    #[arg(value_name = "NAME|FILE|MAP", value_hint = ValueHint::FilePath)]
    pub(crate) what: String,
    /// How deep the head is to go [default: as deep as the tunnel is known]
    #[arg(long, value_name = "M", value_parser = length, allow_hyphen_values = true)]
    pub(crate) to: Option<f64>,
    /// Distance between the rows [default: 10 to 20 rows, finer in the files]
    #[arg(long, value_name = "M", value_parser = length, allow_hyphen_values = true)]
    pub(crate) step: Option<f64>,
    /// UAVs at hand, the head included [default: the scenario's; for a bare map as many as it takes]
    #[arg(long, value_name = "N", value_parser = uavs, allow_hyphen_values = true)]
    pub(crate) uavs: Option<usize>,
    /// Speed of the head [default: the scenario's; for a bare map 0.2]
    #[arg(long, value_name = "MPS", value_parser = speed, allow_hyphen_values = true)]
    pub(crate) speed: Option<f32>,
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, help = BASE)]
    pub(crate) base: Option<[f64; 2]>,
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true, help = HEADING)]
    pub(crate) heading: Option<f64>,
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, help = GOAL)]
    pub(crate) goal: Option<[f64; 2]>,
    #[command(flatten)]
    pub(crate) out: Out,
    #[command(flatten)]
    pub(crate) sets: Sets,
    #[command(flatten)]
    pub(crate) say: Say,
}

fn point(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let numbers: Vec<Option<f64>> = text.trim_matches(['[', ']']).split(',').map(number).collect();
    match numbers.as_slice() {
        [Some(x_m), Some(y_m)] => Ok([*x_m, *y_m]),
        _ => Err("expected X,Y in metres, such as --base=-50.15,34.03".to_owned()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    let length_m = text.parse().ok().filter(|length_m: &f64| length_m.is_finite() && *length_m > 0.0);
    length_m.ok_or_else(|| "expected a length in metres, more than 0".to_owned())
}

fn uavs(text: &str) -> Result<usize, String> {
    let uavs = text.parse().ok().filter(|uavs| (1..=UAVS_MAX).contains(uavs));
    uavs.ok_or_else(|| format!("expected a whole number from 1 to {UAVS_MAX}"))
}

fn angle(text: &str) -> Result<f64, String> {
    let angle_deg = text.parse().ok().filter(|angle_deg: &f64| angle_deg.abs() <= 360.0);
    angle_deg.ok_or_else(|| "expected an angle in degrees, from -360 to 360".to_owned())
}

fn speed(text: &str) -> Result<f32, String> {
    let speed_mps = text.parse().ok().filter(|speed_mps| *speed_mps > 0.0 && *speed_mps <= 1.0);
    speed_mps.ok_or_else(|| "expected a speed in m/s, more than 0 and at most 1".to_owned())
}
