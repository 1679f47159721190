use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

use super::{files, folder, has, ok, reference, small, stderr, table, uchain};

/// Runs words of a shell with a mount of its own on the folder `disk`.
fn mounted(here: &Path, options: &str, words: &str) -> Output {
    let script = format!("mount -t tmpfs -o {options} tmpfs disk && {words}");
    let mut unshare = Command::new("unshare");
    unshare.current_dir(here).args(["-rm", "sh", "-c", &script, env!("CARGO_BIN_EXE_uchain")]);
    unshare.output().unwrap()
}

fn can_mount() -> bool {
    has("unshare", &["-rm", "sh", "-c", "mount -t tmpfs tmpfs /mnt"])
}

#[test]
fn a_full_disk_of_1_mib_is_an_error_that_names_the_file_and_what_was_flown_stays() {
    if !can_mount() {
        return;
    }
    let here = folder();
    fs::create_dir(here.path().join("disk")).unwrap();
    let args = ["sweep", "corner", "--set", "duration_s=5", "--replicates", "12"];
    ok(uchain(here.path(), &[&args[..], &["--out", "reference", "--quiet"]].concat()));
    let sweep = format!(
        "\"$0\" {} --out disk/sweep --record all --threads 1; code=$?; cp -r disk/sweep kept; exit $code",
        args.join(" ")
    );
    let full = mounted(here.path(), "size=1M", &sweep);
    assert_eq!(full.status.code(), Some(1), "{}", stderr(&full));
    assert!(stderr(&full).contains("disk/sweep/"), "{}", stderr(&full));
    assert!(stderr(&full).contains("No space left on device"), "{}", stderr(&full));

    let kept = here.path().join("kept");
    let flown = files(&kept.join("chunks"));
    assert!((1..12).contains(&flown.len()), "{flown:?}");
    assert!(files(&kept).iter().all(|file| !file.to_string_lossy().ends_with(".part")), "nothing half done");
    ok(uchain(here.path(), &[&args[..], &["--out", "kept", "--resume", "--quiet"]].concat()));
    assert!(table(&kept) == table(&here.path().join("reference")));

    // The same on a disk with room.
    fs::remove_dir_all(&kept).unwrap();
    let room = mounted(here.path(), "size=64M", &sweep);
    assert_eq!(room.status.code(), Some(0), "{}", stderr(&room));
    assert!(table(&kept) == table(&here.path().join("reference")));
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error_before_the_first_run() {
    if !can_mount() {
        return;
    }
    let here = folder();
    fs::create_dir(here.path().join("disk")).unwrap();
    let sweep = format!("\"$0\" {}", small("disk/sweep", &[]).join(" "));
    let refused = mounted(here.path(), "ro", &sweep);
    assert_eq!(refused.status.code(), Some(1), "{}", stderr(&refused));
    assert!(
        stderr(&refused).contains("error: disk/sweep: cannot make the folder: Read-only file system"),
        "{}",
        stderr(&refused)
    );
    assert_eq!(mounted(here.path(), "rw", &sweep).status.code(), Some(0));
}

#[test]
fn a_damaged_chunk_is_named_and_flown_again_and_the_others_stay() {
    let here = folder();
    let reference = reference(here.path());
    ok(uchain(here.path(), &small("part", &["--shard", "1/2", "--quiet"])));
    let chunk = here.path().join("part/chunks/00000004.jsonl");
    let whole = fs::read(&chunk).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    let other = fs::read(here.path().join("part/chunks/00000002.jsonl")).unwrap();
    let all = files(&here.path().join("part"));
    let contents = || all.iter().map(|file| fs::read(file).ok()).collect::<Vec<_>>();
    let before = contents();
    let damages: [(&[u8], &str); 6] = [
        (&whole[..whole.len() - 1], "it is cut short"),
        (&whole[..whole.len() / 2], "it is cut short"),
        (&[], "it is cut short"),
        (&flipped, "its checksum is wrong"),
        (&other, "it belongs to another sweep"),
        (&whole, ""),
    ];
    for (bytes, why) in damages {
        fs::write(&chunk, bytes).unwrap();
        let is_whole = why.is_empty();
        // Nobody but the sweep itself may mend it.
        let merged = uchain(here.path(), &["merge", "part", "part", "--out", "merged"]);
        assert_eq!(merged.status.code(), Some(3));
        assert_eq!(stderr(&merged).contains("is damaged"), !is_whole, "{}", stderr(&merged));
        let resumed = ok(uchain(here.path(), &small("part", &["--resume", "--shard", "1/2", "--quiet"])));
        let wanted =
            format!("warning: part/chunks/00000004.jsonl is damaged: {why}; --resume flies its runs again\n");
        assert_eq!(stderr(&resumed), if is_whole { "" } else { &wanted });
        assert_eq!(contents(), before, "{why}");
    }
    ok(uchain(here.path(), &small("part", &["--resume", "--quiet"])));
    assert!(table(&here.path().join("part")) == reference);
}

#[test]
fn a_sweep_that_cannot_go_on_exits_with_1_and_goes_on_once_it_can() {
    let here = folder();
    let reference = reference(here.path());
    ok(uchain(here.path(), &small("part", &["--shard", "1/2", "--quiet"])));
    // A folder where a chunk has to go.
    let chunk = here.path().join("part/chunks/00000003.jsonl");
    fs::create_dir(&chunk).unwrap();
    fs::write(chunk.join("letter.txt"), "dear").unwrap();
    let stopped = uchain(here.path(), &small("part", &["--resume", "--quiet"]));
    assert_eq!(stopped.status.code(), Some(1), "{}", stderr(&stopped));
    assert!(stderr(&stopped).contains("part/chunks/00000003.jsonl: cannot read"), "{}", stderr(&stopped));
    fs::remove_dir_all(&chunk).unwrap();
    ok(uchain(here.path(), &small("part", &["--resume", "--quiet"])));
    assert!(table(&here.path().join("part")) == reference);
    // What a process left that was killed while it wrote its first file.
    fs::create_dir(here.path().join("early")).unwrap();
    fs::write(here.path().join("early/sweep.json.part"), "{\"version\":").unwrap();
    ok(uchain(here.path(), &small("early", &["--resume", "--quiet"])));
    assert!(table(&here.path().join("early")) == reference);
}

#[test]
fn two_processes_do_not_work_on_one_folder() {
    let here = folder();
    fs::create_dir(here.path().join("a")).unwrap();
    let held = fs::File::open(here.path().join("a")).unwrap();
    held.lock().unwrap();
    let busy = uchain(here.path(), &small("a", &["--quiet"]));
    assert_eq!(busy.status.code(), Some(2));
    assert!(stderr(&busy).contains("another process works on this sweep"), "{}", stderr(&busy));
    drop(held);
    ok(uchain(here.path(), &small("a", &["--quiet"])));
}
