use std::{fs, path::Path, process::ExitCode, sync::Arc};

use uchain_cli::main_with_missions;
use uchain_sim::{
    config::{ConfigError, builtin},
    map::Map,
    mission::{
        Mission as _, Scene as _,
        chain::{Chain, ChainExtensions, Course, McapRecorder, Metrics, Summary, plan},
        explore::Site,
    },
    radio::{Antenna, NO_LINK_DB, PathLoss, RadioError, RadioKind, RadioModel},
    registry::{AnyMission, Of, Registry},
    run::run,
};

use crate::course;

/// A user's own model: Eq. 22 as it is, and so much more.
#[derive(Debug)]
struct Own {
    eq_22: PathLoss,
    more_db: f32,
}

impl RadioModel for Own {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        self.eq_22.loss_db(map, from, to) + self.more_db
    }
}

fn fly(name: &str, more_db: f32) -> Summary {
    let course = course(name, &[]);
    let eq_22 = PathLoss::new(course.scenario.radio.clone(), &course.map).unwrap();
    run(&course.with_radio("own", Arc::new(Own { eq_22, more_db })), 1, &mut ()).unwrap()
}

#[test]
fn a_model_of_ones_own_that_says_eq_22_flies_as_the_built_in_one_and_a_thousandth_of_a_decibel_more_does_not()
{
    for name in ["corner", "circuit"] {
        let built_in = run(&course(name, &[]), 1, &mut ()).unwrap();
        // All of it: the optimum asks the model as well.
        assert_eq!(fly(name, 0.0), built_in, "{name}");
        assert_ne!(fly(name, 1e-3).digest, built_in.digest, "{name}");
    }
}

/// Nothing is heard, whatever that is called.
#[derive(Debug)]
struct Broken(f32);

impl RadioModel for Broken {
    fn loss_db(&self, _: &Map, _: &Antenna, _: &Antenna) -> f32 {
        self.0
    }
}

#[test]
fn a_loss_that_is_no_number_is_no_link_for_run_and_plan_alike() {
    let plain = course("straight", &["duration_s=20"]);
    let none = plain.with_radio("broken", Arc::new(Broken(NO_LINK_DB)));
    let (flown, planned) = (run(&none, 1, &mut ()).unwrap(), plan(&none, None, 1.0, None).unwrap());
    assert!(flown.verdict.to_string().contains("toward the base loses 2000.0 dB"), "{}", flown.verdict);
    assert_eq!(planned.uavs_needed, None);
    for loss_db in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let broken = plain.with_radio("broken", Arc::new(Broken(loss_db)));
        assert_eq!(run(&broken, 1, &mut ()).unwrap(), flown, "{loss_db}");
        assert_eq!(plan(&broken, None, 1.0, None).unwrap(), planned, "{loss_db}");
    }
}

#[test]
fn a_disc_is_planned_by_its_range_and_says_that_no_relay_hears_when_to_take_off() {
    let course = course("straight", &["radio.model=disc", "radio.range_m=4"]);
    // 13.5 m in links of 4 m each.
    let planned = plan(&course, None, 0.5, None).unwrap();
    let needed: Vec<usize> = planned.rows.iter().map(|row| row.relays_needed.unwrap()).collect();
    let by_hand: Vec<usize> =
        planned.rows.iter().map(|row| ((row.depth_m / 4.0).ceil() as usize) - 1).collect();
    assert_eq!(needed, by_hand);
    assert!(planned.rows.iter().all(|row| row.bottleneck_db == Some(35.0)));
    let notes = course.notes().join("\n");
    assert!(notes.contains("no relay takes off before the link is lost"), "{notes}");
    let flown = run(&course, 1, &mut ()).unwrap();
    let text = format!("{flown:?}");
    assert!(!text.contains("inf") && !text.contains("NaN"), "{text}");
    assert_eq!(flown.uavs, 1, "{text}");
}

#[test]
fn what_the_disc_needs_and_the_path_loss_does_not_is_said() {
    let error = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        Course::read(&builtin("corner").unwrap(), &sets).unwrap_err().to_string()
    };
    let cases = [
        (
            &["radio.model=disk"][..],
            "--set radio.model=disk: radio.model = \"disk\": unknown choice; did you mean 'disc'? \
          (known: path-loss, disc, log-distance, multi-wall, p1238, table, two-slope, visibility)",
        ),
        (
            &["radio.model=disc"],
            "radio.range_m = nothing: the model \"disc\" needs a range; it must lie in 0.1..=1000000",
        ),
        (
            &["radio.model=disc", "radio.range_m=0"],
            "--set radio.range_m=0: radio.range_m = 0: must lie in 0.1..=1000000",
        ),
        (&["radio.model=3"], "radio.model = 3"),
        (&["radio.modell=disc"], "unknown key 'radio.modell'; did you mean 'model'?"),
    ];
    for (sets, expected) in cases {
        let got = error(sets);
        assert!(got.contains(expected), "{sets:?}: {got}");
    }
    let notes = course("corner", &["radio.range_m=4"]).notes().join("\n");
    assert!(notes.contains("radio.range_m = 4: the model \"path-loss\" has no range"), "{notes}");
    assert!(course("corner", &[]).notes().is_empty());
}

#[test]
fn a_model_is_written_into_a_scenario_only_if_it_is_another_one() {
    let written = |sets: &[&str]| course("corner", sets).scenario.to_toml().unwrap();
    let plain = written(&[]);
    assert!(!plain.contains("\nmodel = ") && plain.matches("range_m = ").count() == 1, "{plain}");
    assert_eq!(written(&["radio.model=path-loss"]), plain);
    let disc = written(&["radio.model=disc", "radio.range_m=4"]);
    assert!(disc.contains("model = \"disc\"\nrange_m = 4.0"), "{disc}");
}

/// Eq. 22 by a word of the program's own; `alpha_step`, which "mean-exponent" does not read, adds to it.
const OWN: RadioKind = RadioKind::new("own", "Eq. 22, as a user writes it.", |table, map| {
    let eq_22 = PathLoss::new(table.clone(), map);
    let eq_22 = eq_22.map_err(|cause| RadioError::Map { key: "detour_db_per_m", cause })?;
    Ok(Arc::new(Own { eq_22, more_db: table.alpha_step - 2.0 }))
});

static MISSIONS: [&dyn AnyMission; 2] =
    [&Of::<Course>::with(ChainExtensions { radios: &[OWN], ..Course::BUILTIN }), &Of::<Site>::NEW];

fn registry() -> Registry {
    Registry::new(&MISSIONS)
}

fn read(registry: Registry, sets: &[&str]) -> Result<Arc<Course>, ConfigError> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Ok(registry.read(&builtin("corner").unwrap(), &sets)?.get::<Course>().unwrap().clone())
}

#[test]
fn a_model_of_ones_own_by_its_word_flies_is_recorded_and_verified() {
    let built_in = run(&course("corner", &[]), 1, &mut ()).unwrap();
    let own = read(registry(), &["radio.model=own"]).unwrap();
    assert!(own.scenario.to_toml().unwrap().contains("model = \"own\""));
    let mut recorder = McapRecorder::start(Vec::new(), &own, 1).unwrap();
    let flown = run(&own, 1, &mut recorder).unwrap();
    assert_eq!(flown.digest, built_in.digest);
    let more = read(registry(), &["radio.model=own", "radio.alpha_step=2.001"]).unwrap();
    assert_ne!(run(&more, 1, &mut ()).unwrap().digest, built_in.digest, "the control");

    let file = recorder.finish().unwrap();
    let open = |registry: Registry| {
        registry.open_bytes(Box::new(std::io::Cursor::new(file.clone())), "memory").unwrap()
    };
    assert!(open(registry()).verify().unwrap().agrees());
    let error = open(Registry::default()).verify().unwrap_err().to_string();
    assert!(
        error.contains(
            "unknown choice (known: path-loss, disc, log-distance, multi-wall, p1238, table, two-slope, visibility)"
        ),
        "{error}"
    );

    let misspelt = read(registry(), &["radio.model=onw"]).unwrap_err().to_string();
    assert!(misspelt.contains("did you mean 'own'? (known: path-loss, disc, log-distance, multi-wall, p1238, table, two-slope, visibility, own)"), "{misspelt}");
    let explained = |registry: Registry| registry.explain("radio.model").unwrap()[0].choices.clone();
    assert_eq!(explained(registry()).len(), 9);
    assert_eq!(explained(registry())[8], ("own".to_owned(), "Eq. 22, as a user writes it.".to_owned()));
    assert_eq!(explained(Registry::default()).len(), 8);
}

#[test]
fn a_word_that_a_program_gives_twice_is_refused() {
    const DISC: RadioKind = RadioKind::new("disc", "Another disc.", |_, _| Ok(Arc::new(Broken(NO_LINK_DB))));
    static TWICE: [&dyn AnyMission; 1] =
        [&Of::<Course>::with(ChainExtensions { radios: &[DISC], ..Course::BUILTIN })];
    let error = read(Registry::new(&TWICE), &["radio.model=disc", "radio.range_m=3"]).unwrap_err();
    assert!(error.to_string().contains("gives the word to more than one model"), "{error}");
}

#[test]
fn the_command_line_runs_sweeps_and_verifies_a_model_of_ones_own() {
    let here = tempfile::tempdir().unwrap();
    let path = |name: &str| here.path().join(name).display().to_string();
    let uchain = |registry, args: &[&str]| {
        main_with_missions(registry, ["uchain"].iter().chain(args).copied().map(str::to_owned))
    };
    let (ok, refused) = (ExitCode::SUCCESS, ExitCode::from(3));
    let (one, many) = (path("one"), path("many"));
    let fly = ["run", "corner", "--set", "radio.model=own", "--out", &one, "--quiet"];
    assert_eq!(uchain(registry(), &fly), ok);
    let text = fs::read(Path::new(&one).join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(summary["digest"], run(&course("corner", &[]), 1, &mut ()).unwrap().digest);
    let recording = format!("{one}/run.mcap");
    assert_eq!(uchain(registry(), &["verify", &recording, "--quiet"]), ok);
    assert_eq!(uchain(Registry::default(), &fly), refused, "the control");
    let vary = "radio.model=\"path-loss\",\"own\"";
    let sweep = ["sweep", "corner", "--vary", vary, "--set", "duration_s=10", "--out", &many, "--quiet"];
    assert_eq!(uchain(registry(), &sweep), ok);
    assert_eq!(uchain(registry(), &["plan", "corner", "--set", "radio.model=own", "--quiet"]), ok);
}

/// Where a UAV is by its odometer and by the tunnel's middle, at the end of a flight, and the summary's word of the head.
fn flown_and_deep(name: &str) -> (Vec<[f64; 2]>, Summary) {
    let course = course(name, &[]);
    let mut chain: Chain = Chain::start(course.clone(), 1);
    let mut metrics = Metrics::new(course.clone());
    while chain.step(&mut metrics).unwrap().is_none() {}
    let tunnel = course.tunnel.as_ref().unwrap();
    let flown = chain.world().bodies().iter().zip(&course.spawns).filter(|(body, _)| body.airborne);
    let pairs =
        flown.map(|(body, spawn)| [body.forward_m, tunnel.depth_m(body.at) - tunnel.depth_m(spawn.at)]);
    (pairs.collect(), metrics.summary(1, String::new()))
}

#[test]
fn what_uavs_count_of_their_way_drifts_in_bends_and_the_summary_says_how_far_the_head_flew() {
    let (straight, of_straight) = flown_and_deep("straight");
    for [flown_m, deep_m] in &straight {
        assert!((flown_m - deep_m).abs() < 0.05, "{straight:?}");
    }
    assert!((f64::from(of_straight.head_flown_m) - straight[0][0]).abs() < 0.1, "{of_straight:?}");
    let (bent, of_bent) = flown_and_deep("circuit-frontiers2021");
    assert!(bent.iter().any(|[flown_m, deep_m]| (flown_m - deep_m).abs() > 0.1), "the control: {bent:?}");
    assert!(of_bent.head_flown_m > of_bent.head_reach_m, "{of_bent:?}");
}
