//! Every program in `examples/` runs, ends well and prints what its own head says it prints; and a stranger's package, in
//! another workspace and with nothing but path dependencies, builds and runs those of them that show a seam.

use std::{fs, path::Path, process::Command};

use anyhow::{Context as _, Result, ensure};

use super::{LIBM_ONLY, Outcome};
use crate::house::{House, read, run};

pub(super) fn print_what_they_say(house: &House) -> Result<Outcome> {
    // The whole workspace, as in the step `test`: same features, so that nothing compiles a second time.
    run(&mut house.cargo("build --locked --profile checked --workspace --examples"))?;
    let folder = house.root.join("examples");
    let mut sources: Vec<_> = fs::read_dir(&folder)
        .with_context(|| format!("cannot read {}", folder.display()))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|end| end == "rs"))
        .collect();
    sources.sort();
    ensure!(!sources.is_empty(), "{} is empty", folder.display());
    for source in sources {
        let program = house.target.join("checked/examples").join(source.file_stem().unwrap_or_default());
        runs_as_said(&source, &mut Command::new(program))?;
    }
    Ok(Outcome::Passed)
}

/// What a stranger has to be able to do with the public items of the libraries: fly, and answer each question in his own
/// way.
const STRANGERS: [&str; 5] = ["fly", "own_law", "own_radio", "own_strategy", "own_mission"];

pub(super) fn build_elsewhere(house: &House) -> Result<Outcome> {
    // All of that workspace, as in the step `libm`: same features, so that nothing compiles a second time.
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --workspace --features control"))?;
    for name in STRANGERS {
        let source = house.root.join("examples").join(name).with_extension("rs");
        let program = house.built(LIBM_ONLY).join("release").join(name);
        runs_as_said(&source, &mut Command::new(program))?;
    }
    Ok(Outcome::Passed)
}

/// Runs a program, and compares what it prints with what its source says.
fn runs_as_said(source: &Path, program: &mut Command) -> Result<()> {
    let text = fs::read_to_string(source).with_context(|| format!("cannot read {}", source.display()))?;
    let said = said(&text).with_context(|| format!("{} does not say what it prints", source.display()))?;
    // `read` leaves out blanks at both ends, and a first line may begin with some.
    let printed = read(program)?;
    ensure!(
        printed == said.trim(),
        "{} prints\n\n{printed}\n\nand says that it prints\n\n{said}",
        source.display()
    );
    Ok(())
}

/// What a program prints by its own account: the block fenced as `text` in the comment at its head.
fn said(source: &str) -> Option<String> {
    let head = source.lines().map_while(|line| line.strip_prefix("//!"));
    let block = head.map(|line| line.strip_prefix(' ').unwrap_or(line)).skip_while(|line| *line != "```text");
    let lines: Vec<&str> = block.skip(1).take_while(|line| *line != "```").collect();
    (!lines.is_empty()).then(|| lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    /// A source that says it prints "one" and "two", run as this line of a shell.
    fn runs(line: &str) -> Result<()> {
        let mut source = tempfile::NamedTempFile::new()?;
        source.write_all(b"//! Counts.\n//!\n//! ```text\n//! one\n//! two\n//! ```\nfn main() {}\n")?;
        runs_as_said(source.path(), Command::new("sh").args(["-c", line]))
    }

    #[test]
    fn a_program_has_to_print_what_its_head_says_and_end_well() {
        assert!(runs("echo one; echo two").is_ok());
        let other = runs("echo one; echo three").unwrap_err().to_string();
        assert!(other.contains("three") && other.contains("two"), "the control: {other}");
        assert!(runs("echo one; echo two; exit 1").unwrap_err().to_string().contains("exit status: 1"));
        assert!(runs("echo one").is_err());
    }

    #[test]
    fn a_program_that_says_nothing_of_what_it_prints_is_found() {
        assert_eq!(said("//! ```text\n//! a\n//!  b\n//! ```\n").as_deref(), Some("a\n b"));
        assert_eq!(said("//! Prints something.\nfn main() {}\n"), None);
        assert_eq!(said("//! ```text\n//! ```\n"), None);
    }
}
