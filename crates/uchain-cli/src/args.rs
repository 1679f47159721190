//! The command-line parser: its grammar (subcommands), made of the arguments that each command has in its own room.

mod advise;
mod text;

use std::{ffi::OsString, path::PathBuf};

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use uchain_sim::registry::Registry;

use crate::{
    exit::{self, Exit},
    flags::{Quiet, Sets},
    fly, map, node, paper, plan, radio, recording, sweep, view,
};

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
    Run(fly::Run),
    /// Open a flight in the browser: watch it, ask why, fly it by hand
    View(view::View),
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
    Plan(Box<plan::Plan>),
    /// A map by itself: what it is, a picture, another kind of file, or one out of nothing
    #[command(subcommand, after_help = map::EXAMPLES)]
    Map(map::Map),
    /// A radio by itself: fitted to a log of losses, or asked for its losses over a map
    #[command(subcommand, after_help = radio::EXAMPLES)]
    Radio(radio::Radio),
    /// Send the log of a real flight through the node: what would it have asked for?
    Node(Box<node::Node>),
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

/// A parsed command line.
pub(crate) enum Parsed {
    /// To be executed.
    Command(Command),
    /// Help, version or a usage error: already on the screen.
    Answered(Exit),
}

/// The whole grammar, with all its help.
pub(crate) fn grammar() -> clap::Command {
    Cli::command().after_help(format!("{}\n{}", text::TOP, exit::table()))
}

/// Parses a command line; the first argument is the program's name.
pub(crate) fn parse(
    registry: Registry,
    args: impl IntoIterator<Item = impl Into<OsString> + Clone>,
) -> Parsed {
    let args: Vec<OsString> = args.into_iter().map(Into::into).collect();
    match grammar().try_get_matches_from(&args).and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => Parsed::Command(cli.command),
        Err(answer) => {
            let exit = if answer.use_stderr() { Exit::Usage } else { Exit::Ok };
            // A reader that went away has seen enough.
            let _ = advise::advise(registry, answer, &args).print();
            Parsed::Answered(exit)
        }
    }
}
