use std::{
    fs,
    io::{Seek as _, SeekFrom, Write as _},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use serde_json::Value;
use uchain_sim::{
    analyse::{Cell, Kind},
    config::builtin,
    sweep::{
        Design, DesignText, Sweep,
        folder::{Folder, FolderError, Job, Manifest, Record, Shard, Watch},
        report::metrics,
    },
};

use super::{files, folder, ok, reference, small, stderr, stdout, table, uchain};

/// All columns of scalars of a table: name, kind, cells.
fn scalars(folder: &Path) -> Result<Vec<(String, Kind, Vec<Cell>)>, FolderError> {
    let folder = Folder::open(folder)?;
    let mut columns = folder.sweep()?.columns();
    columns.retain(|column| !matches!(column.kind, Kind::Numbers | Kind::Singles));
    let read = |column: &uchain_sim::analyse::Column| {
        let cells: Result<Vec<_>, FolderError> = folder.column(column)?.collect();
        Ok((column.name.clone(), column.kind, cells?.concat()))
    };
    columns.iter().map(read).collect()
}

#[test]
fn a_row_is_what_run_says_bit_for_bit() {
    let here = folder();
    let args = ["sweep", "corner", "--set", "duration_s=60", "--vary", "radio.sigma_db=0.3,2.7"];
    ok(uchain(here.path(), &[&args[..], &["--replicates", "8", "--out", "a", "--quiet"]].concat()));
    let columns = scalars(&here.path().join("a")).unwrap();
    let cell = |name: &str, run: usize| {
        let found = columns.iter().find(|(known, ..)| known == name);
        found.map(|(_, kind, cells)| (*kind, cells[run].clone()))
    };
    let (mut compared, mut fractions) = (0, 0);
    for run in 0..16 {
        let seed = cell("seed", run).unwrap().1.number().unwrap();
        let Cell::Count(seed) = cell("seed", run).unwrap().1 else { panic!("{seed}") };
        let sigma = format!("radio.sigma_db={}", if run < 8 { 0.3 } else { 2.7 });
        let seed = seed.to_string();
        let args = ["run", "corner", "--set", "duration_s=60", "--set", &sigma, "--seed", &seed];
        let rest = ["--json", "--no-record", "--force", "--out", "one"];
        let flown = ok(uchain(here.path(), &[&args[..], &rest].concat()));
        let summary: Value = serde_json::from_str(stdout(&flown)).unwrap();
        for (key, value) in summary.as_object().unwrap() {
            let (Some((kind, cell)), Some(number)) = (cell(key, run), value.as_number()) else { continue };
            // The digits as they are printed, read by another reader than ours.
            let digits = number.to_string();
            let Some(there) = cell.number() else { continue };
            let is_same = match kind {
                Kind::Single => digits.parse::<f32>().unwrap().to_bits() == (there as f32).to_bits(),
                _ => digits.parse::<f64>().unwrap().to_bits() == there.to_bits(),
            };
            assert!(is_same, "run {run}: {key} = {digits}, {there} in the table");
            compared += 1;
            fractions += usize::from(there.fract() != 0.0);
        }
        assert_eq!(cell("digest", run).unwrap().1.text(), summary["digest"].as_str());
    }
    assert!(compared > 100 && fractions > 50, "{compared} numbers, {fractions} of them with a fraction");
}

#[test]
fn a_bit_that_flips_in_the_table_is_refused_wherever_it_is() {
    let here = folder();
    let whole = reference(here.path());
    let folder = here.path().join("reference");
    let wanted = scalars(&folder).unwrap();
    let file = folder.join("runs.parquet");
    let put = |place: usize, byte: u8| {
        let mut out = fs::OpenOptions::new().write(true).open(&file).unwrap();
        out.seek(SeekFrom::Start(place as u64)).unwrap();
        out.write_all(&[byte]).unwrap();
    };
    for (byte, bit) in (0..whole.len()).zip((0..8).cycle()) {
        put(byte, whole[byte] ^ 1 << bit);
        let read = scalars(&folder);
        put(byte, whole[byte]);
        let is_refused = matches!(read, Err(FolderError::Damaged { .. }));
        assert!(is_refused, "bit {bit} of byte {byte}: {:?}", read.map(|now| now == wanted));
    }
    assert!(scalars(&folder).unwrap() == wanted, "what is whole again is read");
    put(whole.len() / 2, whole[whole.len() / 2] ^ 1);
    for command in [&["report", "reference"][..], &["repro", "reference", "--run", "3"]] {
        let refused = uchain(here.path(), command);
        assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
        let why =
            "reference/runs.parquet is damaged: its checksum is not that in sweep.json; remove it and fly";
        assert!(stderr(&refused).contains(why), "{}", stderr(&refused));
    }
    // Going on with it is no way to a table that is wrong: removed, it is flown again.
    let resumed = uchain(here.path(), &small("reference", &["--resume"]));
    assert_eq!(resumed.status.code(), Some(3), "{}", stderr(&resumed));
    fs::remove_file(&file).unwrap();
    ok(uchain(here.path(), &small("reference", &["--resume", "--quiet"])));
    assert!(table(&folder) == whole && scalars(&folder).unwrap() == wanted);
}

#[test]
fn a_report_tells_every_number_whatever_is_varied() {
    let here = folder();
    let vary = ["--vary", "chain.uavs=2,3", "--vary", "radio.sigma_db=0,4", "--replicates", "2"];
    let args = ["sweep", "straight", "--set", "duration_s=5", "--out", "a", "--quiet"];
    ok(uchain(here.path(), &[&args[..], &vary].concat()));
    let args = ["sweep", "apartment", "--set", "duration_s=5", "--out", "b", "--quiet"];
    ok(uchain(here.path(), &[&args[..], &["--vary", "explore.robots=1,2"]].concat()));
    for (name, result) in [("a", "uavs"), ("b", "robots")] {
        let report = ok(uchain(here.path(), &["report", name]));
        let text = stdout(&report);
        let sweep = Folder::open(&here.path().join(name)).unwrap().sweep().unwrap();
        let names: Vec<String> = metrics(&sweep).into_iter().map(|column| column.name).collect();
        assert!(names.iter().any(|name| name == result), "{names:?}");
        let told = |heading: &str| {
            let line = text.lines().find_map(|line| line.strip_prefix(heading)).unwrap_or_default();
            line.trim_end_matches('.')
                .split(", ")
                .map(|word| word.split(" = ").next().unwrap_or("").to_owned())
                .collect::<Vec<_>>()
        };
        let (constant, absent) = (told("The same in all runs: "), told("In no run: "));
        for name in &names {
            let has_table = text.contains(&format!("\n## {name}\n"));
            let places = [has_table, constant.contains(name), absent.contains(name)];
            assert_eq!(
                places.iter().filter(|is_there| **is_there).count(),
                1,
                "{name}: {places:?} in {text}"
            );
        }
    }
}

#[test]
fn shards_are_merged_when_one_has_every_run_and_others_none() {
    let here = folder();
    // One run is one chunk: the first shard has all there is.
    let one = ["sweep", "straight", "--set", "duration_s=3"];
    let shard = |out: &str, more: &[&str]| {
        uchain(here.path(), &[&one[..], &["--out", out, "--quiet"], more].concat())
    };
    ok(shard("all", &[]));
    for number in ["1", "2", "3"] {
        ok(shard(&format!("part{number}"), &["--shard", &format!("{number}/3")]));
    }
    assert!(
        here.path().join("part1/runs.parquet").exists() && !here.path().join("part2/runs.parquet").exists()
    );
    for (number, folders) in
        [&["part1", "part2", "part3"][..], &["part3", "part1"], &["part1"], &["part1", "part1"]]
            .iter()
            .enumerate()
    {
        let out = format!("whole{number}");
        let merged = ok(uchain(here.path(), &[&["merge"][..], folders, &["--out", &out, "--json"]].concat()));
        let said: Value = serde_json::from_str(stdout(&merged)).unwrap();
        assert_eq!((&said["runs"], &said["complete"]), (&1.into(), &true.into()));
        assert!(table(&here.path().join(&out)) == table(&here.path().join("all")), "{folders:?}");
        ok(uchain(here.path(), &["report", &out, "--quiet"]));
    }
    ok(uchain(here.path(), &["merge", "part2", "part1", "--out", "part1", "--quiet"]));
    let none = uchain(here.path(), &["merge", "part2", "part3", "--out", "none"]);
    assert_eq!(none.status.code(), Some(3));
    assert!(stderr(&none).contains("1 of 1 runs are missing"), "{}", stderr(&none));

    // A shard beside a table of all: it has to say the same.
    let reference = reference(here.path());
    ok(uchain(here.path(), &small("some", &["--shard", "2/4", "--quiet"])));
    ok(uchain(here.path(), &["merge", "some", "reference", "--out", "both", "--quiet"]));
    assert!(table(&here.path().join("both")) == reference);
    let chunk = here.path().join("some/chunks/00000005.jsonl");
    let text = fs::read_to_string(&chunk).unwrap();
    let end = text.trim_end().rfind('\n').unwrap() + 1;
    let other = text[..end].replace("\"]\n", "?\"]\n");
    assert_ne!(other, text[..end], "words end every row");
    let hash = twox_hash::XxHash64::oneshot(0, other.as_bytes());
    fs::write(&chunk, format!("{other}{{\"xxh64\":\"{hash:016x}\"}}\n")).unwrap();
    let differs = uchain(here.path(), &["merge", "some", "reference", "--out", "neither"]);
    assert_eq!(differs.status.code(), Some(3), "{}", stderr(&differs));
    assert!(stderr(&differs).contains("hold different rows for the same runs"), "{}", stderr(&differs));
    assert!(!here.path().join("neither").exists());
}

/// Takes the first chunk away as soon as it is there.
struct Thief<'a> {
    chunks: &'a Path,
    has_stolen: AtomicBool,
}

impl Watch for Thief<'_> {
    fn stop(&self) -> bool {
        false
    }

    fn done(&self, _: u64, _: u64, now: bool) {
        if now && !self.has_stolen.swap(true, Ordering::Relaxed) {
            let is_whole = |file: &std::path::PathBuf| file.extension().is_some_and(|end| end == "jsonl");
            fs::remove_file(files(self.chunks).into_iter().find(is_whole).unwrap()).unwrap();
        }
    }

    fn again(&self, why: &FolderError) {
        panic!("{why}");
    }
}

#[test]
fn a_sweep_whose_chunks_go_is_not_complete_and_says_so() {
    let here = folder();
    let path = here.path().join("a");
    let design = Design::parse(&DesignText::default(), "").unwrap();
    let sets = vec!["duration_s=1".to_owned()];
    let sweep = Sweep::new(builtin("straight").unwrap(), sets, design, 5, 1).unwrap();
    let walls = sweep.check().unwrap();
    let folder = Folder::begin(&path, Manifest::of(&sweep, walls), Path::new(""), false).unwrap();
    let chunks = path.join("chunks");
    let thief = Thief { chunks: &chunks, has_stolen: AtomicBool::new(false) };
    let job = Job { shard: Shard { number: 1, of: 1 }, record: Record::None, watch: &thief };
    let error = folder.fly(&sweep, job).unwrap_err();
    assert!(error.to_string().starts_with("1 of 5 runs are missing, the first is run "), "{error}");
    assert!(folder.finish(&sweep).unwrap().is_none());
    // The next time nothing is stolen.
    folder.fly(&sweep, job).unwrap();
    assert_eq!(folder.finish(&sweep).unwrap().unwrap().runs, 5);
}

#[test]
fn a_sweep_that_is_carried_elsewhere_goes_on_with_the_files_that_are_there() {
    let here = folder();
    let first = here.path().join("first");
    fs::create_dir(&first).unwrap();
    let text = "name = \"mine\"\nduration_s = 60.0\n[map.movingai]\nfile = \"rooms.map\"\ncell_m = 0.5\n[explore]\nrobots = 1\n";
    fs::write(first.join("mine.toml"), text).unwrap();
    let row = "@@@@@@@@@@@@\n";
    let map = format!("type octile\nheight 12\nwidth 12\nmap\n{row}{}{row}", "@..........@\n".repeat(10));
    fs::write(first.join("rooms.map"), map).unwrap();
    let args = ["sweep", "mine.toml", "--set", "duration_s=2", "--replicates", "4", "--quiet"];
    ok(uchain(&first, &[&args[..], &["--out", "all"]].concat()));
    let whole = table(&first.join("all"));
    ok(uchain(&first, &[&args[..], &["--out", "part", "--shard", "1/2"]].concat()));
    let second = here.path().join("second");
    fs::rename(&first, &second).unwrap();
    ok(uchain(&second, &[&args[..], &["--out", "part", "--resume"]].concat()));
    assert!(table(&second.join("part")) == whole);
    let columns = scalars(&second.join("part")).unwrap();
    let digests = columns.iter().find(|(name, ..)| name == "digest").unwrap();
    assert!(digests.2.iter().all(|digest| digest.text().is_some()), "every run was flown");
}
