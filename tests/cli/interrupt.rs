use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    time::Duration,
};

use crate::{command, files, folder, stderr, stdout, uchain};

/// Whether a process has a handler of its own for Ctrl-C by now.
#[cfg(target_os = "linux")]
fn listens_for_interrupt(pid: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() & 0b10 != 0
}

/// Flies for long, presses Ctrl-C.
#[cfg(target_os = "linux")]
fn interrupted(folder: &Path, extra: &[&str]) -> Output {
    let mut args = vec!["run", "corner", "--set", "duration_s=86400", "--out", "results"];
    args.extend(extra);
    let mut child = command(folder, &args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let recorded = || folder.join("results/run.mcap").exists() || extra.contains(&"--no-record");
    while child.try_wait().unwrap().is_none() && !(listens_for_interrupt(child.id()) && recorded()) {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    child.wait_with_output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_a_run_with_130_and_nothing_is_written_but_the_recording() {
    let here = folder();
    let output = interrupted(here.path(), &["--no-record"]);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("of simulated time; nothing was written"), "{}", stderr(&output));
    assert_eq!(files(here.path()), Vec::<PathBuf>::new());

    let output = interrupted(here.path(), &[]);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("results/run.mcap holds the flight up to there"), "{}", stderr(&output));
    let results = here.path().join("results");
    assert_eq!(files(here.path()), [results.clone(), results.join("run.mcap")]);
    let verified = uchain(here.path(), &["verify", "results/run.mcap"]);
    assert_eq!(verified.status.code(), Some(0), "{}", stderr(&verified));
    assert!(stdout(&verified).contains("the same, bit for bit, for the "), "{}", stdout(&verified));
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_error() {
    let here = folder();
    for args in ["list", "--help", "show corner", "run straight --set duration_s=5 --json"] {
        let script = format!("\"$0\" {args} | true; exit \"${{PIPESTATUS[0]}}\"");
        let shell = Command::new("bash")
            .current_dir(here.path())
            .args(["-c", &script, env!("CARGO_BIN_EXE_uchain")])
            .output()
            .unwrap();
        assert_eq!((shell.status.code(), stderr(&shell)), (Some(0), ""), "{args}");
    }
}
