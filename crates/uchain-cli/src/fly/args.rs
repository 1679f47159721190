//! Arguments of `uchain run`.

use clap::{Args, ValueHint};

use crate::{
    exit::Failure,
    flags::{Out, Say, Sets, seed},
    output::{Folder, folder_name},
    recording,
};

const EXAMPLES: &str = "\
Examples:
  uchain run corner
  uchain run corner --seed 7 --set takeoff.s_min_db=55 --set 'pilot.0.follow=left'
  uchain run apartment --set explore.robots=4 --set explore.strategy=srg
  uchain run city.map --set map.cell_m=0.25 --set explore.robots=20    a MovingAI map; or map.yaml, a ROS map
  uchain run ./mine.toml --out results/a --json

Writes run.mcap while it flies (open it in Foxglove or Rerun), then summary.json and run.png. A run that is
stopped leaves run.mcap, readable up to there. Same scenario, same seed: same digest, bit for bit.
Of an exploration there is map.yaml with map.pgm besides: what was seen, as a ROS map.
";

/// One flight.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: runs/<scenario or file>-s<seed>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the summary as JSON on stdout, and nothing else there")))]
pub(crate) struct Run {
    /// Name of a built-in scenario, or path of a file (holds a / or ends in .toml); a bare map (.map, .yaml, .pgm) is explored
    #[arg(value_name = "NAME|FILE", value_hint = ValueHint::FilePath)]
    pub(crate) scenario: String,
    /// Seed of all noise in the run
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) out: Out,
    #[command(flatten)]
    pub(crate) sets: Sets,
    #[command(flatten)]
    pub(crate) recording: recording::Choice,
    #[command(flatten)]
    pub(crate) say: Say,
}

impl Run {
    /// Where the results go.
    pub(crate) fn folder(&self) -> Result<Folder, Failure> {
        self.out.folder(|| Folder::ours("runs", &folder_name(&self.scenario), &format!("-s{}", self.seed)))
    }
}
