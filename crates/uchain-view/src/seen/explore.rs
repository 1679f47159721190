//! What there is to see of an exploration.

use serde::Serialize;
use serde_json::{Value, json};
use uchain_core::explore::Purpose;
use uchain_sim::{
    mission::{
        Mission as _, Scene as _, Stopped,
        explore::{Exploration, ExploreFrame, ExploreMetrics, RobotFrame, Site},
    },
    pilot::Asked,
    run::InputOf,
};

use super::{Viewed, graph::Graph, whole_text};
use crate::{
    problem::Problem,
    told::{Input, Since},
};

#[derive(Serialize)]
struct FrameView {
    tick: u64,
    time_s: f64,
    exact: bool,
    decision: bool,
    rounds: u32,
    hubs: u32,
    stopped: Option<Stopped>,
    robots: Vec<RobotView>,
}

#[derive(Serialize)]
struct RobotView {
    x_m: f32,
    y_m: f32,
    z_m: f32,
    heading_rad: f32,
    level: u16,
    purpose: &'static str,
    moves: bool,
    holds: bool,
    mfl: bool,
    to_m: Option<[f32; 2]>,
    wall_contacts: u32,
    robot_contacts: u32,
    level_passes: u32,
}

/// Rounds are rare: ways are drawn by two places a second.
const ROW_TICKS: u64 = 10;

impl Viewed for Site {
    type Extra = Graph;
    type Read = ();

    fn of_its_kind(&self) -> (&'static str, Value) {
        let (params, team) = (&self.scenario.params, &self.scenario.team);
        let levels: Vec<f32> = (0..8).map(|level| params.height_m(level)).collect();
        let exploration = json!({
            "strategy": params.strategy.word(),
            "sectors": params.sectors,
            "first_rad": 0.0,
            "range_m": params.r_s_m,
            "level_z_m": levels,
            "v_mps": team.v_mps,
            "spawns_m": self.spawns.iter().map(uchain_sim::glam::Vec2::to_array).collect::<Vec<_>>(),
        });
        ("exploration", exploration)
    }

    fn radius_m(&self) -> f32 {
        self.scenario.params.r_body_m
    }

    fn input(_: Input) -> Result<InputOf<Self>, Problem> {
        Err(Problem::new("robots that explore have no pilot: they decide for themselves"))
    }

    fn shown(input: &InputOf<Self>) -> Option<Input> {
        match *input {}
    }

    fn to_text(&self, _: &[Asked<InputOf<Self>>]) -> Result<String, Problem> {
        whole_text(self)
    }

    fn columns(&self) -> Vec<String> {
        let all = ["time_s", "coverage", "hubs", "rounds", "moving"].map(str::to_owned);
        let each = |robot| ["x_m", "y_m", "z_m"].map(|name| format!("{name}.{robot}"));
        all.into_iter().chain((0..self.crew()).flat_map(each)).collect()
    }

    fn is_row(frame: &ExploreFrame) -> bool {
        frame.decision || frame.tick.is_multiple_of(ROW_TICKS) || frame.stopped.is_some()
    }

    fn row(&self, frame: &ExploreFrame, metrics: &ExploreMetrics, to: &mut Vec<f32>) {
        let moving = frame.robots.iter().filter(|robot| robot.moves).count();
        to.extend([
            frame.time_s() as f32,
            metrics.coverage() as f32,
            frame.hubs as f32,
            frame.rounds as f32,
            moving as f32,
        ]);
        to.extend(frame.robots.iter().flat_map(|robot| [robot.x_m, robot.y_m, robot.z_m]));
    }

    fn read_on((): &mut (), _: &ExploreFrame) {}

    fn kept(frame: &ExploreFrame, (): &()) -> ExploreFrame {
        // What is new in the graph is kept by itself.
        ExploreFrame {
            tick: frame.tick,
            rounds: frame.rounds,
            decision: frame.decision,
            robots: frame.robots.clone(),
            hubs: frame.hubs,
            stopped: frame.stopped,
            ..ExploreFrame::default()
        }
    }

    fn bytes(frame: &ExploreFrame) -> usize {
        size_of::<ExploreFrame>() + size_of_val(&frame.robots[..])
    }

    fn frame_json(&self, frame: &ExploreFrame, graph: &Graph, exact: bool) -> Result<String, Problem> {
        let robot = |(i, robot): (usize, &RobotFrame)| RobotView {
            x_m: robot.x_m,
            y_m: robot.y_m,
            z_m: robot.z_m,
            heading_rad: robot.heading_rad,
            level: robot.level,
            purpose: robot.purpose.word(),
            moves: robot.moves,
            holds: robot.holds,
            mfl: robot.mfl,
            to_m: graph.next_m(frame.tick, i).filter(|_| robot.moves),
            wall_contacts: robot.wall_contacts,
            robot_contacts: robot.robot_contacts,
            level_passes: robot.level_passes,
        };
        let view = FrameView {
            tick: frame.tick,
            time_s: frame.time_s(),
            exact,
            decision: frame.decision,
            rounds: frame.rounds,
            hubs: frame.hubs,
            stopped: frame.stopped,
            robots: frame.robots.iter().enumerate().map(robot).collect(),
        };
        serde_json::to_string(&view).map_err(Problem::new)
    }

    fn why(&self, exploration: &Exploration, (): &(), robot: usize) -> Result<Value, Problem> {
        let frame = exploration.frame();
        let Some(now) = frame.robots.get(robot) else {
            let last = frame.robots.len().saturating_sub(1);
            return Err(Problem::new(format!("there is no robot {robot}: expected 0 to {last}")));
        };
        let strategy = self.scenario.params.strategy.word();
        let mut words = vec![match now.purpose {
            Purpose::Explore => format!("It flies to a frontier that it sees, chosen by {strategy}."),
            Purpose::Backtrack => {
                "No frontier is in sight: it flies back along the graph to the nearest one that nobody else takes.".to_owned()
            }
            Purpose::Home => "No frontier is left for it: it flies home along the graph.".to_owned(),
            Purpose::Park => "It is home, and nothing is left to do.".to_owned(),
            Purpose::Wait => "It waits: what is left is taken by others.".to_owned(),
        }];
        if now.holds {
            words.push("It holds this round to let another robot pass.".to_owned());
        }
        if now.mfl {
            words.push(format!("Its way crosses another robot's: it keeps clear on level {}.", now.level));
        }
        Ok(json!({
            "reached": true,
            "tick": frame.tick,
            "uav": robot,
            "words": words,
            "purpose": now.purpose.word(),
            "level": now.level,
            "holds": now.holds,
            "mfl": now.mfl,
        }))
    }

    fn graph(graph: &Graph, from: Since) -> Value {
        graph.since(from)
    }
}
