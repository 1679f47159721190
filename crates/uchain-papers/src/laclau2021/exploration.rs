//! The exploration of Laclau 2021, Fig. 4D to F: the head flies 10 m into the circuit, relays follow; three treatments
//! of the signal, 30 runs each, with the same noise, by three readings: the authors' code, their logs, the paper's text.

use std::sync::Arc;

use uchain_core::chain::CenterParams;
use uchain_sim::{mission::chain::Course, record::RecordError, sweep::Run};

use super::trace::{Sample, Trace, record_trace, spread};
use crate::{
    PaperError,
    experiment::{Experiment, RecordedRun, each_run, scenario},
};

/// The three treatments: their names, and whose signal relays level within which tolerance.
pub(crate) const TREATMENTS: [&str; 3] = ["T0", "T5", "K"];
const SETS: [[&str; 2]; 3] = [
    ["link.signal=\"raw\"", "equalize.tolerance_db=0"],
    ["link.signal=\"raw\"", "equalize.tolerance_db=5"],
    ["link.signal=\"filtered\"", "equalize.tolerance_db=0"],
];
pub(super) const REPLICATES: u64 = 30;
pub(super) const DURATION_S: f64 = 120.0;
/// Losses this near to each other are level (dB): the authors' simulator.
pub(super) const LEVEL_DB: f64 = 7.0;
/// Links that count (Fig. 4E and F leave the fourth one out).
pub(super) const LINKS: usize = 3;
/// Level is looked for from a tenth of the run on (s).
pub(super) const FROM_S: f64 = 0.1 * DURATION_S;
/// The end: the last seconds (s).
pub(super) const END_S: f64 = 30.0;
/// Decisions in a window of ten seconds.
const WINDOW: usize = 50;
/// Loss of a relay that is still parked at the base (dB).
pub(super) const PARKED_DB: f64 = 35.0;
/// Threshold of a launch (dB).
pub(super) const S_MIN_DB: f64 = 60.0;

/// One run.
#[derive(Debug)]
pub(super) struct Flight {
    pub(super) samples: Vec<Sample>,
    /// Of the first run.
    pub(super) recorded: Option<RecordedRun>,
    /// When the head is asked to stop (s).
    pub(super) stop_s: f64,
    pub(super) launches_s: Vec<f64>,
    pub(super) relays_used: usize,
    pub(super) relays_needed: Option<usize>,
    /// How far the head came: by the shortest way, and by its odometer (m).
    pub(super) head_reach_m: f64,
    pub(super) head_flown_m: f64,
}

/// By treatment, then by replicate.
pub(super) type RunsByTreatment = Vec<Vec<Flight>>;

/// Readings of what was flown: their names, whether T0 and T5 launch on the raw signal, and further settings.
const READINGS: [(&str, bool, &[&str]); 3] =
    [("coded", false, &[]), ("logged", true, &[]), ("printed", true, PRINTED)];
/// Eq. 12, its largest speed, the head's way and Eq. 22, without a detour, as the text prints them.
pub(super) const PRINTED: &[&str] = &[
    "equalize.law=\"lipschitz\"",
    "equalize.v_max_mps=0.3",
    "pilot.0.speed_mps=0.2",
    "pilot.1.start_s=50",
    "radio.detour_db_per_m=0",
];
/// Place of the second one.
const LOGGED: usize = 1;

/// All runs.
#[derive(Debug)]
pub(crate) struct Exploration {
    /// By reading.
    treated: Vec<RunsByTreatment>,
    /// K once more, its filter without optic flow (A = 0), by the first reading.
    pub(super) without_flow: Vec<Flight>,
    /// K once more with this project's default slowing near walls, by the first reading.
    pub(super) default_slowing: Vec<Flight>,
    /// K once more with the shortest way in place of odometers, by the first reading.
    pub(super) shortest_way: Vec<Flight>,
}

impl Exploration {
    pub(crate) fn fly() -> Result<Self, PaperError> {
        let treated = READINGS.iter().map(|(_, raw, sets)| treated(*raw, sets)).collect::<Result<_, _>>()?;
        let slowing = format!("center.slow_over_m={}", CenterParams::default().slow_over_m);
        Ok(Self {
            treated,
            without_flow: variant(&["kalman.flow_gain_db_per_m=0"])?,
            default_slowing: variant(&[&slowing])?,
            shortest_way: variant(&["radio.detour=geodesic"])?,
        })
    }

    /// Names of readings, and what was flown.
    pub(super) fn readings(&self) -> impl Iterator<Item = (&'static str, &RunsByTreatment)> {
        READINGS.iter().map(|(name, ..)| *name).zip(&self.treated)
    }

    /// K of the first reading.
    pub(super) fn coded(&self) -> &[Flight] {
        self.treated.first().and_then(|treated| treated.last()).map_or(&[], Vec::as_slice)
    }

    /// The second reading.
    pub(super) fn logged(&self) -> &[Vec<Flight>] {
        self.treated.get(LOGGED).map_or(&[], Vec::as_slice)
    }
}

fn treated(raw: bool, sets: &[&str]) -> Result<RunsByTreatment, PaperError> {
    let fly = |(treatment, [signal, tolerance]): (&&str, [&str; 2])| {
        let launch = if raw && *treatment != "K" { "raw" } else { "filtered" };
        let launch = format!("takeoff.launch_signal=\"{launch}\"");
        let own = [signal, tolerance, &launch];
        variant(&own.into_iter().chain(sets.iter().copied()).collect::<Vec<_>>())
    };
    TREATMENTS.iter().zip(SETS).map(fly).collect()
}

fn variant(sets: &[&str]) -> Result<Vec<Flight>, PaperError> {
    let experiment =
        Experiment { source: scenario("circuit-frontiers2021"), sets, vary: &[], replicates: REPLICATES };
    Ok(each_run(experiment, fly)?.into_iter().flatten().collect())
}

fn fly(course: &Arc<Course>, one: Run) -> Result<Flight, RecordError> {
    let Trace { samples, summary, recorded } = record_trace(course, one)?;
    Ok(Flight {
        samples,
        recorded,
        stop_s: course.scenario.pilot.last().map_or(0.0, |last| last.start_s),
        launches_s: summary.launches_s,
        relays_used: summary.relays_used,
        relays_needed: summary.relays_needed,
        head_reach_m: f64::from(summary.head_reach_m),
        head_flown_m: f64::from(summary.head_flown_m),
    })
}

/// Largest minus smallest true loss of the first three links at any time, a parked relay's link to the base included:
/// the authors' simulator (dB).
fn spread_db(sample: &Sample) -> f64 {
    spread(sample.true_db().chain([PARKED_DB; LINKS]).take(LINKS))
}

impl Flight {
    /// First time from a tenth of the run on at which links are level (s).
    pub(super) fn converged_s(&self) -> Option<f64> {
        let is_level = |sample: &&Sample| sample.time_s >= FROM_S && spread_db(sample) < LEVEL_DB;
        self.samples.iter().find(is_level).map(|sample| sample.time_s)
    }

    /// Standard deviation of the depth of a relay, from 1, that flies: from convergence or the head's stop on,
    /// whichever is later, to the end (m). `None` without convergence, or on the ground.
    pub(super) fn spread_m(&self, relay: usize) -> Option<f64> {
        self.launches_s.get(relay)?;
        Some(standard_deviation(&self.depths_m(relay, self.converged_s()?.max(self.stop_s))))
    }

    /// The same within windows of ten seconds at the end: what noise does, without drift (m). `None` as well if
    /// somebody took off lately.
    pub(super) fn end_spread_m(&self, relay: usize) -> Option<f64> {
        self.launches_s.get(relay)?;
        self.converged_s()?;
        if self.launches_s.last().is_some_and(|at_s| *at_s > DURATION_S - END_S) {
            return None;
        }
        let depths_m = self.depths_m(relay, DURATION_S - END_S);
        let windows: Vec<f64> = depths_m.chunks_exact(WINDOW).map(standard_deviation).collect();
        let square = windows.iter().map(|spread_m| spread_m * spread_m).sum::<f64>();
        (!windows.is_empty()).then(|| (square / windows.len() as f64).sqrt())
    }

    /// Largest minus smallest true loss of the links that are flown, in the mean of the last ten seconds (dB).
    pub(super) fn end_spread_db(&self) -> Option<f64> {
        let late = self.samples.iter().filter(|sample| sample.time_s >= DURATION_S - 10.0);
        let spreads: Vec<f64> = late.map(|sample| spread(sample.true_db())).collect();
        (!spreads.is_empty()).then(|| spreads.iter().sum::<f64>() / spreads.len() as f64)
    }

    fn depths_m(&self, relay: usize, from_s: f64) -> Vec<f64> {
        let late = self.samples.iter().filter(|sample| sample.time_s >= from_s);
        late.filter_map(|sample| sample.depths_m.get(relay).copied()).collect()
    }

    /// When the fourth UAV took off (s).
    pub(super) fn fourth_s(&self) -> Option<f64> {
        self.launches_s.get(3).copied()
    }

    /// The fourth UAV took off when the head had stopped.
    pub(super) fn is_late_fourth(&self) -> bool {
        self.fourth_s().is_some_and(|at_s| at_s >= self.stop_s)
    }

    /// First time from the head's stop on at which the head's link is not above the threshold (s).
    pub(super) fn head_within_s(&self) -> Option<f64> {
        let mut late = self.samples.iter().filter(|sample| sample.time_s >= self.stop_s);
        let within = late.find(|sample| sample.true_db().next().is_some_and(|db| db <= S_MIN_DB));
        within.map(|sample| sample.time_s)
    }

    /// It used more relays than the best chain needs.
    pub(super) fn is_wasteful(&self) -> bool {
        self.relays_needed.is_some_and(|needed| self.relays_used > needed)
    }

    /// Share of the decisions from a time on in which some true loss is above the threshold.
    pub(super) fn share_above(&self, from_s: f64) -> f64 {
        let late: Vec<&Sample> = self.samples.iter().filter(|sample| sample.time_s >= from_s).collect();
        let above = |sample: &&&Sample| sample.true_db().any(|true_db| true_db > S_MIN_DB);
        late.iter().filter(above).count() as f64 / late.len().max(1) as f64
    }
}

/// Standard deviation.
fn standard_deviation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / n).sqrt()
}
