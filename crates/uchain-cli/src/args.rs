//! What may be asked. clap lives here and in `teach` only.

mod plan;
mod text;

use std::{ffi::OsString, io::Write as _, path::PathBuf, process::ExitCode};

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueHint};
use clap_complete::Shell;

use crate::{
    exit::{self, Exit, Failure},
    output::{Folder, called},
    paper, print, recording, sweep, teach,
};
pub(crate) use plan::Plan;

const SET: &str =
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
    /// Fly a scenario; leave a summary, a picture and a recording
    Run(Run),
    /// Look into a recording: summary, numbers over time, the picture again
    Inspect(recording::Inspect),
    /// Fly a recording again and compare every bit of every tick
    Verify(recording::Verify),
    /// Where two recordings part, and how far
    Diff(recording::Diff),
    /// Fly many runs of a scenario; leave a table, a row a run
    Sweep(Box<sweep::Sweep>),
    /// Put the shards of a sweep together
    Merge(sweep::Merge),
    /// Statistics of a sweep: tables and pictures
    Report(sweep::Report),
    /// Fly one row of a sweep again, with a recording
    Repro(sweep::Repro),
    /// How many UAVs does a tunnel need, and for how long? (flies nothing)
    Plan(Box<Plan>),
    /// Draw the figures and tables of the papers again, published values beside ours
    Paper(paper::Paper),
    /// List the scenarios and the presets that are built in
    #[command(after_help = text::LIST)]
    List,
    /// Print the TOML of a scenario or a preset, to copy and edit
    #[command(after_help = text::SHOW)]
    Show {
        /// Name of a built-in scenario
        #[arg(value_name = "NAME", required_unless_present = "preset")]
        scenario: Option<String>,
        /// Name of a preset: values that --set preset=NAME writes under those of a scenario
        #[arg(long, value_name = "NAME", conflicts_with = "scenario")]
        preset: Option<String>,
    },
    /// Read a scenario and its map, lay everything out, fly nothing
    #[command(after_help = text::CHECK)]
    Check {
        /// Path of a scenario file, or name of a built-in scenario
        #[arg(value_name = "FILE|NAME", value_hint = ValueHint::FilePath)]
        scenario: String,
        #[command(flatten)]
        sets: Sets,
        #[command(flatten)]
        quiet: Quiet,
    },
    /// What a key of a scenario means: unit, range, default, equation, source
    #[command(after_help = text::EXPLAIN)]
    Explain {
        #[arg(
            help = "A key (radio.alpha_wall, or alpha_wall alone) or a table (radio) [default: list all keys]"
        )]
        key: Option<String>,
    },
    /// Print the JSON Schema of scenario files, for editors
    #[command(after_help = text::SCHEMA)]
    Schema,
    /// Print what makes a shell complete commands, options, scenarios and keys
    #[command(after_help = text::COMPLETIONS)]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page, or write one for every command
    #[command(after_help = text::MAN)]
    Man {
        /// Folder for the pages: uchain.1, uchain-run.1 and so on; same names are overwritten
        #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
        out: Option<PathBuf>,
    },
}

/// One flight.
#[derive(Debug, Args)]
#[command(after_help = text::RUN)]
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
        self.out.folder(|| Folder::ours("runs", &called(&self.scenario), &format!("-s{}", self.seed)))
    }
}

/// Where results go.
#[derive(Debug, Args)]
pub(crate) struct Out {
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Write into --out even if it holds something else; only our own files are replaced
    #[arg(long)]
    force: bool,
}

impl Out {
    /// The folder asked for, if one was.
    pub(crate) fn chosen(&self) -> Result<Option<Folder>, Failure> {
        self.out.as_ref().map(|path| Folder::chosen(path, self.force)).transpose()
    }

    /// The folder asked for, else one of our own.
    pub(crate) fn folder(&self, ours: impl FnOnce() -> Result<Folder, Failure>) -> Result<Folder, Failure> {
        self.chosen()?.map_or_else(ours, Ok)
    }
}

/// What is written over a scenario.
#[derive(Debug, Args)]
pub(crate) struct Sets {
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment, help = SET)]
    pub(crate) set: Vec<String>,
}

/// How a result is told.
#[derive(Debug, Args)]
#[command(mut_arg("quiet", |quiet| quiet.help("Print errors only: no progress, no report (--json still prints)")))]
pub(crate) struct Say {
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    quiet: Quiet,
}

impl Say {
    /// Whether to show how far the work has come.
    pub(crate) fn progress(&self) -> bool {
        !(self.quiet.quiet || self.json)
    }

    /// Tells people something on the way, on stderr.
    pub(crate) fn note(&self, words: &str) {
        if !self.quiet.quiet {
            // Nobody is left to tell when stderr is gone.
            let _ = writeln!(std::io::stderr(), "note: {words}");
        }
    }

    /// Prints the result for programs, for people, or not at all.
    pub(crate) fn result(&self, json: &str, text: impl FnOnce() -> String) -> Result<(), Failure> {
        if self.json { print(json) } else { self.quiet.report(text) }
    }
}

/// Whether anything is told.
#[derive(Debug, Args)]
pub(crate) struct Quiet {
    /// Print errors only
    #[arg(long)]
    quiet: bool,
}

impl Quiet {
    /// Whether only errors are to be said.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Prints, unless asked not to.
    pub(crate) fn report(&self, text: impl FnOnce() -> String) -> Result<(), Failure> {
        if self.quiet { Ok(()) } else { print(&text()) }
    }
}

/// A command line, taken apart.
pub(crate) enum Asked {
    /// To be obeyed.
    Command(Command),
    /// Help, version or a usage error: already on the screen.
    Answered(ExitCode),
}

/// The whole grammar, with all its help.
pub(crate) fn grammar() -> clap::Command {
    Cli::command().after_help(format!("{}\n{}", text::TOP, exit::table()))
}

/// Takes a command line apart; the first argument is the program's name.
pub(crate) fn parse(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Asked {
    let args: Vec<OsString> = args.into_iter().map(Into::into).collect();
    match grammar().try_get_matches_from(&args).and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => Asked::Command(cli.command),
        Err(answer) => {
            let exit = if answer.use_stderr() { Exit::Usage } else { Exit::Ok };
            // A reader that went away has seen enough.
            let _ = teach::advise(answer, &args).print();
            Asked::Answered(exit.code())
        }
    }
}

pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}

fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("expected key=value, such as equalize.v_max_mps=0.2".to_owned()),
    }
}
