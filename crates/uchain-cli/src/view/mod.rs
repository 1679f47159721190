//! `uchain view`: a page with a flight in it, opened in the browser. Nothing is flown here: the page does, with the same
//! engine.

mod browser;
mod flight;
mod page;

use std::{
    fs,
    io::Write as _,
    path::{Path, PathBuf},
};

use clap::{Args, ValueHint};
use uchain_sim::registry::Registry;

use crate::{
    exit::Failure,
    flags::{Quiet, Sets, seed},
    output::unfinished_file,
};

use flight::{Brought, flight};

const EXAMPLES: &str = "\
Examples:
  uchain view                                the page alone: fly what its menu has, drop files on it
  uchain view circuit                        fly the head around it with the arrow keys
  uchain view corner --seed 7 --set radio.sigma_db=8
  uchain view mine.toml
  uchain view floor.yaml                     robots explore a ROS map; or city.map, a MovingAI map
  uchain view runs/corner-s1/run.mcap        a recording, to look at or to go on with by hand
  uchain view sweeps/corner --run 17         one row of a sweep

Leaves views/<what>.html, one file with everything inside that opens in any browser, without a network; send it to
whom you like. It flies with the same bits as uchain run. The page itself is built once with `cargo xtask web`; a
uchain that was installed with the feature `view`, such as Python's, has it inside.
";

/// A flight in the browser.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct View {
    /// Name of a built-in scenario, a scenario file, a bare map (.map, .yaml, .pgm), a recording (.mcap), or a folder of a run
    /// or, with --run, of a sweep [default: the page alone]
    #[arg(value_name = "NAME|FILE|DIR", value_hint = ValueHint::AnyPath)]
    what: Option<String>,
    /// Which run of a sweep: column `run` of its table
    #[arg(long, value_name = "I", conflicts_with_all = ["seed", "set"], requires = "what")]
    run: Option<u64>,
    /// Seed of all noise in the flight [default: 1]
    #[arg(long, value_name = "N", value_parser = seed, requires = "what")]
    seed: Option<u64>,
    #[command(flatten)]
    sets: Sets,
    /// File for the page [default: views/<what>.html, overwritten]
    #[arg(long, value_name = "FILE.html", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Write the page and open no browser
    #[arg(long)]
    no_open: bool,
    #[command(flatten)]
    quiet: Quiet,
}

pub(crate) fn view(registry: Registry, asked: &View) -> Result<(), Failure> {
    // What is wrong with the flight is said before anything about pages.
    let brought = flight(registry, asked)?;
    let page = page::with(brought.as_ref().map(Brought::json).transpose()?.as_deref())?;
    let file = asked.out.clone().unwrap_or_else(|| {
        let name = brought.as_ref().map_or("uchain", |brought| brought.name.as_str());
        Path::new("views").join(format!("{name}.html"))
    });
    write(&file, &page)?;
    asked.quiet.report(|| format!("{}\n", file.display()))?;
    if !asked.no_open
        && let Err(why) = browser::open(&file)
        && !asked.quiet.is_quiet()
    {
        // Nobody is left to tell when stderr is gone.
        let _ = writeln!(std::io::stderr(), "note: {why}; open {} yourself", file.display());
    }
    Ok(())
}

/// The page, whole or not at all.
fn write(file: &Path, page: &str) -> Result<(), Failure> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let write = || {
        fs::create_dir_all(folder)?;
        let mut part = unfinished_file(folder)?;
        part.write_all(page.as_bytes())?;
        Ok(part.persist(file).map(drop)?)
    };
    write().map_err(|cause| Failure::Write { file: file.to_owned(), cause })
}
