//! What is drawn of a replay, box by box.

use uchain_core::chain::Stage;

use super::{Known, Replay, Step};
use crate::draw::panel::widened;

/// Most points of one line; the picture is narrower than that.
const POINTS_MAX: usize = 2000;
/// Usual distances of rows from which on a line through what was measured has a gap.
const FAR: f64 = 5.0;
/// A box lower than this is a low one (px), and shows at least this much on either side of 0.
const LOW: f64 = 100.0;
const LEAST: f64 = 0.1;
/// Colours of the two links, of the four beams, and of speeds.
const BACK: usize = 1;
const FRONT: usize = 0;
const BEAMS: [(&str, usize); 4] =
    [("front left", 4), ("front right", 2), ("rear left", 3), ("rear right", 5)];
const ASKED: usize = 0;
const WISHED: usize = 1;
const FLOWN: usize = 2;
const LOGGED: usize = 3;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum How {
    /// Behind one that is mostly the same.
    Wide,
    Thick,
    /// In the background.
    Thin,
    Dashed,
    /// As losses are in every picture.
    Loss(Known),
}

/// A line.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) name: &'static str,
    pub(super) colour: usize,
    pub(super) how: How,
    /// Time (s) and value; `None` where it has a gap.
    pub(super) points: Vec<Option<(f64, f64)>>,
}

/// A box of axes over time.
#[derive(Debug)]
pub(super) struct Graph {
    pub(super) label: &'static str,
    pub(super) height: f64,
    pub(super) range: (f64, f64),
    /// A thin line right across, and what it is called.
    pub(super) level: Option<(f64, String)>,
    pub(super) curves: Vec<Curve>,
}

/// The boxes that have something to show, from above.
pub(super) fn graphs(replay: &Replay) -> Vec<Graph> {
    let steps = &replay.steps;
    // In a gap between rows the node goes on, and what the log has ends.
    let far_s = FAR * replay.usual_s;
    let curve = |name, colour, how, of: &dyn Fn(&Step) -> Option<f32>| {
        curve(steps, name, (colour, how), f64::INFINITY, of)
    };
    let logged = |name, colour, how, of: &dyn Fn(&Step) -> Option<f32>| {
        self::curve(steps, name, (colour, how), far_s, of)
    };
    let flies = |step: &Step| step.why.stage == Stage::Flying;
    // Without distances nothing is centred.
    let has_tof = steps.iter().any(|step| step.tof.is_some());
    let (raw, filtered) = (How::Loss(Known::Raw), How::Loss(Known::Filtered));
    let s_min_db = replay.summary.s_min_db;
    let graphs = [
        graph(
            "loss (dB)",
            170.0,
            s_min_db.map(|s_min_db| (f64::from(s_min_db), format!("s_min {s_min_db} dB"))),
            vec![
                curve("", BACK, raw, &|step| step.raw_db[0]),
                curve("", FRONT, raw, &|step| step.raw_db[1]),
                curve("back", BACK, filtered, &|step| step.why.estimates.back.filtered_db),
                curve("front", FRONT, filtered, &|step| step.why.estimates.front.filtered_db),
            ],
        ),
        graph(
            "front − back (dB)",
            70.0,
            Some((0.0, String::new())),
            vec![curve("", FLOWN, How::Thick, &|step| step.why.imbalance_db)],
        ),
        graph(
            "forward (m/s)",
            130.0,
            Some((0.0, String::new())),
            vec![
                logged("flown", FLOWN, How::Thin, &|step| step.ground_speed_mps),
                curve("wished", WISHED, How::Thin, &|step| Some(step.why.wish_mps).filter(|_| flies(step))),
                curve("allowed", WISHED, How::Wide, &|step| step.why.estimates.allowed_mps),
                curve("asked", ASKED, How::Thick, &|step| Some(step.command.forward_mps)),
                logged("in the log", LOGGED, How::Dashed, &|step| step.asked[0]),
            ],
        ),
        graph(
            "distances (m)",
            100.0,
            None,
            (0..4)
                .map(|i| logged(BEAMS[i].0, BEAMS[i].1, How::Thick, &|step| Some(beams(step)?[i])))
                .collect(),
        ),
        graph(
            "left (m/s)",
            70.0,
            Some((0.0, String::new())),
            vec![
                curve("asked", ASKED, How::Thick, &|step| has_tof.then_some(step.command.lateral_mps)),
                logged("in the log", LOGGED, How::Dashed, &|step| step.asked[1]),
            ],
        ),
        graph(
            "yaw rate (rad/s)",
            70.0,
            Some((0.0, String::new())),
            vec![
                curve("asked", ASKED, How::Thick, &|step| has_tof.then_some(step.command.yaw_rate_radps)),
                logged("in the log", LOGGED, How::Dashed, &|step| step.asked[2]),
            ],
        ),
    ];
    graphs.into_iter().flatten().collect()
}

fn beams(step: &Step) -> Option<[f32; 4]> {
    step.tof.map(|tof| [tof.nw_m, tof.ne_m, tof.sw_m, tof.se_m])
}

/// A line through what there is, with a gap where rows lie farther apart than `far_s`.
fn curve(
    steps: &[Step],
    name: &'static str,
    (colour, how): (usize, How),
    far_s: f64,
    of: &dyn Fn(&Step) -> Option<f32>,
) -> Curve {
    let value = |step: &Step| of(step).filter(|value| value.is_finite()).map(f64::from);
    let every = steps.iter().filter_map(value).count().div_ceil(POINTS_MAX).max(1);
    let (mut points, mut found, mut row_s, mut is_broken) = (Vec::new(), 0, None, false);
    for step in steps {
        if step.line.is_some() {
            is_broken |= row_s.replace(step.time_s).is_some_and(|before_s| step.time_s - before_s > far_s);
        }
        let Some(value) = value(step) else { continue };
        if found % every == 0 {
            let has_gap = std::mem::take(&mut is_broken) && found > 0;
            points.extend(has_gap.then_some(None));
            points.push(Some((step.time_s, value)));
        }
        found += 1;
    }
    Curve { name, colour, how, points }
}

/// A box with those of its lines that have points; `None` without any.
fn graph(
    label: &'static str,
    height: f64,
    level: Option<(f64, String)>,
    mut curves: Vec<Curve>,
) -> Option<Graph> {
    curves.retain(|curve| !curve.points.is_empty());
    if curves.is_empty() {
        return None;
    }
    let values = curves.iter().flat_map(|curve| &curve.points).flatten().map(|(_, value)| *value);
    let level_at = level.as_ref().map(|(level, _)| *level);
    // A low box around 0 shows at least a tenth either way: finer numbers at its axis would reach into its name.
    let least = level_at.filter(|level| *level == 0.0 && height < LOW).map(|_| [-LEAST, LEAST]);
    let range = widened(values.chain(level_at).chain(least.into_iter().flatten()), 0.07);
    Some(Graph { label, height, range, level, curves })
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use crate::log::Settings;

    #[test]
    fn what_was_measured_breaks_across_a_gap_and_what_was_decided_does_not() {
        let mut log = "time_s,ground_speed_mps,back_rssi_dbm,front_rssi_dbm\n".to_owned();
        for row in (0..100).filter(|row| !(40..60).contains(row)) {
            // A speed in every tenth row: farther apart than any gap, in a log without one.
            let speed = if row % 10 == 0 { "0.1" } else { "" };
            let _ = writeln!(log, "{},{speed},-50,-57", f64::from(row) * 0.05);
        }
        let replay = Replay::of(&log, "log.csv", &Settings::read(&[]).unwrap()).unwrap();
        let graphs = graphs(&replay);
        let points = |name: &str| {
            let curves = || graphs.iter().filter(|graph| graph.label.starts_with("forward"));
            let curve = curves().flat_map(|graph| &graph.curves).find(|curve| curve.name == name);
            curve.unwrap().points.iter().map(Option::is_some).collect::<Vec<_>>()
        };
        assert_eq!(points("flown"), [true, true, true, true, false, true, true, true, true]);
        assert!(points("asked").into_iter().all(|is_there| is_there));
    }
}
