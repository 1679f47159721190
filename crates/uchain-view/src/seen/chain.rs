//! What there is to see of a chain.

use serde::Serialize;
use serde_json::{Value, json};
use uchain_core::chain::{Doing, LaunchHold, Override, PilotInput, Tof, WallSide, Walls};
use uchain_sim::{
    clock::period_ticks,
    mission::{
        Scene as _,
        chain::{Chain, Course, Frame, LinkFrame, Metrics, Moment, PilotStep, UavFrame},
    },
    pilot::Asked,
};

use super::{Viewed, whole_text, why};
use crate::{
    problem::Problem,
    told::{Input, Since},
};

#[derive(Serialize)]
struct FrameView<'a> {
    tick: u64,
    time_s: f64,
    exact: bool,
    decision: bool,
    leader: usize,
    head_reach_m: f32,
    head: Option<HeadView>,
    uavs: Vec<UavView>,
    links: Vec<LinkView<'a>>,
}

#[derive(Serialize)]
#[expect(clippy::struct_field_names, reason = "they are speeds, and say so on the page")]
struct HeadView {
    pilot_mps: f32,
    allowed_mps: f32,
    asked_mps: f32,
}

#[derive(Serialize)]
struct UavView {
    x_m: f32,
    y_m: f32,
    heading_rad: f32,
    forward_mps: f32,
    lateral_mps: f32,
    airborne: bool,
    wall_contacts: u32,
    uav_contacts: u32,
    tof: Option<TofView>,
    doing: Option<DoingView>,
}

/// What it is about.
#[derive(Serialize)]
struct DoingView {
    overridden: Option<&'static str>,
    follow: &'static str,
    walls: Option<&'static str>,
    pushed_by: Option<&'static str>,
    launch: Option<&'static str>,
}

impl From<Doing> for DoingView {
    fn from(doing: Doing) -> Self {
        let held = |held| match held {
            None => "armed",
            Some(LaunchHold::Ahead) => "held: the UAV ahead has not flown for long enough",
            Some(LaunchHold::Unlevelled) => "held: the flying chain has not levelled",
            Some(LaunchHold::Silent) => "held: nothing is heard of the chain",
        };
        Self {
            overridden: doing.overridden.map(Override::word),
            follow: doing.follow.word(),
            walls: doing.walls.map(Walls::word),
            pushed_by: doing.pushed_by.map(|side| if side == WallSide::Left { "left" } else { "right" }),
            launch: doing.launch.map(|launch| held(launch.held)),
        }
    }
}

#[derive(Serialize)]
#[expect(clippy::struct_field_names, reason = "they are distances, and say so on the page")]
struct TofView {
    nw_m: f32,
    ne_m: f32,
    sw_m: f32,
    se_m: f32,
}

#[derive(Serialize)]
struct LinkView<'a> {
    uav: usize,
    /// The UAV at its other end; nobody where that is the base.
    behind: Option<&'a usize>,
    true_db: f32,
    filtered_db: Option<f32>,
    raw_db: Option<f32>,
    front_silence_s: Option<f32>,
    rear_silence_s: Option<f32>,
    heard: Option<bool>,
}

impl From<&UavFrame> for UavView {
    fn from(uav: &UavFrame) -> Self {
        let tof = |Tof { nw_m, ne_m, sw_m, se_m }| TofView { nw_m, ne_m, sw_m, se_m };
        Self {
            x_m: uav.x_m,
            y_m: uav.y_m,
            heading_rad: uav.heading_rad,
            forward_mps: uav.forward_mps,
            lateral_mps: uav.lateral_mps,
            airborne: uav.airborne,
            wall_contacts: uav.wall_contacts,
            uav_contacts: uav.uav_contacts,
            tof: uav.tof.filter(|_| uav.airborne).map(tof),
            doing: uav.doing.map(DoingView::from),
        }
    }
}

/// What a UAV's sensors read last, and what it was about at its last decision.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Last {
    pub(super) tof: Option<Tof>,
    pub(super) doing: Option<Doing>,
}

/// The numbers of a UAV over time.
const OF_EACH: [&str; 5] = ["x_m", "y_m", "true_db", "filtered_db", "raw_db"];

impl Viewed for Course {
    type Extra = ();
    type Read = Vec<Last>;

    fn of_its_kind(&self) -> (&'static str, Value) {
        let s = &self.scenario;
        let spawns: Vec<Value> = self
            .spawns
            .iter()
            .map(|spawn| json!({ "at_m": spawn.at.to_array(), "heading_rad": spawn.heading_rad }))
            .collect();
        let step = |step: &PilotStep| json!({ "start_s": step.start_s, "speed_mps": step.speed_mps, "follow": step.follow });
        let chain = json!({
            "base_m": self.base.to_array(),
            "goal_m": s.chain.goal_m.map(|goal_m| self.map.to_local(goal_m).to_array()),
            "s_min_db": s.takeoff.s_min_db,
            "limit_db": s.packets.limit_db,
            "lost_s": s.link.lost_s,
            "tof_range_m": s.tof.range_m,
            "v_max_mps": s.equalize.v_max_mps,
            "decision_ticks": period_ticks(s.equalize.decision_s),
            "spawns": spawns,
            "pilot": s.pilot.iter().map(step).collect::<Vec<_>>(),
        });
        ("chain", chain)
    }

    fn radius_m(&self) -> f32 {
        self.scenario.motion.radius_m
    }

    fn input(Input { speed_mps, follow }: Input) -> Result<PilotInput, Problem> {
        let input = PilotInput { speed_mps, follow };
        let refused = |why| Problem::new(format!("the pilot's input: {why}"));
        PilotStep::from(Asked { tick: 0, input }).check().map_err(refused)?;
        Ok(input)
    }

    fn shown(input: &PilotInput) -> Option<Input> {
        Some(Input { speed_mps: input.speed_mps, follow: input.follow })
    }

    fn to_text(&self, inputs: &[Asked<PilotInput>]) -> Result<String, Problem> {
        if inputs.is_empty() {
            return whole_text(self);
        }
        self.scenario.by_hand(inputs).to_toml().map_err(Problem::new)
    }

    fn columns(&self) -> Vec<String> {
        let all = ["time_s", "head_reach_m", "worst_link_db", "spread_db"].map(str::to_owned);
        let each = |uav| OF_EACH.map(|name| format!("{name}.{uav}"));
        all.into_iter().chain((0..self.crew()).flat_map(each)).collect()
    }

    fn is_row(frame: &Frame) -> bool {
        frame.decision
    }

    fn row(&self, frame: &Frame, _: &Metrics, to: &mut Vec<f32>) {
        let moment = Moment::of(frame, f32::INFINITY);
        to.extend([
            frame.time_s() as f32,
            frame.head_reach_m,
            moment.worst_link_db.unwrap_or(f32::NAN),
            moment.spread_db.unwrap_or(f32::NAN),
        ]);
        let first = to.len();
        to.extend(frame.uavs.iter().flat_map(|uav| [uav.x_m, uav.y_m, f32::NAN, f32::NAN, f32::NAN]));
        for link in &frame.links {
            let losses = [Some(link.true_db), link.filtered_db, link.raw_db];
            let at = first + OF_EACH.len() * link.uav + 2;
            if let Some(places) = to.get_mut(at..at + losses.len()) {
                places
                    .iter_mut()
                    .zip(losses)
                    .for_each(|(place, loss_db)| *place = loss_db.unwrap_or(f32::NAN));
            }
        }
    }

    fn read_on(read: &mut Self::Read, frame: &Frame) {
        read.resize(frame.uavs.len(), Last::default());
        for (last, uav) in read.iter_mut().zip(&frame.uavs) {
            last.tof = uav.tof.or(last.tof).filter(|_| uav.airborne);
            last.doing = uav.doing.or(last.doing);
        }
    }

    fn kept(frame: &Frame, read: &Self::Read) -> Frame {
        let mut kept = frame.clone();
        for (uav, last) in kept.uavs.iter_mut().zip(read) {
            (uav.tof, uav.doing) = (last.tof, last.doing);
        }
        kept
    }

    fn bytes(frame: &Frame) -> usize {
        size_of::<Frame>() + size_of_val(&frame.uavs[..]) + size_of_val(&frame.links[..])
    }

    fn frame_json(&self, frame: &Frame, (): &(), exact: bool) -> Result<String, Problem> {
        let lost_s = self.scenario.link.lost_s;
        let behind = frame.links.iter().skip(1).map(|link| Some(&link.uav)).chain([None]);
        let link = |(link, behind): (&LinkFrame, _)| LinkView {
            uav: link.uav,
            behind,
            true_db: link.true_db,
            filtered_db: link.filtered_db,
            raw_db: link.raw_db,
            front_silence_s: link.silence.and_then(|silence| silence.front_s),
            rear_silence_s: link.silence.and_then(|silence| silence.rear_s),
            heard: link.is_heard(lost_s),
        };
        let view = FrameView {
            tick: frame.tick,
            time_s: frame.time_s(),
            exact,
            decision: frame.decision,
            leader: frame.leader,
            head_reach_m: frame.head_reach_m,
            head: frame.head.map(|head| HeadView {
                pilot_mps: head.pilot_mps,
                allowed_mps: head.allowed_mps,
                asked_mps: head.asked_mps,
            }),
            uavs: frame.uavs.iter().map(UavView::from).collect(),
            links: frame.links.iter().zip(behind).map(link).collect(),
        };
        serde_json::to_string(&view).map_err(Problem::new)
    }

    fn why(&self, chain: &Chain, read: &Self::Read, uav: usize) -> Result<Value, Problem> {
        why::why(self, chain, read.get(uav).copied().unwrap_or_default(), uav)
    }

    fn graph((): &(), _: Since) -> Value {
        json!({ "nodes": [], "labels": [], "edges": [] })
    }
}
