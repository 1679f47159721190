use std::{
    fs,
    os::unix::process::ExitStatusExt as _,
    path::Path,
    process::{Command, Stdio},
    time::Duration,
};

use super::{command, files, folder, has, ok, reference, small, stderr, table, uchain};

/// Runs that are on the disk, without the table.
fn chunks(folder: &Path) -> usize {
    let chunks = folder.join("chunks");
    let is_whole = |path: &&std::path::PathBuf| path.extension().is_some_and(|end| end == "jsonl");
    if chunks.is_dir() { files(&chunks).iter().filter(is_whole).count() } else { 0 }
}

#[test]
fn fifty_kills_at_random_moments_lose_no_finished_chunk_and_double_no_row() {
    let here = folder();
    let (life, reference) = timed(|| reference(here.path()));
    let out = here.path().join("killed");
    let (mut kills, mut hits, mut before) = (0, 0, 0);
    let mut random = 1_u64;
    while kills < 50 {
        let args = small("killed", &["--resume", "--quiet", "--threads", "2"]);
        let mut child = command(here.path(), &args).stdout(Stdio::null()).spawn().unwrap();
        // Any spread of moments will do, if most of them are within the life of the process.
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(life.mul_f64((random >> 33) as f64 / f64::from(1_u32 << 31)));
        child.kill().unwrap();
        let status = child.wait().unwrap();
        kills += 1;
        hits += usize::from(status.signal() == Some(9));
        if out.join("runs.parquet").exists() {
            assert!(table(&out) == reference, "a table is there whole or not at all");
            fs::remove_dir_all(&out).unwrap();
        }
        let after = if out.exists() { chunks(&out) } else { 0 };
        assert!(!out.exists() || after >= before, "{before} chunks before the kill, {after} after it");
        before = after;
    }
    assert!(hits >= 10, "only {hits} of {kills} kills met the process");
    ok(uchain(here.path(), &small("killed", &["--resume", "--quiet"])));
    assert!(table(&out) == reference);
}

/// How long something takes.
#[expect(clippy::disallowed_methods, reason = "a moment to kill at is a matter of this machine")]
fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let start = std::time::Instant::now();
    let done = work();
    (start.elapsed(), done)
}

/// Runs the small sweep; `what` happens to it when it is about to make its `nth` call of this name. Whether it came to
/// that.
fn injected(here: &Path, out: &str, call: &str, nth: usize, what: &str) -> bool {
    let mut strace = Command::new("strace");
    strace.current_dir(here).args(["-f", "-qq", "-o", "/dev/null", "-e", &format!("trace={call}")]);
    strace.args(["-e", &format!("inject={call}:{what}:when={nth}"), env!("CARGO_BIN_EXE_uchain")]);
    let output = strace.args(small(out, &["--resume", "--quiet", "--threads", "1"])).output().unwrap();
    let was_hit = !output.status.success();
    let (signal, code) = (output.status.signal(), output.status.code());
    assert!(!was_hit || signal == Some(9) || code == Some(1), "{signal:?} {code:?} {}", stderr(&output));
    // The first call is also the first of the thread that tells what went wrong.
    assert!(code != Some(1) || nth == 1 || stderr(&output).contains("cannot"), "{}", stderr(&output));
    was_hit
}

#[test]
fn a_kill_at_every_write_rename_and_fsync_is_mended_by_resume() {
    if !has("strace", &["-o", "/dev/null", "true"]) {
        return;
    }
    let here = folder();
    let reference = reference(here.path());
    for call in ["write", "fsync", "rename", "mkdir", "unlinkat"] {
        let mut nth = 1;
        while injected(here.path(), "killed", call, nth, "signal=KILL") {
            ok(uchain(here.path(), &small("killed", &["--resume", "--quiet"])));
            assert!(table(&here.path().join("killed")) == reference, "{call} {nth}");
            fs::remove_dir_all(here.path().join("killed")).unwrap();
            nth += 1;
        }
        // 12 chunks, the manifest and the table; each with an fsync of its folder.
        let least = match call {
            "fsync" => 28,
            "write" | "rename" => 14,
            _ => 1,
        };
        assert!(nth > least, "only {} calls of {call} were met", nth - 1);
        fs::remove_dir_all(here.path().join("killed")).unwrap();
    }
}

#[test]
fn a_disk_that_is_full_at_any_write_is_an_error_and_resume_goes_on() {
    if !has("strace", &["-o", "/dev/null", "true"]) {
        return;
    }
    let here = folder();
    let reference = reference(here.path());
    for (call, error) in [("write", "error=ENOSPC"), ("fsync", "error=EIO"), ("rename", "error=EROFS")] {
        let mut nth = 1;
        while injected(here.path(), "full", call, nth, error) {
            ok(uchain(here.path(), &small("full", &["--resume", "--quiet"])));
            assert!(table(&here.path().join("full")) == reference, "{call} {nth}");
            fs::remove_dir_all(here.path().join("full")).unwrap();
            nth += 1;
        }
        assert!(nth > 14, "only {} calls of {call} were met", nth - 1);
        fs::remove_dir_all(here.path().join("full")).unwrap();
    }
}

#[test]
fn ctrl_c_leaves_a_folder_that_resume_completes() {
    let here = folder();
    let reference = {
        let args = ["sweep", "corner", "--replicates", "300", "--out", "reference", "--quiet"];
        ok(uchain(here.path(), &args));
        table(&here.path().join("reference"))
    };
    let args = ["sweep", "corner", "--replicates", "300", "--out", "stopped", "--threads", "1"];
    let mut child =
        command(here.path(), &args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let out = here.path().join("stopped");
    while chunks(&out) < 3 {
        assert!(child.try_wait().unwrap().is_none(), "it was over before it could be stopped");
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let stopped = child.wait_with_output().unwrap();
    assert_eq!(stopped.status.code(), Some(130), "{}", stderr(&stopped));
    assert!(stderr(&stopped).contains("--resume goes on where it stopped"), "{}", stderr(&stopped));
    let there = chunks(&out);
    assert!((3..150).contains(&there), "{there} chunks");
    let report = uchain(here.path(), &["report", "stopped"]);
    assert_eq!(report.status.code(), Some(3));
    assert!(stderr(&report).contains("of 300 runs are there; go on with --resume"), "{}", stderr(&report));

    ok(uchain(here.path(), &[&args[..], &["--resume", "--quiet"]].concat()));
    assert!(table(&out) == reference);
    assert!(!out.join("chunks").exists());
}
