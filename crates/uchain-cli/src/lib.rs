//! uchain on the command line: reads a scenario, flies it, leaves a summary, a picture and a recording; and tells what
//! every key of a scenario means.
//!
//! A library, so that other front ends (a wheel's console script) can call [`main_with`].

mod args;
mod exit;
mod flags;
mod fly;
mod monitor;
mod output;
mod paper;
mod plan;
mod recording;
mod report;
mod sweep;
mod teach;

use std::{
    ffi::OsString,
    fmt::Write as _,
    io::{self, Write as _},
    process::ExitCode,
};

use uchain_sim::{
    config::{ConfigError, PRESETS, Preset, Source, builtin, builtin_names},
    mission::{Mission, describe},
};

use args::{Command, Parsed};
use exit::Failure;

/// Runs one command line; the first argument is the program's name. Results go to stdout, all else to
/// stderr. The exit codes are listed by `uchain --help`.
pub fn main_with(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    let done = match args::parse(args) {
        Parsed::Command(command) => execute(command),
        Parsed::Answered(code) => return code,
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // What differs has been said.
        Err(failure @ Failure::Differ) => failure.exit().code(),
        Err(failure) => {
            let hint = teach::hint(&failure).map(|hint| format!("hint: {hint}\n")).unwrap_or_default();
            // Nobody is left to tell when stderr is gone.
            let _ = io::stderr().write_all(format!("error: {failure}\n{hint}").as_bytes());
            failure.exit().code()
        }
    }
}

/// Runs the command that was parsed.
fn execute(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(args) => fly::fly(&args),
        Command::Inspect(args) => recording::inspect(&args),
        Command::Verify(args) => recording::verify(&args),
        Command::Diff(args) => recording::diff(&args),
        Command::Sweep(args) => sweep::fly(&args),
        Command::Merge(args) => sweep::merge(&args),
        Command::Report(args) => sweep::report(&args),
        Command::Repro(args) => sweep::repro(&args),
        Command::Plan(args) => plan::compute(&args),
        Command::Paper(args) => paper::regenerate(&args),
        Command::List => print(&list()?),
        Command::Show { preset: Some(name), .. } => print(Preset::find(&name)?.text),
        Command::Show { scenario, .. } => print(&Source::find(&scenario.unwrap_or_default())?.text),
        Command::Check { scenario, sets, quiet } => {
            let mission = Mission::read(&Source::find(&scenario)?, &sets.set)?;
            quiet.report(|| checked(&mission))
        }
        Command::Explain { key } => teach::explain(key.as_deref()),
        Command::Schema => teach::schema(),
        Command::Completions { shell } => teach::completions(shell),
        Command::Man { out } => teach::man(out.as_deref()),
    }
}

/// What a scenario comes to, in one line.
fn checked(mission: &Mission) -> String {
    let (name, who, count, walls, duration_s) = match mission {
        Mission::Chain(course) => {
            let scenario = &course.scenario;
            let preset = scenario.preset.as_ref().map(|name| format!(", preset {name}")).unwrap_or_default();
            (
                format!("{}{preset}", scenario.name),
                "UAV",
                course.spawns.len(),
                &course.map,
                scenario.duration_s,
            )
        }
        Mission::Explore(site) => {
            let scenario = &site.scenario;
            (scenario.name.clone(), "robot", site.spawns.len(), &site.map, scenario.duration_s)
        }
    };
    let (walls, s) = (walls.walls().len(), if count == 1 { "" } else { "s" });
    let ok = format!("ok: {name}: {count} {who}{s}, {walls} walls, {duration_s} s\n");
    mission.notes().iter().fold(ok, |text, words| text + "note: " + words + "\n")
}

/// Name and description of every scenario and preset that is compiled in.
fn list() -> Result<String, ConfigError> {
    let mut entries = Vec::new();
    for source in builtin_names().iter().filter_map(|name| builtin(name)) {
        let about = describe(&source, &[])?;
        entries.push((about.name, about.description));
    }
    for preset in PRESETS {
        entries.push((format!("preset={}", preset.name), preset.description().to_owned()));
    }
    let width = entries.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let mut lines = String::new();
    for (name, description) in entries {
        // Writing to a String cannot fail.
        let _ = writeln!(lines, "{name:width$}  {description}");
    }
    Ok(lines)
}

/// Writes to stdout. A reader that went away (`| head`) has seen enough: no error.
fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}
