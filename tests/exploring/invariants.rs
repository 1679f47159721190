//! What holds at every tick of an exploration.

use uchain_core::explore::{Label, Purpose};
use uchain_sim::{
    mission::{
        Mission as _, Stopped,
        explore::{Exploration, ExploreFrame, ExploreHistory, Site},
    },
    record::{RecordError, Recorder},
};

use super::site;

/// Checks every frame on its own, and keeps the map that frames tell of.
struct Inspector<'a> {
    site: &'a Site,
    told: ExploreHistory,
    first: Option<ExploreFrame>,
    last: ExploreFrame,
}

impl Recorder<ExploreFrame> for Inspector<'_> {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.told.frame(frame)?;
        assert!(
            frame.labels.iter().all(|change| change.label == Label::Free),
            "a label goes from 1 to 0 only"
        );
        for node in &frame.nodes {
            assert!(
                node.sectors.iter().all(|sector| sector.label != Label::Free),
                "a scan knows returns only"
            );
        }
        let nodes =
            frame.edges.iter().map(|ends| ends.map(|end| self.told.node(end).expect("a node told of")));
        for [a, b] in nodes {
            let clear_m = self.clear_m(a.at_m, b.at_m);
            let least_m = self.site.scenario.params.r_body_m;
            assert!(clear_m > least_m - 0.003, "an edge passes a wall at {clear_m} m");
        }
        for robot in &frame.robots {
            assert_eq!((robot.wall_contacts, robot.robot_contacts), (0, 0), "at {} s", frame.time_s());
        }
        self.first.get_or_insert_with(|| frame.clone());
        self.last.clone_from(frame);
        Ok(())
    }
}

impl Inspector<'_> {
    /// Least distance of a straight line from the walls, to 2.5 mm.
    fn clear_m(&self, a: [f32; 2], b: [f32; 2]) -> f32 {
        let (a, b) = (glam::Vec2::from(a), glam::Vec2::from(b));
        let steps = (a.distance(b) / 0.005).ceil().max(1.0) as u32;
        let at = |i| a.lerp(b, i as f32 / steps as f32);
        (0..=steps).map(|i| self.site.map.clearance_m(at(i))).fold(f32::INFINITY, f32::min)
    }

    fn hubs_told(&self) -> Vec<(u16, u32)> {
        let is_hub = |node: &&uchain_sim::mission::explore::NodeFrame| {
            ExploreHistory::frontiers(node).next().is_some()
        };
        let mut hubs: Vec<_> =
            self.told.nodes.iter().filter(is_hub).map(|node| (node.id.robot, node.id.number)).collect();
        hubs.sort_unstable();
        hubs
    }
}

fn inspect(name: &str, sets: &[&str], seed: u64) {
    let site = site(name, sets);
    let mut exploration = Exploration::start(site.clone(), seed);
    let mut inspector = Inspector {
        site: &site,
        told: ExploreHistory::default(),
        first: None,
        last: ExploreFrame::default(),
    };
    let stopped = loop {
        let stopped = exploration.step(&mut inspector).expect("nobody stops it");
        if inspector.last.decision {
            let hubs: Vec<_> =
                exploration.team().whole().hubs().map(|hub| (hub.node.robot, hub.node.number)).collect();
            assert_eq!(hubs, inspector.hubs_told(), "the hub list is the list of nodes with a frontier");
            let all_parked = inspector.last.robots.iter().all(|robot| robot.purpose == Purpose::Park);
            assert_eq!(stopped.is_some(), all_parked, "it is over when all are parked");
            assert!(!all_parked || hubs.is_empty(), "no frontier is left");
        }
        if let Some(stopped) = stopped {
            break stopped;
        }
    };
    assert_eq!(stopped, Stopped::Explored);
    for i in 0..site.scenario.team.robots {
        let home = uchain_core::explore::NodeId { robot: i, number: 0 };
        let (robot, home) = (inspector.last.robots[usize::from(i)], inspector.told.node(home).unwrap());
        assert_eq!([robot.x_m, robot.y_m], home.at_m, "robot {i} is home");
    }
}

#[test]
fn labels_edges_hubs_and_the_end_are_right_at_every_tick() {
    std::thread::scope(|scope| {
        for map in ["apartment", "corridors"] {
            scope.spawn(move || {
                for (i, strategy) in ["cssg", "cssg-random", "srg"].into_iter().enumerate() {
                    for robots in [1, 2, 3, 6] {
                        let strategy = format!("explore.strategy={strategy}");
                        inspect(map, &[&strategy, &format!("explore.robots={robots}")], 7 + i as u64);
                    }
                }
                inspect(map, &["explore.edges=eq8", "explore.robots=1"], 1);
            });
        }
    });
}

#[test]
fn where_all_walls_are_at_the_scans_range_one_scan_is_enough_or_a_few_moves_are() {
    // A wall at exactly R_s from the robot, and a hair on either side of it.
    for half_m in ["1.0999", "1.1", "1.1001", "1.12"] {
        let h: f64 = half_m.parse().unwrap();
        let text = format!(
            "name = \"cell\"\nduration_s = 600.0\n[map.walls]\nouter_m = [[-{h}, -{h}], [{h}, -{h}], [{h}, {h}], [-{h}, \
             {h}]]\n[explore]\nrobots = 1\nspawns_m = [[0.0, 0.0]]\n"
        );
        let source = uchain_sim::config::Source { label: "cell.toml".into(), text, folder: "".into() };
        let site = Site::read(&source, &[]).unwrap();
        let summary = super::summary(&site, 1);
        assert_eq!(summary.stopped, Some(Stopped::Explored), "{half_m}");
        assert!(summary.iterations < 60, "{half_m}: {}", summary.iterations);
    }
}
