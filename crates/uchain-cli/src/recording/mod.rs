//! Commands on recordings (`inspect`, `verify`, `diff`): their arguments, and how a recording is opened.

mod diff;
mod inspect;
mod verify;

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use uchain_sim::registry::{AnyRecording, Registry};

use crate::{
    exit::Failure,
    flags::{Out, Quiet, Say},
    output::Folder,
};

pub(crate) use diff::diff;
pub(crate) use inspect::inspect;
pub(crate) use verify::verify;

const INSPECT_EXAMPLES: &str = "\
Examples:
  uchain inspect runs/corner-s1/run.mcap
  uchain inspect run.mcap --json | jq '.moments[] | [.time_s, .worst_link_db]'
  uchain inspect run.mcap --out again        inspect.json and run.png, the same picture as the run's

A recording that was cut short is read up to its last whole chunk. A damaged one is refused, exit code 3.
";

const VERIFY_EXAMPLES: &str = "\
Examples:
  uchain verify runs/corner-s1/run.mcap && echo the same
  uchain verify old.mcap                     does this version still fly as the one that recorded it?

Flies the scenario in the recording with its seed, in the walls that were recorded: no other file is needed.
Names the first tick that differs in any bit, and ends with exit code 4.
";

const DIFF_EXAMPLES: &str = "\
Examples:
  uchain diff runs/corner-s1/run.mcap runs/corner-s2/run.mcap
  uchain diff before.mcap after.mcap && echo the same flight

Says in which keys the scenarios differ, where the flights part, and for every quantity how far they get apart.
Exit code 4 if the flights differ.
";

/// Whether a flight is recorded.
#[derive(Debug, Args)]
pub(crate) struct Choice {
    /// Record the flight in run.mcap (this is the default)
    #[arg(long, overrides_with = "no_record")]
    record: bool,
    /// Leave no run.mcap
    #[arg(long)]
    no_record: bool,
}

impl Choice {
    pub(crate) fn wanted(&self) -> bool {
        self.record || !self.no_record
    }
}

/// A look into a recording.
#[derive(Debug, Args)]
#[command(after_help = INSPECT_EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Also write inspect.json and run.png into this folder")))]
#[command(mut_arg("json", |json| json.help("Print summary and numbers over time as JSON on stdout, and nothing else there")))]
pub(crate) struct Inspect {
    /// A recording, such as runs/corner-s1/run.mcap
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    #[command(flatten)]
    out: Out,
    #[command(flatten)]
    say: Say,
}

impl Inspect {
    /// Where picture and numbers go, if anywhere.
    fn folder(&self) -> Result<Option<Folder>, Failure> {
        self.out.chosen()?.map(|folder| folder.only_of(&self.file)).transpose()
    }
}

/// A recording flown again.
#[derive(Debug, Args)]
#[command(after_help = VERIFY_EXAMPLES)]
pub(crate) struct Verify {
    /// A recording, such as runs/corner-s1/run.mcap
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    #[command(flatten)]
    quiet: Quiet,
}

/// Two recordings side by side.
#[derive(Debug, Args)]
#[command(after_help = DIFF_EXAMPLES)]
pub(crate) struct Diff {
    /// A recording
    #[arg(value_name = "A", value_hint = ValueHint::FilePath)]
    here: PathBuf,
    /// Another one
    #[arg(value_name = "B", value_hint = ValueHint::FilePath)]
    there: PathBuf,
    #[command(flatten)]
    quiet: Quiet,
}

fn open(registry: Registry, file: &Path) -> Result<Box<dyn AnyRecording>, Failure> {
    registry.open(file).map_err(|cause| Failure::Recording { file: file.to_owned(), cause })
}
