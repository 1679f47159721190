//! The numbers of a chain over time, for programs.

use std::sync::Arc;

use uchain_core::chain::Tof;

use super::{Chain, Course, Frame, LinkFrame, Metrics, Moment, Silence, UavFrame, events::Events};
use crate::{
    clock::{period_ticks, total_ticks},
    mission::{Keep, Log, Logbook},
    record::{
        RecordError, Recorder,
        table::{Read, Rows, Series},
    },
};

/// A row per frame.
const FRAMES: &[Series<Frame>] = &[
    ("time_s", Read::Number(Frame::time_s)),
    ("decision", Read::Flag(|frame| frame.decision)),
    ("leader", Read::Count(|frame| frame.leader as u32)),
    ("head_reach_m", Read::Single(|frame| frame.head_reach_m)),
    ("head_pilot_mps", Read::Single(|frame| frame.head.map_or(f32::NAN, |head| head.pilot_mps))),
    ("head_allowed_mps", Read::Single(|frame| frame.head.map_or(f32::NAN, |head| head.allowed_mps))),
    ("head_asked_mps", Read::Single(|frame| frame.head.map_or(f32::NAN, |head| head.asked_mps))),
    ("x_m", Read::Singles(|frame, to| singles(frame, to, |uav| uav.x_m))),
    ("y_m", Read::Singles(|frame, to| singles(frame, to, |uav| uav.y_m))),
    ("heading_rad", Read::Singles(|frame, to| singles(frame, to, |uav| uav.heading_rad))),
    ("forward_mps", Read::Singles(|frame, to| singles(frame, to, |uav| uav.forward_mps))),
    ("lateral_mps", Read::Singles(|frame, to| singles(frame, to, |uav| uav.lateral_mps))),
    ("yaw_rate_radps", Read::Singles(|frame, to| singles(frame, to, |uav| uav.yaw_rate_radps))),
    ("airborne", Read::Flags(|frame, to| to.extend(frame.uavs.iter().map(|uav| uav.airborne)))),
    ("wall_contacts", Read::Counts(|frame, to| to.extend(frame.uavs.iter().map(|uav| uav.wall_contacts)))),
    ("uav_contacts", Read::Counts(|frame, to| to.extend(frame.uavs.iter().map(|uav| uav.uav_contacts)))),
    ("tof_nw_m", Read::Singles(|frame, to| tof(frame, to, |tof| tof.nw_m))),
    ("tof_ne_m", Read::Singles(|frame, to| tof(frame, to, |tof| tof.ne_m))),
    ("tof_sw_m", Read::Singles(|frame, to| tof(frame, to, |tof| tof.sw_m))),
    ("tof_se_m", Read::Singles(|frame, to| tof(frame, to, |tof| tof.se_m))),
];

/// A row per decision; a link stands at the UAV at its front end.
const LINKS: &[Series<Frame>] = &[
    ("time_s", Read::Number(Frame::time_s)),
    ("decided_s", Read::Number(Frame::decided_s)),
    ("worst_link_db", Read::Single(|frame| moment(frame).worst_link_db.unwrap_or(f32::NAN))),
    ("spread_db", Read::Single(|frame| moment(frame).spread_db.unwrap_or(f32::NAN))),
    ("true_db", Read::Singles(|frame, to| links(frame, to, |link| Some(link.true_db)))),
    ("filtered_db", Read::Singles(|frame, to| links(frame, to, |link| link.filtered_db))),
    ("raw_db", Read::Singles(|frame, to| links(frame, to, |link| link.raw_db))),
    ("front_silence_s", Read::Singles(|frame, to| silence(frame, to, |silence| silence.front_s))),
    ("rear_silence_s", Read::Singles(|frame, to| silence(frame, to, |silence| silence.rear_s))),
];

fn singles(frame: &Frame, to: &mut Vec<f32>, of: fn(&UavFrame) -> f32) {
    to.extend(frame.uavs.iter().map(of));
}

fn tof(frame: &Frame, to: &mut Vec<f32>, of: fn(&Tof) -> f32) {
    to.extend(frame.uavs.iter().map(|uav| uav.tof.as_ref().map_or(f32::NAN, of)));
}

fn links(frame: &Frame, to: &mut Vec<f32>, of: impl Fn(&LinkFrame) -> Option<f32>) {
    let before = to.len();
    to.resize(before + frame.uavs.len(), f32::NAN);
    for link in &frame.links {
        if let (Some(place), Some(value)) = (to.get_mut(before + link.uav), of(link)) {
            *place = value;
        }
    }
}

fn silence(frame: &Frame, to: &mut Vec<f32>, of: fn(&Silence) -> Option<f32>) {
    links(frame, to, |link| link.silence.as_ref().and_then(of));
}

fn moment(frame: &Frame) -> Moment {
    // Who is connected is not asked.
    Moment::of(frame, f32::INFINITY)
}

/// Keeps the numbers of a chain over time.
pub(super) struct ChainLog {
    keep: Keep,
    frames: Option<Rows<Frame>>,
    links: Option<Rows<Frame>>,
    events: Events,
    log: Log,
}

impl ChainLog {
    pub(super) fn new(course: &Course, frames: Option<Keep>) -> Result<Self, RecordError> {
        let (crew, ticks) = (course.spawns.len(), total_ticks(course.scenario.duration_s));
        let decisions = ticks.div_ceil(period_ticks(course.scenario.equalize.decision_s).max(1));
        let rows = |name, series, most| Rows::new(name, series, crew, most).map(|rows| rows.with_room(most));
        let kept = |keep: Keep| if keep == Keep::Ticks { ticks } else { decisions };
        Ok(Self {
            keep: frames.unwrap_or(Keep::Decisions),
            frames: frames.map(|keep| rows("frames", FRAMES, kept(keep))).transpose()?,
            links: frames.map(|_| rows("links", LINKS, decisions)).transpose()?,
            events: Events::new(course),
            log: Log::default(),
        })
    }
}

impl Recorder<Frame> for ChainLog {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if let Some(frames) = self.frames.as_mut().filter(|_| frame.decision || self.keep == Keep::Ticks) {
            frames.push(frame)?;
        }
        if let Some(links) = self.links.as_mut().filter(|_| frame.decision) {
            links.push(frame)?;
        }
        self.log.note(self.events.update(frame));
        Ok(())
    }
}

impl Logbook<Chain> for ChainLog {
    fn log(&self) -> &Log {
        &self.log
    }

    fn close(self: Box<Self>, _: &Metrics) -> Log {
        let tables = self.frames.into_iter().chain(self.links).map(Rows::table).collect();
        Log { tables, ..self.log }
    }
}

/// A logbook of a course.
pub(super) fn logbook(
    course: &Arc<Course>,
    frames: Option<Keep>,
) -> Result<Option<Box<dyn Logbook<Chain>>>, RecordError> {
    Ok(Some(Box::new(ChainLog::new(course, frames)?)))
}
