//! Where a head could be sent to, for who has not said so.

use std::fmt;

use glam::Vec2;

use super::Course;
use crate::{
    map::{Map, MapError},
    mission::chain::PlanError,
};

/// The place that is farthest from the base along the middle of the passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Farthest {
    /// Place in the scenario's frame (m): `chain.goal_m`.
    pub at_m: [f64; 2],
    /// Length of the way there (m).
    pub way_m: f64,
}

impl fmt::Display for Farthest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { at_m: [x_m, y_m], way_m } = self;
        write!(
            f,
            "the farthest place from the base is [{x_m:.2}, {y_m:.2}], {way_m:.1} m away along the passages"
        )
    }
}

impl Course {
    /// Why there is no plan where nobody knows the middle of the tunnel, with a place to send the head to.
    pub(crate) fn no_tunnel(&self) -> PlanError {
        self.farthest().ok().flatten().map_or(PlanError::NoTunnel, PlanError::NoGoal)
    }

    /// The place that a UAV can fly to which is farthest from the base along the middle of the passages; `None` if there is
    /// no passage at the base that is wide enough.
    ///
    /// # Errors
    /// A map too large for the tunnel graph.
    pub fn farthest(&self) -> Result<Option<Farthest>, MapError> {
        Farthest::of(&self.map, self.base, self.scenario.motion.radius_m)
    }
}

impl Farthest {
    /// The same of a map alone, from a base in its frame, for who needs so much room on all sides (m).
    pub(crate) fn of(map: &Map, base: Vec2, radius_m: f32) -> Result<Option<Self>, MapError> {
        let tree = map.tunnel_graph()?.tree_for(map, base, radius_m);
        Ok(tree.deepest().filter(|&deepest| deepest > 0).map(|deepest| {
            let ([x, y], at) = (map.offset_m(), tree.at[deepest]);
            Self { at_m: [f64::from(at.x) + x, f64::from(at.y) + y], way_m: tree.depth_m[deepest] }
        }))
    }
}

#[cfg(test)]
mod tests {
    use crate::{config::builtin, mission::chain::Course};

    #[test]
    fn the_farthest_place_is_the_far_end_of_the_tunnel_in_the_scenarios_own_frame() {
        for (name, sets) in [
            (
                "straight",
                &["map.corridor.centre_line_m=[[5000,0],[5014,0]]", "chain.base_m=[5000.5,0]"] as &[&str],
            ),
            ("corner", &[]),
        ] {
            let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
            let course = Course::read(&builtin(name).unwrap(), &sets).unwrap();
            let farthest = course.farthest().unwrap().unwrap();
            let tunnel = course.tunnel.as_ref().unwrap();
            // Half the width before the end's wall the middle ends.
            assert!(
                (farthest.way_m - (tunnel.length_m() - 0.5)).abs() < 0.6,
                "{name}: {farthest:?} {}",
                tunnel.length_m()
            );
            let depth_m = tunnel.depth_m(course.map.to_local(farthest.at_m));
            assert!((depth_m - tunnel.length_m()).abs() < 0.6, "{name}: {farthest:?} {depth_m}");
        }
    }
}
