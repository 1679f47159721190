//! Exit codes and error messages of all commands.

use std::{
    fmt::Write as _,
    io,
    path::{Path, PathBuf},
};

use uchain_sim::{
    config::ConfigError,
    draw::DrawError,
    log::LogError,
    mission::chain::PlanError,
    radio_fit::FitError,
    record::{
        RecordError,
        mcap::{About, PlayError, ReadError},
    },
    registry::{FlightError, PlanFlightError, PlanRequestError, named},
    run::RunError,
    sweep::{DesignError, folder::FolderError, report::ReportError},
};

/// This version.
pub(crate) const OURS: &str = env!("CARGO_PKG_VERSION");
/// Longest version that is shown: it is read from a file.
const VERSION_SHOWN: usize = 40;

/// Exit codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    Ok = 0,
    RunFailed = 1,
    Usage = 2,
    InputInvalid = 3,
    Differ = 4,
    Interrupted = 130,
}

/// The one table of exit codes; `--help` prints it.
const TABLE: [(Exit, &str); 6] = [
    (Exit::Ok, "ok"),
    (Exit::RunFailed, "run failed, its results could not be written, or a sweep is not complete"),
    (Exit::Usage, "usage: wrong arguments, or an output folder that is not to be touched"),
    (
        Exit::InputInvalid,
        "input missing or invalid: scenario, map, recording, log, sweep or a name that nobody knows; nothing is written. Or data that \
         support no fit, which radio fit draws all the same",
    ),
    (Exit::Differ, "verify, diff, repro: the flights differ"),
    (
        Exit::Interrupted,
        "interrupted (Ctrl-C); a recording is left up to there, and a sweep goes on with --resume",
    ),
];

impl Exit {
    pub(crate) fn code(self) -> u8 {
        self as u8
    }
}

/// The table as text.
pub(crate) fn table() -> String {
    let mut text = "Exit codes:\n".to_owned();
    for (exit, meaning) in TABLE {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {:>3}  {meaning}", exit as u8);
    }
    text
}

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Input(#[from] ConfigError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Log(#[from] LogError),
    #[error(transparent)]
    Fit(#[from] FitError),
    /// What was seen of the data has been said and drawn.
    #[error("{log}: the data do not support a fit: {why}")]
    NoFit { log: String, why: String },
    #[error("{0}")]
    Map(String),
    #[error("{0}")]
    Usage(String),
    #[error(
        "this uchain has no page to fly in: `cargo xtask web` in the project's folder builds it, then type the same again; \
         an installed uchain takes it along with `cargo install --path crates/uchain-cli --features view`"
    )]
    NoPage,
    #[error(
        "{map} is a bare map: add {missing}, in the map's own frame (m), such as --base=-50.15,34.03; `uchain map plot {map}` \
         draws it with its coordinates{places}"
    )]
    BareMap { map: String, missing: &'static str, places: String },
    #[error(transparent)]
    PlanFlight(PlanFlightError),
    #[error("{} holds something else ({found}); name another folder, or add --force to write there all the same", folder.display())]
    Occupied { folder: PathBuf, found: String },
    #[error("{} holds another run ({found}); name another folder with --out", folder.display())]
    OtherRun { folder: PathBuf, found: &'static str },
    #[error("{} is there already; name another file, or add --force to replace it", file.display())]
    Exists { file: PathBuf },
    #[error("{} is what the map is read from; name another file", file.display())]
    OwnMap { file: PathBuf },
    #[error("{}: results in {} would take its place; name another folder with --out", file.display(), folder.display())]
    OwnInput { file: PathBuf, folder: PathBuf },
    #[error("{}: another uchain writes there; wait for it, or name another folder with --out", folder.display())]
    Busy { folder: PathBuf },
    #[error("{}: cannot write results there: {cause}", folder.display())]
    Folder { folder: PathBuf, cause: io::Error },
    #[error("{}: cannot write: {cause}", file.display())]
    Write { file: PathBuf, cause: io::Error },
    #[error("cannot write the summary: {0}")]
    Json(#[from] serde_json::Error),
    #[error(transparent)]
    Draw(#[from] DrawError),
    #[error(transparent)]
    Flight(FlightError),
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    #[error("{0}; nothing was written")]
    Run(#[from] RecordError),
    #[error("{error}; {} holds the flight up to there", recording.display())]
    Cut { error: RecordError, recording: PathBuf },
    #[error("{}: {cause}", file.display())]
    WriteRecording { file: PathBuf, cause: RecordError },
    #[error("{}: {cause}", file.display())]
    Recording { file: PathBuf, cause: ReadError },
    #[error("{}: recorded by uchain {theirs}, this is {OURS}: {cause}", file.display())]
    OtherVersion { file: PathBuf, theirs: String, cause: ReadError },
    #[error("interrupted; no summary and no picture were written")]
    Interrupted,
    #[error("the flights differ")]
    Differ,
    #[error(transparent)]
    Paper(#[from] uchain_papers::PaperError),
    #[error(transparent)]
    Design(DesignError),
    #[error(transparent)]
    Sweep(FolderError),
    /// A sweep that had begun; what is done stays, and --resume goes on.
    #[error(transparent)]
    Incomplete(FolderError),
    #[error("run {run} differs: its digest was {then}, now it is {now}")]
    DigestDiffers { run: u64, then: String, now: String },
}

impl From<FlightError> for Failure {
    fn from(error: FlightError) -> Self {
        match error {
            FlightError::Draw(error) => Self::Draw(error),
            FlightError::Json(error) => Self::Json(error),
            error => Self::Flight(error),
        }
    }
}

impl From<PlanRequestError> for Failure {
    fn from(error: PlanRequestError) -> Self {
        match error {
            PlanRequestError::Config(error) => Self::Input(error),
            PlanRequestError::BareMap { map, needs_base, needs_goal, places } => {
                let missing = match (needs_base, needs_goal) {
                    (true, false) => "--base X,Y",
                    (false, true) => "--goal X,Y",
                    _ => "--base X,Y and --goal X,Y",
                };
                Self::BareMap { map, missing, places: named(&places) }
            }
            error => Self::Map(error.to_string()),
        }
    }
}

impl From<PlanFlightError> for Failure {
    fn from(error: PlanFlightError) -> Self {
        match error {
            PlanFlightError::Run(RunError::Record(RecordError::Interrupted { .. })) => Self::Interrupted,
            error => Self::PlanFlight(error),
        }
    }
}

impl From<DesignError> for Failure {
    fn from(error: DesignError) -> Self {
        match error {
            DesignError::Config(error) => Self::Input(error),
            error => Self::Design(error),
        }
    }
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::Design(error) => error.into(),
            error => Self::Sweep(error),
        }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Folder(error) => error.into(),
            ReportError::Draw(error) => Self::Draw(error),
            error => Self::Map(error.to_string()),
        }
    }
}

/// How a command ends that went wrong with a sweep's folder.
fn sweep_exit(error: &FolderError) -> Exit {
    match error {
        FolderError::Io { doing, .. } if *doing != "read" => Exit::RunFailed,
        FolderError::Pool(_) => Exit::RunFailed,
        FolderError::Exists { .. }
        | FolderError::Another { .. }
        | FolderError::Occupied { .. }
        | FolderError::Busy { .. } => Exit::Usage,
        FolderError::Interrupted => Exit::Interrupted,
        // Nothing to read there, or not what it should be.
        _ => Exit::InputInvalid,
    }
}

impl Failure {
    /// Of a recording that cannot be flown, or not be read further; another version may be the reason.
    pub(crate) fn refused(file: &Path, about: &About, cause: ReadError) -> Self {
        let (file, theirs) = (file.to_owned(), &about.version);
        if theirs == OURS {
            Self::Recording { file, cause }
        } else {
            Self::OtherVersion { file, theirs: theirs.chars().take(VERSION_SHOWN).collect(), cause }
        }
    }

    /// Of a recording that was played.
    pub(crate) fn played(file: &Path, about: &About, cause: PlayError) -> Self {
        match cause {
            PlayError::Read(cause) => Self::refused(file, about, cause),
            PlayError::Record(cause) => Self::Run(cause),
        }
    }

    pub(crate) fn exit(&self) -> Exit {
        match self {
            Self::Interrupted
            | Self::Plan(PlanError::Interrupted)
            | Self::Incomplete(FolderError::Interrupted)
            | Self::Run(RecordError::Interrupted { .. })
            | Self::Cut { error: RecordError::Interrupted { .. }, .. } => Exit::Interrupted,
            Self::Input(_)
            | Self::Plan(_)
            | Self::PlanFlight(_)
            | Self::Log(_)
            | Self::Fit(_)
            | Self::NoFit { .. }
            | Self::Map(_)
            | Self::NoPage
            | Self::Recording { .. }
            | Self::OtherVersion { .. }
            | Self::Design(_) => Exit::InputInvalid,
            Self::Usage(_)
            | Self::BareMap { .. }
            | Self::Occupied { .. }
            | Self::OtherRun { .. }
            | Self::OwnInput { .. }
            | Self::Exists { .. }
            | Self::OwnMap { .. }
            | Self::Busy { .. }
            | Self::Folder { .. } => Exit::Usage,
            Self::Differ | Self::DigestDiffers { .. } => Exit::Differ,
            Self::Sweep(error) => sweep_exit(error),
            Self::Write { .. }
            | Self::Json(_)
            | Self::Draw(_)
            | Self::Stdout(_)
            | Self::Flight(_)
            | Self::Paper(_)
            | Self::Run(_)
            | Self::Cut { .. }
            | Self::Incomplete(_)
            | Self::WriteRecording { .. } => Exit::RunFailed,
        }
    }
}
