//! What a planner asks before anyone flies: how many UAVs does the tunnel need, and how long does that take?

mod assumptions;
mod battery;
mod best;
mod clock;
mod error;
mod flown;
mod places;
mod reach;
mod sensitivity;
#[cfg(test)]
mod tests;

use serde::Serialize;

use crate::{
    analyse::optimum::MOST_LINKS,
    mission::chain::{
        Course,
        shown::plan::{answer, help},
    },
    radio::Budgeted,
};

pub use assumptions::{Assumptions, BatteryAssumed, HeadAssumed, MapAssumed, RadioAssumed};
pub use battery::{Batteries, Battery};
pub use error::PlanError;
pub use flown::{FlightEnd, Flown, FlownRun};
pub use places::Place;
pub use reach::Reach;
pub use sensitivity::{Sensitivity, Variant};

use best::{Best, best_chains, deepest_m};
use clock::Clock;

/// Most rows of a plan.
pub const MOST_ROWS: usize = 1_000;
/// Longest stay (s), and largest share of a battery that may be kept back (1).
const STAY_MAX_S: f64 = 86_400.0;
const RESERVE_MAX: f64 = 0.9;
/// Most numbers of links listed in a row.
pub const MOST_LISTED: usize = 16;

/// The best chains against the head's depth, and the time they take. Nothing is simulated: relays are taken to stand
/// at once where they are best, in mid-tunnel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// The scenario's name.
    pub scenario: String,
    /// Greatest depth of the tunnel (m).
    pub tunnel_m: f64,
    /// Loss no link may exceed (dB), `takeoff.s_min_db`.
    pub s_min_db: f64,
    /// Relays at hand, the head left out; `None` where nobody said how many.
    pub relays_available: Option<usize>,
    /// Longest flight (s), `chain.endurance_s`.
    pub endurance_s: f64,
    /// Speed of the head (m/s): the pilot's first step forward, at most `equalize.v_max_mps`; `None` if it does not
    /// fly forward, and then no times.
    pub speed_mps: Option<f64>,
    /// Speed the pilot asks of the head (m/s), where it is more than `equalize.v_max_mps` and so is not flown.
    pub speed_asked_mps: Option<f64>,
    /// UAVs needed at the worst depth, the head included; `None` where no number would do.
    pub uavs_needed: Option<usize>,
    /// How deep the head can go, to a centimetre, with every row on the way there feasible (m); `None` if it is not even the
    /// first centimetre.
    pub feasible_to_m: Option<f64>,
    /// When each relay takes off, in order.
    pub launches: Vec<Launch>,
    /// One row per depth, from the first step to the depth asked for.
    pub rows: Vec<PlanRow>,
    /// What was taken for granted.
    pub assumptions: Assumptions,
    /// Where the relays stand when the head is at the depth asked for, the one next to the head first; none where no
    /// number would do.
    pub places: Vec<Place>,
    /// Where the head is then, in the map file's own frame (m).
    pub head_m: Option<[f64; 2]>,
    /// Who runs out first, the way back and the reserve counted; `None` without times.
    pub batteries: Option<Batteries>,
    /// How much hangs on the limit and on the exponents.
    pub sensitivity: Sensitivity,
    /// The answer in one sentence.
    pub verdict: String,
    /// What would bring all home, where not all come home.
    pub would_help: Option<String>,
    /// What the limit was worked out from, if it was.
    pub budget: Option<Budgeted>,
    /// How much of the map is in reach with so many relays, if that was asked.
    pub everywhere: Option<Reach>,
    /// What it came to when it was flown, if it was.
    pub flown: Option<Flown>,
}

/// How a mission is planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanOptions {
    /// How deep the head is to go (m); the tunnel's end if `None`.
    pub to_m: Option<f64>,
    /// Distance between two rows (m).
    pub step_m: f64,
    /// UAVs at hand, the head included; as many as it takes if `None`.
    pub uavs: Option<usize>,
    /// How long the head stays where it is to go (s).
    pub stay_s: f64,
    /// Share of a battery that nobody may use (1).
    pub reserve: f64,
}

impl Default for PlanOptions {
    /// Down to the tunnel's end in steps of 1 m, and back at once with a fifth of each battery left.
    fn default() -> Self {
        Self { to_m: None, step_m: 1.0, uavs: None, stay_s: 0.0, reserve: RESERVE }
    }
}

/// Share of a battery that nobody may use unless told otherwise (1). It is ours.
pub const RESERVE: f64 = 0.2;

/// A relay's take-off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Launch {
    /// Which relay, counted from 1.
    pub relay: usize,
    /// Depth of the head at which the chain needs it (m): that of the first row that does, or before it if several relays come
    /// with one row.
    pub depth_m: f64,
    /// When the head is there (min).
    pub time_min: Option<f64>,
}

/// The best chain for one depth of the head.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanRow {
    /// Depth of the head (m).
    pub depth_m: f64,
    /// Least worst link with 1, 2, … links (dB), up to as many as are needed; none where more than [`MOST_LISTED`] are.
    /// Where no number would do, up to as many as there are UAVs at hand, and at most [`MOST_LISTED`].
    pub bottleneck_by_links_db: Vec<f64>,
    /// Fewest relays that keep every link within `s_min`; `None` where no number does.
    pub relays_needed: Option<usize>,
    /// Least worst link with so many relays (dB).
    pub bottleneck_db: Option<f64>,
    /// When the head is there (min), counted from its take-off.
    pub time_min: Option<f64>,
    /// For how long the first relay has been in the air by then (min); `None` while it is on the ground.
    pub first_relay_min: Option<f64>,
    /// When all are home again if the head turns round here, its stay counted (min, from its take-off).
    pub home_min: Option<f64>,
    /// Whether there are relays enough, here and on the way here, and neither the head nor a relay has flown
    /// longer than a battery lasts. The way back is not counted.
    pub feasible: bool,
}

/// Rows that are worked out at once.
const AT_ONCE: usize = 32;

/// Plans a mission down to `to_m` (the tunnel's end if `None`), with a row every `step_m`, for so many `uavs` at hand,
/// the head included (`None`: as many as it takes).
///
/// ```
/// use uchain_sim::{mission::chain::{plan, Course}, config::builtin};
/// let course = Course::read(&builtin("straight").unwrap(), &[]).unwrap();
/// let plan = plan(&course, Some(10.0), 1.0, None).unwrap();
/// assert_eq!((plan.rows.len(), plan.uavs_needed), (10, Some(3)));
/// ```
///
/// # Errors
/// A tunnel of unknown middle; a depth beyond its end; a depth or a step that is not positive; more than
/// [`MOST_ROWS`] rows.
pub fn plan(course: &Course, to_m: Option<f64>, step_m: f64, uavs: Option<usize>) -> Result<Plan, PlanError> {
    plan_while(course, &PlanOptions { to_m, step_m, uavs, ..PlanOptions::default() }, &mut || true)
}

/// Like [`plan`], with all there is to say, as long as whoever asked for it wants to go on, which is asked every few rows.
///
/// # Errors
/// Those of [`plan`], and [`PlanError::Interrupted`].
pub fn plan_while(
    course: &Course,
    asked: &PlanOptions,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Plan, PlanError> {
    let PlanOptions { to_m, step_m, uavs, .. } = *asked;
    let optimum = course.optimum().ok_or_else(|| course.no_tunnel())?;
    let tunnel_m = optimum.tunnel().length_m();
    let to_m = to_m.unwrap_or(tunnel_m);
    for (key, got) in [("to_m", to_m), ("step_m", step_m)] {
        if got.is_nan() || got <= 0.0 {
            return Err(PlanError::NotPositive { key, got });
        }
    }
    for (key, got, most) in [("stay_s", asked.stay_s, STAY_MAX_S), ("reserve", asked.reserve, RESERVE_MAX)] {
        if !(0.0..=most).contains(&got) {
            return Err(PlanError::OutOfRange { key, got, most });
        }
    }
    // A centimetre of grace for a depth that was read off a rounded table.
    if to_m > tunnel_m + 0.01 {
        return Err(PlanError::Beyond { to_m, length_m: tunnel_m });
    }
    let steps = (to_m / step_m - 1e-6).ceil().max(1.0);
    if steps > MOST_ROWS as f64 {
        return Err(PlanError::Rows { step_m, to_m });
    }

    let scenario = &course.scenario;
    let clock = Clock::new(course);
    let mut plan = Plan {
        scenario: scenario.name.clone(),
        tunnel_m,
        s_min_db: scenario.takeoff.s_min_db.into(),
        relays_available: uavs.map(|uavs| uavs.saturating_sub(1)),
        endurance_s: scenario.chain.endurance_s.into(),
        speed_mps: clock.speed_mps,
        speed_asked_mps: clock.speed_asked_mps,
        uavs_needed: Some(1),
        feasible_to_m: None,
        launches: Vec::new(),
        rows: Vec::with_capacity(steps as usize),
        assumptions: Assumptions::of(course, &clock, asked),
        places: Vec::new(),
        head_m: None,
        batteries: None,
        sensitivity: Sensitivity::default(),
        verdict: String::new(),
        would_help: None,
        budget: None,
        everywhere: None,
        flown: None,
    };
    let depths_m = (1..=steps as usize).map(|step| (step as f64 * step_m).min(to_m).min(tunnel_m));
    let depths_m: Vec<f64> = depths_m.collect();
    let mut best = Vec::with_capacity(depths_m.len());
    for depths_m in depths_m.chunks(AT_ONCE) {
        if !go_on() {
            return Err(PlanError::Interrupted);
        }
        best.extend(best_chains(&optimum, depths_m, uavs));
    }
    let mut feasible_so_far = true;
    for (depth_m, Best { links, by_links_db, bottleneck_db }) in depths_m.into_iter().zip(best) {
        let relays_needed = links.map(|links| links - 1);
        let time_min = clock.time_min(depth_m);
        plan.launch(relays_needed.unwrap_or_default(), depth_m, &clock);
        let before = plan.uavs_needed;
        plan.uavs_needed = plan.uavs_needed.zip(links).map(|(most, links)| most.max(links));
        let can_be = |links: Option<usize>, time_min: Option<f64>| {
            links.is_some_and(|links| links <= uavs.unwrap_or(MOST_LINKS))
                && time_min.is_none_or(|time_min| 60.0 * time_min <= plan.endurance_s)
        };
        let feasible = can_be(plan.uavs_needed, time_min);
        if feasible_so_far && feasible {
            plan.feasible_to_m = Some(depth_m);
        } else if feasible_so_far {
            let (from_m, needed) =
                plan.rows.last().map_or((0.0, Some(1)), |row: &PlanRow| (row.depth_m, before));
            plan.feasible_to_m = deepest_m(from_m, depth_m, |depth_m| {
                let links = needed.zip(optimum.head(depth_m).links_needed());
                can_be(links.map(|(most, links)| most.max(links)), clock.time_min(depth_m))
            });
        }
        feasible_so_far &= feasible;
        let first_min = plan.launches.first().and_then(|first| first.time_min);
        plan.rows.push(PlanRow {
            depth_m,
            bottleneck_by_links_db: by_links_db,
            relays_needed,
            bottleneck_db,
            time_min,
            first_relay_min: time_min.zip(first_min).map(|(now_min, first_min)| now_min - first_min),
            home_min: clock.home_min(depth_m, asked.stay_s),
            feasible,
        });
    }
    if !go_on() {
        return Err(PlanError::Interrupted);
    }
    let goal_m = to_m.min(tunnel_m);
    plan.batteries = battery::batteries(&plan, &clock, goal_m, asked);
    plan.places = places::places(course, &plan, goal_m);
    plan.head_m = Some(places::in_own_frame(&course.map, optimum.tunnel().at(goal_m).0));
    plan.sensitivity = sensitivity::sensitivity(course, goal_m, go_on)?;
    (plan.verdict, plan.would_help) = (answer(&plan), help(&plan));
    Ok(plan)
}

impl Plan {
    /// Notes who takes off for a row. Where rows lie so far apart that several relays come with one of them, their
    /// take-offs are spread over the way from the row before.
    fn launch(&mut self, relays: usize, depth_m: f64, clock: &Clock) {
        let before_m = self.rows.last().map_or(0.0, |row| row.depth_m);
        let (have, new) = (self.launches.len(), relays.saturating_sub(self.launches.len()));
        for nth in 1..=new {
            let depth_m = before_m + (depth_m - before_m) * (nth as f64 / new as f64);
            self.launches.push(Launch { relay: have + nth, depth_m, time_min: clock.time_min(depth_m) });
        }
    }
}
