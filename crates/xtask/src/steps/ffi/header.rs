//! `uchain.h` is made of the library as it is, and every compiler takes it.

use std::{fs, process::Command};

use anyhow::{Context as _, Result, ensure};

use super::{FOLDER, STRICT, built};
use crate::house::{House, run};

/// The program that makes it, a workspace of its own.
const MAKER: &str = "crates/uchain-ffi/header";

/// Dialects, with the compiler for each.
const DIALECTS: [(&str, &str); 6] =
    [("cc", "c99"), ("cc", "c11"), ("cc", "c17"), ("c++", "c++11"), ("c++", "c++17"), ("c++", "c++20")];

/// A program of both languages that includes it twice.
const PROGRAM: &str = "#include \"uchain.h\"\n#include \"uchain.h\"\n\
    uchain_status fly(uchain_node *node, uchain_observation *seen, uchain_command *asked);\n\
    uchain_status fly(uchain_node *node, uchain_observation *seen, uchain_command *asked)\n\
    {\n    seen->pilot_follow = UCHAIN_FOLLOW_LEFT;\n    return uchain_step(node, seen, asked);\n}\n";

/// It is what cbindgen makes of the sources today.
pub(super) fn is_the_library(house: &House) -> Result<()> {
    fs::create_dir_all(built(house))?;
    let fresh = built(house).join("uchain.h");
    let mut make = house.cargo("run --quiet --locked --");
    make.current_dir(house.root.join(MAKER)).env("CARGO_TARGET_DIR", built(house).join("header"));
    run(make.arg(&fresh))?;
    let committed = house.root.join(FOLDER).join("uchain.h");
    let read = |path| fs::read_to_string(path).with_context(|| format!("cannot read {FOLDER}/uchain.h"));
    same(&read(&committed)?, &read(&fresh)?)?;
    println!("uchain.h is what the library is");
    Ok(())
}

fn same(committed: &str, made: &str) -> Result<()> {
    let lines = || committed.lines().zip(made.lines());
    let line = lines().take_while(|(old, new)| old == new).count();
    ensure!(
        committed == made,
        "{FOLDER}/uchain.h, line {}: `{}`, and the library says `{}`; to mend it:\n\
         cargo run --locked --manifest-path {MAKER}/Cargo.toml -- {FOLDER}/uchain.h",
        line + 1,
        committed.lines().nth(line).unwrap_or_default(),
        made.lines().nth(line).unwrap_or_default()
    );
    Ok(())
}

/// The page whose programs in C have to compile.
const GUIDE: &str = "docs/guide/firmware.md";

/// C and C++ take it without a warning, and C the guide's programs.
pub(super) fn compiles(house: &House) -> Result<()> {
    let guide = fs::read_to_string(house.root.join(GUIDE)).with_context(|| format!("cannot read {GUIDE}"))?;
    let programs = in_c(&guide);
    ensure!(!programs.is_empty(), "{GUIDE} has no program in C");
    for (number, program) in programs.iter().enumerate() {
        let source = built(house).join(format!("guide-{number}.c"));
        fs::write(&source, program)?;
        let mut command = Command::new("cc");
        command.arg("-std=c99").args(STRICT).arg("-I").arg(house.root.join(FOLDER));
        run(command.arg("-fsyntax-only").arg(&source))?;
    }
    let source = built(house).join("twice");
    for (compiler, dialect) in DIALECTS {
        let source = source.with_extension(if compiler == "cc" { "c" } else { "cpp" });
        fs::write(&source, PROGRAM)?;
        let mut command = Command::new(compiler);
        command.arg(format!("-std={dialect}")).args(STRICT).arg("-I").arg(house.root.join(FOLDER));
        run(command.arg("-fsyntax-only").arg(&source))?;
    }
    Ok(())
}

/// The blocks of C in a page.
fn in_c(page: &str) -> Vec<&str> {
    page.split("\n```c\n").skip(1).filter_map(|rest| Some(rest.split_once("\n```")?.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_c_are_found_in_a_page() {
        let page = "a\n```c\nint x;\n```\nb\n```rust\nlet y;\n```\n```c\nint z;\n```\n";
        assert_eq!(in_c(page), ["int x;", "int z;"]);
    }

    #[test]
    fn a_header_of_yesterday_is_told_by_its_first_line_that_differs() {
        assert!(same("a\nb\n", "a\nb\n").is_ok());
        let told = same("a\nfloat k_db_per_m;\n", "a\nfloat k_db;\n").unwrap_err().to_string();
        assert!(
            told.contains("uchain.h, line 2: `float k_db_per_m;`") && told.contains("`float k_db;`"),
            "{told}"
        );
        assert!(same("a\n", "a\nb\n").unwrap_err().to_string().contains("line 2: ``"));
    }
}
