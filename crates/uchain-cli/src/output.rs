//! Where results go, and how they get there whole or not at all.

use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;
use uchain_sim::record::RecordError;

use crate::exit::Failure;

/// What a command leaves in its folder.
#[derive(Debug)]
pub(crate) struct Names {
    /// The numbers, in JSON.
    pub(crate) numbers: &'static str,
    /// The picture.
    pub(crate) picture: &'static str,
    /// The recording.
    pub(crate) recording: Option<&'static str>,
    /// What there is besides.
    pub(crate) others: &'static [&'static str],
}

impl Names {
    fn hold(&self, name: &str) -> bool {
        name == self.numbers
            || name == self.picture
            || self.recording == Some(name)
            || self.others.contains(&name)
    }
}

/// What `uchain run` leaves of a chain.
pub(crate) const RUN: Names =
    Names { numbers: "summary.json", picture: "run.png", recording: Some("run.mcap"), others: &[] };
/// What `uchain run` leaves of an exploration: besides, the explored map as a ROS map, and where robots were over time.
pub(crate) const EXPLORE: Names = Names { others: &["map.pgm", "map.yaml", "states.png"], ..RUN };
/// What `uchain plan` leaves.
pub(crate) const PLAN: Names =
    Names { numbers: "plan.json", picture: "plan.png", recording: None, others: &[] };
/// What `uchain inspect --out` leaves.
pub(crate) const INSPECT: Names = Names { numbers: "inspect.json", recording: None, ..RUN };

const ALL: [&Names; 4] = [&RUN, &EXPLORE, &PLAN, &INSPECT];

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
            let is_ours = ALL.iter().any(|names| names.hold(&name))
                || crate::paper::leaves(&name)
                || name.starts_with(UNFINISHED);
            if !is_ours && !force {
                return Err(Failure::Occupied { folder: path.to_owned(), found: name.into_owned() });
            }
        }
        Ok(folder)
    }

    /// Begins the file of a recording: its first words are written before it has its name. From then on the folder is
    /// about the new run, and what an older one left in it is gone.
    pub(crate) fn begin<T>(
        &self,
        name: &str,
        start: impl FnOnce(fs::File) -> Result<T, RecordError>,
    ) -> Result<(T, PathBuf), Failure> {
        let file = self.path.join(name);
        let started = self.or_not_at_all(|| {
            let failed = |cause| Failure::Write { file: file.clone(), cause };
            let (unfinished, path) = unfinished_file(&self.path).map_err(failed)?.into_parts();
            let started = start(unfinished).map_err(|cause| Failure::Tape { file: file.clone(), cause })?;
            path.persist(&file).map_err(|error| failed(error.error))?;
            Ok(started)
        })?;
        for name in [RUN.numbers, RUN.picture].iter().chain(EXPLORE.others) {
            // Mostly there is none.
            let _ = fs::remove_file(self.path.join(name));
        }
        Ok((started, file))
    }

    /// Writes into the folder. One that was not there before stays only if that went well.
    fn or_not_at_all<T>(&self, write: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        let is_new = !self.path.exists();
        let written = fs::create_dir_all(&self.path)
            .map_err(|cause| Failure::Write { file: self.path.clone(), cause })
            .and_then(|()| write());
        if written.is_err() && is_new {
            // Goes only if it is empty, and then it is ours.
            let _ = fs::remove_dir(&self.path);
        }
        written
    }

    /// Where the files are, for people.
    pub(crate) fn says(&self, names: &Names) -> String {
        let numbers = self.path.join(names.numbers).display().to_string();
        let others = names.recording.iter().chain(names.others).copied();
        let mut files: Vec<&str> = [numbers.as_str(), names.picture].into_iter().chain(others).collect();
        let last = files.pop().unwrap_or_default();
        format!("{} and {last}", files.join(", "))
    }

    /// Writes the picture, the other files and the numbers. All are complete under other names before any shows under
    /// its own.
    pub(crate) fn write(
        &self,
        names: &Names,
        numbers: &[u8],
        picture: &[u8],
        others: &[&[u8]],
    ) -> Result<(), Failure> {
        let others = names.others.iter().copied().zip(others.iter().copied());
        let files = [(names.picture, picture)].into_iter().chain(others).chain([(names.numbers, numbers)]);
        self.or_not_at_all(|| {
            let ready = files.map(|(name, bytes)| self.prepare(name, bytes).map(|file| (name, file)));
            let ready: Vec<(&str, NamedTempFile)> = ready.collect::<Result<_, _>>()?;
            ready.into_iter().try_for_each(|(name, file)| self.show(name, file))
        })
    }

    /// Writes files of any names, each whole or not at all.
    pub(crate) fn write_each(&self, files: &[(String, &[u8])]) -> Result<(), Failure> {
        self.or_not_at_all(|| {
            files.iter().try_for_each(|(name, bytes)| self.show(name, self.prepare(name, bytes)?))
        })
    }

    /// Where it is, for people.
    pub(crate) fn path(&self) -> &Path {
        &self.path
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
