//! Places in a tunnel, checked one after the other: the base, the goal, where UAVs wait.

use glam::Vec2;

use super::{Scenario, Spawn};
use crate::{
    config::{ConfigError, Document},
    map::{CentreLine, Map, Tunnel},
    scene::{in_rock, refuse, room_near, to_a_micrometre},
};

/// A goal nearer to a wall than this is on it (m).
const ON_A_WALL_M: f32 = 1e-3;

/// Where a UAV is to wait, in the scenario's frame, and the key that says so.
pub(super) struct Place {
    pub(super) key: String,
    pub(super) got: String,
    pub(super) at_m: [f64; 2],
}

/// One place per UAV, head first.
pub(super) fn waiting_places(scenario: &Scenario) -> Vec<Place> {
    let chain = &scenario.chain;
    if let Some(places) = &chain.spawns_m {
        let place = |(i, &at_m): (usize, &[f64; 2])| Place {
            key: format!("chain.spawns_m.{i}"),
            got: format!("[{}, {}]", at_m[0], at_m[1]),
            at_m,
        };
        return places.iter().enumerate().map(place).collect();
    }
    let (sin, cos) = libm::sincosf(chain.heading_deg.to_radians());
    let [x_m, y_m] = chain.base_m;
    let place = |index: usize| {
        let along_m = chain.spacing_m * (chain.uavs - 1 - index) as f32;
        let at_m = [x_m + f64::from(along_m * cos), y_m + f64::from(along_m * sin)];
        if index + 1 == chain.uavs {
            return Place { key: "chain.base_m".to_owned(), got: format!("[{x_m}, {y_m}]"), at_m };
        }
        Place { key: "chain.spacing_m".to_owned(), got: chain.spacing_m.to_string(), at_m }
    };
    (0..chain.uavs).map(place).collect()
}

/// Checks one place after the other.
pub(super) struct Spots<'a> {
    pub(super) map: &'a Map,
    pub(super) radius_m: f32,
    pub(super) document: &'a Document<'a>,
}

impl Spots<'_> {
    pub(super) fn invalid(&self, key: &str, got: &str, expected: String) -> ConfigError {
        let got = self.document.written(key).unwrap_or_else(|| got.to_owned());
        ConfigError::Invalid { at: self.document.origin(key), key: key.to_owned(), got, expected }
    }

    /// The tunnel from the base on, to the goal if there is one.
    pub(super) fn tunnel(
        &self,
        scenario: &Scenario,
        line: Option<CentreLine>,
        base: Vec2,
    ) -> Result<Option<Tunnel>, ConfigError> {
        let heading_rad = scenario.chain.heading_deg.to_radians();
        let Some([x_m, y_m]) = scenario.chain.goal_m else {
            return Ok(line.map(|line| Tunnel::new(line, base, heading_rad)));
        };
        let goal = self.map.to_local([x_m, y_m]);
        let wrong =
            |expected: &str| Err(self.invalid("chain.goal_m", &format!("[{x_m}, {y_m}]"), expected.into()));
        if let Some(in_rock) = in_rock(self.map, goal) {
            let room = room_near(self.map, goal, self.radius_m);
            return wrong(&format!("the goal is {in_rock}; expected free space{room}"));
        }
        if self.map.clearance_m(goal) < ON_A_WALL_M {
            let room = room_near(self.map, goal, self.radius_m);
            return wrong(&format!("the goal is on a wall; expected free space{room}"));
        }
        let Some(line) = line else {
            let path = self.map.tunnel_between(base, goal, self.radius_m);
            let line = path.map_err(|cause| refuse(self.document, "chain.goal_m", cause))?;
            let (_, heading_rad) = line.at(0.0);
            return Ok(Some(Tunnel::new(line, base, heading_rad)));
        };
        let tunnel = Tunnel::new(line, base, heading_rad);
        let depth_m = tunnel.depth_m(goal);
        if depth_m <= 0.0 {
            return wrong("the goal lies behind the base; expected one ahead, as chain.heading_deg points");
        }
        Ok(Some(tunnel.until(depth_m)))
    }

    pub(super) fn stands_free(
        &self,
        index: usize,
        place: &Place,
        at: Vec2,
        others: &[Spawn],
    ) -> Result<(), ConfigError> {
        let [x_m, y_m] = place.at_m.map(to_a_micrometre);
        let uav = format!("UAV {index} would wait at ({x_m}, {y_m}) m");
        let wrong = |expected| Err(self.invalid(&place.key, &place.got, expected));
        if let Some(in_rock) = in_rock(self.map, at) {
            return wrong(format!("{uav}, which is {in_rock}; expected free space"));
        }
        let radius_m = self.radius_m;
        let clearance_m = self.map.clearance_m(at);
        if clearance_m < radius_m {
            return wrong(format!(
                "{uav}, {clearance_m:.3} m from a wall; expected at least its radius, {radius_m} m"
            ));
        }
        for (other, spawn) in others.iter().enumerate() {
            let apart_m = spawn.at.distance(at);
            if apart_m < 2.0 * radius_m {
                return wrong(format!(
                    "{uav}, {apart_m:.3} m from UAV {other}; expected at least two radii, {} m",
                    2.0 * radius_m
                ));
            }
        }
        Ok(())
    }
}
