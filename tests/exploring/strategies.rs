//! The study that Kim 2021, §9 leaves open: CSSG, its baselines and what else people fly, on three maps.

use std::fmt::Write as _;

use uchain_core::explore::StrategyKind;
use uchain_sim::{
    analyse::Estimate,
    config::builtin,
    mission::{
        Stopped,
        explore::{ExploreSummary, Site},
    },
    registry::AnyScene,
    run::run,
    sweep::{Design, DesignText, Sweep},
};

/// Maps, and how many robots explore them.
const STUDIES: [(&str, &str); 3] = [("apartment", "2,3,4,5,6"), ("corridors", "2,3,4,5,6"), ("lab", "2")];
const SEEDS: u64 = 20;

/// All explorations of a map, strategy by strategy and team by team.
fn explored(map: &str, robots: &str) -> Vec<Vec<ExploreSummary>> {
    let strategies = StrategyKind::BUILTIN.map(StrategyKind::word).join(",");
    let vary = vec![format!("explore.strategy={strategies}"), format!("explore.robots={robots}")];
    let design = Design::parse(&DesignText { vary, table: None }, "").unwrap();
    let sweep = Sweep::new(builtin(map).unwrap(), Vec::new(), design, SEEDS, 1).unwrap();
    let site = |scene: &dyn AnyScene| scene.get::<Site>().expect("an exploration").clone();
    let runs = sweep.each(|scene, one| run(&site(scene), one.seed, &mut ()));
    let runs: Vec<ExploreSummary> = runs.into_iter().map(|run| run.unwrap().unwrap()).collect();
    runs.chunks(SEEDS as usize).map(<[_]>::to_vec).collect()
}

fn plus_minus(runs: &[ExploreSummary], of: impl Fn(&ExploreSummary) -> f64) -> String {
    let estimate = Estimate::of(&runs.iter().map(of).collect::<Vec<_>>()).unwrap();
    format!("{:8.2} ± {:5.2}", estimate.mean, estimate.half_width.unwrap())
}

#[test]
fn every_strategy_explores_three_maps_with_nothing_touched() {
    let mut text = format!(
        "means over {SEEDS} runs with their 95 % intervals\n{:<10} {:<16} {:>6}  {:>16}  {:>16}  {:>16}  {:>16}\n",
        "map", "strategy", "robots", "iterations", "m/robot", "time (s)", "overlap (%)"
    );
    for (map, robots) in STUDIES {
        for runs in explored(map, robots) {
            for run in &runs {
                let which = format!("{map} {:?} {} robots, seed {}", run.strategy, run.robots, run.seed);
                assert_eq!((run.stopped, run.hubs_left), (Some(Stopped::Explored), 0), "{which}");
                assert_eq!((run.wall_contacts, run.robot_contacts), (0, 0), "{which}");
            }
            let _ = writeln!(
                text,
                "{map:<10} {:<16} {:>6}  {}  {}  {}  {}",
                runs[0].strategy.word(),
                runs[0].robots,
                plus_minus(&runs, |run| run.iterations.into()),
                plus_minus(&runs, ExploreSummary::distance_mean_m),
                plus_minus(&runs, |run| run.sim_s),
                plus_minus(&runs, |run| 100.0 * run.overlap),
            );
        }
    }
    insta::assert_snapshot!(text);
}
