use std::{
    collections::BTreeMap,
    fs,
    hash::Hasher as _,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Duration,
};

use serde_json::Value;
use twox_hash::XxHash64;
use uchain_sim::{
    config::builtin,
    mathematics,
    mission::chain::{Course, Frame, McapRecorder},
    record::{RecordError, Recorder, mcap::End},
    replay::Recording,
    run::run,
};

use crate::{SHORT, command, files, folder, shared_cases, stderr, stdout, uchain};

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

impl<R: Recorder<Frame>> Recorder<Frame> for Tamper<R> {
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
        ("absent.mcap", 3, "error: absent.mcap: cannot read: No such file"),
        (".", 3, "error: .: cannot read: Is a directory"),
    ] {
        for args in [&["inspect", name, "--out", "results"][..], &["verify", name], &["diff", name, name]] {
            let output = uchain(here.path(), args);
            assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
            assert!(stderr(&output).starts_with(words), "{args:?}: {}", stderr(&output));
            assert_eq!((stdout(&output), files(here.path())), ("", before.clone()), "{args:?}");
        }
    }
}

#[test]
fn whatever_is_missing_exits_with_3_whoever_is_asked_for_it() {
    let here = folder();
    for args in [
        &["run", "absent.toml"][..],
        &["run", "absent.map"],
        &["check", "absent.toml"],
        &["plan", "absent.toml"],
        &["plan", "absent.yaml", "--base=0,0", "--goal=1,0"],
        &["sweep", "absent.toml", "--out", "s"],
        &["sweep", "corner", "--design", "absent.csv", "--out", "s"],
        &["inspect", "absent.mcap"],
        &["verify", "absent.mcap"],
        &["diff", "absent.mcap", "absent.mcap"],
        &["merge", "absent", "--out", "s"],
        &["report", "absent"],
        &["repro", "absent", "--run", "0"],
        &["show", "absent"],
    ] {
        let output = uchain(here.path(), args);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("absent"), "{args:?}: {}", stderr(&output));
        assert_eq!(files(here.path()), Vec::<PathBuf>::new(), "{args:?}");
    }
}

/// Takes a text off a record's front.
fn text(record: &mut &[u8]) -> String {
    let (length, rest) = record.split_first_chunk::<4>().unwrap();
    let (text, rest) = rest.split_at(u32::from_le_bytes(*length) as usize);
    *record = rest;
    String::from_utf8(text.to_vec()).unwrap()
}

/// The recording that another program would have left: one entry of its metadata is another one. Without an end, and
/// so without a checksum of the whole.
fn of_another_program(file: &[u8], key: &str, value: &str) -> Vec<u8> {
    const METADATA: u8 = 0x0c;
    const DATA_END: u8 = 0x0f;
    let (magic, mut rest) = file.split_at(8);
    let mut out = magic.to_vec();
    while rest.first().is_some_and(|opcode| *opcode != DATA_END) {
        let length = u64::from_le_bytes(rest[1..9].try_into().unwrap()) as usize;
        let (record, behind) = rest.split_at(9 + length);
        rest = behind;
        if record[0] != METADATA {
            out.extend(record);
            continue;
        }
        let mut body = &record[9..];
        let name = text(&mut body);
        body = &body[4..];
        let mut entries = BTreeMap::new();
        while !body.is_empty() {
            let key = text(&mut body);
            entries.insert(key, text(&mut body));
        }
        entries.remove("checksum").unwrap();
        entries.insert(key.to_owned(), value.to_owned());
        let mut hash = XxHash64::with_seed(0);
        for text in entries.iter().flat_map(|(key, value)| [key, value]) {
            hash.write(&(text.len() as u64).to_le_bytes());
            hash.write(text.as_bytes());
        }
        entries.insert("checksum".to_owned(), format!("{:016x}", hash.finish()));
        let bytes = |text: &str| [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat();
        let map: Vec<u8> =
            entries.iter().flat_map(|(key, value)| [bytes(key), bytes(value)].concat()).collect();
        let body = [bytes(&name), (map.len() as u32).to_le_bytes().to_vec(), map].concat();
        out.push(METADATA);
        out.extend((body.len() as u64).to_le_bytes());
        out.extend(body);
    }
    out
}

#[test]
fn another_versions_recording_is_named_as_such_before_anything_is_said_of_it() {
    let here = folder();
    let flown = uchain(here.path(), &["run", "corner", "--set", SHORT, "--quiet", "--out", "ours"]);
    assert_eq!(flown.status.code(), Some(0), "{}", stderr(&flown));
    let ours = fs::read(here.path().join("ours/run.mcap")).unwrap();
    let scenario = Recording::<_, Course>::read(ours.as_slice(), "memory").unwrap().about.scenario;
    let write = |name: &str, file: Vec<u8>| fs::write(here.path().join(name), file).unwrap();
    let older = of_another_program(&ours, "version", "0.0.9");
    write("older.mcap", older.clone());
    write(
        "unknown.mcap",
        of_another_program(&older, "scenario", &scenario.replace("k_db_per_m", "k_db_per_n")),
    );
    // What differs: the file holds another seed's flight.
    write("differs.mcap", of_another_program(&older, "seed", "2"));
    write("format.mcap", of_another_program(&older, "format", "2"));

    let said = "recorded by uchain 0.0.9, flown by 0.1.0\n";
    let same = uchain(here.path(), &["verify", "older.mcap"]);
    assert_eq!((same.status.code(), stderr(&same)), (Some(0), ""));
    assert_eq!(stdout(&same), format!("{said}all 100 ticks are the same, bit for bit\n"));
    let differs = uchain(here.path(), &["verify", "differs.mcap"]);
    assert_eq!(differs.status.code(), Some(4), "{}", stderr(&differs));
    assert!(stdout(&differs).starts_with(&format!("{said}differs at tick ")), "{}", stdout(&differs));

    let words = "unknown.mcap: recorded by uchain 0.0.9, this is 0.1.0: ";
    for command in ["verify", "inspect"] {
        let unknown = uchain(here.path(), &[command, "unknown.mcap", "--quiet"]);
        assert_eq!(unknown.status.code(), Some(3), "{}", stderr(&unknown));
        assert!(stderr(&unknown).starts_with(&format!("error: {words}")), "{}", stderr(&unknown));
        assert!(stderr(&unknown).contains("k_db_per_n"), "{}", stderr(&unknown));
        let format = uchain(here.path(), &[command, "format.mcap"]);
        assert_eq!(format.status.code(), Some(3), "{}", stderr(&format));
        assert!(
            stderr(&format)
                .contains("recorded by uchain 0.0.9, the metadata record \"uchain\": format = \"2\""),
            "{}",
            stderr(&format)
        );
    }
    let differ = uchain(here.path(), &["diff", "ours/run.mcap", "differs.mcap"]);
    assert!(stdout(&differ).starts_with("version: 0.1.0 and 0.0.9\nseed: 1 and 2\n"), "{}", stdout(&differ));
}

#[test]
fn verify_names_foreign_mathematics_before_it_names_a_difference() {
    let here = folder();
    let flown = uchain(here.path(), &["run", "corner", "--set", SHORT, "--quiet", "--out", "ours"]);
    assert_eq!(flown.status.code(), Some(0), "{}", stderr(&flown));
    let ours = fs::read(here.path().join("ours/run.mcap")).unwrap();
    let about = Recording::<_, Course>::read(ours.as_slice(), "memory").unwrap().about;
    assert_eq!(
        about.mathematics,
        Some(mathematics::fingerprint_of_libm()),
        "the command line brings its own"
    );
    let foreign = of_another_program(&ours, "mathematics", "0123456789abcdef");
    fs::write(here.path().join("differs.mcap"), of_another_program(&foreign, "seed", "2")).unwrap();
    let differs = uchain(here.path(), &["verify", "differs.mcap"]);
    assert_eq!(differs.status.code(), Some(4), "{}", stderr(&differs));
    let lines: Vec<&str> = stdout(&differs).lines().collect();
    assert!(
        lines[0].starts_with("foreign mathematics: the program that recorded did not link "),
        "{lines:?}"
    );
    assert!(lines[1].starts_with("differs at tick "), "{lines:?}");
}

#[test]
fn a_file_that_ends_in_zeros_is_a_recording_that_was_cut_short() {
    let here = folder();
    let flown = uchain(here.path(), &["run", "corner", "--set", "duration_s=10", "--quiet", "--out", "ours"]);
    assert_eq!(flown.status.code(), Some(0), "{}", stderr(&flown));
    let mut file = fs::read(here.path().join("ours/run.mcap")).unwrap();
    let length = file.len();
    file[length * 3 / 4..].fill(0);
    fs::write(here.path().join("zeros.mcap"), &file).unwrap();
    let verified = uchain(here.path(), &["verify", "zeros.mcap"]);
    assert_eq!(verified.status.code(), Some(0), "{}", stderr(&verified));
    assert!(stdout(&verified).contains("the file is cut short"), "{}", stdout(&verified));
    // The control: something stands behind the zeros.
    file[length - 1] = 1;
    fs::write(here.path().join("hole.mcap"), &file).unwrap();
    let refused = uchain(here.path(), &["verify", "hole.mcap"]);
    assert_eq!(refused.status.code(), Some(3));
    assert!(stderr(&refused).starts_with("error: hole.mcap: damaged at byte "), "{}", stderr(&refused));
}

#[test]
fn a_recording_of_others_is_no_damaged_one_of_ours() {
    let Some(cases) = shared_cases() else { return };
    let file = cases.join("mcap/f_nochunk.mcap");
    for command in ["inspect", "verify"] {
        let output = uchain(folder().path(), &[command, file.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        assert!(
            stderr(&output).contains("f_nochunk.mcap: not a recording of uchain: "),
            "{}",
            stderr(&output)
        );
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
        let mut recording = Recording::<_, Course>::open(&file).unwrap();
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
