//! What a ring comes to.

use std::{f64::consts::TAU, sync::Arc};

use serde::Serialize;
use uchain_sim::{
    analyse::{Outcome, Verdict},
    clock::{time_s, total_ticks},
    mission::{Metrics, Summary},
    record::{RecordError, Recorder},
};

use super::{Ring, RingFrame, RingScene};

/// What one run came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct RingSummary {
    /// The scenario's name.
    pub(crate) scenario: String,
    /// The seed.
    pub(crate) seed: u64,
    /// What was found.
    #[serde(flatten)]
    pub(crate) verdict: Verdict,
    /// Simulated time (s).
    pub(crate) sim_s: f64,
    /// Way over ground, by robot (m).
    pub(crate) distance_m: Vec<f64>,
    /// Rounds of the slowest robot.
    pub(crate) rounds: f64,
    /// Contacts between robots begun.
    pub(crate) contacts: u32,
    /// Hash over every bit of every frame, 16 hex digits.
    pub(crate) digest: String,
}

impl Summary for RingSummary {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    fn digest(&self) -> &str {
        &self.digest
    }
}

/// Adds a run up.
#[derive(Debug)]
pub(crate) struct RingMetrics {
    scene: Arc<RingScene>,
    last: RingFrame,
    distance_m: Vec<f64>,
}

impl Recorder<RingFrame> for RingMetrics {
    fn frame(&mut self, frame: &RingFrame) -> Result<(), RecordError> {
        self.distance_m.resize(frame.robots.len(), 0.0);
        for ((way_m, here), before) in self.distance_m.iter_mut().zip(&frame.robots).zip(&self.last.robots) {
            let (dx_m, dy_m) = (f64::from(here.x_m - before.x_m), f64::from(here.y_m - before.y_m));
            *way_m += (dx_m * dx_m + dy_m * dy_m).sqrt();
        }
        self.last.clone_from(frame);
        Ok(())
    }
}

impl Metrics for RingMetrics {
    type Mission = Ring;

    fn of(scene: Arc<RingScene>) -> Self {
        Self { scene, last: RingFrame::default(), distance_m: Vec::new() }
    }

    fn sum_up(&self, seed: u64, digest: String) -> RingSummary {
        let (sim_s, of_s) = (time_s(self.last.tick), self.scene.duration_s);
        let least_m = self.distance_m.iter().copied().fold(f64::INFINITY, f64::min);
        let rounds = least_m / (TAU * f64::from(self.scene.ring.radius_m));
        let words = format!("{rounds:.2} rounds of the slowest robot");
        let good = Outcome::Own { word: "round", words: words.clone(), is_success: true };
        let mut found = Vec::new();
        if self.last.tick < total_ticks(of_s) {
            found.push(Outcome::Interrupted { at_s: sim_s, of_s: Some(of_s) });
        }
        if rounds.is_nan() || rounds < 0.9 {
            found.push(Outcome::Own { word: "not-round", words, is_success: false });
        }
        RingSummary {
            scenario: uchain_sim::mission::Scene::name(&*self.scene).to_owned(),
            seed,
            verdict: Verdict::new(good, found, Vec::new()),
            sim_s,
            distance_m: self.distance_m.clone(),
            rounds,
            contacts: self.last.robots.iter().map(|robot| robot.contacts).sum::<u32>() / 2,
            digest,
        }
    }
}
