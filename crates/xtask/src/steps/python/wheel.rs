//! The wheel: packed of what the gate has built anyway, installed, and asked whether it is what it says.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, ExitCode},
};

use anyhow::{Context as _, Result, ensure};

use super::environment::Environment;
use crate::{
    house::{House, run},
    steps::{LIBM_ONLY, Outcome},
};

/// Words of the step `test`, and the libraries: whole workspace, same features, so that nothing compiles a second time.
const BUILD: &str = "build --locked --profile checked --workspace --tests --lib";
/// The cargo that this program calls when maturin takes it for one.
pub(crate) const PACKS_WITH: &str = "UCHAIN_GATE_CARGO";

/// Maturin builds one package alone, with the features of that package alone: the whole simulation a second time. So it
/// is given this program in the place of cargo, which builds what it asks for as the gate builds everything, and has
/// cargo tell maturin where that is.
pub(crate) fn build_for_maturin() -> ExitCode {
    let house = House::find();
    let cargo = env::var_os(PACKS_WITH).unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(BUILD.split(' ')).arg("--message-format=json-render-diagnostics").current_dir(&house.root);
    match command.status() {
        Ok(status) => ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)),
        Err(error) => {
            eprintln!("cannot start cargo: {error}");
            ExitCode::FAILURE
        }
    }
}

pub(crate) fn is_what_it_says(house: &House) -> Result<Outcome> {
    let environment = match Environment::of_tests(house)? {
        Ok(environment) => environment,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    let wheel = packed(house, &environment, "crates/uchain-py")?;
    environment.replace(&wheel)?;
    environment.replace(&packed(house, &environment, "examples/own_law")?)?;

    let python = || Command::new(environment.python());
    run(python().args(["-m", "mypy.stubtest", "uchain"]).current_dir(&house.root))?;
    // A shared library without our linker's flags, for a test to see what happens to its mathematics.
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --package module"))?;
    let module = house.built(LIBM_ONLY).join("release/libmodule.so");
    run(python()
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "tests/python"])
        .current_dir(&house.root)
        .env("UCHAIN_CLI", house.target.join("checked/uchain"))
        .env("UCHAIN_CONTROL_MODULE", module)
        .env("PATH", with_first(&environment.program(""))?))?;
    newcomer(house, &wheel)
}

/// `PATH` with a folder before all others.
fn with_first(folder: &Path) -> Result<std::ffi::OsString> {
    let others = env::var_os("PATH").unwrap_or_default();
    Ok(env::join_paths(std::iter::once(folder.to_owned()).chain(env::split_paths(&others)))?)
}

/// The wheel of a crate.
fn packed(house: &House, environment: &Environment, package: &str) -> Result<PathBuf> {
    let folder = house.target.join("proof/wheel").join(Path::new(package).file_name().unwrap_or_default());
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    let this = env::current_exe().context("where is this program?")?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    run(Command::new(environment.program("maturin"))
        .args([
            "build",
            "--quiet",
            "--locked",
            "--profile",
            "checked",
            "--auditwheel",
            "skip",
            "--manifest-path",
        ])
        .arg(house.root.join(package).join("Cargo.toml"))
        .arg("--out")
        .arg(&folder)
        .env("CARGO", this)
        .env(PACKS_WITH, cargo))?;
    let mut found = Vec::new();
    for entry in fs::read_dir(&folder).with_context(|| format!("cannot read {}", folder.display()))? {
        found.push(entry?.path());
    }
    ensure!(found.len() == 1, "one wheel is expected in {}, found {found:?}", folder.display());
    Ok(found.remove(0))
}

/// Somebody with Python and numpy, and no Rust: what README shows first does what it says.
fn newcomer(house: &House, wheel: &Path) -> Result<Outcome> {
    let folder = house.target.join("proof/newcomer");
    let bare = match Environment::with(&folder, &["numpy"])? {
        Ok(bare) => bare,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    bare.replace(wheel)?;
    let readme = house.root.join("README.md");
    let text = fs::read_to_string(&readme).with_context(|| format!("cannot read {}", readme.display()))?;
    let program = text.split("```python\n").nth(1).and_then(|rest| rest.split("```").next());
    let program = program.context("README.md has no Python to begin with")?;
    let lines = program.lines().count();
    ensure!(lines <= 10, "README's first Python has {lines} lines; ten at most are a beginning");
    // Nothing but this Python on the path.
    run(Command::new(bare.python())
        .args(["-c", program])
        .current_dir(&folder)
        .env("PATH", bare.program("")))?;
    for picture in ["corner.png", "sweep.png"] {
        let bytes = fs::read(folder.join(picture)).with_context(|| format!("README promises {picture}"))?;
        ensure!(bytes.starts_with(b"\x89PNG"), "{picture} is no PNG");
    }
    run(Command::new(bare.program("uchain")).args(["check", "corner"]).env("PATH", bare.program("")))?;
    Ok(Outcome::Passed)
}
