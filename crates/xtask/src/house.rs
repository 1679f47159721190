//! Where things are, and how a program is started there.

use std::{
    env,
    ffi::OsString,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use anyhow::{Context as _, Result, ensure};

/// The project's folders and its cargo.
pub(crate) struct House {
    /// The folder of the root `Cargo.toml`.
    pub(crate) root: PathBuf,
    /// Where cargo puts what it builds.
    pub(crate) target: PathBuf,
    cargo: OsString,
}

/// A mini-workspace under `tests/` that proves something about a whole build.
#[derive(Clone, Copy)]
pub(crate) struct Proof(pub(crate) &'static str);

impl House {
    pub(crate) fn find() -> Self {
        let root: PathBuf =
            Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new(".")).into();
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        let target = std::path::absolute(&target).unwrap_or(target);
        Self { root, target, cargo: env::var_os("CARGO").unwrap_or_else(|| "cargo".into()) }
    }

    /// `cargo`, in the project's root.
    pub(crate) fn cargo(&self, args: &str) -> Command {
        let mut command = Command::new(&self.cargo);
        command.args(args.split_whitespace()).current_dir(&self.root);
        command
    }

    /// `cargo` in a mini-workspace. All of them build below the project's own target folder.
    pub(crate) fn cargo_in(&self, proof: Proof, args: &str) -> Command {
        let mut command = self.cargo(args);
        command.current_dir(self.root.join("tests").join(proof.0)).env("CARGO_TARGET_DIR", self.built(proof));
        command
    }

    /// Where a mini-workspace's builds go.
    pub(crate) fn built(&self, proof: Proof) -> PathBuf {
        self.target.join("proof").join(proof.0)
    }
}

/// Whether a missing tool is a failure.
pub(crate) fn ci() -> bool {
    env::var_os("CI").is_some_and(|v| v == "true")
}

/// Runs a program in the open; it must end well.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    println!("$ {}", shown(command));
    let status =
        command.stdin(Stdio::null()).status().with_context(|| format!("cannot start {}", shown(command)))?;
    ensure!(status.success(), "`{}` ended with {status}", shown(command));
    Ok(())
}

/// Runs a program and keeps what it prints; how it ends is the caller's concern.
pub(crate) fn capture(command: &mut Command) -> Result<Output> {
    println!("$ {}", shown(command));
    command.stdin(Stdio::null()).output().with_context(|| format!("cannot start {}", shown(command)))
}

/// What a program prints, trimmed; it must end well.
pub(crate) fn read(command: &mut Command) -> Result<String> {
    let output = capture(command)?;
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    ensure!(output.status.success(), "`{}` ended with {}\n{out}{err}", shown(command), output.status);
    Ok(out.trim().into())
}

/// Runs a build that has to fail, and for the right reason: `message` stands in what it prints.
pub(crate) fn must_fail_with(command: &mut Command, message: &str) -> Result<()> {
    let output = capture(command)?;
    let printed = String::from_utf8_lossy(&output.stderr);
    ensure!(!output.status.success(), "`{}` passed; it has to fail with \"{message}\"", shown(command));
    ensure!(
        printed.contains(message),
        "`{}` failed as it has to, but without saying \"{message}\":\n{printed}",
        shown(command)
    );
    println!("fails as it must: {message}");
    Ok(())
}

fn shown(command: &Command) -> String {
    let mut words = Vec::new();
    for (key, value) in command.get_envs().filter(|(key, _)| *key != "CARGO_TARGET_DIR") {
        words.push(format!("{}='{}'", key.display(), value.unwrap_or_default().display()));
    }
    words.push(Path::new(command.get_program()).file_name().unwrap_or_default().display().to_string());
    words.extend(command.get_args().map(|arg| arg.display().to_string()));
    words.join(" ")
}
