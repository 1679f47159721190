//! Arguments of `uchain radio`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueHint};
use uchain_sim::{
    radio_fit::{Mapping, about_columns},
    registry::Spot,
};

use crate::{
    flags::{Out, Say, Sets},
    plan::spot,
};

pub(crate) const EXAMPLES: &str = "\
Examples:
  uchain radio fit --template > mine.csv     a log for your radio to go on with
  uchain radio fit walk.csv                  exponent, noise, shadowing, with intervals
  uchain radio map corner                    what is lost from the base to everywhere
";

const FIT: &str = "\
Examples:
  uchain radio fit --template > mine.csv
  uchain radio fit walk.csv                  fits/walk: fit.json, fit.png, radio.toml
  uchain radio fit theirs.csv --columns distance_m=distance*0.01,rssi_dbm=rssiBLE
  uchain radio fit poses.csv --anchors anchors.csv --columns x1_m=x,y1_m=y,rssi_dbm=rssi_*
  uchain radio fit walk.csv --plan corner    relays by the fit, and over its interval
  uchain radio fit walk.csv --plan basement.yaml --base=-50.15,34.03 --goal=-3,25.7

Fits loss = L0 + 10 alpha log10(d/d0), noise that is new at every packet and shadowing that stays with
the place, by restricted maximum likelihood; packets that were not heard count as ones that lost more
than the radio hears. What the data do not support is refused: exit code 3, no radio.toml, and the
picture shows why.
";

const MAP: &str = "\
Examples:
  uchain radio map corner                    from the base; radiomaps/corner
  uchain radio map corner --from=3,0 --set takeoff.s_min_db=64
  uchain radio map corner --along            along the tunnel: a table and a line
  uchain radio map basement.yaml --from=-50.15,34.03 --set radio.alpha_free=2.5

Noise is off. The line in the picture is where a link loses takeoff.s_min_db. Writes loss.png, loss.csv
and loss.json.
";

/// What to do with a radio.
#[derive(Debug, Subcommand)]
pub(crate) enum Radio {
    /// What a log of losses says about the radio that made it
    Fit(Box<Fit>),
    /// What a radio loses from one place to all of a map, or along its tunnel
    Map(Box<Map>),
}

/// A log, fitted.
#[derive(Debug, Args)]
#[command(after_help = format!("{FIT}\nColumns:\n{}", about_columns()))]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: fits/<log>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the fit as JSON on stdout, and nothing else there")))]
#[command(mut_arg("set", |set| set.help("Write one value over the scenario of --plan (repeatable); the fit's own go over it")))]
pub(crate) struct Fit {
    /// The log, a table in CSV: a row for every packet, columns as listed below
    #[arg(value_name = "LOG", value_hint = ValueHint::FilePath, required_unless_present = "template")]
    pub(crate) log: Option<PathBuf>,
    /// Print the header of a log and three rows, and do nothing else
    #[arg(long, conflicts_with_all = ["log", "json", "out", "plan"])]
    pub(crate) template: bool,
    /// What the log's columns are called: OURS=THEIRS, THEIRS*FACTOR, NAME* (one for every link) or a number
    #[arg(long, value_name = "OURS=THEIRS")]
    pub(crate) columns: Option<Mapping>,
    /// Where the fixed ends of the links stand: a table with the columns id, x, y and perhaps z (m)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) anchors: Option<PathBuf>,
    /// Fit this link alone
    #[arg(long, value_name = "NAME")]
    pub(crate) link: Option<String>,
    /// Power that packets are sent with, antennas' gains in it [default: 0, the loss is minus the received power]
    #[arg(long, value_name = "DBM", value_parser = power, allow_hyphen_values = true)]
    pub(crate) tx_dbm: Option<f64>,
    /// What stands in the log for a packet that was not heard, beside an empty cell
    #[arg(long, value_name = "VALUE", value_parser = number, allow_hyphen_values = true)]
    pub(crate) lost: Option<f64>,
    /// Distance that L0 is said at [default: 0.25]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub(crate) reference_m: Option<f64>,
    /// Plan for this scenario or map with the fitted radio, at its best and at both ends of its interval
    #[arg(long, value_name = "NAME|FILE|MAP", value_hint = ValueHint::FilePath)]
    pub(crate) plan: Option<String>,
    /// Where the base station stands, for --plan: X,Y, or a place that the map names
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true, requires = "plan")]
    pub(crate) base: Option<Spot>,
    /// The deepest place the head may be sent to, for --plan: X,Y, or a place that the map names
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true, requires = "plan")]
    pub(crate) goal: Option<Spot>,
    /// How deep the head is to go, for --plan [default: as deep as the tunnel is known]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true, requires = "plan")]
    pub(crate) to: Option<f64>,
    #[command(flatten)]
    pub(crate) sets: Sets,
    #[command(flatten)]
    pub(crate) out: Out,
    #[command(flatten)]
    pub(crate) say: Say,
}

/// Losses over a map.
#[derive(Debug, Args)]
#[command(after_help = MAP)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: radiomaps/<scenario or file>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the losses as JSON on stdout, and nothing else there")))]
pub(crate) struct Map {
    /// Name of a built-in scenario, path of a scenario file, or of a map
    #[arg(value_name = "NAME|FILE|MAP", value_hint = ValueHint::FilePath)]
    pub(crate) what: String,
    /// From where: X,Y, or a place that the map names [default: the scenario's base]
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true)]
    pub(crate) from: Option<Spot>,
    /// Along the tunnel, in a table and a line, instead of all of the map
    #[arg(long)]
    pub(crate) along: bool,
    /// Where the tunnel ends, for --along in a map that has none: X,Y, or a place that the map names
    #[arg(long, value_name = "X,Y|NAME", value_parser = spot, allow_hyphen_values = true, requires = "along")]
    pub(crate) goal: Option<Spot>,
    #[command(flatten)]
    pub(crate) sets: Sets,
    #[command(flatten)]
    pub(crate) out: Out,
    #[command(flatten)]
    pub(crate) say: Say,
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "expected a number, such as 0.5".to_owned())
}

fn power(text: &str) -> Result<f64, String> {
    number(text)
        .ok()
        .filter(|dbm| dbm.abs() <= 100.0)
        .ok_or_else(|| "expected dBm, from -100 to 100".to_owned())
}
