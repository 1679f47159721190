//! One process at a time writes into a folder.

use std::{
    fs::{File, TryLockError},
    io,
    path::Path,
};

/// The file that is locked where a folder cannot be. It stays: a lock is the system's, not the file's.
pub const LOCK: &str = ".uchain-lock";

/// A folder that nobody else writes to, as long as this lives. The system forgets the lock of a process that is killed,
/// and what such a process left behind stops nobody.
#[derive(Debug)]
pub struct Lock {
    _held: Option<File>,
}

/// Why a folder is not ours alone.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    /// Another process, or another thread of this one, holds it.
    #[error("another process writes there")]
    Busy,
    /// The system said no.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl Lock {
    /// Takes a folder that is there.
    ///
    /// # Errors
    /// [`LockError`].
    pub fn take(folder: &Path) -> Result<Self, LockError> {
        // Only Unix opens a folder as a file, and then nothing is left in it.
        if cfg!(unix) { Self::hold(File::open(folder)?) } else { Self::by_file(folder) }
    }

    fn by_file(folder: &Path) -> Result<Self, LockError> {
        let file = folder.join(LOCK);
        Self::hold(File::options().create(true).truncate(false).write(true).open(file)?)
    }

    fn hold(file: File) -> Result<Self, LockError> {
        match file.try_lock() {
            Ok(()) => Ok(Self { _held: Some(file) }),
            Err(TryLockError::WouldBlock) => Err(LockError::Busy),
            // Some file systems know no locks; there everyone minds their own folder.
            Err(TryLockError::Error(_)) => Ok(Self { _held: None }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_held_by_one_at_a_time_and_a_file_left_behind_stops_nobody() {
        let folder = tempfile::tempdir().unwrap();
        for take in [Lock::take, Lock::by_file] {
            let held = take(folder.path()).unwrap();
            assert!(matches!(take(folder.path()), Err(LockError::Busy)));
            drop(held);
            assert!(take(folder.path()).is_ok());
        }
        assert!(folder.path().join(LOCK).exists());
        assert!(Lock::by_file(folder.path()).is_ok());
    }

    #[test]
    fn a_folder_that_is_not_there_cannot_be_held() {
        let absent = tempfile::tempdir().unwrap().path().join("absent");
        assert!(matches!(Lock::take(&absent), Err(LockError::Io(_))));
        assert!(matches!(Lock::by_file(&absent), Err(LockError::Io(_))));
    }
}
