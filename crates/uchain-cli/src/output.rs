//! Where results go, and how they get there whole or not at all.

use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use crate::exit::Failure;

/// What a command leaves in its folder.
#[derive(Debug)]
pub(crate) struct Names {
    /// The numbers, in JSON.
    pub(crate) numbers: &'static str,
    /// The picture.
    pub(crate) picture: &'static str,
}

/// What `uchain run` leaves.
pub(crate) const RUN: Names = Names { numbers: "summary.json", picture: "run.png" };
/// What `uchain plan` leaves.
pub(crate) const PLAN: Names = Names { numbers: "plan.json", picture: "plan.png" };

/// What `uchain run` leaves of an exploration besides: the explored map, as a ROS map.
pub(crate) const MAP: [&str; 2] = ["map.yaml", "map.pgm"];

/// How names of files start that are not finished yet.
const UNFINISHED: &str = ".uchain-";

/// A folder that may be written to.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// A folder under `runs` or `plans` in the working folder; it is ours.
    pub(crate) fn ours(above: &str, name: &str) -> Self {
        Self { path: Path::new(above).join(name) }
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
            let known = [RUN, PLAN].iter().any(|names| name == names.numbers || name == names.picture);
            let is_ours = known || MAP.iter().any(|map| name == *map) || name.starts_with(UNFINISHED);
            if !is_ours && !force {
                return Err(Failure::Occupied { folder: path.to_owned(), found: name.into_owned() });
            }
        }
        Ok(folder)
    }

    /// Where the files are, for people.
    pub(crate) fn says(&self, names: &Names) -> String {
        format!("{} and {}", self.path.join(names.numbers).display(), names.picture)
    }

    /// Writes the picture and the numbers.
    pub(crate) fn write(&self, names: &Names, numbers: &[u8], picture: &[u8]) -> Result<(), Failure> {
        self.write_all(&[(names.picture, picture), (names.numbers, numbers)])
    }

    /// Writes files. All are complete under other names before any shows under its own.
    pub(crate) fn write_all(&self, files: &[(&str, &[u8])]) -> Result<(), Failure> {
        let is_new = !self.path.exists();
        let written = fs::create_dir_all(&self.path)
            .map_err(|cause| Failure::Write { file: self.path.clone(), cause })
            .and_then(|()| {
                let ready = |&(name, bytes): &(&str, &[u8])| self.prepare(name, bytes);
                let ready: Vec<NamedTempFile> = files.iter().map(ready).collect::<Result<_, _>>()?;
                files.iter().zip(ready).try_for_each(|((name, _), file)| self.show(name, file))
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
