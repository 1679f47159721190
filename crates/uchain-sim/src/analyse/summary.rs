//! The numbers a run is judged by.

use serde::Serialize;

/// One link of the flying chain at the end of a run: medians over the last 10 s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LinkSummary {
    /// The UAV at the link's front end, 0 = head.
    pub uav: usize,
    /// Loss without noise (dB).
    pub true_db: f32,
    /// The front end's filtered estimate (dB); `None` when it never heard a packet.
    pub filtered_db: Option<f32>,
}

/// What one run came to. A function of (scenario, seed): nothing here is measured by a clock.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The scenario's name.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// Simulated time (s).
    pub sim_s: f64,
    /// How the run went, in words: completed, who failed and when, whether the chain was whole at the end.
    pub outcome: String,
    /// Take-off times (s), in order; the head's is the first.
    pub launches_s: Vec<f64>,
    /// UAVs in the air at the end.
    pub uavs: usize,
    /// Links at the end, head first, base link last.
    pub links: Vec<LinkSummary>,
    /// Largest minus smallest true loss, median over the last 10 s (dB); `None` without two links.
    pub spread_db: Option<f32>,
    /// First time the true losses lie within 7 dB of each other, searched from a tenth of the run or
    /// the last launch, whichever is later (s); `None` if never.
    pub converged_s: Option<f64>,
    /// Wall contacts begun.
    pub wall_contacts: u32,
    /// Contacts between UAVs begun.
    pub uav_contacts: u32,
    /// Share of decisions at which every link's true loss was below the reception limit.
    pub connected_fraction: f64,
    /// Farthest tunnel distance of the head from the base (m).
    pub head_reach_m: f32,
    /// Hash over every bit of every UAV's state at every tick, 16 hex digits.
    pub digest: String,
}
