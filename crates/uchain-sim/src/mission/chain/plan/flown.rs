//! Flights of a plan, beside it: the plan is a best case.

use serde::Serialize;

/// What the flights came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Flown {
    /// How long each was flown (s).
    pub duration_s: f64,
    /// UAVs in each, the head included.
    pub uavs: usize,
    /// Flight by flight.
    pub runs: Vec<FlownRun>,
    /// The middle one in every number; of an even count the worse of the two in the middle.
    pub median: FlownRun,
    /// The worst in every number: not one flight, but the worst of all.
    pub worst: FlownRun,
}

/// How a flight ended, by what its head did in the last minute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FlightEnd {
    /// It was there.
    Arrived,
    /// In another passage than the planned one, or elsewhere away from it: without a map the laws keep to walls and not to
    /// a way.
    Astray,
    /// Its link let it go no farther: the relays behind it had not come up.
    HeldByLink,
    /// On the way, with a link that is good enough, and yet it hardly moved: before a wall.
    Stuck,
    /// Still on its way.
    UnderWay,
}

impl FlightEnd {
    /// All of them, from good to bad.
    pub const ALL: [Self; 5] = [Self::Arrived, Self::UnderWay, Self::HeldByLink, Self::Stuck, Self::Astray];

    /// In words, of so many flights.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Arrived => "there",
            Self::UnderWay => "still under way when the time was up",
            Self::HeldByLink => {
                "held back by the head's link: the relays did not come up (link.head_stop_db)"
            }
            Self::Stuck => "before a wall",
            Self::Astray => "away from the planned way: without a map the laws follow walls",
        }
    }
}

/// One flight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FlownRun {
    /// Its seed; `None` of a middle or a worst.
    pub seed: Option<u64>,
    /// Farthest that the head came along the tunnel (m).
    pub reach_m: f64,
    /// When the head was where it was to go (min); `None` if it never was.
    pub there_min: Option<f64>,
    /// Relays that took off.
    pub relays: usize,
    /// Largest true loss of any link (dB); `None` if there never was one.
    pub worst_link_db: Option<f64>,
    /// Share of the time in which every link was heard (1).
    pub connected_fraction: f64,
    /// Contacts with walls and with each other.
    pub contacts: u32,
    /// How it ended; `None` of a middle or a worst.
    pub ended: Option<FlightEnd>,
    /// Where the head was at the end, in the map's own frame (m); `None` of a middle or a worst.
    pub head_m: Option<[f64; 2]>,
}

impl Flown {
    /// Of these flights.
    pub fn of(duration_s: f64, uavs: usize, runs: Vec<FlownRun>) -> Self {
        let (median, worst) = (each(&runs, Of::middle), each(&runs, Of::worst));
        Self { duration_s, uavs, runs, median, worst }
    }
}

/// Values from good to bad.
struct Of(Vec<f64>);

impl Of {
    fn middle(&self) -> f64 {
        self.0.get(self.0.len() / 2).copied().unwrap_or_default()
    }

    fn worst(&self) -> f64 {
        self.0.last().copied().unwrap_or_default()
    }
}

/// The middle or the worst in every number. Who was never there was there after all others.
fn each(runs: &[FlownRun], pick: fn(&Of) -> f64) -> FlownRun {
    let sorted = |value: fn(&FlownRun) -> f64, sign: f64| {
        let mut values: Vec<f64> = runs.iter().map(value).collect();
        values.sort_by(|a, b| (sign * a).total_cmp(&(sign * b)));
        pick(&Of(values))
    };
    let (small, large) = (1.0, -1.0);
    let there_min = sorted(|run| run.there_min.unwrap_or(f64::INFINITY), small);
    let worst_link_db = sorted(|run| run.worst_link_db.unwrap_or(f64::NEG_INFINITY), small);
    FlownRun {
        seed: None,
        reach_m: sorted(|run| run.reach_m, large),
        there_min: Some(there_min).filter(|there_min| there_min.is_finite()),
        relays: sorted(|run| run.relays as f64, small) as usize,
        worst_link_db: Some(worst_link_db).filter(|loss_db| loss_db.is_finite()),
        connected_fraction: sorted(|run| run.connected_fraction, large),
        contacts: sorted(|run| f64::from(run.contacts), small) as u32,
        ended: None,
        head_m: None,
    }
}
