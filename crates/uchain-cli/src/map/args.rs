//! Arguments of `uchain map`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueHint};
use uchain_sim::map::make::{KINDS, Kind};

use crate::flags::{MapArgs, Quiet, Say, Sets};

pub(crate) const EXAMPLES: &str = "\
Examples:
  uchain map make branching --seed 3 --out mine.png   a mine to try things on
  uchain map info mine.yaml                  what is it, and where would a chain go?
  uchain map plot mine.yaml --graph          a picture to read --base and --goal off
  uchain map convert mine.yaml mine.csv      its walls as a table

Then: uchain plan mine.yaml --base=X,Y --goal=X,Y
";

const INFO: &str = "\
Examples:
  uchain map info basement.yaml
  uchain map info stata                      the map of a scenario
  uchain map info floor.pgm --cell 0.1       a bare picture needs its scale

Says what kind of file it is, what of it was dropped, guessed or merged, how large it is, how wide its
passages are and what is too narrow, and proposes a base and a goal.
";

const PLOT: &str = "\
Examples:
  uchain map plot basement.yaml              plots/basement.png
  uchain map plot basement.yaml --graph      with the middle of its passages, junctions and dead ends
  uchain map plot basement.yaml --at=-50.15,34.03 --at=-3,25.7   is that free, and how near is a wall?
  uchain map plot corner --out corner.png

To scale, with a grid in the coordinates of the map's own file: what is read off can be typed as --base
and --goal.
";

const CONVERT: &str = "\
Examples:
  uchain map convert corner corner.yaml      for ROS: corner.yaml and corner.pgm
  uchain map convert basement.yaml coarse.png --out-cell 0.2   larger cells; coarse.yaml says so
  uchain map convert basement.yaml walls.csv   corners as a table

The end of the name says what is written. SVG, GeoJSON and CSV keep every wall where it is; cells keep
it within half a cell.
";

const MAKE: &str = "\
Examples:
  uchain map make tunnel --seed 1 --length 300 --width 2.5 --out tunnel.png
  uchain map make branching --seed 3 --length 2000 --out mine.png
  uchain map make cave --seed 5 --size 80,60 --roughness 0.5 --out cave.png
  uchain map make room-and-pillar --seed 2 --out pillars.csv

Kinds: tunnel (one winding way), cave (rugged chambers and passages), maze (one way between two
places), rooms (rooms with doors), room-and-pillar (a mine on pillars), branching (a mine of one drift
and its galleries). The same seed makes the same map on every computer. A picture (.png, .pgm) has a
.yaml beside it that says its scale: give that to the other commands.
";

/// What to do with a map.
#[derive(Debug, Subcommand)]
pub(crate) enum Map {
    /// What a map is: its size, its passages, what was not read
    #[command(after_help = INFO)]
    Info(Info),
    /// Draw a map to scale, to read coordinates off
    #[command(after_help = PLOT)]
    Plot(Plot),
    /// Write a map as another kind of file
    #[command(after_help = CONVERT)]
    Convert(Convert),
    /// Make a map: a tunnel, a cave, a maze, rooms, a mine
    #[command(after_help = MAKE)]
    Make(Make),
}

/// Which map, and how it is read.
#[derive(Debug, Args)]
pub(crate) struct Read {
    /// Path of a map or of a scenario file, or name of a built-in scenario
    #[arg(value_name = "MAP|NAME", value_hint = ValueHint::FilePath)]
    pub(crate) what: String,
    #[command(flatten)]
    pub(crate) map: MapArgs,
    /// Survey station where the branch ends (needs --from)
    #[arg(long, value_name = "STATION")]
    pub(crate) to: Option<String>,
    #[command(flatten)]
    pub(crate) sets: Sets,
}

/// Numbers of a map.
#[derive(Debug, Args)]
#[command(mut_arg("json", |json| json.help("Print everything as JSON on stdout, and nothing else there")))]
pub(crate) struct Info {
    #[command(flatten)]
    pub(crate) read: Read,
    #[command(flatten)]
    pub(crate) say: Say,
}

/// A picture of a map.
#[derive(Debug, Args)]
pub(crate) struct Plot {
    #[command(flatten)]
    pub(crate) read: Read,
    /// Mark a place, and say whether it is free and how near a wall is (repeatable)
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) at: Vec<[f64; 2]>,
    /// Draw the middle of all passages, where they meet and where they end, with coordinates
    #[arg(long)]
    pub(crate) graph: bool,
    /// The picture [default: plots/<scenario or file>.png, overwritten]
    #[arg(long, value_name = "FILE.png", value_hint = ValueHint::FilePath)]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file of --out if it is there already
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) quiet: Quiet,
}

/// A map as another kind of file.
#[derive(Debug, Args)]
pub(crate) struct Convert {
    #[command(flatten)]
    pub(crate) read: Read,
    /// File to write: .yaml, .pgm or .png (ROS), .svg, .geojson, .csv
    #[arg(value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(crate) out: PathBuf,
    /// Side of a cell of what is written, for ROS [default: 0.05, larger for large maps]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub(crate) out_cell: Option<f64>,
    /// Replace OUT if it is there already
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) quiet: Quiet,
}

/// A map out of nothing.
#[derive(Debug, Args)]
pub(crate) struct Make {
    /// tunnel, cave, maze, rooms, room-and-pillar or branching
    #[arg(value_name = "KIND", value_parser = kind)]
    pub(crate) kind: Kind,
    /// Which one of them
    #[arg(long, value_name = "N", value_parser = crate::flags::seed, default_value = "1", allow_hyphen_values = true)]
    pub(crate) seed: u64,
    /// Length of all ways together (tunnel, branching) [default: 100 and 1000]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true, conflicts_with = "size")]
    pub(crate) length: Option<f64>,
    /// Size across and up (the other kinds) [default: by kind, 20,15 to 120,80]
    #[arg(long, value_name = "X,Y", value_parser = size, allow_hyphen_values = true)]
    pub(crate) size: Option<[f64; 2]>,
    /// Width of the passages, of doors in rooms [default: by kind, 1 to 5]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub(crate) width: Option<f64>,
    /// By which share of it the width varies, 0 to 0.5 (tunnel, cave, branching) [default: 0.1, cave 0.4]
    #[arg(long, value_name = "SHARE", value_parser = number, allow_hyphen_values = true)]
    pub(crate) roughness: Option<f64>,
    /// File to write: .png or .pgm (ROS, with a .yaml beside it), .yaml, .svg, .geojson, .csv
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) out: PathBuf,
    /// Side of a cell of a picture [default: 0.05, larger for large maps]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub(crate) out_cell: Option<f64>,
    /// Replace the file if it is there already
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) quiet: Quiet,
}

fn kind(name: &str) -> Result<Kind, String> {
    // What people call the one that looks like one.
    let name = if name == "mine" { "branching" } else { name };
    Kind::find(name).ok_or_else(|| format!("expected one of {}", KINDS.map(Kind::name).join(", ")))
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "expected a number, such as 0.5".to_owned())
}

fn pair(text: &str, separators: &[char]) -> Option<[f64; 2]> {
    let (x, y) = text.trim_matches(['[', ']']).split_once(separators)?;
    Some([number(x.trim()).ok()?, number(y.trim()).ok()?])
}

fn point(text: &str) -> Result<[f64; 2], String> {
    pair(text, &[',']).ok_or_else(|| "expected X,Y in metres, such as --at=-50.15,34.03".to_owned())
}

fn size(text: &str) -> Result<[f64; 2], String> {
    pair(text, &[',', 'x']).ok_or_else(|| "expected X,Y in metres, such as --size 80,60".to_owned())
}
