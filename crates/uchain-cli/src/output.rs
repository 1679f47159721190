//! Where results go, and how they get there whole or not at all.

use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use crate::exit::Failure;

/// The summary's file name.
pub(crate) const SUMMARY: &str = "summary.json";
/// The picture's file name.
pub(crate) const PICTURE: &str = "run.png";
/// How names of files start that are not finished yet.
const UNFINISHED: &str = ".uchain-";

/// A folder that may be written to.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// `runs/<scenario>-s<seed>` under the working folder; it is ours.
    pub(crate) fn ours(scenario: &str, seed: u64) -> Self {
        Self { path: Path::new("runs").join(format!("{scenario}-s{seed}")) }
    }

    /// A folder of the user's choice: absent, empty, or with nothing but results in it, unless forced.
    pub(crate) fn chosen(path: &Path, force: bool) -> Result<Self, Failure> {
        let folder = Self { path: path.to_owned() };
        let refuse = |cause| Failure::Folder { folder: path.to_owned(), cause };
        let entries = match fs::read_dir(path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(folder),
            Err(error) => return Err(refuse(error)),
        };
        for entry in entries {
            let name = entry.map_err(refuse)?.file_name();
            let name = name.to_string_lossy();
            let is_ours = name == SUMMARY || name == PICTURE || name.starts_with(UNFINISHED);
            if !is_ours && !force {
                return Err(Failure::Occupied { folder: path.to_owned(), found: name.into_owned() });
            }
        }
        Ok(folder)
    }

    /// The folder's path.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the picture and the summary. Both are complete under other names before either shows
    /// under its own.
    pub(crate) fn write(&self, summary: &[u8], picture: &[u8]) -> Result<(), Failure> {
        let is_new = !self.path.exists();
        let written = fs::create_dir_all(&self.path)
            .map_err(|cause| Failure::Write { file: self.path.clone(), cause })
            .and_then(|()| {
                let picture = self.prepare(PICTURE, picture)?;
                let summary = self.prepare(SUMMARY, summary)?;
                self.show(PICTURE, picture)?;
                self.show(SUMMARY, summary)
            });
        if written.is_err() && is_new {
            // Goes only if it is empty, and then it is ours.
            let _ = fs::remove_dir(&self.path);
        }
        written
    }

    fn prepare(&self, name: &str, bytes: &[u8]) -> Result<NamedTempFile, Failure> {
        let write = || {
            let mut file = unfinished_file(&self.path)?;
            file.write_all(bytes)?;
            Ok(file)
        };
        write().map_err(|cause| self.failed(name, cause))
    }

    fn show(&self, name: &str, file: NamedTempFile) -> Result<(), Failure> {
        match file.persist(self.path.join(name)) {
            Ok(_) => Ok(()),
            Err(error) => Err(self.failed(name, error.error)),
        }
    }

    fn failed(&self, name: &str, cause: io::Error) -> Failure {
        Failure::Write { file: self.path.join(name), cause }
    }
}

/// Readable as the user's umask says: results are not secret, as temporary files otherwise are.
#[cfg(unix)]
fn unfinished_file(folder: &Path) -> io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt as _;
    let permissions = fs::Permissions::from_mode(0o666);
    tempfile::Builder::new().prefix(UNFINISHED).permissions(permissions).tempfile_in(folder)
}

#[cfg(not(unix))]
fn unfinished_file(folder: &Path) -> io::Result<NamedTempFile> {
    tempfile::Builder::new().prefix(UNFINISHED).tempfile_in(folder)
}
