//! The seam between brain and body has a second answer: a node put together from the laws, outside of the library.

use std::{path::Path, process::ExitCode, sync::Arc};

use uchain_cli::main_with_missions;
use uchain_core::{
    bounded,
    chain::{
        Brain, Centering, Command, End, Estimates, Follow, HeadGuard, LinkEnd, LinkEstimate, Node,
        NodeParams, Observation, Packet, RelayGuard, Signal, Stage, Takeoff, Walls, center, equalize,
    },
};
use uchain_sim::{
    config::builtin,
    mission::{
        Mission, Scene as _,
        chain::{Chain, ChainExtensions, ChainOf, Course, MakeBrain},
    },
    registry::{Of, Registry},
    run::run,
};

use crate::course;

/// Flies as the built-in node does: Algorithm 1, Eq. 12, Eq. 20 and 21, the overrides of §4.3.
#[derive(Debug)]
pub(super) struct Mine {
    params: NodeParams,
    place: u16,
    airborne: bool,
    decisions: u32,
    links: [LinkEnd; 2],
    head: HeadGuard,
    relay: RelayGuard,
    takeoff: Takeoff,
    centering: Centering,
    follow: Follow,
    forward_mps: f32,
    imbalance_db: f32,
}

impl Mine {
    pub(super) fn new(uav: usize, params: &NodeParams) -> Self {
        Self {
            params: params.clone(),
            place: uav as u16,
            airborne: false,
            decisions: 0,
            links: [LinkEnd::new(End::Front), LinkEnd::new(End::Rear)],
            head: HeadGuard::default(),
            relay: RelayGuard::default(),
            takeoff: Takeoff::default(),
            centering: Centering::default(),
            follow: Follow::Centre,
            forward_mps: 0.0,
            imbalance_db: 0.0,
        }
    }

    fn flown_s(&self) -> f32 {
        self.decisions as f32 * self.params.equalize.decision_s
    }

    fn has_settled(&self) -> bool {
        self.airborne && self.flown_s() >= self.params.takeoff.rise_s + self.params.takeoff.hover_s
    }

    fn hear(&mut self, seen: &Observation) {
        let (p, own_mps) = (&self.params, seen.ground_speed_mps.unwrap_or(0.0));
        let Some(radio) = &seen.radio else { return };
        let [back, front] = &mut self.links;
        let (period_s, ahead) = (p.equalize.decision_s, radio.front(self.place));
        if !self.airborne {
            front.hear(ahead, None, period_s, &p.kalman, &p.link);
            let loss_db = front.signal_db(p.takeoff.launch_signal).filter(|_| ahead.is_some());
            let is_due = |loss_db| self.takeoff.due(loss_db, &front.neighbour(), period_s, &p.takeoff);
            self.airborne = self.place == 0 || loss_db.is_some_and(is_due);
            return;
        }
        back.hear(radio.back(self.place), Some(own_mps), period_s, &p.kalman, &p.link);
        front.hear(ahead, Some(own_mps), period_s, &p.kalman, &p.link);
        self.decisions += 1;
        let signal = p.link.signal;
        let wish_mps = if self.place == 0 {
            let pilot = seen.pilot.unwrap_or_default();
            self.follow = pilot.follow;
            self.head.limit(pilot.speed_mps, back, &p.link)
        } else {
            let both = back.signal_db(signal).zip(front.signal_db(signal));
            let (level_mps, own_db) = both.map_or((0.0, 0.0), |(back_db, front_db)| {
                (equalize(back_db, front_db, &p.equalize), (front_db - back_db).abs())
            });
            self.follow = front.neighbour().follow;
            self.imbalance_db = own_db.max(front.neighbour().imbalance_db);
            self.relay.limit(level_mps, back, front, &p.link)
        };
        self.forward_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
    }
}

impl Brain for Mine {
    fn decide(&mut self, seen: &Observation) -> Command {
        self.place = seen.place.unwrap_or(self.place);
        self.hear(seen);
        if let Some(tof) = &seen.tof {
            let p = &self.params;
            self.centering = center(tof, p.tof_range_m, self.forward_mps < 0.0, self.follow, &p.center);
        }
        let airborne = self.airborne;
        if !self.has_settled() {
            return Command { airborne, ..Command::default() };
        }
        let Centering { lateral_mps, yaw_rate_radps, speed_share } = self.centering;
        Command { forward_mps: self.forward_mps * speed_share, lateral_mps, yaw_rate_radps, airborne }
    }

    fn say(&self, seen: &Observation) -> Packet {
        Packet {
            place: seen.place.unwrap_or(self.place),
            ground_speed_mps: seen.ground_speed_mps.unwrap_or(0.0),
            flown_s: self.flown_s(),
            follow: self.follow,
            imbalance_db: self.imbalance_db,
            ..Packet::default()
        }
    }

    fn estimates(&self) -> Estimates {
        let [back, front] = self.links.map(|link| LinkEstimate {
            filtered_db: link.loss_db(),
            raw_db: link.signal_db(Signal::Raw),
            silent_s: link.silent_s(),
        });
        Estimates { back, front, allowed_mps: self.has_settled().then_some(self.forward_mps) }
    }
}

fn digest(course: &Arc<Course>) -> String {
    run(course, 3, &mut ()).unwrap().digest
}

#[test]
fn a_law_of_ones_own_that_returns_eq_12_has_the_digest_of_the_built_in_one() {
    let faults = "faults.dead=[{ uav = 1, start_s = 70 }]";
    for (name, sets) in [
        ("straight", vec!["duration_s=150", faults]),
        ("corner", vec!["packets.delay_ticks=6", "faults.burst_rate=0.05"]),
        ("circuit", vec!["link.signal=raw", "takeoff.launch=converged"]),
    ] {
        let built_in = course(name, &sets);
        let own = built_in.with_law("mine", Mine::new);
        assert_eq!(digest(&own), digest(&built_in), "{name}");
        // The control: a thousandth more gain.
        let other = built_in.with_law("other", |uav, params| {
            let mut params = params.clone();
            params.equalize.k_db_per_m *= 1.001;
            Mine::new(uav, &params)
        });
        assert_ne!(digest(&other), digest(&built_in), "{name}");
    }
}

#[test]
fn a_chain_of_one_type_of_brains_flies_as_one_that_may_have_any() {
    let course = course("corner", &[]);
    let (mut any, mut nodes) = (Chain::start(course.clone(), 1), ChainOf::<Node>::start(course, 1));
    for _ in 0..2000 {
        any.step(&mut ()).unwrap();
        nodes.step(&mut ()).unwrap();
        assert_eq!(any.frame(), nodes.frame());
    }
    nodes.reset(2);
    nodes.step(&mut ()).unwrap();
    assert_ne!(any.frame(), nodes.frame(), "the control");
}

#[test]
fn a_scenario_names_the_law_that_is_not_the_built_in_one() {
    let course = course("corner", &[]);
    assert!(!course.scenario.to_toml().unwrap().contains("brain"));
    let own = course.with_law("mine", Mine::new);
    assert!(own.scenario.to_toml().unwrap().contains("brain = \"mine\""));
}

#[test]
fn what_a_node_believes_is_worked_out_when_somebody_asks_and_changes_nothing() {
    let course = Course::read(&builtin("corner").unwrap(), &[]).unwrap();
    let (mut asked, mut left_alone) = (Chain::start(course.clone(), 1), Chain::start(course, 1));
    let (mut stages, mut walls) = (Vec::new(), Vec::new());
    for _ in 0..2400 {
        asked.step(&mut ()).unwrap();
        left_alone.step(&mut ()).unwrap();
        let why = asked.explain(1).unwrap();
        stages.push(why.stage);
        walls.extend(why.walls);
        if let (Stage::Flying, Some(imbalance_db), None) = (why.stage, why.imbalance_db, why.overridden) {
            let law_mps = bounded(imbalance_db / (3.0 * 25.0) / 0.2, -0.3, 0.3);
            assert_eq!(why.wish_mps, law_mps, "Eq. 12 of what it believes");
            assert_eq!(why.estimates.allowed_mps, Some(law_mps));
        }
        assert_eq!(asked.frame(), left_alone.frame());
    }
    stages.dedup();
    assert_eq!(stages, [Stage::Waiting, Stage::Rising, Stage::Flying]);
    assert!([Walls::Both, Walls::Left].iter().all(|wanted| walls.contains(wanted)), "a corner to the left");
    assert!(asked.explain(99).is_none());
}

/// Chains that may be flown by a law of ours, by its name.
const CHAINS: Of<Course> = Of::with(ChainExtensions {
    brains: &[("mine", |uav, params| Box::new(Mine::new(uav, params)))],
    ..Course::BUILTIN
});

#[test]
fn a_law_has_its_name_in_every_command() {
    let here = tempfile::tempdir().unwrap();
    let path = |name: &str| here.path().join(name).display().to_string();
    let command = |registry, args: &[&str]| {
        main_with_missions(registry, ["uchain"].iter().chain(args).copied().map(str::to_owned))
    };
    let uchain = |args: &[&str]| command(Registry::new(&[&CHAINS]), args);
    let (own, built_in, table) = (path("own"), path("built-in"), path("table"));
    let short = ["run", "corner", "--quiet", "--set", "duration_s=40", "--out"];
    assert_eq!(uchain(&[&short[..], &[&own, "--set", "chain.brain=mine"]].concat()), ExitCode::SUCCESS);
    assert_eq!(uchain(&[&short[..], &[&built_in]].concat()), ExitCode::SUCCESS);
    let digest = |folder: &str| {
        let text = std::fs::read(Path::new(folder).join("summary.json")).unwrap();
        serde_json::from_slice::<serde_json::Value>(&text).unwrap()["digest"].clone()
    };
    assert_eq!(digest(&own), digest(&built_in));
    let verify = ["verify", &format!("{own}/run.mcap"), "--quiet"];
    assert_eq!(uchain(&verify), ExitCode::SUCCESS);
    assert_ne!(
        command(Registry::default(), &verify),
        ExitCode::SUCCESS,
        "the control: nobody brings that law"
    );
    let vary =
        ["sweep", "corner", "--vary", "chain.brain=node,mine", "--replicates", "2", "--quiet", "--out"];
    assert_eq!(uchain(&[&vary[..], &[&table, "--set", "duration_s=5"]].concat()), ExitCode::SUCCESS);
    assert_ne!(
        uchain(&[&short[..], &[&path("none"), "--set", "chain.brain=mien"]].concat()),
        ExitCode::SUCCESS
    );
}

#[test]
fn a_word_for_a_law_is_explained_and_names_one_law_only() {
    let registry = Registry::new(&[&CHAINS]);
    let brain = &registry.explain("chain.brain").unwrap()[0];
    let words: Vec<&str> = brain.choices.iter().map(|(word, _)| word.as_str()).collect();
    assert_eq!((brain.kind, words), ("word", vec!["node", "mine"]));
    let refused = |brains, word: &str| {
        let source = builtin("corner").unwrap();
        let sets = [format!("chain.brain={word}")];
        let laid = Course::read_with(&source, &sets, ChainExtensions { brains, ..Course::BUILTIN });
        laid.map(drop).map_err(|error| error.to_string())
    };
    let twice = "this program gives the word to more than one law";
    let mine: MakeBrain = |uav, params| Box::new(Mine::new(uav, params));
    for (brains, word) in [([("mine", mine); 2], "mine"), ([("node", mine); 2], "node")] {
        let error = refused(Box::leak(Box::new(brains)), word).unwrap_err();
        assert!(error.contains(twice), "{error}");
    }
    assert_eq!(refused(Box::leak(Box::new([("mine", mine)])), "mine"), Ok(()), "the control");
}
