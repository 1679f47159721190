//! The numbers a run is judged by.

use serde::Serialize;

use crate::{analyse::Verdict, mission};

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
    /// What was asked and what came; in files the two fields `outcome`, a word, and `verdict`, words with numbers.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Take-off times (s), in order; the head's is the first.
    pub launches_s: Vec<f64>,
    /// UAVs in the air at the end.
    pub uavs: usize,
    /// Relays in the air at the end: UAVs, the head left out.
    pub relays_used: usize,
    /// Fewest relays that keep every link within `takeoff.s_min_db` with the head at its last depth, placed by
    /// someone who knows the map; `None` where no number does, or the tunnel's middle is not known.
    pub relays_needed: Option<usize>,
    /// How much worse the worst link is than that of the best chain with as many links and its head as deep, median
    /// over the last 10 s (dB). The best chain stands in mid-tunnel, a real one need not: where it cuts corners it can be
    /// negative. `None` without links, or where the tunnel's middle is not known.
    pub bottleneck_gap_db: Option<f32>,
    /// Links at the end, head first, base link last.
    pub links: Vec<LinkSummary>,
    /// Largest minus smallest true loss, median over the last 10 s (dB); `None` without two links.
    pub spread_db: Option<f32>,
    /// Largest true loss of any link at any decision (dB); `None` if there never was a link.
    pub worst_link_db: Option<f32>,
    /// First time the true losses lie within 7 dB of each other, searched from a tenth of the run or
    /// the last launch, whichever is later (s); `None` if never.
    pub converged_s: Option<f64>,
    /// Wall contacts begun.
    pub wall_contacts: u32,
    /// Contacts between UAVs begun.
    pub uav_contacts: u32,
    /// Share of the decisions since the head's take-off at which it flew and every link had been heard within
    /// `link.lost_s`, both ways (1); `None` if it never flew, or a recording does not say.
    pub connected_fraction: Option<f64>,
    /// Share of the decisions since the head's take-off at which it flew and every link's true loss was below
    /// `packets.limit_db` (1), *connected* in the sense of the papers; `None` if it never flew.
    pub below_limit_fraction: Option<f64>,
    /// Farthest tunnel distance of the head from the base (m), on the ground too.
    pub head_reach_m: f32,
    /// Longest way of the head forward from where it waited, backward taken off, by an odometer without a fault (m). In bends
    /// it is more than [`Self::head_reach_m`], the shortest way.
    pub head_flown_m: f32,
    /// Hash over every bit of every UAV's pose, velocity and contacts at every tick, and of every link at every
    /// decision, 16 hex digits.
    pub digest: String,
}

impl mission::Summary for Summary {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    fn digest(&self) -> &str {
        &self.digest
    }
}
