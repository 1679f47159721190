use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
    time::Duration,
};

use serde_json::Value;
use uchain_sim::{
    config::{Course, builtin},
    record::{
        Frame, RecordError, Recorder,
        mcap::{End, McapRecorder, Recording},
    },
    run::run,
};

use crate::{SHORT, command, files, folder, stderr, stdout, uchain};

#[test]
fn inspect_finds_in_the_recording_what_the_run_came_to_and_draws_the_same_picture() {
    let here = folder();
    let flown = uchain(here.path(), &["run", "corner", "--set", "duration_s=30", "--json"]);
    assert_eq!(flown.status.code(), Some(0), "{}", stderr(&flown));
    let looked = uchain(here.path(), &["inspect", "runs/corner-s1/run.mcap", "--json", "--out", "again"]);
    assert_eq!(looked.status.code(), Some(0), "{}", stderr(&looked));

    let flown: Value = serde_json::from_str(stdout(&flown)).unwrap();
    let found: Value = serde_json::from_str(stdout(&looked)).unwrap();
    for (key, value) in flown.as_object().unwrap().iter().filter(|(key, _)| *key != "wall_s") {
        assert_eq!(found.get(key), Some(value), "{key}");
    }
    assert_eq!((&found["whole"], &found["ticks"]), (&Value::Bool(true), &Value::from(600)));
    assert_eq!(found["moments"].as_array().unwrap().len(), 150, "every decision of a short run");
    let picture = |folder: &str| fs::read(here.path().join(folder).join("run.png")).unwrap();
    assert!(picture("again") == picture("runs/corner-s1"), "another picture");
    assert_eq!(stdout(&looked), fs::read_to_string(here.path().join("again/inspect.json")).unwrap());

    let table = uchain(here.path(), &["inspect", "runs/corner-s1/run.mcap"]);
    assert!(stdout(&table).contains("\n  time (s)  UAVs  reach (m)"), "{}", stdout(&table));
    assert!(stdout(&table).lines().count() < 50, "{}", stdout(&table));
}

#[test]
fn without_a_recording_there_is_none_and_the_digest_is_the_same() {
    let here = folder();
    let digest = |flag: &str, out: &str| {
        let output = uchain(here.path(), &["run", "bend", "--set", SHORT, flag, "--json", "--out", out]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let summary: Value = serde_json::from_str(stdout(&output)).unwrap();
        summary["digest"].clone()
    };
    assert_eq!(digest("--record", "with"), digest("--no-record", "without"));
    assert!(here.path().join("with/run.mcap").exists() && !here.path().join("without/run.mcap").exists());
}

/// Raises one UAV's speed by one ulp at one tick.
struct Tamper<R>(R);

impl<R: Recorder> Recorder for Tamper<R> {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        if frame.tick == 50 {
            frame.uavs[0].forward_mps = frame.uavs[0].forward_mps.next_up();
        }
        self.0.frame(&frame)
    }
}

#[test]
fn verify_and_diff_pass_what_is_untouched_and_find_one_ulp_at_its_tick() {
    let here = folder();
    let flown = uchain(here.path(), &["run", "corner", "--set", SHORT, "--quiet", "--out", "true"]);
    assert_eq!(flown.status.code(), Some(0), "{}", stderr(&flown));
    let verified = uchain(here.path(), &["verify", "true/run.mcap"]);
    assert_eq!((verified.status.code(), stderr(&verified)), (Some(0), ""));
    assert_eq!(stdout(&verified), "all 100 ticks are the same, bit for bit\n");

    let course = Course::read(&builtin("corner").unwrap(), &[SHORT.to_owned()]).unwrap();
    let mut tamper = Tamper(McapRecorder::start(Vec::new(), &course, 1).unwrap());
    run(&course, 1, &mut tamper).unwrap();
    fs::write(here.path().join("tampered.mcap"), tamper.0.finish().unwrap()).unwrap();
    let refuted = uchain(here.path(), &["verify", "tampered.mcap"]);
    assert_eq!((refuted.status.code(), stderr(&refuted)), (Some(4), ""));
    assert!(
        stdout(&refuted).starts_with("differs at tick 50 (2.50 s), UAV 0, forward_mps: 0."),
        "{}",
        stdout(&refuted)
    );

    let same = uchain(here.path(), &["diff", "true/run.mcap", "true/run.mcap"]);
    assert_eq!((same.status.code(), stderr(&same)), (Some(0), ""));
    assert_eq!(stdout(&same), "the flights are the same, bit for bit, for 100 ticks\n");
    let differ = uchain(here.path(), &["diff", "true/run.mcap", "tampered.mcap"]);
    assert_eq!((differ.status.code(), stderr(&differ)), (Some(4), ""));
    let words = "the flights part at tick 50 (2.50 s), UAV 0, forward_mps: ";
    assert!(stdout(&differ).starts_with(words), "{}", stdout(&differ));
    assert!(stdout(&differ).contains("\n1 of 100 ticks differ"), "{}", stdout(&differ));

    let args = ["run", "corner", "--seed", "2", "--set", "duration_s=4", "--quiet", "--out", "other"];
    assert_eq!(uchain(here.path(), &args).status.code(), Some(0));
    let differ = uchain(here.path(), &["diff", "true/run.mcap", "other/run.mcap"]);
    let words = "seed: 1 and 2\nduration_s: 5.0 and 4.0\nticks: 100 and 80\nthe flights part at tick ";
    assert!(stdout(&differ).starts_with(words), "{}", stdout(&differ));
    assert_eq!(differ.status.code(), Some(4));
}

#[test]
fn what_is_no_recording_or_a_damaged_one_exits_with_3_and_says_where() {
    let here = folder();
    assert_eq!(uchain(here.path(), &["run", "bend", "--set", SHORT, "--quiet"]).status.code(), Some(0));
    let mut file = fs::read(here.path().join("runs/bend-s1/run.mcap")).unwrap();
    let middle = file.len() / 2;
    file[middle] ^= 1;
    fs::write(here.path().join("damaged.mcap"), &file).unwrap();
    fs::write(here.path().join("text.mcap"), "dear").unwrap();
    fs::write(here.path().join("long.mcap"), "dear reader, this is no recording").unwrap();
    let before = files(here.path());
    for (name, code, words) in [
        ("damaged.mcap", 3, "error: damaged.mcap: damaged at byte "),
        ("text.mcap", 3, "error: text.mcap: the file ends after 4 bytes"),
        ("long.mcap", 3, "error: long.mcap: not an MCAP file"),
        ("absent.mcap", 1, "error: absent.mcap: cannot read: No such file"),
    ] {
        for args in [&["inspect", name, "--out", "results"][..], &["verify", name], &["diff", name, name]] {
            let output = uchain(here.path(), args);
            assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
            assert!(stderr(&output).starts_with(words), "{args:?}: {}", stderr(&output));
            assert_eq!((stdout(&output), files(here.path())), ("", before.clone()), "{args:?}");
        }
    }
}

/// A run under way in `results`, with its recording begun.
fn under_way(folder: &Path) -> std::process::Child {
    let args = ["run", "corner", "--set", "duration_s=86400", "--out", "results", "--quiet"];
    let child = command(folder, &args).stderr(Stdio::null()).spawn().unwrap();
    while !folder.join("results/run.mcap").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[test]
fn fifty_killed_runs_leave_fifty_readable_recordings() {
    let here = folder();
    let mut ticks = Vec::new();
    for i in 0..50 {
        let mut child = under_way(here.path());
        std::thread::sleep(Duration::from_millis(2 * i));
        child.kill().unwrap();
        child.wait().unwrap();
        let file = here.path().join("results/run.mcap");
        let mut recording = Recording::open(&file).unwrap();
        recording.frames.play(&mut ()).unwrap();
        assert_eq!(recording.frames.end(), Some(End::CutShort), "kill {i}");
        ticks.push(recording.frames.tick());
        if i % 10 == 9 {
            let verified = uchain(here.path(), &["verify", "results/run.mcap"]);
            assert_eq!(verified.status.code(), Some(0), "{}", stderr(&verified));
            assert!(stdout(&verified).contains("the file is cut short"), "{}", stdout(&verified));
        }
        fs::remove_file(&file).unwrap();
    }
    println!("ticks recorded before the kill: {ticks:?}");
    assert!(ticks.iter().filter(|ticks| **ticks > 0).count() > 20, "{ticks:?}");
    assert!(here.path().join("results").read_dir().unwrap().next().is_none(), "nothing else is left");
}

#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_run_with_1_and_the_recording_is_readable() {
    let here = folder();
    let script = "trap '' XFSZ; ulimit -f 200; exec \"$0\" run corner --set duration_s=86400 --out results";
    let output = Command::new("bash")
        .current_dir(here.path())
        .args(["-c", script, env!("CARGO_BIN_EXE_uchain")])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).starts_with("error: cannot write the recording: "), "{}", stderr(&output));
    assert!(stderr(&output).contains("results/run.mcap holds the flight up to there"), "{}", stderr(&output));
    let looked = uchain(here.path(), &["inspect", "results/run.mcap"]);
    assert_eq!(looked.status.code(), Some(0), "{}", stderr(&looked));
    assert!(stdout(&looked).contains("ended early, after "), "{}", stdout(&looked));
}
