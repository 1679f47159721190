//! When the head is where.

use crate::mission::chain::Course;

/// When the head is where, if nothing stops it.
pub(super) struct Clock {
    pub(super) speed_mps: Option<f64>,
    pub(super) speed_asked_mps: Option<f64>,
    pub(super) ready_s: f64,
    pub(super) start_m: f64,
}

impl Clock {
    pub(super) fn new(course: &Course) -> Self {
        let scenario = &course.scenario;
        let asked = scenario.pilot.iter().map(|step| step.speed_mps).find(|&speed_mps| speed_mps > 0.0);
        // Whatever the pilot asks for, the head clamps it.
        let v_max_mps = scenario.equalize.v_max_mps;
        let flown = asked.map(|speed_mps| speed_mps.min(v_max_mps)).filter(|&speed_mps| speed_mps > 0.0);
        let start_m = course.spawns.first().and_then(|head| course.depth_m(head.at));
        Self {
            speed_mps: flown.map(f64::from),
            speed_asked_mps: asked.filter(|&speed_mps| speed_mps > v_max_mps).map(f64::from),
            ready_s: (scenario.takeoff.rise_s + scenario.takeoff.hover_s).into(),
            start_m: start_m.unwrap_or_default().into(),
        }
    }

    pub(super) fn time_min(&self, depth_m: f64) -> Option<f64> {
        let way_m = (depth_m - self.start_m).max(0.0);
        self.speed_mps.map(|speed_mps| (self.ready_s + way_m / speed_mps) / 60.0)
    }

    /// When the head is home again from a depth, at the same speed (min), if it stays there for so long (s).
    pub(super) fn home_min(&self, depth_m: f64, stay_s: f64) -> Option<f64> {
        let back_m = (depth_m - self.start_m).max(0.0);
        let there_min = self.time_min(depth_m)?;
        self.speed_mps.map(|speed_mps| there_min + (stay_s + back_m / speed_mps) / 60.0)
    }

    /// How deep the head may go to be home again after so long (s), if it stays there for so long (s).
    pub(super) fn turn_m(&self, home_s: f64, stay_s: f64) -> Option<f64> {
        let on_the_way_s = home_s - self.ready_s - stay_s;
        let speed_mps = self.speed_mps.filter(|_| on_the_way_s >= 0.0)?;
        Some(self.start_m + speed_mps * on_the_way_s / 2.0)
    }
}
