//! Arguments of `uchain plan`.

use clap::{Args, ValueHint};
use uchain_sim::{mission::chain::UAVS_MAX, radio::LinkBudget, registry::Spot};

use crate::flags::{MapArgs, Out, Say, Sets};

const BASE: &str = "Where the base station stands: X,Y in the map's own frame, or a place that the map names";
const HEADING: &str = "Direction of the tunnel at the base (short for --set chain.heading_deg=DEG)";
const GOAL: &str = "The deepest place the head may be sent to: X,Y, or a place that the map names";
const BUDGET: &str = "Work limit and reference loss out of a link budget, all in path loss: crazyflie, a .toml file, or \
                      key=value,key=value of tx_dbm, tx_gain_dbi, rx_gain_dbi, sensitivity_dbm, margin_db, frequency_mhz";

const EXAMPLES: &str = "\
Examples:
  uchain plan corner
  uchain plan ./mine.toml --to 12 --uavs 6 --set takeoff.s_min_db=65
  uchain plan basement.yaml --base=-50.15,34.03 --goal=-3,25.7 --speed 0.1 --stay 2
  uchain plan map.pgm --cell 0.1 --base=2,2 --goal=40.5,14.5   a picture, 0.1 m a pixel
  uchain plan corner --budget crazyflie --fly 2   a radio's data sheet, and two flights
  uchain plan basement.yaml --base=-50.15,34.03 --everywhere   where could one go?

A bare map needs --base and --goal: X,Y in the map's own frame, or places that it names. --from and --to cut a
branch out of a cave survey, with base and goal at its ends. What is assumed is said first; then relays against
depth, where they stand, whose battery lasts for the way in and back, and how much hangs on a decibel. Nothing is
flown but with --fly. Writes plan.json, plan.png, places.csv and places.geojson.
";

/// One plan.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: plans/<scenario or file>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the whole plan as JSON on stdout, and nothing else there")))]
pub(crate) struct Plan {
    /// Name of a built-in scenario, path of a scenario file, or of a map
    #[arg(value_name = "NAME|FILE|MAP", value_hint = ValueHint::FilePath)]
    pub(crate) what: String,
    /// How deep the head is to go [default: as deep as the tunnel is known]; with --from, where the branch ends
    #[arg(long, value_name = "M|STATION", value_parser = to, allow_hyphen_values = true)]
    pub(crate) to: Option<To>,
    /// Distance between the rows [default: 10 to 20 rows, finer in the files]
    #[arg(long, value_name = "M", value_parser = length, allow_hyphen_values = true)]
    pub(crate) step: Option<f64>,
    /// UAVs at hand, the head included [default: the scenario's; for a bare map as many as it takes]
    #[arg(long, value_name = "N", value_parser = uavs, allow_hyphen_values = true)]
    pub(crate) uavs: Option<usize>,
    /// Speed of the head [default: the scenario's; for a bare map 0.2]
    #[arg(long, value_name = "MPS", value_parser = speed, allow_hyphen_values = true)]
    pub(crate) speed: Option<f32>,
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true, help = BASE)]
    pub(crate) base: Option<Spot>,
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true, help = HEADING)]
    pub(crate) heading: Option<f64>,
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true, help = GOAL)]
    pub(crate) goal: Option<Spot>,
    #[command(flatten)]
    pub(crate) map: MapArgs,
    /// How long the head stays at its goal before it turns back [default: 0]
    #[arg(long, value_name = "MIN", value_parser = stay, allow_hyphen_values = true)]
    pub(crate) stay: Option<f64>,
    /// Share of each battery that nobody may use [default: 0.2]
    #[arg(long, value_name = "SHARE", value_parser = reserve, allow_hyphen_values = true)]
    pub(crate) reserve: Option<f64>,
    #[arg(long, value_name = "BUDGET", value_parser = LinkBudget::read, help = BUDGET)]
    pub(crate) budget: Option<LinkBudget>,
    /// Work out the relays that every place of the map needs, too: everywhere.png and everywhere.csv; without --goal a bare map is planned to its farthest place
    #[arg(long)]
    pub(crate) everywhere: bool,
    /// Fly the plan with seeds 1 to N, and set flights beside plan
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub(crate) fly: Option<u64>,
    #[command(flatten)]
    pub(crate) out: Out,
    #[command(flatten)]
    pub(crate) sets: Sets,
    #[command(flatten)]
    pub(crate) say: Say,
}

/// A depth, or a station of a survey, whose name may be a number.
#[derive(Debug, Clone)]
pub(crate) struct To {
    /// Depth (m), if it is a number.
    pub(crate) depth_m: Option<f64>,
    /// Name of a station.
    pub(crate) station: String,
}

fn to(text: &str) -> Result<To, String> {
    let depth_m = text.parse::<f64>().is_ok().then(|| length(text)).transpose()?;
    Ok(To { depth_m, station: text.to_owned() })
}

/// Two numbers are a place; what is not made of numbers is a name.
pub(crate) fn spot(text: &str) -> Result<Spot, String> {
    let is_name = !text.is_empty()
        && text.split(',').any(|part| part.trim_matches(['[', ']', ' ']).parse::<f64>().is_err());
    match point(text) {
        Ok(at_m) => Ok(Spot::At(at_m)),
        Err(_) if is_name && !text.contains(',') => Ok(Spot::Named(text.to_owned())),
        Err(error) => Err(error),
    }
}

fn stay(text: &str) -> Result<f64, String> {
    let stay_min = text.parse().ok().filter(|stay_min: &f64| (0.0..=1440.0).contains(stay_min));
    stay_min.ok_or_else(|| "expected minutes, from 0 to 1440".to_owned())
}

fn reserve(text: &str) -> Result<f64, String> {
    let reserve = text.parse().ok().filter(|reserve: &f64| (0.0..=0.9).contains(reserve));
    reserve.ok_or_else(|| "expected a share, from 0 to 0.9, such as 0.2".to_owned())
}

fn point(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let numbers: Vec<Option<f64>> = text.trim_matches(['[', ']']).split(',').map(number).collect();
    match numbers.as_slice() {
        [Some(x_m), Some(y_m)] => Ok([*x_m, *y_m]),
        _ => {
            Err("expected X,Y in metres, such as --base=-50.15,34.03, or a place that the map names"
                .to_owned())
        }
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
