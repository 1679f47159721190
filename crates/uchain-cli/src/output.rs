//! Output folders: files are written atomically (a temporary file, then renamed), one process at a time writes into a
//! folder (a file lock), and what is in it is about one run.

pub(crate) mod file;
mod folder_name;
mod inputs;
pub(crate) mod papers;

use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;
use uchain_sim::{
    record::RecordError,
    sweep::folder::{LOCK, Lock, LockError},
};

use crate::exit::Failure;

pub(crate) use folder_name::folder_name;
pub(crate) use inputs::inputs;

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
    /// What goes before these come, since it is about another run; the numbers first: without them a folder claims
    /// nothing.
    pub(crate) replaces: &'static [&'static str],
}

/// Everything that tells of a run. The recording goes last: alone it is as whole as before.
const OF_A_RUN: &[&str] =
    &["summary.json", "inspect.json", "run.png", "map.yaml", "map.pgm", "states.png", "run.mcap"];

impl Names {
    fn hold(&self, name: &str) -> bool {
        name == self.numbers
            || name == self.picture
            || self.recording == Some(name)
            || self.others.contains(&name)
    }
}

/// What `uchain run` leaves, beside what the mission has to show.
pub(crate) const RUN: Names = Names {
    numbers: "summary.json",
    picture: "run.png",
    recording: Some("run.mcap"),
    others: &[],
    replaces: OF_A_RUN,
};
/// What `uchain plan` leaves.
pub(crate) const PLAN: Names = Names {
    numbers: "plan.json",
    picture: "plan.png",
    recording: None,
    others: &["places.csv", "places.geojson"],
    replaces: &["plan.json", "plan.png", "places.csv", "places.geojson", "everywhere.csv", "everywhere.png"],
};
/// The same with `--everywhere`.
pub(crate) const PLAN_EVERYWHERE: Names =
    Names { others: &["places.csv", "places.geojson", "everywhere.csv", "everywhere.png"], ..PLAN };
/// What `uchain node` leaves.
pub(crate) const NODE: Names = Names {
    numbers: "node.json",
    picture: "node.png",
    recording: None,
    others: &["commands.csv"],
    replaces: &["node.json", "node.png", "commands.csv"],
};
/// What `uchain radio fit` leaves.
pub(crate) const FIT: Names = Names {
    numbers: "fit.json",
    picture: "fit.png",
    recording: None,
    others: &["radio.toml"],
    replaces: &["fit.json", "fit.png", "radio.toml"],
};
/// The same of data that do not support a fit.
pub(crate) const FIT_REFUSED: Names = Names { others: &[], ..FIT };
/// What `uchain radio map` leaves.
pub(crate) const LOSSES: Names = Names {
    numbers: "loss.json",
    picture: "loss.png",
    recording: None,
    others: &["loss.csv"],
    replaces: &["loss.json", "loss.png", "loss.csv"],
};
/// What `uchain inspect --out` leaves.
pub(crate) const INSPECT: Names =
    Names { numbers: "inspect.json", recording: None, replaces: &["inspect.json", "run.png"], ..RUN };

const ALL: [&Names; 7] = [&RUN, &PLAN, &PLAN_EVERYWHERE, &NODE, &INSPECT, &FIT, &LOSSES];

/// Whether some command leaves a file of this name.
fn is_result(name: &str) -> bool {
    OF_A_RUN.contains(&name) || ALL.iter().any(|names| names.hold(name))
}

/// How names of files start that are not finished yet.
const UNFINISHED: &str = ".uchain-";

/// A folder that may be written to, by nobody else meanwhile.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
    // Given back before folders go.
    _lock: Lock,
    _made: CreatedFolders,
}

/// Folders that were not there before, the innermost first. They go again if nothing came into them.
#[derive(Debug)]
struct CreatedFolders(Vec<PathBuf>);

impl Drop for CreatedFolders {
    fn drop(&mut self) {
        let is_lock = |entry: io::Result<fs::DirEntry>| entry.is_ok_and(|entry| entry.file_name() == LOCK);
        if let Some(innermost) = self.0.first()
            && fs::read_dir(innermost).is_ok_and(|mut entries| entries.all(is_lock))
        {
            let _ = fs::remove_file(innermost.join(LOCK));
        }
        for folder in &self.0 {
            // Goes only if it is empty, and then it is ours.
            let _ = fs::remove_dir(folder);
        }
    }
}

impl Folder {
    /// A folder under `runs` or `plans` in the working folder; it is ours.
    pub(crate) fn ours(above: &str, name: &str, ending: &str) -> Result<Self, Failure> {
        let above = Path::new(above);
        Self::enter(above.join(folder_name::beside_others(above, name, ending)))
    }

    fn enter(path: PathBuf) -> Result<Self, Failure> {
        let is_new = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        let made = CreatedFolders(path.ancestors().take_while(is_new).map(Path::to_owned).collect());
        let failed = |cause| Failure::Write { file: path.clone(), cause };
        fs::create_dir_all(&path).map_err(failed)?;
        let folder = match Lock::take(&path) {
            Ok(lock) => Self { path, _lock: lock, _made: made },
            Err(LockError::Busy) => return Err(Failure::Busy { folder: path }),
            Err(LockError::Io(cause)) => return Err(failed(cause)),
        };
        // Nobody is at work on them: who was has been killed.
        folder.clear_all(&[], |name| name.starts_with(UNFINISHED) && name != LOCK)?;
        Ok(folder)
    }

    /// A folder of the user's choice: absent, empty, or with nothing but results in it, unless forced.
    pub(crate) fn chosen(path: &Path, force: bool) -> Result<Self, Failure> {
        let refuse = |cause| Failure::Folder { folder: path.to_owned(), cause };
        let entries = match fs::read_dir(path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Self::enter(path.to_owned()),
            Err(error) => return Err(refuse(error)),
        };
        for entry in entries {
            let name = entry.map_err(refuse)?.file_name();
            let name = name.to_string_lossy();
            let is_ours = is_result(&name) || papers::leaves(&name) || name.starts_with(UNFINISHED);
            if !is_ours && !force {
                return Err(Failure::Occupied { folder: path.to_owned(), found: name.into_owned() });
            }
        }
        Self::enter(path.to_owned())
    }

    /// Refuses a folder in which results would take the place of what they are made of: a map, its picture, the map of a
    /// scenario or a log that lies there under a name of ours.
    pub(crate) fn spares(self, inputs: &[PathBuf]) -> Result<Self, Failure> {
        let Ok(folder) = fs::canonicalize(&self.path) else { return Ok(self) };
        let is_in_the_way = |input: &&PathBuf| {
            fs::canonicalize(input).is_ok_and(|file| {
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                file.parent() == Some(&folder) && is_result(&name)
            })
        };
        match inputs.iter().find(is_in_the_way) {
            Some(file) => Err(Failure::OwnInput { file: file.clone(), folder: self.path.clone() }),
            None => Ok(self),
        }
    }

    /// Refuses a folder that holds another run than this recording's: its picture would stand beside that run's numbers.
    pub(crate) fn only_of(self, recording: &Path) -> Result<Self, Failure> {
        let own = RUN.recording.map(|name| self.path.join(name)).and_then(|own| fs::canonicalize(own).ok());
        if own.is_some() && own == fs::canonicalize(recording).ok() {
            return Ok(self);
        }
        let mut telling = [RUN.numbers].into_iter().chain(RUN.recording);
        match telling.find(|name| self.path.join(name).exists()) {
            Some(found) => Err(Failure::OtherRun { folder: self.path.clone(), found }),
            None => Ok(self),
        }
    }

    /// Begins the file of a recording: its first words are written before it has its name. From then on the folder is
    /// about the new run, and what an older one left in it is gone.
    pub(crate) fn begin<T>(
        &self,
        name: &str,
        start: impl FnOnce(fs::File) -> Result<T, RecordError>,
    ) -> Result<(T, PathBuf), Failure> {
        let file = self.path.join(name);
        let failed = |cause| Failure::Write { file: file.clone(), cause };
        let (unfinished, path) = unfinished_file(&self.path).map_err(failed)?.into_parts();
        let started =
            start(unfinished).map_err(|cause| Failure::WriteRecording { file: file.clone(), cause })?;
        // An older recording stays until the new one takes its name.
        self.clear(OF_A_RUN.iter().filter(|older| **older != name).copied())?;
        path.persist(&file).map_err(|error| failed(error.error))?;
        Ok((started, file))
    }

    /// Removes what tells of another run, in this order.
    fn clear(&self, names: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<(), Failure> {
        for name in names {
            let file = self.path.join(name);
            match fs::remove_file(&file) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                // A folder under one of our names is nobody's result; who wants to write there will say so.
                Err(_) if file.is_dir() => {}
                Err(cause) => return Err(Failure::Write { file, cause }),
                Ok(()) => {}
            }
        }
        Ok(())
    }

    /// Removes all files that an older call of the same command left: first those that claim something.
    pub(crate) fn clear_all(&self, first: &[&str], is_ours: impl Fn(&str) -> bool) -> Result<(), Failure> {
        self.clear(first)?;
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        self.clear(names.filter(|name| is_ours(name)).collect::<Vec<_>>())
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
    /// its own, and what is about another run goes in between.
    pub(crate) fn write(
        &self,
        names: &Names,
        numbers: &[u8],
        picture: &[u8],
        others: &[&[u8]],
    ) -> Result<(), Failure> {
        let others = names.others.iter().copied().zip(others.iter().copied());
        let files = [(names.picture, picture)].into_iter().chain(others).chain([(names.numbers, numbers)]);
        let ready = files.map(|(name, bytes)| self.prepare(name, bytes).map(|file| (name, file)));
        let ready: Vec<(&str, NamedTempFile)> = ready.collect::<Result<_, _>>()?;
        self.clear(names.replaces.iter().filter(|name| names.recording != Some(**name)))?;
        ready.into_iter().try_for_each(|(name, file)| self.show(name, file))
    }

    /// Writes files of any names, each whole or not at all.
    pub(crate) fn write_each(&self, files: &[(String, &[u8])]) -> Result<(), Failure> {
        files.iter().try_for_each(|(name, bytes)| self.show(name, self.prepare(name, bytes)?))
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
pub(crate) fn unfinished_file(folder: &Path) -> io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt as _;
    let permissions = fs::Permissions::from_mode(0o666);
    tempfile::Builder::new().prefix(UNFINISHED).permissions(permissions).tempfile_in(folder)
}

#[cfg(not(unix))]
pub(crate) fn unfinished_file(folder: &Path) -> io::Result<NamedTempFile> {
    tempfile::Builder::new().prefix(UNFINISHED).tempfile_in(folder)
}
