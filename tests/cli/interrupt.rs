use std::{
    fs,
    path::PathBuf,
    process::{Command, Stdio},
    time::Duration,
};

use crate::{command, files, folder, stderr};

/// Whether a process has a handler of its own for Ctrl-C by now.
#[cfg(target_os = "linux")]
fn listens_for_interrupt(pid: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() & 0b10 != 0
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_a_run_with_130_and_nothing_is_written() {
    let here = folder();
    let args = ["run", "corner", "--set", "duration_s=86400", "--out", "results"];
    let mut child =
        command(here.path(), &args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while child.try_wait().unwrap().is_none() && !listens_for_interrupt(child.id()) {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("of simulated time; nothing was written"), "{}", stderr(&output));
    assert_eq!(files(here.path()), Vec::<PathBuf>::new());
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
