//! Commands on sweeps, many runs of a scenario (`sweep`, `merge`, `report`, `repro`): their arguments.

mod fly;
mod merge;
mod progress;
mod report;
mod repro;
mod summary;

use std::path::PathBuf;

use clap::{Args, ValueEnum, ValueHint};
use uchain_sim::sweep::folder::{Record, Shard};

use crate::flags::{Out, Quiet, Say, Sets, seed};

pub(crate) use fly::fly;
pub(crate) use merge::merge;
pub(crate) use report::report;
pub(crate) use repro::repro;

const VARY: &str = "Fly every value of a key: radio.sigma_db=1,3,5, or a range with both ends, \
                    equalize.tolerance_db=0..5/6 (repeatable: every combination)";
const DESIGN: &str = "Fly the rows of a table, a variant each; its first line holds keys, an empty cell leaves the scenario's value";

const SWEEP_EXAMPLES: &str = "\
Examples:
  uchain sweep corner --replicates 100 --out sweeps/corner
  uchain sweep corner --vary radio.sigma_db=1,3,5 --vary chain.uavs=2..6/5 --replicates 20 --out sigma
  uchain sweep ./mine.toml --design design.csv --replicates 5 --out d --record failed
  uchain sweep corner --replicates 100 --out sweeps/corner --resume      go on where it stopped
  uchain sweep corner --replicates 1000 --shard 2/4 --out part2          a quarter of it, then: uchain merge

Leaves DIR/runs.parquet, a row a run; a run that failed is a row with its reason. The bytes are the same for any
number of threads, for shards that are merged and for sweeps that were stopped and resumed. The runs of a
replicate have the same seed in all variants; uchain run --seed with the seed of a row flies it alone.
Then: uchain report DIR, uchain repro DIR --run I.
";

const MERGE_EXAMPLES: &str = "\
Examples:
  uchain merge part1 part2 part3 part4 --out whole
  uchain merge part* --out whole --json | jq -r .digest

Makes one runs.parquet of the folders of uchain sweep --shard, which stay as they are. It is the same, byte for
byte, as if one process had flown it all.
";

const REPORT_EXAMPLES: &str = "\
Examples:
  uchain report sweeps/corner
  uchain report sweeps/corner --quiet && less sweeps/corner/report.md

Writes report.md (mean, 95 % interval of the mean and median of every number in every variant), report.csv (the
same for programs) and plots/, a PNG and an SVG a number, into the sweep's folder.
";

const REPRO_EXAMPLES: &str = "\
Examples:
  uchain repro sweeps/corner --run 17                  results in runs/corner-run17
  uchain repro sweeps/corner --run 17 --out seventeen  run.mcap, run.png and summary.json there

Flies one row of a sweep again, alone and with a recording. Exit code 4 if its digest is not that of the row.
";

/// Many runs.
#[derive(Debug, Args)]
#[command(after_help = SWEEP_EXAMPLES)]
#[command(mut_arg("json", |json| json.help("Print what it came to as JSON on stdout, and nothing else there")))]
pub(crate) struct Sweep {
    /// Name of a built-in scenario, or path of a file (holds a / or ends in .toml)
    #[arg(value_name = "NAME|FILE", value_hint = ValueHint::FilePath)]
    scenario: String,
    #[arg(long, value_name = "KEY=VALUES", value_parser = varied, help = VARY)]
    vary: Vec<String>,
    #[arg(long, value_name = "FILE.csv", value_hint = ValueHint::FilePath, help = DESIGN)]
    design: Option<PathBuf>,
    /// Runs of every variant, each with a seed of its own
    #[arg(long, value_name = "N", default_value_t = 1)]
    replicates: u64,
    /// Root seed: that of every run follows from it and the replicate
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed)]
    seed: u64,
    /// Folder for the results
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Runs at one time [default: one for every processor]
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<usize>,
    /// Fly only the I-th of N parts, into a folder of its own; uchain merge puts them together
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Go on with the sweep in --out; what is done stays
    #[arg(long)]
    resume: bool,
    /// Which runs leave a recording, in DIR/recordings
    #[arg(long, value_name = "WHICH", value_enum, default_value_t = Recorded::None)]
    record: Recorded,
    #[command(flatten)]
    sets: Sets,
    #[command(flatten)]
    say: Say,
}

/// Shards put together.
#[derive(Debug, Args)]
#[command(after_help = MERGE_EXAMPLES)]
#[command(mut_arg("json", |json| json.help("Print what it came to as JSON on stdout, and nothing else there")))]
pub(crate) struct Merge {
    /// Folders of one sweep, flown in parts
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath, required = true)]
    folders: Vec<PathBuf>,
    /// Folder for the whole
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    #[command(flatten)]
    say: Say,
}

/// A sweep in tables and pictures.
#[derive(Debug, Args)]
#[command(after_help = REPORT_EXAMPLES)]
pub(crate) struct Report {
    /// Folder of a sweep
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    #[command(flatten)]
    quiet: Quiet,
}

/// One row flown again.
#[derive(Debug, Args)]
#[command(after_help = REPRO_EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: runs/<scenario or file>-run<I>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the summary as JSON on stdout, and nothing else there")))]
pub(crate) struct Repro {
    /// Folder of a sweep
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    /// Which run: column `run` of its table
    #[arg(long, value_name = "I")]
    run: u64,
    #[command(flatten)]
    out: Out,
    #[command(flatten)]
    say: Say,
}

/// Which runs leave a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Recorded {
    Failed,
    None,
    All,
}

impl From<Recorded> for Record {
    fn from(asked: Recorded) -> Self {
        match asked {
            Recorded::Failed => Self::Failed,
            Recorded::None => Self::None,
            Recorded::All => Self::All,
        }
    }
}

fn varied(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, values)) if !key.trim().is_empty() && !values.trim().is_empty() => Ok(text.to_owned()),
        _ => {
            Err("expected key=values, such as radio.sigma_db=1,3,5 or equalize.tolerance_db=0..5/6"
                .to_owned())
        }
    }
}

fn threads(text: &str) -> Result<usize, String> {
    const MOST: usize = 1024;
    let threads = text.parse().ok().filter(|threads| (1..=MOST).contains(threads));
    threads.ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))
}

fn shard(text: &str) -> Result<Shard, String> {
    let read = || {
        let (number, of) = text.split_once('/')?;
        let shard = Shard { number: number.parse().ok()?, of: of.parse().ok()? };
        (1..=shard.of).contains(&shard.number).then_some(shard)
    };
    read().ok_or_else(|| "expected I/N with I from 1 to N, such as 2/4".to_owned())
}
