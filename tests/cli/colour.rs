use std::{
    fs,
    process::{Command, Output, Stdio},
};

use crate::{SHORT, command, folder};

const ESCAPE: u8 = 0x1b;

fn everything(output: &Output) -> Vec<u8> {
    [output.stdout.as_slice(), &output.stderr].concat()
}

#[test]
fn no_escape_byte_goes_where_there_is_no_terminal() {
    let here = folder();
    let table: &[&[&str]] = &[
        &["--help"],
        &["run", "--help"],
        &["fly"],
        &["list"],
        &["explain"],
        &["explain", "alpha_wall"],
        &["explain", "nothing"],
        &["check", "corner"],
        &["run", "corner", "--set", SHORT],
        &["plan", "corner"],
        &["man"],
    ];
    for args in table {
        for (name, value) in [("TERM", "xterm-256color"), ("NO_COLOR", "1")] {
            let output = command(here.path(), args).env(name, value).output().unwrap();
            assert!(!everything(&output).contains(&ESCAPE), "{args:?}");
        }
    }
}

/// What comes out on a terminal; `script` makes one. `None` where there is no such program.
fn on_a_terminal(args: &str, environment: &[(&str, &str)]) -> Option<Vec<u8>> {
    let here = folder();
    let typed = here.path().join("typed");
    let mut script = Command::new("script");
    script
        .args(["--quiet", "--return", "--command"])
        .arg(format!("'{}' {args}", env!("CARGO_BIN_EXE_uchain")))
        .arg(&typed)
        .current_dir(here.path())
        .env("TERM", "xterm-256color")
        .env_remove("NO_COLOR")
        // Where CI is set, colour is taken to be welcome even on a dumb terminal.
        .env_remove("CI")
        .envs(environment.iter().copied())
        .stdin(Stdio::null());
    match script.output() {
        Ok(_) => fs::read(typed).ok(),
        Err(_) => None,
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_colour_unless_asked_not_to_and_a_dumb_one_no_progress_either() {
    let Some(coloured) = on_a_terminal("--help", &[]) else {
        assert_ne!(std::env::var("CI").as_deref(), Ok("true"), "`script` is missing");
        eprintln!("skipped: `script` is missing");
        return;
    };
    assert!(coloured.contains(&ESCAPE), "control: a terminal gets colour");
    let run = format!("run corner --set {SHORT}");
    assert!(on_a_terminal(&run, &[]).unwrap().contains(&ESCAPE), "control: a terminal gets progress");
    for environment in [("NO_COLOR", "1"), ("CLICOLOR", "0"), ("TERM", "dumb")] {
        for args in ["--help", "run --help", "fly"] {
            let plain = on_a_terminal(args, &[environment]).unwrap();
            assert!(!plain.contains(&ESCAPE), "{environment:?} {args}: {}", String::from_utf8_lossy(&plain));
        }
    }
    let progress = on_a_terminal(&run, &[("NO_COLOR", "1")]).unwrap();
    let colours = progress.windows(2).filter(|pair| pair == b"\x1b[").count();
    let coloured = String::from_utf8_lossy(&progress).contains("\x1b[3");
    assert!(!coloured, "{colours} sequences: {}", String::from_utf8_lossy(&progress));
    assert!(!on_a_terminal(&run, &[("TERM", "dumb")]).unwrap().contains(&ESCAPE));
    assert!(!on_a_terminal(&format!("{run} --quiet"), &[]).unwrap().contains(&ESCAPE));
}
