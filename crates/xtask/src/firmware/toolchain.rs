//! Rust for the drone's microcontroller: rustup's if it can be had, else Debian's.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use anyhow::Result;

use crate::house::{self, House};

/// A Cortex-M4F with its floating point unit: the STM32F405 of a Crazyflie.
pub(crate) const TARGET: &str = "thumbv7em-none-eabihf";

/// Debian's compiler goes by its path, for rustup's stays first on PATH.
const DEBIAN: [&str; 3] = ["/usr/bin/cargo", "/usr/bin/rustc", "/usr/bin/rustdoc"];

/// A Rust that builds for [`TARGET`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Toolchain(Kind);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// The project's own cargo, which has the target's library.
    Own,
    /// Debian's matched compiler and library source (`rustc-web`, `rust-web-src`).
    Debian,
}

/// What there is on this machine.
#[expect(clippy::struct_excessive_bools, reason = "five answers, none of which says anything of another")]
#[derive(Debug, Clone, Copy)]
struct Found {
    /// The project's Rust has the target's library.
    target: bool,
    /// rustup is there and has not been asked for the target yet.
    rustup: bool,
    /// Debian's compiler is there, new enough, and with the source of its library.
    debian: bool,
    /// `arm-none-eabi-ld`, which links for Debian's.
    linker: bool,
    /// `qemu-system-arm`.
    qemu: bool,
}

#[derive(Debug, PartialEq, Eq)]
enum Choice {
    Build(Kind),
    /// Ask rustup for the target, and look again.
    Ask,
    /// What to install, in a line.
    Install(String),
}

/// Everything that flies on the emulated chip takes these. What is missing is fetched if rustup is there; the inner error
/// is what to install, in a line.
pub(crate) fn toolchain(house: &House) -> Result<Result<Toolchain, String>> {
    let mut found = look(house)?;
    if choose(found) == Choice::Ask {
        // Without a network it says so itself.
        let _ = house::run(Command::new("rustup").args(["target", "add", TARGET]).current_dir(&house.root));
        found = Found { rustup: false, target: has_target(house)?, ..found };
    }
    Ok(match choose(found) {
        Choice::Build(kind) => Ok(Toolchain(kind)),
        Choice::Install(line) => Err(line),
        Choice::Ask => Err(format!("rustup target add {TARGET}")),
    })
}

fn choose(found: Found) -> Choice {
    let debian = found.debian && found.linker;
    if !found.qemu {
        return Choice::Install(
            "the emulated chip is missing: apt-get install qemu-system-arm (or your system's QEMU for Arm)"
                .into(),
        );
    }
    match found {
        Found { target: true, .. } => Choice::Build(Kind::Own),
        Found { rustup: true, .. } => Choice::Ask,
        _ if debian => Choice::Build(Kind::Debian),
        _ => Choice::Install(format!(
            "this Rust cannot build for {TARGET}: rustup target add {TARGET}, or on Debian \
             apt-get install --no-install-recommends rustc-web cargo-web rust-web-src gcc-arm-none-eabi"
        )),
    }
}

fn look(house: &House) -> Result<Found> {
    let [cargo, rustc, _] = DEBIAN;
    Ok(Found {
        target: has_target(house)?,
        rustup: is_there("rustup"),
        debian: is_there(cargo) && is_new_enough(rustc) && has_source(rustc),
        linker: is_there("arm-none-eabi-ld"),
        qemu: is_there("qemu-system-arm"),
    })
}

/// Whether the standard library is there for this target, in the Rust that builds the project.
fn has_target(house: &House) -> Result<bool> {
    let mut asked = Command::new("rustc");
    asked.args(["--print", "target-libdir", "--target", TARGET]).current_dir(&house.root);
    Ok(Path::new(&house::read(&mut asked)?).exists())
}

/// Whether a program can be started.
pub(crate) fn is_there(program: &str) -> bool {
    said(program, &["--version"]).is_some()
}

/// What a program says of itself; `None` if it cannot be started, or fails.
fn said(program: &str, args: &[&str]) -> Option<String> {
    let output = Command::new(program).args(args).stdin(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn is_new_enough(rustc: &str) -> bool {
    let least = minor(env!("CARGO_PKG_RUST_VERSION"));
    said(rustc, &["--version"]).and_then(|said| minor(said.split(' ').nth(1)?)) >= least
}

/// 89 of `1.89.0`.
fn minor(version: &str) -> Option<u32> {
    version.strip_prefix("1.")?.split('.').next()?.parse().ok()
}

/// Whether a compiler has the source of its own library, from which it builds one for the target.
fn has_source(rustc: &str) -> bool {
    let sysroot = said(rustc, &["--print", "sysroot"]);
    sysroot.is_some_and(|root| Path::new(&root).join("lib/rustlib/src/rust/library/core").exists())
}

impl Toolchain {
    /// `cargo` in a folder below the project's root that is a workspace of its own: `build`, `rustc` or `clippy`, for the
    /// chip, with whatever comes after. What it builds lies in [`built`](Self::built).
    pub(crate) fn cargo(self, house: &House, folder: &str, args: &str) -> Command {
        let (task, more) = args.split_once(' ').unwrap_or((args, ""));
        let mut command = house.cargo(task);
        if self.0 == Kind::Debian {
            let [cargo, rustc, rustdoc] = DEBIAN;
            command = Command::new(cargo);
            command.arg(task);
            command.env("RUSTC", rustc).env("RUSTDOC", rustdoc).env("RUSTC_BOOTSTRAP", "1");
            command.env_remove("RUSTUP_TOOLCHAIN");
            let of_target =
                |key: &str| format!("CARGO_TARGET_{}_{key}", TARGET.to_uppercase().replace('-', "_"));
            command.env(of_target("LINKER"), "arm-none-eabi-ld");
            command.env(of_target("RUSTFLAGS"), "-C linker-flavor=ld");
            command.arg("-Zbuild-std=core,alloc,compiler_builtins");
        }
        command.args(["--target", TARGET]).args(more.split_whitespace());
        command.current_dir(house.root.join(folder)).env("CARGO_TARGET_DIR", self.target_dir(house, folder));
        command
    }

    /// Where what such a folder builds for the chip in `release` lies.
    pub(crate) fn built(self, house: &House, folder: &str) -> PathBuf {
        self.target_dir(house, folder).join(TARGET).join("release")
    }

    /// Two compilers do not share a folder.
    fn target_dir(self, house: &House, folder: &str) -> PathBuf {
        let whose = match self.0 {
            Kind::Own => "chip",
            Kind::Debian => "chip-debian",
        };
        house.target.join(whose).join(Path::new(folder).file_name().unwrap_or_default())
    }

    /// In a word, for people.
    pub(crate) fn word(self) -> &'static str {
        match self.0 {
            Kind::Own => "the project's Rust",
            Kind::Debian => "Debian's Rust",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Found = Found { target: true, rustup: true, debian: true, linker: true, qemu: true };

    #[test]
    fn the_projects_rust_comes_first_then_rustup_is_asked_then_debians() {
        assert_eq!(choose(ALL), Choice::Build(Kind::Own));
        let without = Found { target: false, ..ALL };
        assert_eq!(choose(without), Choice::Ask);
        let asked_in_vain = Found { rustup: false, ..without };
        assert_eq!(choose(asked_in_vain), Choice::Build(Kind::Debian));
    }

    #[test]
    fn what_is_missing_is_said_in_one_line() {
        let install = |found| match choose(found) {
            Choice::Install(line) => line,
            other => panic!("{other:?}"),
        };
        let bare = Found { target: false, rustup: false, debian: false, ..ALL };
        let no_linker = Found { debian: true, linker: false, ..bare };
        for line in [install(bare), install(no_linker)] {
            assert!(line.contains("rustup target add") && line.contains("gcc-arm-none-eabi"), "{line}");
            assert!(!line.contains('\n'));
        }
        let line = install(Found { qemu: false, ..ALL });
        assert!(line.contains("apt-get install qemu-system-arm") && !line.contains('\n'), "{line}");
    }

    #[test]
    fn a_compiler_older_than_the_project_asks_for_is_none() {
        assert_eq!((minor("1.89"), minor("1.63.0"), minor("1.96.0-nightly")), (Some(89), Some(63), Some(96)));
        assert_eq!(minor("rustc"), None);
        assert!(!is_new_enough("/nowhere/rustc"));
    }
}
