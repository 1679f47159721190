//! Same seed, same bits; noise, ranges and scan times; files that load back.

use uchain_sim::{
    map::{Unknown, read_ros},
    mission::{
        Stopped,
        explore::{ExploreFrame, ExploreHistory, RosMap},
    },
    record::{RecordError, Recorder},
    run::run,
};

use super::{site, summary};

#[test]
fn the_same_seed_gives_the_same_exploration_whoever_watches_and_on_whatever_thread() {
    let site = site("apartment", &["explore.position_sigma_m=0.01", "explore.strategy=cssg-random"]);
    let alone = summary(&site, 5);
    assert_eq!(alone, run(&site, 5, &mut ExploreHistory::default()).unwrap());
    std::thread::scope(|scope| {
        let runs = [(); 2].map(|()| scope.spawn(|| summary(&site, 5)));
        for other in runs {
            assert_eq!(other.join().unwrap(), alone);
        }
    });
    assert_ne!(alone.digest, summary(&site, 6).digest);
}

/// Stops at its hundredth frame.
struct Stop(u32);

impl Recorder<ExploreFrame> for Stop {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.0 += 1;
        if self.0 == 100 { Err(RecordError::Interrupted { time_s: frame.time_s() }) } else { Ok(()) }
    }
}

#[test]
fn a_recorder_can_end_an_exploration_and_the_time_can_be_up() {
    let error = run(&site("corridors", &[]), 1, &mut Stop(0)).unwrap_err();
    assert_eq!(error.to_string(), "interrupted at 5.0 s of simulated time");
    let short = summary(&site("corridors", &["duration_s=20"]), 1);
    assert_eq!((short.stopped, short.sim_s), (Some(Stopped::Time), 20.0));
    assert!(short.hubs_left > 0 && short.coverage < 0.9, "{short:?}");
}

#[test]
fn scans_take_their_time_and_change_nothing_else() {
    let quick = summary(&site("corridors", &["explore.robots=1"]), 3);
    let slow = summary(&site("corridors", &["explore.robots=1", "explore.scan_s=2"]), 3);
    assert_eq!((quick.iterations, &quick.distance_m), (slow.iterations, &slow.distance_m));
    let scans = f64::from(quick.nodes[0]);
    assert!((slow.sim_s - quick.sim_s - 2.0 * scans).abs() < 1e-6, "{} {} {scans}", slow.sim_s, quick.sim_s);
}

#[test]
fn a_team_that_hears_only_what_is_near_still_sees_everything_and_comes_home() {
    for map in ["apartment", "corridors"] {
        for seed in 1..=5 {
            let far = summary(&site(map, &[]), seed);
            let near = summary(&site(map, &["explore.range_m=2.25"]), seed);
            assert_eq!((near.stopped, near.hubs_left), (Some(Stopped::Explored), 0));
            assert_eq!((near.wall_contacts, near.robot_contacts), (0, 0));
            assert!(near.coverage > 0.98, "{}", near.coverage);
            // What is far over all of the map is as good as unlimited.
            assert_eq!(summary(&site(map, &["explore.range_m=20"]), seed).digest, far.digest);
        }
    }
}

#[test]
fn robots_that_know_their_place_to_2_cm_see_everything_and_come_home() {
    for map in ["apartment", "corridors"] {
        for seed in 1..=5 {
            let summary = summary(&site(map, &["explore.position_sigma_m=0.02"]), seed);
            assert_eq!((summary.stopped, summary.hubs_left), (Some(Stopped::Explored), 0), "{map} {seed}");
            assert!(summary.coverage > 0.98, "{map} {seed}: {}", summary.coverage);
            assert_eq!((summary.wall_contacts, summary.robot_contacts), (0, 0), "{map} {seed}");
        }
    }
}

#[test]
fn the_explored_map_loads_back_as_a_ros_map() {
    let site = site("apartment", &[]);
    let mut history = ExploreHistory::default();
    run(&site, 1, &mut history).unwrap();
    let written = RosMap::explored(&site.map, site.ground(), &history.nodes, 1.0);
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    std::fs::write(&yaml, &written.yaml).unwrap();
    std::fs::write(folder.path().join("map.pgm"), &written.pgm).unwrap();
    let read = read_ros(&yaml, Unknown::Rock, None, 0.0).unwrap();
    let in_file = |local: [f32; 2]| {
        let [x, y] = site.map.offset_m();
        read.to_local([f64::from(local[0]) + x, f64::from(local[1]) + y])
    };
    assert!(history.nodes.iter().all(|node| !read.in_rock(in_file(node.at_m))), "nodes are free");
    // Along a wall between two rooms, and along a way through a door of it.
    for (x, y, rock) in [(3.15, 2.0, true), (2.0, 5.75, true), (3.0, 5.75, false), (5.0, 5.0, false)] {
        assert_eq!(read.in_rock(read.to_local([x, y])), rock, "({x}, {y})");
    }
}
