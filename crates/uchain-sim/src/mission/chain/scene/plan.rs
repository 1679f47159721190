//! What a planner asks before anyone flies: how many UAVs does the tunnel need, and how long does that take?

use serde::Serialize;
use uchain_core::bounded;

use crate::mission::chain::Course;

/// Most rows of a plan.
pub const MOST_ROWS: usize = 1_000;
/// Most numbers of links listed in a row.
pub const MOST_LISTED: usize = 16;

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Depth means nothing here.
    #[error("nobody knows the middle of this map's tunnel: say where the head is to go with chain.goal_m")]
    NoTunnel,
    /// A depth the tunnel does not have.
    #[error("to_m = {to_m}: the tunnel ends {length_m:.2} m from the base")]
    Beyond {
        /// The depth asked for (m).
        to_m: f64,
        /// Greatest depth (m).
        length_m: f64,
    },
    /// A quantity outside its range.
    #[error("{key} = {got}: must be more than 0")]
    NotPositive {
        /// The quantity.
        key: &'static str,
        /// What was given.
        got: f64,
    },
    /// Too fine.
    #[error("step_m = {step_m}: {to_m} m in such steps are more than {MOST_ROWS} rows")]
    Rows {
        /// The step asked for (m).
        step_m: f64,
        /// The depth asked for (m).
        to_m: f64,
    },
    /// Nobody wants it any more.
    #[error("interrupted")]
    Interrupted,
}

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
    /// The deepest row up to which every row is feasible (m); `None` if already the first is not.
    pub feasible_to_m: Option<f64>,
    /// When each relay takes off, in order.
    pub launches: Vec<Launch>,
    /// One row per depth, from the first step to the depth asked for.
    pub rows: Vec<PlanRow>,
}

/// A relay's take-off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Launch {
    /// Which relay, counted from 1.
    pub relay: usize,
    /// Depth of the first row at which the chain needs it (m).
    pub depth_m: f64,
    /// When the head is there (min).
    pub time_min: Option<f64>,
}

/// The best chain for one depth of the head.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanRow {
    /// Depth of the head (m).
    pub depth_m: f64,
    /// Least worst link with 1, 2, … links (dB), up to as many as are needed and at most [`MOST_LISTED`]; where no
    /// number would do, up to as many as there are UAVs at hand.
    pub bottleneck_by_links_db: Vec<f64>,
    /// Fewest relays that keep every link within `s_min`; `None` where no number does.
    pub relays_needed: Option<usize>,
    /// Least worst link with so many relays (dB).
    pub bottleneck_db: Option<f64>,
    /// When the head is there (min), counted from its take-off.
    pub time_min: Option<f64>,
    /// For how long the first relay has been in the air by then (min); `None` while it is on the ground.
    pub first_relay_min: Option<f64>,
    /// Whether there are relays enough, here and on the way here, and neither the head nor a relay has flown
    /// longer than a battery lasts. The way back is not counted.
    pub feasible: bool,
}

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
    plan_while(course, to_m, step_m, uavs, &mut || true)
}

/// Like [`plan`], as long as whoever asked for it wants to go on, which is asked before every row.
///
/// # Errors
/// Those of [`plan`], and [`PlanError::Interrupted`].
pub fn plan_while(
    course: &Course,
    to_m: Option<f64>,
    step_m: f64,
    uavs: Option<usize>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Plan, PlanError> {
    let optimum = course.optimum().ok_or(PlanError::NoTunnel)?;
    let tunnel_m = optimum.tunnel().length_m();
    let to_m = to_m.unwrap_or(tunnel_m);
    for (key, got) in [("to_m", to_m), ("step_m", step_m)] {
        if got.is_nan() || got <= 0.0 {
            return Err(PlanError::NotPositive { key, got });
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
    };
    let mut feasible_so_far = true;
    for step in 1..=steps as usize {
        if !go_on() {
            return Err(PlanError::Interrupted);
        }
        let depth_m = (step as f64 * step_m).min(to_m).min(tunnel_m);
        let links = optimum.links_needed(depth_m);
        let listed = bounded(links.or(uavs).unwrap_or(MOST_LISTED), 1, MOST_LISTED);
        let bottleneck = |links| optimum.optimum(depth_m, links).bottleneck_db;
        let relays_needed = links.map(|links| links - 1);
        let time_min = clock.time_min(depth_m);
        for relay in plan.launches.len() + 1..=relays_needed.unwrap_or_default() {
            plan.launches.push(Launch { relay, depth_m, time_min });
        }
        plan.uavs_needed = plan.uavs_needed.zip(links).map(|(most, links)| most.max(links));
        let enough = plan.uavs_needed.is_some_and(|needed| uavs.is_none_or(|uavs| needed <= uavs));
        let lasts = time_min.is_none_or(|time_min| 60.0 * time_min <= plan.endurance_s);
        let feasible = enough && lasts;
        feasible_so_far &= feasible;
        if feasible_so_far {
            plan.feasible_to_m = Some(depth_m);
        }
        let first_min = plan.launches.first().and_then(|first| first.time_min);
        plan.rows.push(PlanRow {
            depth_m,
            bottleneck_by_links_db: (1..=listed).map(bottleneck).collect(),
            relays_needed,
            bottleneck_db: links.map(bottleneck),
            time_min,
            first_relay_min: time_min.zip(first_min).map(|(now_min, first_min)| now_min - first_min),
            feasible,
        });
    }
    Ok(plan)
}

/// When the head is where, if nothing stops it.
struct Clock {
    speed_mps: Option<f64>,
    speed_asked_mps: Option<f64>,
    ready_s: f64,
    start_m: f64,
}

impl Clock {
    fn new(course: &Course) -> Self {
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

    fn time_min(&self, depth_m: f64) -> Option<f64> {
        let way_m = (depth_m - self.start_m).max(0.0);
        self.speed_mps.map(|speed_mps| (self.ready_s + way_m / speed_mps) / 60.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::builtin;

    fn course(name: &str, sets: &[&str]) -> std::sync::Arc<Course> {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Course::read(&builtin(name).unwrap(), &sets).unwrap()
    }

    #[test]
    fn a_straight_tunnel_needs_a_relay_every_44_m_and_the_head_takes_its_time() {
        // 60 dB reach 0.25 · 10^1.25 = 4.446 m.
        let plan = plan(&course("straight", &["chain.endurance_s=60"]), None, 0.5, None).unwrap();
        let needed: Vec<_> = plan.rows.iter().map(|row| row.relays_needed.unwrap()).collect();
        let by_hand: Vec<_> = plan.rows.iter().map(|row| (row.depth_m / 4.4457).floor() as usize).collect();
        assert_eq!(needed, by_hand);
        assert_eq!(plan.uavs_needed, Some(4));
        let depths_m: Vec<_> = plan.launches.iter().map(|launch| launch.depth_m).collect();
        assert_eq!(depths_m, [4.5, 9.0, 13.5]);
        // 2 s to be ready, then 0.2 m/s from 0.75 m on.
        let row = &plan.rows[19];
        assert!((row.time_min.unwrap() - (2.0 + 9.25 / 0.2) / 60.0).abs() < 1e-6);
        assert!((row.first_relay_min.unwrap() - 5.5 / 0.2 / 60.0).abs() < 1e-6);
        assert!(plan.rows[..24].iter().all(|row| row.feasible), "a minute is enough for 12.35 m");
        assert!(!plan.rows[24].feasible && plan.feasible_to_m == Some(12.0));
    }

    #[test]
    fn relays_that_are_not_there_end_what_is_feasible() {
        let plan = plan(&course("straight", &[]), Some(10.0), 1.0, Some(2)).unwrap();
        assert_eq!((plan.relays_available, plan.feasible_to_m), (Some(1), Some(8.0)));
        assert!(plan.rows.iter().all(|row| row.bottleneck_db.unwrap() <= 60.0));
        let last = plan.rows.last().unwrap();
        assert!(
            last.bottleneck_by_links_db.is_sorted_by(|a, b| a > b) && last.bottleneck_by_links_db.len() == 3
        );
    }

    #[test]
    fn what_cannot_be_planned_is_refused_in_words() {
        let course = course("straight", &[]);
        let words = |to_m, step_m| plan(&course, to_m, step_m, None).unwrap_err().to_string();
        assert_eq!(words(Some(20.0), 1.0), "to_m = 20: the tunnel ends 13.50 m from the base");
        assert_eq!(words(None, 0.0), "step_m = 0: must be more than 0");
        assert_eq!(words(Some(f64::NAN), 1.0), "to_m = NaN: must be more than 0");
        assert_eq!(words(Some(10.0), 0.001), "step_m = 0.001: 10 m in such steps are more than 1000 rows");
        let lost = Course { tunnel: None, ..(*course).clone() };
        assert_eq!(plan(&lost, None, 1.0, None).unwrap_err(), PlanError::NoTunnel);
    }

    #[test]
    fn the_head_flies_no_faster_than_its_laws_let_it() {
        let at = |speed: &str| {
            let set = format!("pilot.0.speed_mps={speed}");
            plan(&course("straight", &[&set, "equalize.v_max_mps=0.25"]), None, 5.0, None).unwrap()
        };
        let (fast, most) = (at("1"), at("0.25"));
        assert_eq!(fast.rows, most.rows);
        assert_eq!((fast.speed_mps, fast.speed_asked_mps), (Some(0.25), Some(1.0)));
        assert_eq!((most.speed_mps, most.speed_asked_mps), (Some(0.25), None));
    }

    #[test]
    fn without_a_pilot_who_flies_forward_there_are_no_times() {
        for set in ["pilot.0.speed_mps=0", "equalize.v_max_mps=0"] {
            let plan = plan(&course("straight", &[set]), None, 5.0, None).unwrap();
            let row = &plan.rows[1];
            assert_eq!((plan.speed_mps, row.time_min, row.first_relay_min), (None, None, None), "{set}");
            assert!(plan.rows.iter().all(|row| row.feasible), "{set}");
        }
    }
}
