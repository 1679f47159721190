//! Time series of a run: losses and depths at every decision, and how the figures draw them.

use std::{ops::Range, sync::Arc};

use uchain_sim::{
    draw::figure::{Known, Mark},
    mission::chain::{Course, Frame, History, LinkFrame, Summary},
    record::{RecordError, Recorder},
    run::run,
    sweep::Run,
};

use crate::experiment::RecordedRun;

/// On a ring, somebody deeper than this share of a round stands behind the base: nobody flies that far.
const BEHIND: f64 = 0.75;

/// One decision.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) time_s: f64,
    /// Of the links that are flown, the head's first.
    pub(super) links: Vec<LinkFrame>,
    /// Depth of every UAV (m).
    pub(super) depths_m: Vec<f64>,
    /// UAVs in the air.
    pub(super) airborne: usize,
}

impl Sample {
    /// True losses (dB).
    pub(super) fn true_db(&self) -> impl Iterator<Item = f64> {
        self.links.iter().map(|link| f64::from(link.true_db))
    }
}

/// Largest minus smallest.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    high - low
}

/// The time series of a run, and its summary.
pub(super) struct Trace {
    pub(super) samples: Vec<Sample>,
    pub(super) summary: Summary,
    /// Of the first replicate.
    pub(super) recorded: Option<RecordedRun>,
}

/// Flies a run and records its time series.
pub(super) fn record_trace(course: &Arc<Course>, one: Run) -> Result<Trace, RecordError> {
    let mut recorder = TraceRecorder { course, samples: Vec::new() };
    let mut history = (one.replicate == 0).then(History::default);
    let summary = run(course, one.seed, &mut (&mut recorder, &mut history))?;
    let recorded = history.map(|history| RecordedRun::new(course, history, &summary));
    Ok(Trace { samples: recorder.samples, summary, recorded })
}

/// Records every decision.
struct TraceRecorder<'a> {
    course: &'a Course,
    samples: Vec<Sample>,
}

impl Recorder<Frame> for TraceRecorder<'_> {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if !frame.decision {
            return Ok(());
        }
        let Some(tunnel) = &self.course.tunnel else { return Ok(()) };
        let depth_m = |at| {
            let depth_m = tunnel.depth_m(at);
            let is_behind = tunnel.line().is_closed() && depth_m > BEHIND * tunnel.length_m();
            if is_behind { depth_m - tunnel.length_m() } else { depth_m }
        };
        self.samples.push(Sample {
            time_s: frame.decided_s(),
            links: frame.links.clone(),
            depths_m: frame.uavs.iter().map(|uav| depth_m(glam::Vec2::new(uav.x_m, uav.y_m))).collect(),
            airborne: frame.uavs.iter().filter(|uav| uav.airborne).count(),
        });
        Ok(())
    }
}

/// Curves of the losses of these links over time; filtered ones where they are what relays go by.
pub(super) fn loss_curves(samples: &[Sample], links: Range<usize>, is_filtered: bool) -> Vec<Mark> {
    let curve = |link: usize, word: &str, known, of: fn(&LinkFrame) -> Option<f32>| {
        let point = |sample: &Sample| Some((sample.time_s, f64::from(of(sample.links.get(link)?)?)));
        let points: Vec<(f64, f64)> = samples.iter().filter_map(point).collect();
        Mark::Loss { name: format!("link {link} {word}"), uav: link, known, points }
    };
    let most = samples.iter().map(|sample| sample.links.len()).max().unwrap_or(0);
    let links = links.start..links.end.min(most);
    let raw = links.clone().map(|link| curve(link, "raw", Known::Raw, |link| link.raw_db));
    let filtered = links.clone().filter(|_| is_filtered);
    let filtered = filtered.map(|link| curve(link, "filtered", Known::Filtered, |link| link.filtered_db));
    let truly = links.clone().map(|link| curve(link, "true", Known::True, |link| Some(link.true_db)));
    raw.chain(filtered).chain(truly).collect()
}

/// The threshold of a launch in a box over time.
pub(super) fn threshold(s_min_db: f64) -> Mark {
    Mark::Level { name: format!("s_min {s_min_db} dB"), y: s_min_db }
}
