//! What may be asked. clap lives here only.

use std::{ffi::OsString, path::PathBuf, process::ExitCode};

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::exit::{self, Exit};

const EXAMPLES: &str = "\
Examples:
  uchain list                                what is there to fly
  uchain run corner                          fly it; results in runs/corner-s1
  uchain run corner --seed 7 --set chain.uavs=5 --set radio.sigma_db=0
  uchain show corner > mine.toml             copy a scenario and edit it
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

const SET_HELP: &str =
    "Write one value over the scenario's, such as chain.uavs=5 or pilot.0.speed_mps=0.1 (repeatable)";

/// Fly a chain of UAVs that keep a radio link through a tunnel, and look at what it came to.
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
    /// List the scenarios that are built in
    List,
    /// Print a scenario's TOML, to copy and edit
    Show {
        /// Name of a built-in scenario
        #[arg(value_name = "NAME")]
        scenario: String,
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
