//! Pythons of our own below the target folder, with the packages that a step asks for.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use anyhow::{Context as _, Result, bail};

use crate::house::{self, House, run};

/// What a usual Python has, and Debian's does not have without a package more.
const CAN_MAKE: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";
/// Where to get it.
const REMEDY: &str = "no Python 3.11 or later with `venv` (apt-get install python3 python3-venv)";

/// A Python.
pub(super) struct Environment {
    folder: PathBuf,
}

impl Environment {
    /// The one with everything that tests need; `Err` in words if this machine has no Python to make it of, which is an
    /// error when `CI=true`.
    pub(super) fn of_tests(house: &House) -> Result<Result<Self, String>> {
        Self::of(house, "tests/python/requirements.txt", "python")
    }

    /// One in a folder below the target folder, with what a file lists; `Err` as above.
    pub(super) fn of(house: &House, wanted: &str, folder: &str) -> Result<Result<Self, String>> {
        let wanted = house.root.join(wanted);
        let wanted =
            fs::read_to_string(&wanted).with_context(|| format!("cannot read {}", wanted.display()))?;
        let packages: Vec<&str> =
            wanted.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')).collect();
        Self::with(&house.target.join(folder), &packages)
    }

    /// One with these packages, made anew if it had others.
    pub(super) fn with(folder: &Path, packages: &[&str]) -> Result<Result<Self, String>> {
        let this = Self { folder: folder.to_owned() };
        let (stamp, wanted) = (folder.join("packages.txt"), packages.join("\n"));
        if fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) && this.python().exists() {
            return Ok(Ok(this));
        }
        let mut check = Command::new("python3");
        check.args(["-c", CAN_MAKE]).stdin(Stdio::null()).stderr(Stdio::null());
        if !check.status().is_ok_and(|status| status.success()) {
            if house::ci() {
                bail!(REMEDY);
            }
            return Ok(Err(REMEDY.to_owned()));
        }
        run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(folder))?;
        if let Err(error) = this.install(packages) {
            if house::ci() {
                return Err(error);
            }
            return Ok(Err(format!(
                "its packages cannot be installed, perhaps there is no network: {error:#}"
            )));
        }
        fs::write(&stamp, wanted).with_context(|| format!("cannot write {}", stamp.display()))?;
        Ok(Ok(this))
    }

    /// Installs packages, or wheels.
    pub(super) fn install(&self, packages: &[&str]) -> Result<()> {
        let options = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        run(Command::new(self.python()).args(options).args(packages))
    }

    /// Puts a wheel in the place of the one that was there, whatever its version.
    pub(super) fn replace(&self, wheel: &Path) -> Result<()> {
        let options = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        let only = ["--force-reinstall", "--no-deps", "--no-index"];
        run(Command::new(self.python()).args(options).args(only).arg(wheel))
    }

    /// Its interpreter.
    pub(super) fn python(&self) -> PathBuf {
        self.program("python")
    }

    /// A command that a package brought.
    pub(super) fn program(&self, name: &str) -> PathBuf {
        self.folder.join("bin").join(name)
    }
}
