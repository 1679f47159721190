//! Why a relay never took off.

use uchain_core::chain::{LaunchHold, NodeParams, PendingLaunch, Signal};

use super::super::Step;

/// What was seen of a launch so far.
#[derive(Debug, Default)]
pub(in crate::log) struct Grounded {
    /// When a launch was last asked for, and what it waited for.
    asked: Option<(f64, PendingLaunch)>,
    /// It is asked for still.
    is_asked: bool,
}

impl Grounded {
    /// The launch after a decision.
    pub(in crate::log) fn see(&mut self, time_s: f64, launch: Option<PendingLaunch>) {
        self.is_asked = launch.is_some();
        self.asked = launch.map(|launch| (time_s, launch)).or(self.asked);
    }

    /// Why there was none, for people.
    pub(in crate::log) fn words(&self, steps: &[Step], params: &NodeParams) -> String {
        let takeoff = &params.takeoff;
        let front_db = |step: &Step| match takeoff.launch_signal {
            Signal::Filtered => step.why.estimates.front.filtered_db,
            Signal::Raw => step.why.estimates.front.raw_db,
        };
        let Some(most_db) = steps.iter().filter_map(front_db).reduce(f32::max) else {
            return "nothing was heard of the neighbour toward the head".to_owned();
        };
        let s_min_db = takeoff.s_min_db;
        let Some((asked_s, launch)) = self.asked else {
            return format!(
                "its front link came to {most_db:.2} dB at most, and it takes off above takeoff.s_min_db = {s_min_db}"
            );
        };
        let held = match launch.held {
            Some(LaunchHold::Ahead) => {
                let least_s = takeoff.after_previous_s;
                format!(
                    "the UAV ahead had not flown for takeoff.after_previous_s = {least_s} (front_flown_s)"
                )
            }
            Some(LaunchHold::Unlevelled) => {
                let most_db = takeoff.converged_db;
                format!("the chain had not levelled to takeoff.converged_db = {most_db} (front_imbalance_db)")
            }
            Some(LaunchHold::Silent) => {
                format!("nothing had been heard for longer than link.lost_s = {}", params.link.lost_s)
            }
            None => format!("it had not stayed so for takeoff.launch_hold_s = {}", takeoff.launch_hold_s),
        };
        let until =
            if self.is_asked { "at the end".to_owned() } else { format!("until {asked_s:.2} s only") };
        format!(
            "its front link was above takeoff.s_min_db = {s_min_db} {until} ({most_db:.2} dB at most), but {held}"
        )
    }
}
