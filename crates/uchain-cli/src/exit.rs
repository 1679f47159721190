//! How a command can end.

use std::{fmt::Write as _, io, path::PathBuf, process::ExitCode};

use uchain_sim::{
    analyse::PlanError, config::ConfigError, draw::DrawError, record::RecordError, run::RunError,
};

/// Exit codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    Ok = 0,
    RunFailed = 1,
    Usage = 2,
    InputInvalid = 3,
    Interrupted = 130,
}

/// The one table of exit codes; `--help` prints it.
const TABLE: [(Exit, &str); 5] = [
    (Exit::Ok, "ok"),
    (Exit::RunFailed, "run failed, or its results could not be written"),
    (Exit::Usage, "usage: wrong arguments, or an output folder that is not to be touched"),
    (Exit::InputInvalid, "input invalid: scenario, map or a name that nobody knows; nothing is written"),
    (Exit::Interrupted, "interrupted (Ctrl-C); nothing is written"),
];

impl Exit {
    pub(crate) fn code(self) -> ExitCode {
        ExitCode::from(self as u8)
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
    #[error("{0}")]
    Map(String),
    #[error("{map} is a bare map: add {missing}, in the map's own frame (m), such as --base=-50.15,34.03")]
    BareMap { map: String, missing: &'static str },
    #[error("{} holds something else ({found}); name another folder, or add --force to write there all the same", folder.display())]
    Occupied { folder: PathBuf, found: String },
    #[error("{}: cannot write results there: {cause}", folder.display())]
    Folder { folder: PathBuf, cause: io::Error },
    #[error("{}: cannot write: {cause}", file.display())]
    Write { file: PathBuf, cause: io::Error },
    #[error("cannot write the summary: {0}")]
    Json(#[from] serde_json::Error),
    #[error(transparent)]
    Draw(#[from] DrawError),
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    #[error("{0}; nothing was written")]
    Run(#[from] RunError),
    #[error("interrupted; nothing was written")]
    Interrupted,
}

impl Failure {
    pub(crate) fn exit(&self) -> Exit {
        match self {
            Self::Input(_) | Self::Plan(_) | Self::Map(_) => Exit::InputInvalid,
            Self::BareMap { .. } | Self::Occupied { .. } | Self::Folder { .. } => Exit::Usage,
            Self::Interrupted | Self::Run(RunError::Record(RecordError::Interrupted { .. })) => {
                Exit::Interrupted
            }
            Self::Write { .. } | Self::Json(_) | Self::Draw(_) | Self::Stdout(_) | Self::Run(_) => {
                Exit::RunFailed
            }
        }
    }
}
