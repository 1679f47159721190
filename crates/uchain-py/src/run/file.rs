//! A recording under way: a file that gets its name once it is whole.

use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

use pyo3::PyErr;
use tempfile::NamedTempFile;

use crate::errors::RecordingError;

/// A file without its name.
pub(super) struct Unfinished {
    file: NamedTempFile,
    path: PathBuf,
}

impl Unfinished {
    /// Beside where it is to be.
    pub(super) fn begin(path: PathBuf) -> Result<Self, PyErr> {
        let folder = match path.parent() {
            Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
            Some(folder) if path.file_name().is_some() => folder,
            _ => return Err(failed(&path, &io::Error::other("expected the path of a file"))),
        };
        if path.is_dir() {
            return Err(failed(&path, &io::Error::other("it is a folder; expected the path of a file")));
        }
        if !folder.is_dir() {
            let cause = format!("there is no folder {}", folder.display());
            return Err(failed(&path, &io::Error::other(cause)));
        }
        match unfinished_file(folder) {
            Ok(file) => Ok(Self { file, path }),
            Err(cause) => Err(failed(&path, &cause)),
        }
    }

    /// Where its bytes go.
    pub(super) fn bytes(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Gives it its name.
    pub(super) fn finish(self) -> Result<(), PyErr> {
        self.file.persist(&self.path).map(drop).map_err(|error| failed(&self.path, &error.error))
    }

    /// Why it has none.
    pub(super) fn failed(&self, cause: &io::Error) -> PyErr {
        failed(&self.path, cause)
    }
}

fn failed(path: &Path, cause: &io::Error) -> PyErr {
    RecordingError::new_err(format!("{}: cannot write the recording: {cause}", path.display()))
}

/// Readable as the user's umask says, which temporary files otherwise are not.
fn unfinished_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".uchain-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
