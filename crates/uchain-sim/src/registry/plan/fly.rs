//! A plan flown: does the chain get there, and when?

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use glam::Vec2;
#[cfg(feature = "sweep")]
use rayon::prelude::*;
use uchain_core::chain::{Follow, PilotInput};

use crate::{
    clock::time_s,
    map::Tunnel,
    mission::chain::{
        Course, FlightEnd, Flown, FlownRun, Frame, HeadFrame, PilotStep, Plan, Scenario, Spawn, UavFrame,
    },
    record::{RecordError, Recorder},
    run::{RunError, run_with},
};

/// How much longer than planned a flight may take (1), and time for the chain to level at the end (s): ours.
const LONGER: f64 = 1.5;
const LEVEL_S: f64 = 60.0;
const LONGEST_S: f64 = 86_400.0;
/// Nearer than this to its goal the head is there (m).
const THERE_M: f64 = 0.5;
/// Who is farther from the middle than this is in another passage (m).
const ASTRAY_M: f32 = 3.0;
/// Ticks of a minute.
const MINUTE_TICKS: u32 = 1200;
/// The link holds the head back where it leaves it less than this share of the speed that the pilot asks for (1).
const HELD_SHARE: f32 = 0.5;
/// Who comes less far in a minute does not move (m).
const STUCK_M: f64 = 1.0;
/// How far ahead the pilot looks on his map (m), and by how much the way has to turn there for him to keep to a wall (rad).
const AHEAD_M: f64 = 1.2;
const TURN_RAD: f32 = 0.35;
/// Room between waiting UAVs besides their bodies, and between them and a wall (m).
const ROOM_M: f32 = 0.03;

/// A plan as it is flown: as many UAVs as were planned, and a pilot who has the map. He asks for the planned speed, keeps to
/// the wall on the side to which the way turns, and stops at the goal.
#[derive(Debug)]
pub struct PlanFlight {
    course: Arc<Course>,
    goal_m: f64,
    speed_mps: f32,
}

/// Why a plan cannot be flown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFlightError {
    /// It says not how many UAVs, or how fast.
    #[error("a plan that {0} cannot be flown")]
    NoPlan(&'static str),
    /// There is no room.
    #[error("{uavs} UAVs find no room to wait near the base: {found} do")]
    NoRoom {
        /// Who is to wait.
        uavs: usize,
        /// Who can.
        found: usize,
    },
    /// The head stops before the first relay takes off.
    #[error(
        "{key} = {got_db} is no more than takeoff.s_min_db = {s_min_db}: no relay would take off; try --set {key}={better_db}"
    )]
    Thresholds {
        /// The threshold.
        key: &'static str,
        /// What it is (dB).
        got_db: f32,
        /// The limit (dB).
        s_min_db: f32,
        /// What it could be (dB).
        better_db: f32,
    },
    /// The flight itself.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl PlanFlight {
    /// A plan for this course, ready to be flown.
    ///
    /// # Errors
    /// [`PlanFlightError`], but for the last.
    pub fn new(course: &Course, plan: &Plan) -> Result<Self, PlanFlightError> {
        let goal = plan.rows.last().zip(course.tunnel.as_ref());
        let Some((goal, tunnel)) = goal else { return Err(PlanFlightError::NoPlan("has no tunnel")) };
        let Some(uavs) = plan.uavs_needed else {
            return Err(PlanFlightError::NoPlan("finds no number of relays"));
        };
        let Some((there_min, speed_mps)) = goal.time_min.zip(plan.speed_mps) else {
            return Err(PlanFlightError::NoPlan("has a head that does not fly forward"));
        };
        thresholds(&course.scenario, uavs)?;
        let mut flown = course.clone();
        flown.spawns = waiting(course, tunnel, uavs)?;
        let scenario = &mut flown.scenario;
        let [x_m, y_m] = course.map.offset_m();
        let own = |spawn: &Spawn| [f64::from(spawn.at.x) + x_m, f64::from(spawn.at.y) + y_m];
        scenario.chain.uavs = uavs;
        scenario.chain.spawns_m = Some(flown.spawns.iter().map(own).collect());
        let duration_s = (LONGER * 60.0 * there_min + LEVEL_S).min(LONGEST_S);
        scenario.duration_s = duration_s.ceil();
        let speed_mps = speed_mps as f32;
        scenario.pilot = vec![PilotStep { start_s: 0.0, speed_mps, follow: Follow::Centre }];
        Ok(Self { course: Arc::new(flown), goal_m: goal.depth_m, speed_mps })
    }

    /// The scenario that is flown; its script flies straight on, where the pilot who has the map turns and stops.
    pub fn scenario(&self) -> &Scenario {
        &self.course.scenario
    }

    /// Flies these seeds, and sums them up. `go_on` is asked now and then, and told how many flights are over.
    ///
    /// # Errors
    /// [`PlanFlightError::Run`]: nobody wants it any more.
    pub fn fly(&self, seeds: u64, go_on: &(dyn Fn(usize) -> bool + Sync)) -> Result<Flown, PlanFlightError> {
        let done = AtomicUsize::new(0);
        let one = |seed: u64| {
            let run = self.one(seed, &|| go_on(done.load(Ordering::Relaxed)))?;
            done.fetch_add(1, Ordering::Relaxed);
            go_on(done.load(Ordering::Relaxed));
            Ok(run)
        };
        #[cfg(feature = "sweep")]
        let runs: Result<Vec<FlownRun>, RunError> = (1..=seeds).into_par_iter().map(one).collect();
        #[cfg(not(feature = "sweep"))]
        let runs: Result<Vec<FlownRun>, RunError> = (1..=seeds).map(one).collect();
        let scenario = &self.course.scenario;
        Ok(Flown::of(scenario.duration_s, scenario.chain.uavs, runs?))
    }

    fn one(&self, seed: u64, go_on: &dyn Fn() -> bool) -> Result<FlownRun, RunError> {
        let tunnel = self.course.tunnel.as_ref();
        let mut way = Way::default();
        let mut pilot = |tick: u64, last: &Frame| {
            let head = last.uavs.get(last.leader);
            let asked = head.zip(tunnel).map(|(head, tunnel)| {
                let depth_m = way.watch(last, head, tunnel);
                if way.there_s.is_none() && way.reach_m >= self.goal_m - THERE_M {
                    way.there_s = Some(time_s(tick));
                }
                let speed_mps = if way.there_s.is_some() { 0.0 } else { self.speed_mps };
                PilotInput { speed_mps, follow: side(tunnel, depth_m, head.heading_rad) }
            });
            asked.filter(|_| tick.is_multiple_of(DECISION_TICKS))
        };
        let summary = run_with(&self.course, seed, &mut pilot, &mut Watched(go_on))?.summary;
        Ok(FlownRun {
            seed: Some(seed),
            reach_m: way.reach_m,
            there_min: way.there_s.map(|there_s| there_s / 60.0),
            relays: summary.launches_s.len().saturating_sub(1),
            worst_link_db: summary.worst_link_db.map(f64::from),
            connected_fraction: summary.connected_fraction.unwrap_or_default(),
            contacts: summary.wall_contacts + summary.uav_contacts,
            ended: Some(way.end()),
            head_m: Some(self.course.map.to_file(way.at)),
        })
    }
}

/// How the head gets on along the way.
#[derive(Debug, Default)]
struct Way {
    reach_m: f64,
    there_s: Option<f64>,
    at: Vec2,
    is_astray: bool,
    /// Ticks of the minute that runs, those in which the link held the head back, and how deep it was at its start (m).
    minute: Minute,
    last: Minute,
}

#[derive(Debug, Default, Clone, Copy)]
struct Minute {
    ticks: u32,
    held: u32,
    from_m: f64,
}

impl Way {
    /// Takes in one instant; says how deep the head is (m).
    fn watch(&mut self, frame: &Frame, head: &UavFrame, tunnel: &Tunnel) -> f64 {
        let at = Vec2::new(head.x_m, head.y_m);
        let depth_m = tunnel.depth_m(at);
        let (middle, _) = tunnel.at(depth_m);
        self.at = at;
        self.is_astray = middle.distance(at) >= ASTRAY_M;
        if head.airborne && !self.is_astray {
            self.reach_m = self.reach_m.max(depth_m);
        }
        if self.minute.ticks >= MINUTE_TICKS {
            self.last = self.minute;
            self.minute = Minute { from_m: self.reach_m, ..Minute::default() };
        }
        self.minute.ticks += 1;
        let is_held = |head: &HeadFrame| head.allowed_mps < HELD_SHARE * head.pilot_mps;
        self.minute.held += u32::from(frame.head.as_ref().is_some_and(is_held));
        depth_m
    }

    /// How it ended, by the last whole minute and what came after it.
    fn end(&self) -> FlightEnd {
        let (ticks, held) = (self.last.ticks + self.minute.ticks, self.last.held + self.minute.held);
        if self.there_s.is_some() {
            FlightEnd::Arrived
        } else if self.is_astray {
            FlightEnd::Astray
        } else if 2 * held > ticks {
            FlightEnd::HeldByLink
        } else if self.reach_m - self.last.from_m < STUCK_M {
            FlightEnd::Stuck
        } else {
            FlightEnd::UnderWay
        }
    }
}

/// The pilot thinks as often as the chain (ticks).
const DECISION_TICKS: u64 = 4;

/// The wall to keep to: that on the side to which the way turns.
fn side(tunnel: &Tunnel, depth_m: f64, heading_rad: f32) -> Follow {
    let (here, there) = (tunnel.at(depth_m).0, tunnel.at(depth_m + AHEAD_M).0);
    let ahead = there - here;
    let turn_rad = Vec2::new(libm::cosf(heading_rad), libm::sinf(heading_rad)).angle_to(ahead);
    match turn_rad {
        turn_rad if turn_rad > TURN_RAD => Follow::Left,
        turn_rad if turn_rad < -TURN_RAD => Follow::Right,
        _ => Follow::Centre,
    }
}

/// Ends a run that nobody wants any more; asked once a simulated second.
struct Watched<'a>(&'a dyn Fn() -> bool);

impl Recorder<Frame> for Watched<'_> {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if !frame.tick.is_multiple_of(20) || (self.0)() {
            return Ok(());
        }
        Err(RecordError::Interrupted { time_s: frame.time_s() })
    }
}

/// The head and the relays turn round only beyond the limit.
fn thresholds(scenario: &Scenario, uavs: usize) -> Result<(), PlanFlightError> {
    let s_min_db = scenario.takeoff.s_min_db;
    let all = [
        ("link.head_stop_db", scenario.link.head_stop_db),
        ("link.relay_back_db", scenario.link.relay_back_db),
    ];
    let wrong = all.into_iter().find(|(_, got_db)| uavs > 1 && *got_db <= s_min_db);
    let Some((key, got_db)) = wrong else { return Ok(()) };
    let above_db = if key == "link.head_stop_db" { 10.0 } else { 20.0 };
    Err(PlanFlightError::Thresholds { key, got_db, s_min_db, better_db: s_min_db + above_db })
}

/// Where so many UAVs wait: as the scenario says, as far as its places go; else as near to the base as they find room, the
/// head deepest.
fn waiting(course: &Course, tunnel: &Tunnel, uavs: usize) -> Result<Vec<Spawn>, PlanFlightError> {
    if uavs <= course.spawns.len() {
        return Ok(course.spawns[course.spawns.len() - uavs..].to_vec());
    }
    let radius_m = course.scenario.motion.radius_m;
    let step_m = 2.0 * (radius_m + ROOM_M);
    let mut found: Vec<Spawn> = Vec::with_capacity(uavs);
    let most = (4 * uavs).min((tunnel.length_m() / f64::from(step_m)) as usize + 1);
    for row in 0..most {
        let (middle, heading_rad) = tunnel.at(row as f64 * f64::from(step_m));
        let aside = Vec2::new(-libm::sinf(heading_rad), libm::cosf(heading_rad));
        for place in [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0] {
            let at = middle + aside * (place * step_m);
            let is_free = !course.map.in_rock(at) && course.map.clearance_m(at) >= radius_m + ROOM_M;
            let is_apart = || found.iter().all(|other| other.at.distance(at) >= step_m * 0.999);
            if found.len() < uavs
                && is_free
                && is_apart()
                && course.from_base.leads_to(&course.map, std::iter::empty(), at)
            {
                found.push(Spawn { at, heading_rad });
            }
        }
    }
    if found.len() < uavs {
        return Err(PlanFlightError::NoRoom { uavs, found: found.len() });
    }
    found.reverse();
    Ok(found)
}
