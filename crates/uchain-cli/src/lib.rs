//! `uchain` on the command line: reads a scenario, flies it, leaves a summary, a picture and a recording; sweeps, reports,
//! plans, verifies and compares; sends logs of real flights through the node; and tells what every key of a scenario means. `uchain --help` lists the commands and the
//! exit codes.
//!
//! It is a library, so that a program of one's own can be the same command line with missions, laws, radios and strategies
//! of its own:
//!
//! ```no_run
//! use std::process::ExitCode;
//!
//! use uchain_libm as _; // the same bits on every system
//! use uchain_sim::{
//!     mission::{chain::Course, explore::Site},
//!     registry::{AnyMission, Of, Registry},
//! };
//!
//! // `Of::with` hands words of one's own to a mission that is there; a mission of one's own is one more line.
//! static MISSIONS: [&dyn AnyMission; 2] = [&Of::<Course>::NEW, &Of::<Site>::NEW];
//!
//! fn main() -> ExitCode {
//!     uchain_cli::main_with_missions(Registry::new(&MISSIONS), std::env::args_os())
//! }
//! ```
//!
//! Everything it does is a call of [`uchain_sim`] or `uchain_papers`; nothing here computes.

mod args;
mod exit;
mod flags;
mod fly;
mod map;
mod monitor;
mod node;
mod output;
mod paper;
mod plan;
mod radio;
mod recording;
mod sweep;
mod teach;
mod view;
mod waiting;

use std::{
    ffi::OsString,
    fmt::Write as _,
    io::{self, Write as _},
    process::ExitCode,
};

use uchain_sim::{
    config::{ConfigError, PRESETS, Preset, Source, builtin, builtin_names},
    registry::{AnyScene, Registry},
};

use args::{Command, Parsed};
use exit::{Exit, Failure};

/// Runs one command line; the first argument is the program's name. Results go to stdout, all else to
/// stderr. The exit codes are listed by `uchain --help`.
pub fn main_with(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    main_with_missions(Registry::default(), args)
}

/// Like [`main_with`], for scenarios and recordings of these missions.
pub fn main_with_missions(
    registry: Registry,
    args: impl IntoIterator<Item = impl Into<OsString> + Clone>,
) -> ExitCode {
    ExitCode::from(code_with(registry, args))
}

/// Like [`main_with_missions`], and gives the exit code as a number: for programs that end in another way.
pub fn code_with(registry: Registry, args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> u8 {
    let done = match args::parse(registry, args) {
        Parsed::Command(command) => execute(registry, command),
        Parsed::Answered(exit) => return exit.code(),
    };
    match done {
        Ok(()) => Exit::Ok.code(),
        // What differs has been said.
        Err(failure @ Failure::Differ) => failure.exit().code(),
        Err(failure) => {
            let hint =
                teach::hint(registry, &failure).map(|hint| format!("hint: {hint}\n")).unwrap_or_default();
            // Nobody is left to tell when stderr is gone.
            let _ = io::stderr().write_all(harmless(&format!("error: {failure}\n{hint}")).as_bytes());
            failure.exit().code()
        }
    }
}

/// A message as a terminal may show it: names of files may hold what would move its cursor or colour it.
fn harmless(message: &str) -> String {
    let moves = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    message.chars().map(|c| if moves(c) { '?' } else { c }).collect()
}

/// Runs the command that was parsed.
fn execute(registry: Registry, command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(args) => fly::fly(registry, &args),
        Command::Inspect(args) => recording::inspect(registry, &args),
        Command::Verify(args) => recording::verify(registry, &args),
        Command::Diff(args) => recording::diff(registry, &args),
        Command::Sweep(args) => sweep::fly(registry, &args),
        Command::Merge(args) => sweep::merge(registry, &args),
        Command::Report(args) => sweep::report(registry, &args),
        Command::Repro(args) => sweep::repro(registry, &args),
        Command::Plan(args) => plan::compute(registry, &args),
        Command::Map(what) => map::map(registry, &what),
        Command::Radio(what) => radio::radio(registry, &what),
        Command::Node(args) => node::node(&args),
        Command::Paper(args) => paper::regenerate(&args),
        Command::View(args) => view::view(registry, &args),
        Command::List => print(&list(registry)?),
        Command::Show { preset: Some(name), .. } => print(Preset::find(&name)?.text),
        Command::Show { scenario, .. } => print(&Source::find(&scenario.unwrap_or_default())?.text),
        Command::Check { scenario, sets, quiet } => {
            let scene = registry.read(&Source::find(&scenario)?, &sets.set)?;
            quiet.report(|| checked(&*scene))
        }
        Command::Explain { key } => teach::explain(registry, key.as_deref()),
        Command::Schema => teach::schema(registry),
        Command::Completions { shell } => teach::completions(registry, shell),
        Command::Man { out } => teach::man(out.as_deref()),
    }
}

/// What a scenario comes to, in one line.
fn checked(scene: &dyn AnyScene) -> String {
    let (title, robot, count) = (scene.title(), scene.robot(), scene.crew());
    let (walls, s) = (scene.map().walls().len(), if count == 1 { "" } else { "s" });
    let ok = format!("ok: {title}: {count} {robot}{s}, {walls} walls, {} s\n", scene.duration_s());
    scene.notes().iter().fold(ok, |text, words| text + "note: " + words + "\n")
}

/// Name and description of every scenario and preset that is compiled in.
fn list(registry: Registry) -> Result<String, ConfigError> {
    let mut entries = Vec::new();
    for source in builtin_names().iter().filter_map(|name| builtin(name)) {
        let about = registry.describe(&source, &[])?;
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
