use std::{fs, path::Path, process::ExitCode, sync::Arc};

use boon::{Compiler, Schemas};
use uchain_cli::main_with_missions;
use uchain_sim::{
    config::builtin,
    mission::{Mission as _, Scene as _, chain::Course, explore::Site},
    record::{
        RecordError, Recorder,
        mcap::{End, McapRecorder},
    },
    registry::{AnyMission, Of, Registry},
    replay::Recording,
    run::run,
    sweep::{
        Design, DesignText, Sweep,
        folder::{Folder, FolderError, Job, Manifest, Record, Shard, TABLE, Watch},
    },
};

use crate::{
    reset::ring,
    ring::{Ring, RingFrame, RingScene, RingSummary, RingTopics, source},
};

/// The one line.
static MISSIONS: [&dyn AnyMission; 3] = [&Of::<Course>::NEW, &Of::<Site>::NEW, &Of::<RingScene>::NEW];

fn registry() -> Registry {
    Registry::new(&MISSIONS)
}

/// All frames of a run.
#[derive(Default)]
struct All(Vec<RingFrame>);

impl Recorder<RingFrame> for All {
    fn frame(&mut self, frame: &RingFrame) -> Result<(), RecordError> {
        self.0.push(frame.clone());
        Ok(())
    }
}

/// A recording of a run, and its frames.
fn recorded(scene: &Arc<RingScene>) -> (Vec<u8>, Vec<RingFrame>) {
    let recorder = McapRecorder::<_, RingTopics>::start(Vec::new(), scene, 1).unwrap();
    let mut both = (recorder, All::default());
    run(scene, 1, &mut both).unwrap();
    (both.0.finish().unwrap(), both.1.0)
}

/// A recording in which one number of tick 300 is the next one that there is.
fn planted(scene: &Arc<RingScene>) -> Vec<u8> {
    let mut recorder = McapRecorder::<_, RingTopics>::start(Vec::new(), scene, 1).unwrap();
    let mut ring = Ring::start(scene.clone(), 1);
    loop {
        let stopped = ring.step(&mut ()).unwrap();
        let mut frame = ring.frame().clone();
        if frame.tick == 300 {
            frame.robots[1].y_m = frame.robots[1].y_m.next_up();
        }
        recorder.frame(&frame).unwrap();
        if stopped.is_some() {
            return recorder.finish().unwrap();
        }
    }
}

#[test]
fn it_flies_the_same_with_the_same_seed_and_another_way_with_another() {
    let scene = ring();
    let [once, again, other] = [1, 1, 2].map(|seed| run(&scene, seed, &mut ()).unwrap());
    assert_eq!(once, again);
    assert_ne!(once.digest, other.digest);
    assert_eq!(once.verdict.outcome().word(), "round", "{}", once.verdict);
    assert!(once.rounds > 2.0 && once.contacts == 0, "{once:?}");
    let slow = RingScene::read(&source(), &["ring.speed_mps=0.05".to_owned()]).unwrap();
    let slow = run(&slow, 1, &mut ()).unwrap();
    assert_eq!(slow.verdict.outcome().word(), "not-round", "the control: {}", slow.verdict);
}

#[test]
fn its_recording_reads_back_every_frame_and_flies_again() {
    let scene = ring();
    let (file, written) = recorded(&scene);
    let mut recording = Recording::<_, RingScene>::read(file.as_slice(), "memory").unwrap();
    let mut read = All::default();
    let again = recording.scene().unwrap();
    assert_eq!(recording.summary(&again, &mut read).unwrap(), run(&scene, 1, &mut ()).unwrap());
    assert_eq!((read.0.len(), recording.frames.end()), (800, Some(End::Whole)));
    assert!(read.0 == written);

    let verified = |file: &[u8]| {
        let mut recording =
            registry().open_bytes(Box::new(std::io::Cursor::new(file.to_vec())), "memory").unwrap();
        assert_eq!(recording.kind(), "a ring");
        recording.verify().unwrap()
    };
    let whole = verified(&file);
    assert!(whole.agrees());
    assert_eq!((whole.ticks, whole.of), (800, 800));
    let first = verified(&planted(&scene)).first.expect("the control: what was planted is found");
    assert_eq!(first.place(), "tick 300 (15.00 s), robot 1, y_m");
}

#[test]
fn the_registry_tells_its_scenarios_from_all_others() {
    let scene = registry().read(&source(), &[]).unwrap();
    assert_eq!((scene.kind(), scene.crew(), scene.robot()), ("a ring", 3, "robot"));
    assert!(scene.get::<RingScene>().is_some() && scene.get::<Course>().is_none());
    let about = registry().describe(&source(), &[]).unwrap();
    assert_eq!((about.name.as_str(), about.mission.kind()), ("ring", "a ring"));
    for (name, kind) in [("corner", "a chain"), ("apartment", "an exploration")] {
        assert_eq!(registry().read(&builtin(name).unwrap(), &[]).unwrap().kind(), kind);
    }
    let unknown = Registry::default().read(&source(), &[]).unwrap_err();
    assert!(unknown.to_string().contains("ring"), "the control: {unknown}");

    let refused = |set: &str| registry().read(&source(), &[set.to_owned()]).unwrap_err().to_string();
    assert_eq!(
        refused("ring.radius_m=0.1"),
        "--set ring.radius_m=0.1: ring.radius_m = 0.1: must lie in 0.2..=100"
    );
    assert!(refused("ring.radius_m=1.95").contains("must leave 0.1 m to walls"));
    assert!(refused("ring.radios_m=1").contains("did you mean 'radius_m'?"));
    assert!(refused("duration_s=0.07").contains("must be a multiple of the tick"));
    assert!(refused("chain.uavs=3").contains("chain"));
}

#[test]
fn the_schema_takes_its_scenarios_and_no_key_of_another_mission_in_them() {
    let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
    compiler.add_resource("uchain.schema.json", registry().schema()).unwrap();
    let schema = compiler.compile("uchain.schema.json", &mut schemas).unwrap();
    let takes = |text: &str| {
        let table: toml::Table = text.parse().unwrap();
        schemas.validate(&serde_json::to_value(table).unwrap(), schema).is_ok()
    };
    let text = source().text;
    assert!(takes(&text));
    assert!(takes(&ring().to_toml().unwrap()), "with every value written out");
    for wrong in ["\n[chain]\nuavs = 3\n", "\n[explore]\nrobots = 3\n", "robot = 3\n", "robots = 1\n"] {
        assert!(!takes(&(text.clone() + wrong)), "{wrong}");
    }
    for name in ["corner", "apartment"] {
        assert!(takes(&builtin(name).unwrap().text), "{name}");
        assert!(
            !takes(&(builtin(name).unwrap().text + "\n[ring]\nrobots = 3\n")),
            "{name} with a ring in it"
        );
    }

    let radius = &registry().explain("ring.radius_m").unwrap()[0];
    assert_eq!((radius.kind, radius.range), ("number", Some((0.2, 100.0))));
    assert_eq!(radius.meaning, "Radius of the ring (m).");
    assert_eq!(registry().explain("ring").unwrap().len(), 4, "the table and its keys");
    assert!(Registry::default().explain("ring.radius_m").is_err(), "the control");
}

fn sweep() -> Sweep {
    let vary = vec!["ring.radius_m=0.8,1.2".to_owned()];
    let design = Design::parse(&DesignText { vary, table: None }, "").unwrap();
    Sweep::of(registry(), source(), vec!["duration_s=20".to_owned()], design, 2, 1).unwrap()
}

/// Stops nothing.
struct Patient;

impl Watch for Patient {
    fn stop(&self) -> bool {
        false
    }

    fn done(&self, _: u64, _: u64, _: bool) {}

    fn again(&self, why: &FolderError) {
        panic!("{why}");
    }
}

#[test]
fn a_sweep_over_its_keys_comes_to_the_same_in_memory_and_in_a_folder() {
    let sweep = sweep();
    let flown = sweep.each(|scene, run| {
        let flown = scene.fly(run.seed, &mut ()).unwrap();
        (flown.digest().to_owned(), flown.summary::<RingSummary>().unwrap().rounds)
    });
    let flown: Vec<(String, f64)> = flown.into_iter().map(Result::unwrap).collect();
    assert_eq!(flown.len(), 4);
    assert!(flown[0].1 > 1.2 * flown[2].1, "rounds of a small ring and of a large one: {flown:?}");

    let here = tempfile::tempdir().unwrap();
    let manifest = Manifest::of(&sweep, sweep.check().unwrap());
    let folder =
        Folder::begin(here.path(), manifest, Path::new("."), false).unwrap().with_missions(registry());
    let sweep = folder.sweep().unwrap();
    let shard = Shard { number: 1, of: 1 };
    folder.fly(&sweep, Job { shard, record: Record::All, watch: &Patient }).unwrap();
    let totals = folder.finish(&sweep).unwrap().expect("all runs are there");
    assert_eq!((totals.runs, totals.failed), (4, 0));
    assert!(fs::read(here.path().join(TABLE)).unwrap().starts_with(b"PAR1"));
    for (run, (digest, _)) in flown.iter().enumerate() {
        assert_eq!(folder.known(&sweep, run as u64).unwrap().digest.as_ref(), Some(digest), "run {run}");
        let recording = here.path().join(format!("recordings/run-{run:08}.mcap"));
        assert!(registry().open(&recording).unwrap().verify().unwrap().agrees(), "run {run}");
    }
    let names: Vec<String> = sweep.columns().into_iter().map(|column| column.name).collect();
    assert!(["ring.radius_m", "rounds", "digest"].iter().all(|name| names.iter().any(|it| it == name)));
}

#[test]
fn the_whole_command_line_knows_it() {
    let here = tempfile::tempdir().unwrap();
    let path = |name: &str| here.path().join(name).display().to_string();
    let uchain = |args: &[&str]| {
        main_with_missions(registry(), ["uchain"].iter().chain(args).copied().map(str::to_owned))
    };
    let (ok, differ) = (ExitCode::SUCCESS, ExitCode::from(4));
    let scenario = path("ring.toml");
    fs::write(&scenario, source().text).unwrap();
    assert_eq!(uchain(&["check", &scenario, "--quiet"]), ok);

    let (first, second) = (path("first"), path("second"));
    assert_eq!(uchain(&["run", &scenario, "--out", &first, "--quiet"]), ok);
    assert_eq!(uchain(&["run", &scenario, "--out", &second, "--seed", "2", "--quiet"]), ok);
    let read = |folder: &str, name: &str| fs::read(Path::new(folder).join(name)).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&read(&first, "summary.json")).unwrap();
    assert_eq!(summary["digest"], run(&ring(), 1, &mut ()).unwrap().digest);
    assert_eq!(summary["outcome"], "round");

    let recording = |folder: &str| format!("{folder}/run.mcap");
    assert_eq!(uchain(&["verify", &recording(&first), "--quiet"]), ok);
    let wrong = path("planted.mcap");
    fs::write(&wrong, planted(&ring())).unwrap();
    assert_eq!(uchain(&["verify", &wrong, "--quiet"]), differ, "the control");
    assert_eq!(uchain(&["diff", &recording(&first), &recording(&first), "--quiet"]), ok);
    assert_eq!(uchain(&["diff", &recording(&first), &recording(&second), "--quiet"]), differ);
    let again = path("again");
    assert_eq!(uchain(&["inspect", &recording(&first), "--out", &again, "--quiet"]), ok);
    assert!(read(&again, "run.png") == read(&first, "run.png"), "the same picture");
    let inspected: serde_json::Value = serde_json::from_slice(&read(&again, "inspect.json")).unwrap();
    assert_eq!((&inspected["digest"], &inspected["of_ticks"]), (&summary["digest"], &800.into()));

    let many = path("many");
    let vary = ["sweep", &scenario, "--vary", "ring.radius_m=0.8,1.2", "--out", &many, "--quiet"];
    assert_eq!(uchain(&vary), ok);
    assert!(read(&many, "runs.parquet").starts_with(b"PAR1"));
    assert_eq!(uchain(&["report", &many, "--quiet"]), ok);
    assert_eq!(uchain(&["repro", &many, "--run", "1", "--out", &path("second row"), "--quiet"]), ok);
    assert_eq!(uchain(&["explain", "ring.radius_m"]), ok);
    assert_eq!(uchain(&["explain", "ring.radius_mm"]), ExitCode::from(3), "the control");
}
