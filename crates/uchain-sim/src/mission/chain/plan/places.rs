//! Where the relays stand.

use glam::Vec2;
use serde::Serialize;

use super::Plan;
use crate::{map::Map, mission::chain::Course};

/// Where a relay stands when the head is where it is to go.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Place {
    /// Which relay, counted from 1 in the order of their take-offs: the first is next to the head.
    pub relay: usize,
    /// Place in the map file's own frame (m).
    pub x_m: f64,
    /// The same.
    pub y_m: f64,
    /// How far along the tunnel it is from the base (m).
    pub depth_m: f64,
    /// Loss of its link toward the base (dB).
    pub link_db: f64,
    /// Loss of its link toward the head (dB).
    pub front_db: f64,
    /// By how much the worse of the two stays within the limit (dB).
    pub margin_db: f64,
    /// When it takes off (min, from the head's take-off).
    pub launch_min: Option<f64>,
    /// For how long it flies until it is home again (min).
    pub airborne_min: Option<f64>,
    /// What is left of its battery then, the reserve not counted (min): negative where it does not last.
    pub spare_min: Option<f64>,
}

pub(super) fn places(course: &Course, plan: &Plan, goal_m: f64) -> Vec<Place> {
    let best = course.optimum().and_then(|optimum| Some((optimum, optimum.links_needed(goal_m)?)));
    let Some((optimum, links)) = best else { return Vec::new() };
    let chain = optimum.optimum(goal_m, links);
    let between = chain.link_loss_db.windows(2).zip(chain.depths_m.iter().skip(1)).enumerate();
    let place = |(ahead, (links_db, &depth_m)): (usize, (&[f64], &f64))| {
        let &[front_db, link_db] = links_db else { return None };
        let relay = ahead + 1;
        let [x_m, y_m] = in_own_frame(&course.map, optimum.tunnel().at(depth_m).0);
        let battery = plan.batteries.as_ref().and_then(|batteries| batteries.uavs.get(relay));
        Some(Place {
            relay,
            x_m,
            y_m,
            depth_m,
            link_db,
            front_db,
            margin_db: plan.s_min_db - front_db.max(link_db),
            launch_min: battery.map(|battery| battery.launch_min),
            airborne_min: battery.map(|battery| battery.airborne_min),
            spare_min: battery.map(|battery| battery.spare_min),
        })
    };
    between.filter_map(place).collect()
}

/// A place of the map frame in the map file's own (m).
pub(super) fn in_own_frame(map: &Map, at: Vec2) -> [f64; 2] {
    let [x_m, y_m] = map.offset_m();
    [f64::from(at.x) + x_m, f64::from(at.y) + y_m]
}
