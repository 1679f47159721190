//! What may be asked. clap lives here only.

use std::{ffi::OsString, path::PathBuf, process::ExitCode};

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};

use uchain_sim::config::UAVS_MAX;

use crate::exit::{self, Exit};

const EXAMPLES: &str = "\
Examples:
  uchain list                                what is there to fly
  uchain run corner                          fly it; results in runs/corner-s1
  uchain run corner --seed 7 --set chain.uavs=5 --set radio.sigma_db=0
  uchain run apartment --set explore.robots=4   robots explore rooms together
  uchain run corner --set preset=cavemod     with the values of the authors' firmware
  uchain plan corner                         how many UAVs does it need? (flies nothing)
  uchain show corner > mine.toml             copy a scenario and edit it
  uchain show --preset cavemod               what is in a preset
  uchain check mine.toml                     is it right? (flies nothing)
  uchain run ./mine.toml --out results/a --json | jq .spread_db
";

const RUN_EXAMPLES: &str = "\
Examples:
  uchain run corner
  uchain run corner --seed 7 --set takeoff.s_min_db=55 --set 'pilot.0.follow=left'
  uchain run ./mine.toml --out results/a --json

Writes summary.json and run.png. Same scenario, same seed: same digest, bit for bit.
";

const PLAN_EXAMPLES: &str = "\
Examples:
  uchain plan corner
  uchain plan ./mine.toml --to 40 --uavs 6 --set takeoff.s_min_db=65
  uchain plan basement.yaml --base=-50.15,34.03 --goal=-3,25.7 --speed 0.1

A bare ROS map (map_server's yaml) needs --base and --goal, in the map's own frame; everything else
has a default. Writes plan.json and plan.png.
";

const SET_HELP: &str =
    "Write one value over the scenario's, such as chain.uavs=5 or pilot.0.speed_mps=0.1 (repeatable)";

/// Fly a chain of UAVs that keep a radio link through a tunnel, or robots that explore rooms, and look at what it
/// came to.
#[derive(Debug, Parser)]
#[command(name = "uchain", version, max_term_width = 100, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Fly a scenario; leave a summary and a picture
    Run(Run),
    /// How many UAVs does a tunnel need, and for how long? (flies nothing)
    Plan(Plan),
    /// List the scenarios and the presets that are built in
    List,
    /// Print the TOML of a scenario or a preset, to copy and edit
    Show {
        /// Name of a built-in scenario
        #[arg(value_name = "NAME", required_unless_present = "preset")]
        scenario: Option<String>,
        /// Name of a preset: values that --set preset=NAME writes under those of a scenario
        #[arg(long, value_name = "NAME", conflicts_with = "scenario")]
        preset: Option<String>,
    },
    /// Read a scenario and its map, lay everything out, fly nothing
    Check {
        /// Path of a scenario file, or name of a built-in scenario
        #[arg(value_name = "FILE|NAME")]
        scenario: String,
        #[arg(long, value_name = "KEY=VALUE", value_parser = assignment, help = SET_HELP)]
        set: Vec<String>,
    },
}

/// One flight.
#[derive(Debug, Args)]
#[command(after_help = RUN_EXAMPLES)]
pub(crate) struct Run {
    /// Name of a built-in scenario, or path of a file (holds a / or ends in .toml)
    #[arg(value_name = "NAME|FILE")]
    pub(crate) scenario: String,
    /// Seed of all noise in the run
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Folder for the results [default: runs/<scenario>-s<seed>, overwritten]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write into --out even if it holds something else; only our own files are replaced
    #[arg(long)]
    pub(crate) force: bool,
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment, help = SET_HELP)]
    pub(crate) set: Vec<String>,
    /// Print the summary as JSON on stdout, and nothing else there
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress and no summary; files and errors only
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// One plan.
#[derive(Debug, Args)]
#[command(after_help = PLAN_EXAMPLES)]
pub(crate) struct Plan {
    /// Name of a built-in scenario, path of a scenario file, or of a ROS map (ends in .yaml)
    #[arg(value_name = "NAME|FILE|MAP")]
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
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, help = "Where the base station stands (short for --set chain.base_m=[X, Y])")]
    pub(crate) base: Option<[f64; 2]>,
    #[arg(
        long,
        value_name = "DEG",
        value_parser = angle,
        allow_hyphen_values = true,
        help = "Direction of the tunnel at the base (short for --set chain.heading_deg=DEG)"
    )]
    pub(crate) heading: Option<f64>,
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, help = "The deepest place the head may be sent to (short for --set chain.goal_m=[X, Y])")]
    pub(crate) goal: Option<[f64; 2]>,
    /// Folder for the results [default: plans/<name>, overwritten]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write into --out even if it holds something else; only our own files are replaced
    #[arg(long)]
    pub(crate) force: bool,
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment, help = SET_HELP)]
    pub(crate) set: Vec<String>,
    /// Print the whole plan as JSON on stdout, and nothing else there
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress and no table; files and errors only
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// A command line, taken apart.
pub(crate) enum Asked {
    /// To be obeyed.
    Command(Command),
    /// Help, version or a usage error: already on the screen.
    Answered(ExitCode),
}

/// Takes a command line apart; the first argument is the program's name.
pub(crate) fn parse(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Asked {
    let command = Cli::command().after_help(format!("{EXAMPLES}\n{}", exit::table()));
    match command.try_get_matches_from(args).and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => Asked::Command(cli.command),
        Err(answer) => {
            // A reader that went away has seen enough.
            let _ = answer.print();
            let exit = if answer.use_stderr() { Exit::Usage } else { Exit::Ok };
            Asked::Answered(exit.code())
        }
    }
}

fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("expected key=value, such as equalize.v_max_mps=0.2".to_owned()),
    }
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
