//! Strategies that the library knows nothing of are named in scenarios like those that are built in.

use std::{fs, path::Path, process::ExitCode, sync::Arc};

use uchain_cli::main_with_missions;
use uchain_core::explore::{Cssg, Goal, NearestFrontier, Strategy, StrategyKind, View};
use uchain_sim::{
    config::{ConfigError, builtin},
    mission::{
        Mission as _, Scene as _,
        chain::Course,
        explore::{Exploration, ExploreRecorder, Site, SiteExtensions},
    },
    record::mcap::ReadError,
    registry::{AnyMission, AnyScene, Of, Registry},
    replay::{self, Recording},
    run::run,
};

/// Asks a strategy that is built in.
#[derive(Debug, Clone)]
struct Same<S>(S);

impl<S: Strategy + Clone + 'static> Strategy for Same<S> {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        self.0.goal(view)
    }
}

/// Remembers how often it was asked: twice it goes where CSSG would, then once to the nearest frontier.
#[derive(Debug, Clone, Default)]
struct InTurns {
    asked: u32,
}

impl Strategy for InTurns {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        self.asked += 1;
        if self.asked.is_multiple_of(3) { NearestFrontier.goal(view) } else { Cssg.goal(view) }
    }
}

const OWN: SiteExtensions = SiteExtensions {
    strategies: &[
        StrategyKind::new("my-cssg", "As `cssg`.", |_| Box::new(Same(Cssg))),
        StrategyKind::new("my-nearest", "As `nearest-frontier`.", |_| Box::new(Same(NearestFrontier))),
        StrategyKind::new("my-holding", "As `cssg`, but robots hold.", |_| Box::new(Same(Cssg))).holding(),
        StrategyKind::new("in-turns", "Now this way, now that.", |_| Box::<InTurns>::default()),
    ],
    ..Site::BUILTIN
};

static MISSIONS: [&dyn AnyMission; 2] = [&Of::<Course>::NEW, &Of::<Site>::with(OWN)];

fn registry() -> Registry {
    Registry::new(&MISSIONS)
}

fn by(word: &str) -> Result<Arc<dyn AnyScene>, ConfigError> {
    registry().read(&builtin("apartment").unwrap(), &[format!("explore.strategy={word}")])
}

fn site(word: &str) -> Arc<Site> {
    by(word).unwrap_or_else(|error| panic!("{error}")).get::<Site>().unwrap().clone()
}

fn digest(word: &str) -> String {
    run(&site(word), 3, &mut ()).unwrap().digest
}

#[test]
fn one_that_chooses_as_a_built_in_one_has_its_digest() {
    let [cssg, mine] = ["cssg", "my-cssg"].map(digest);
    assert_eq!(mine, cssg);
    let [nearest, mine] = ["nearest-frontier", "my-nearest"].map(digest);
    assert_eq!(mine, nearest);
    assert_ne!(nearest, cssg, "the control: another choice");
    let holding = run(&site("my-holding"), 3, &mut ()).unwrap();
    assert!(holding.holds.iter().sum::<u32>() > 0 && holding.mfl_s == 0.0, "{holding:?}");
    assert_ne!(holding.digest, cssg, "the control: the same choice with another rule for conflicts");
}

#[test]
fn what_one_remembers_is_its_robots_own_and_begins_anew_with_every_run() {
    let site = site("in-turns");
    let [once, again] = [(); 2].map(|()| run(&site, 3, &mut ()).unwrap());
    assert_eq!(once, again);
    assert!(!["cssg", "nearest-frontier"].map(digest).contains(&once.digest), "it is neither all the time");
    assert_eq!(once.verdict.outcome().word(), "explored", "{}", once.verdict);

    let mut flown = Exploration::start(site.clone(), 3);
    while flown.step(&mut ()).unwrap().is_none() {}
    let end = flown.frame().clone();
    flown.reset(3);
    while flown.step(&mut ()).unwrap().is_none() {}
    assert_eq!(flown.frame(), &end);
}

#[test]
fn its_word_stands_where_those_of_built_in_ones_stand() {
    let site = site("my-nearest");
    let toml = site.to_toml().unwrap();
    assert!(toml.contains("strategy = \"my-nearest\""), "{toml}");
    let builtin_toml = self::site("nearest-frontier").to_toml().unwrap();
    assert_eq!(toml.replace("my-nearest", "nearest-frontier"), builtin_toml, "and nothing else changes");

    let summary = run(&site, 3, &mut ()).unwrap();
    assert_eq!(serde_json::to_value(&summary).unwrap()["strategy"], "my-nearest");

    let key = &registry().explain("explore.strategy").unwrap()[0];
    let words: Vec<&str> = key.choices.iter().map(|(word, _)| word.as_str()).collect();
    let own = ["my-cssg", "my-nearest", "my-holding", "in-turns"];
    assert_eq!(words[..5], StrategyKind::BUILTIN.map(StrategyKind::word));
    assert_eq!(words[5..], own);
    assert_eq!(key.choices[8].1, "Now this way, now that.");
    let built_in = &Registry::default().explain("explore.strategy").unwrap()[0];
    assert_eq!(built_in.choices.len(), 5, "the control");
}

#[test]
fn a_slip_in_its_word_is_hinted_at_and_a_word_that_nobody_knows_is_refused() {
    let refused = |scene: Result<Arc<dyn AnyScene>, ConfigError>| scene.unwrap_err().to_string();
    let all = "cssg, cssg-random, srg, nearest-frontier, utility";
    let own = "my-cssg, my-nearest, my-holding, in-turns";
    assert_eq!(
        refused(by("in-turn")),
        format!(
            "--set explore.strategy=in-turn: explore.strategy = \"in-turn\": unknown choice; did you mean 'in-turns'? \
             (known: {all}, {own})"
        )
    );
    let without =
        Registry::default().read(&builtin("apartment").unwrap(), &["explore.strategy=in-turns".into()]);
    assert_eq!(
        refused(without),
        format!(
            "--set explore.strategy=in-turns: explore.strategy = \"in-turns\": unknown choice (known: {all})"
        )
    );
}

#[test]
fn a_word_that_means_two_strategies_is_refused() {
    const TWICE: SiteExtensions = SiteExtensions {
        strategies: &[StrategyKind::new("srg", "Not that one.", |_| Box::new(Cssg))],
        ..Site::BUILTIN
    };
    let read = |word: &str| {
        Site::read_with(&builtin("apartment").unwrap(), &[format!("explore.strategy={word}")], TWICE)
    };
    let error = read("srg").unwrap_err().to_string();
    assert!(error.ends_with("= \"srg\": this program gives the word to more than one strategy"), "{error}");
    assert!(read("cssg").is_ok(), "the control");
}

#[test]
fn its_recording_flies_again_only_where_its_word_is_known() {
    let site = site("in-turns");
    let mut recorder = ExploreRecorder::start(Vec::new(), &site, 3).unwrap();
    run(&site, 3, &mut recorder).unwrap();
    let file = recorder.finish().unwrap();
    let opened =
        |registry: Registry| registry.open_bytes(Box::new(std::io::Cursor::new(file.clone())), "it").unwrap();
    assert!(opened(registry()).verify().unwrap().agrees());
    let refused = opened(Registry::default()).verify().unwrap_err();
    assert!(matches!(refused, ReadError::Scenario(_)), "{refused:?}");
    assert!(
        refused.to_string().contains("explore.strategy = \"in-turns\": unknown choice (known: cssg"),
        "{refused}"
    );

    let read = || Recording::<_, Site>::read(file.as_slice(), "it").unwrap();
    assert!(replay::verify(&mut read().with_extensions(OWN)).unwrap().agrees());
    assert!(replay::verify(&mut read()).is_err(), "the control");
}

#[test]
fn the_whole_command_line_knows_it() {
    let here = tempfile::tempdir().unwrap();
    let path = |name: &str| here.path().join(name).display().to_string();
    let with = |registry: Registry, args: &[&str]| {
        main_with_missions(registry, ["uchain"].iter().chain(args).copied().map(str::to_owned))
    };
    let uchain = |args: &[&str]| with(registry(), args);
    let (ok, wrong_input) = (ExitCode::SUCCESS, ExitCode::from(3));
    let read = |name: &str| fs::read(Path::new(&path(name))).unwrap();

    let one = path("one");
    let fly =
        ["run", "apartment", "--set", "explore.strategy=my-cssg", "--seed", "3", "--out", &one, "--quiet"];
    assert_eq!(uchain(&fly), ok);
    assert_eq!(with(Registry::default(), &fly), wrong_input, "the control");
    let summary: serde_json::Value = serde_json::from_slice(&read("one/summary.json")).unwrap();
    assert_eq!((&summary["strategy"], &summary["digest"]), (&"my-cssg".into(), &digest("cssg").into()));
    assert!(read("one/run.png").starts_with(b"\x89PNG"));
    let recording = path("one/run.mcap");
    assert_eq!(uchain(&["verify", &recording, "--quiet"]), ok);
    assert_eq!(uchain(&["inspect", &recording, "--out", &path("again"), "--quiet"]), ok);
    assert_ne!(with(Registry::default(), &["verify", &recording, "--quiet"]), ok, "the control");

    let many = path("many");
    let vary = "explore.strategy=\"cssg\",\"my-cssg\"";
    let sweep = ["sweep", "apartment", "--set", "duration_s=30", "--vary", vary, "--replicates", "2"];
    assert_eq!(uchain(&[&sweep[..], &["--out", &many, "--quiet"]].concat()), ok);
    assert_eq!(uchain(&["report", &many, "--quiet"]), ok);
    assert_eq!(uchain(&["repro", &many, "--run", "3", "--out", &path("row"), "--quiet"]), ok);
    assert_eq!(uchain(&["check", "apartment", "--set", "explore.strategy=in-turns", "--quiet"]), ok);
    assert_eq!(uchain(&["check", "apartment", "--set", "explore.strategy=in-turn", "--quiet"]), wrong_input);
}
