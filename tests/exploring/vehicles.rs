//! What a team decides does not depend on what it flies; what happens on the way does.

use std::sync::Arc;

use uchain_core::explore::{Purpose, Target};
use uchain_sim::{
    mission::{
        Mission as _, Stopped,
        explore::{Exploration, ExploreFrame, ExploreSummary, Site, VehicleKind},
    },
    record::{RecordError, Recorder},
};

use super::{site, summary};

const MAPS: [&str; 3] = ["apartment", "corridors", "lab"];
const SEEDS: std::ops::RangeInclusive<u64> = 1..=5;

/// What a round has decided, and where everybody stood.
#[derive(Debug, PartialEq)]
struct Round {
    targets: Vec<Target>,
    nodes: String,
    levels: Vec<(u16, Purpose, bool, bool, bool)>,
}

/// Keeps the last frame.
#[derive(Default)]
struct Last(ExploreFrame);

impl Recorder<ExploreFrame> for Last {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.0.clone_from(frame);
        Ok(())
    }
}

fn rounds(site: &Arc<Site>, seed: u64) -> (Vec<Round>, Stopped) {
    let mut exploration = Exploration::start(site.clone(), seed);
    let (mut rounds, mut last) = (Vec::new(), Last::default());
    loop {
        let stopped = exploration.step(&mut last).expect("nobody stops it");
        let ExploreFrame { decision, nodes, labels, edges, hubs, robots, .. } = &last.0;
        if *decision {
            let levels = robots.iter().map(|r| (r.level, r.purpose, r.moves, r.holds, r.mfl)).collect();
            let nodes = format!("{nodes:?} {labels:?} {edges:?} {hubs}");
            rounds.push(Round { targets: exploration.team().targets().to_vec(), nodes, levels });
        }
        if let Some(stopped) = stopped {
            return (rounds, stopped);
        }
    }
}

/// A map flown by one vehicle, with starts that depend on the seed.
fn flown_by(map: &str, vehicle: &str, more: &[&str]) -> Arc<Site> {
    let vehicle = format!("explore.vehicle={vehicle}");
    site(map, &[&["explore.scatter_m=0.02", &vehicle], more].concat())
}

#[test]
fn rounds_nodes_and_targets_are_the_same_whatever_flies() {
    for map in MAPS {
        for strategy in ["cssg", "srg"] {
            let strategy = format!("explore.strategy={strategy}");
            let [point, quad] =
                ["point-mass", "quadrotor"].map(|vehicle| flown_by(map, vehicle, &[&strategy]));
            for seed in SEEDS {
                let ((of_point, why), (of_quad, other)) = (rounds(&point, seed), rounds(&quad, seed));
                assert_eq!(
                    (why, other),
                    (Stopped::Explored, Stopped::Explored),
                    "{map}, {strategy}, seed {seed}"
                );
                assert!(of_point == of_quad, "{map}, {strategy}, seed {seed}");
            }
        }
    }
}

/// The control: the comparison above sees a centimetre.
#[test]
fn from_where_they_really_hover_robots_decide_otherwise_and_come_home_all_the_same() {
    for map in MAPS {
        let point = flown_by(map, "point-mass", &[]);
        let hovers = flown_by(map, "quadrotor", &["explore.quadrotor.snap=false"]);
        for seed in SEEDS {
            let (others, why) = rounds(&hovers, seed);
            assert_eq!(why, Stopped::Explored, "{map}, seed {seed}");
            assert!(others != rounds(&point, seed).0, "{map}, seed {seed}");
        }
    }
}

#[test]
fn quadrotors_touch_neither_walls_nor_each_other() {
    for map in MAPS {
        for more in [&[][..], &["explore.strategy=srg"], &["explore.quadrotor.snap=false"]] {
            let site = flown_by(map, "quadrotor", more);
            for seed in SEEDS {
                let run = summary(&site, seed);
                let which = format!("{map} {more:?}, seed {seed}");
                assert_eq!(
                    (run.stopped, run.wall_contacts, run.robot_contacts),
                    (Some(Stopped::Explored), 0, 0),
                    "{which}"
                );
            }
        }
    }
    let six = flown_by("apartment", "quadrotor", &["explore.robots=6"]);
    let run = summary(&six, 1);
    assert_eq!((run.stopped, run.wall_contacts, run.robot_contacts), (Some(Stopped::Explored), 0, 0));
}

#[test]
fn gaps_and_downwash_are_told_of_both_vehicles() {
    for vehicle in ["point-mass", "quadrotor"] {
        let site = flown_by("apartment", vehicle, &["explore.robots=4"]);
        let ExploreSummary { gaps, downwash_s, mfl_s, .. } = summary(&site, 2);
        assert_eq!((gaps.len(), downwash_s.len()), (6, 4), "{vehicle}");
        assert!(gaps.is_sorted_by(|a, b| a.least_m <= b.least_m));
        let body_m = 2.0 * f64::from(site.scenario.params.r_body_m);
        for gap in &gaps {
            assert!(gap.least_m > body_m && gap.beside_m.is_none_or(|m| m > body_m), "{vehicle}: {gap:?}");
            assert!(gap.below_m.is_none_or(|m| m > body_m), "{vehicle}: {gap:?}");
            assert_eq!(gap.below_m.is_some(), gap.downwash_s > 0.0, "{vehicle}: {gap:?}");
        }
        let (pairs_s, robots_s) =
            (gaps.iter().map(|gap| gap.downwash_s).sum::<f64>(), downwash_s.iter().sum::<f64>());
        assert!(
            robots_s > 0.0 && robots_s <= pairs_s + 1e-9 && mfl_s > 0.0,
            "{vehicle}: {robots_s} {pairs_s}"
        );
    }
    // A narrower downwash is met less.
    let [narrow, wide] = ["0.05", "0.3"].map(|m| {
        let radius = format!("explore.downwash_radius_m={m}");
        let site = flown_by("apartment", "quadrotor", &["explore.robots=4", &radius]);
        summary(&site, 2).downwash_s.iter().sum::<f64>()
    });
    assert!(narrow < wide, "{narrow} {wide}");
}

/// Kim 2021, Table 1: 21 nodes visited each, 10.454 m and 9.936 m, 101.66 s. A node is visited by each move, and by the
/// start.
#[test]
fn in_the_lab_two_quadrotors_visit_about_as_many_nodes_as_published() {
    let site = site("lab", &[]);
    assert_eq!(site.scenario.team.vehicle, VehicleKind::Quadrotor);
    let run = summary(&site, 1);
    assert_eq!((run.stopped, run.wall_contacts, run.robot_contacts), (Some(Stopped::Explored), 0, 0));
    assert!(run.moves.iter().all(|moves| (18..=24).contains(&(moves + 1))), "{:?}", run.moves);
    assert!(run.coverage > 0.99, "{}", run.coverage);
}

#[test]
fn a_quadrotor_that_cannot_be_flown_ends_its_exploration_in_words() {
    for gains in [
        &["explore.quadrotor.speed_per_s=50", "explore.quadrotor.go_to_per_s=10", "explore.v_mps=20"][..],
        &["explore.quadrotor.roll_p_per_s2=1000", "explore.quadrotor.roll_d_per_s=0.1"],
        &["explore.quadrotor.arrive_m=0.0001", "explore.quadrotor.arrive_mps=0.0001"],
    ] {
        let site = flown_by("corridors", "quadrotor", &[gains, &["duration_s=300"]].concat());
        let run = summary(&site, 1);
        assert!([Some(Stopped::Time), Some(Stopped::Explored)].contains(&run.stopped), "{gains:?}: {run:?}");
    }
}
