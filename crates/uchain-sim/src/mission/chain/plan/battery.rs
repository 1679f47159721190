//! Whose battery lasts until it is home again.
//!
//! The head flies in, stays, and flies back at the same speed; the chain shortens as it has grown: a relay is home when the head
//! comes back to where it was at that relay's take-off. So who took off first lands last, and flies longest.

use serde::Serialize;

use super::{Plan, PlanOptions, clock::Clock};

/// What a battery has to last for, UAV by UAV.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Batteries {
    /// How long a UAV may fly (min): `chain.endurance_s` less the reserve.
    pub usable_min: f64,
    /// When all are home again (min, from the head's take-off).
    pub home_min: f64,
    /// Whether the batteries of all last until then, the reserve untouched.
    pub all_home: bool,
    /// The greatest depth from which all come home (m), at most the depth asked for; `None` if there is none.
    pub home_from_m: Option<f64>,
    /// The speed at which the head would bring all home (m/s), whether or not it may fly so fast; `None` where all come
    /// home, or no speed would do.
    pub speed_needed_mps: Option<f64>,
    /// The `chain.endurance_s` with which all would come home (s), the reserve kept; `None` where all do.
    pub endurance_needed_s: Option<f64>,
    /// UAVs with fresh batteries that would have to take the places of those that are short, one after the other; `None` where
    /// all come home, or where not even who flies to the goal and back at once comes home.
    pub relief_uavs: Option<usize>,
    /// The head, then relay after relay.
    pub uavs: Vec<Battery>,
}

/// One UAV's flight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Battery {
    /// Which UAV: 0 is the head, 1 the first relay.
    pub uav: usize,
    /// When it takes off (min, from the head's take-off).
    pub launch_min: f64,
    /// For how long it has flown when the head is there (min).
    pub there_min: f64,
    /// When it is home again (min, from the head's take-off).
    pub home_min: f64,
    /// For how long it has flown by then (min).
    pub airborne_min: f64,
    /// What is left of its battery then, the reserve not counted (min): negative where it does not last.
    pub spare_min: f64,
}

impl Batteries {
    /// Those whose battery does not last: a run of UAVs from the head on, for who took off first lands last.
    pub fn short(&self) -> impl Iterator<Item = &Battery> {
        self.uavs.iter().filter(|one| one.spare_min < 0.0)
    }
}

pub(super) fn batteries(plan: &Plan, clock: &Clock, goal_m: f64, asked: &PlanOptions) -> Option<Batteries> {
    let (there_min, speed_mps) = (clock.time_min(goal_m)?, clock.speed_mps?);
    let usable_min = plan.endurance_s * (1.0 - asked.reserve) / 60.0;
    let one = |uav, launch_min: f64, from_m: f64| {
        let back_min = (goal_m - from_m).max(0.0) / speed_mps / 60.0;
        let home_min = there_min + asked.stay_s / 60.0 + back_min;
        let airborne_min = home_min - launch_min;
        let spare_min = usable_min - airborne_min;
        Battery { uav, launch_min, there_min: there_min - launch_min, home_min, airborne_min, spare_min }
    };
    let head = one(0, 0.0, clock.start_m);
    let relays = plan.launches.iter().map(|launch| {
        let launch_min = launch.time_min.unwrap_or_default();
        one(launch.relay, launch_min, launch.depth_m.max(clock.start_m))
    });
    let all_home = head.spare_min >= 0.0;
    let on_the_way_s = 60.0 * usable_min - clock.ready_s - asked.stay_s;
    let way_m = 2.0 * (goal_m - clock.start_m).max(0.0);
    let home_from_m = clock.turn_m(60.0 * usable_min, asked.stay_s).map(|turn_m| turn_m.min(goal_m));
    let uavs: Vec<Battery> = std::iter::once(head).chain(relays).collect();
    // Everybody's place is nearer than the goal: who gets there and back can relieve anybody.
    let gets_there = clock.turn_m(60.0 * usable_min, 0.0).is_some_and(|turn_m| turn_m >= goal_m);
    let turns = |one: &Battery| ((one.airborne_min / usable_min).ceil() - 1.0).max(0.0) as usize;
    let relief_uavs = (!all_home && gets_there).then(|| uavs.iter().map(turns).sum());
    Some(Batteries {
        usable_min,
        home_min: head.home_min,
        all_home,
        home_from_m,
        speed_needed_mps: (!all_home && on_the_way_s > 0.0).then(|| way_m / on_the_way_s),
        endurance_needed_s: (!all_home).then(|| 60.0 * head.airborne_min / (1.0 - asked.reserve)),
        relief_uavs,
        uavs,
    })
}
