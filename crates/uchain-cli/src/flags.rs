//! Options that several commands share.

use std::{
    io::Write as _,
    path::{Path, PathBuf},
};

use clap::{Args, ValueHint};

use uchain_sim::config::kind_of_map;

use crate::{exit::Failure, output::Folder, print};

const SET: &str =
    "Write one value over the scenario's, such as chain.uavs=5 or pilot.0.speed_mps=0.1 (repeatable)";

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

/// How a map file is read that does not say everything itself. Where a branch ends is up to each command: --to.
#[derive(Debug, Default, Args)]
pub(crate) struct MapArgs {
    /// Side of a cell or pixel, where the map file does not say it
    #[arg(long, value_name = "M", value_parser = cell, allow_hyphen_values = true)]
    pub(crate) cell: Option<f64>,
    /// Survey station where the branch begins that is cut out of a cave (needs --to)
    #[arg(long, value_name = "STATION")]
    pub(crate) from: Option<String>,
}

impl MapArgs {
    /// Refuses a cell's side for a map that has none, with what says its scale instead.
    pub(crate) fn fits(&self, what: &str) -> Result<(), Failure> {
        let Some((cell_m, kind)) = self.cell.zip(kind_of_map(Path::new(what))) else { return Ok(()) };
        let instead = match kind {
            "ros" | "movingai" => return Ok(()),
            "svg" => "its scale is 1:N by --set map.svg.scale=N",
            "dxf" => "its unit is said by --set map.dxf.unit_m=M",
            _ => "its coordinates are metres, or say themselves what they are",
        };
        Err(Failure::Usage(format!(
            "--cell {cell_m} is for pictures and grids; {what} is of another kind: {instead}"
        )))
    }
}

fn cell(text: &str) -> Result<f64, String> {
    let cell_m = text.parse().ok().filter(|cell_m: &f64| cell_m.is_finite() && *cell_m > 0.0);
    cell_m.ok_or_else(|| "expected a length in metres, more than 0, such as 0.05".to_owned())
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

/// Reads the seed of a run.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}

fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("expected key=value, such as equalize.v_max_mps=0.2".to_owned()),
    }
}
