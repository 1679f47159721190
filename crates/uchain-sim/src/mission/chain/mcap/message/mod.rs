//! Messages of a chain.

mod doing;
mod metrics;

use prost::Message as _;
use uchain_core::chain::Tof;

use super::input::{INPUT, InputMessage};
use crate::record::mcap::{Described, Recordable, alike, bounded, few, set};
use crate::{
    map::FARTHEST_M,
    mission::chain::{Frame, HeadFrame, LinkFrame, Silence, UAVS_MAX, UavFrame},
};
pub(super) use metrics::MetricsMessage;

/// `uchain.Frame`. Stands for one frame after the other, so that its lists are allocated once.
#[derive(Clone, PartialEq, prost::Message)]
pub struct FrameMessage {
    #[prost(uint64, tag = "1")]
    tick: u64,
    #[prost(bool, tag = "2")]
    decision: bool,
    #[prost(float, repeated, tag = "3")]
    x_m: Vec<f32>,
    #[prost(float, repeated, tag = "4")]
    y_m: Vec<f32>,
    #[prost(float, repeated, tag = "5")]
    heading_rad: Vec<f32>,
    #[prost(float, repeated, tag = "6")]
    forward_mps: Vec<f32>,
    #[prost(float, repeated, tag = "7")]
    lateral_mps: Vec<f32>,
    #[prost(float, repeated, tag = "8")]
    yaw_rate_radps: Vec<f32>,
    #[prost(bool, repeated, tag = "9")]
    airborne: Vec<bool>,
    #[prost(uint32, repeated, tag = "10")]
    wall_contacts: Vec<u32>,
    #[prost(uint32, repeated, tag = "11")]
    uav_contacts: Vec<u32>,
    #[prost(float, repeated, tag = "12")]
    tof_m: Vec<f32>,
    #[prost(uint32, repeated, tag = "13")]
    link_uav: Vec<u32>,
    #[prost(float, repeated, tag = "14")]
    link_true_db: Vec<f32>,
    #[prost(float, repeated, tag = "15")]
    link_filtered_db: Vec<f32>,
    #[prost(float, tag = "16")]
    head_reach_m: f32,
    #[prost(float, repeated, tag = "17")]
    link_raw_db: Vec<f32>,
    #[prost(float, repeated, tag = "18")]
    link_silent_s: Vec<f32>,
    #[prost(float, repeated, tag = "19")]
    head_mps: Vec<f32>,
    #[prost(uint32, repeated, tag = "20")]
    overridden: Vec<u32>,
    #[prost(uint32, repeated, tag = "21")]
    follow: Vec<u32>,
    #[prost(uint32, repeated, tag = "22")]
    walls: Vec<u32>,
    #[prost(uint32, repeated, tag = "23")]
    pushed_by: Vec<u32>,
    #[prost(uint32, repeated, tag = "24")]
    launch: Vec<u32>,
    #[prost(float, repeated, tag = "25")]
    launch_db: Vec<f32>,
}

impl FrameMessage {
    /// Takes a frame's values.
    fn fill(&mut self, frame: &Frame) {
        // The pilot's input, and who is piloted, are a message of their own.
        let Frame { tick, decision, uavs, leader: _, links, head_reach_m, head, input: _ } = frame;
        (self.tick, self.decision, self.head_reach_m) = (*tick, *decision, *head_reach_m);
        set(&mut self.x_m, uavs.iter().map(|uav| uav.x_m));
        set(&mut self.y_m, uavs.iter().map(|uav| uav.y_m));
        set(&mut self.heading_rad, uavs.iter().map(|uav| uav.heading_rad));
        set(&mut self.forward_mps, uavs.iter().map(|uav| uav.forward_mps));
        set(&mut self.lateral_mps, uavs.iter().map(|uav| uav.lateral_mps));
        set(&mut self.yaw_rate_radps, uavs.iter().map(|uav| uav.yaw_rate_radps));
        set(&mut self.airborne, uavs.iter().map(|uav| uav.airborne));
        set(&mut self.wall_contacts, uavs.iter().map(|uav| uav.wall_contacts));
        set(&mut self.uav_contacts, uavs.iter().map(|uav| uav.uav_contacts));
        self.tof_m.clear();
        if uavs.iter().any(|uav| uav.tof.is_some()) {
            let beams = |tof: Tof| [tof.nw_m, tof.ne_m, tof.sw_m, tof.se_m];
            self.tof_m.extend(uavs.iter().flat_map(|uav| uav.tof.map_or([f32::NAN; 4], beams)));
        }
        set(&mut self.link_uav, links.iter().map(|link| link.uav as u32));
        set(&mut self.link_true_db, links.iter().map(|link| link.true_db));
        set(&mut self.link_raw_db, links.iter().map(|link| link.raw_db.unwrap_or(f32::NAN)));
        set(&mut self.link_filtered_db, links.iter().map(|link| link.filtered_db.unwrap_or(f32::NAN)));
        let ends = |silence: Silence| [silence.front_s, silence.rear_s].map(|s| s.unwrap_or(f32::NAN));
        set(&mut self.link_silent_s, links.iter().filter_map(|link| link.silence).flat_map(ends));
        let speeds = |head: &HeadFrame| [head.pilot_mps, head.allowed_mps, head.asked_mps];
        set(&mut self.head_mps, head.iter().flat_map(speeds));
        self.fill_doing(uavs);
    }

    fn pour(&self, frame: &mut Frame) -> Result<(), String> {
        self.check()?;
        (frame.tick, frame.decision, frame.head_reach_m) = (self.tick, self.decision, self.head_reach_m);
        set(&mut frame.uavs, (0..self.x_m.len()).map_while(|i| self.uav(i)));
        let uavs = frame.uavs.len();
        for (i, uav) in frame.uavs.iter_mut().enumerate() {
            uav.doing = self.doing(i)?;
        }
        if frame.leader != 0 && frame.leader >= uavs {
            return Err(format!("leader = {}: expected one of {uavs} UAVs", frame.leader));
        }
        set(&mut frame.links, (0..self.link_uav.len()).map_while(|i| self.link(i)));
        frame.head = match self.head_mps[..] {
            [pilot_mps, allowed_mps, asked_mps] => Some(HeadFrame { pilot_mps, allowed_mps, asked_mps }),
            _ => None,
        };
        Ok(())
    }

    fn uav(&self, i: usize) -> Option<UavFrame> {
        let tof = match self.tof_m.get(4 * i..4 * i + 4) {
            Some(beams) if beams.iter().all(|beam_m| beam_m.is_nan()) => None,
            Some(&[nw_m, ne_m, sw_m, se_m]) => Some(Tof { nw_m, ne_m, sw_m, se_m }),
            _ => None,
        };
        Some(UavFrame {
            x_m: *self.x_m.get(i)?,
            y_m: *self.y_m.get(i)?,
            heading_rad: *self.heading_rad.get(i)?,
            forward_mps: *self.forward_mps.get(i)?,
            lateral_mps: *self.lateral_mps.get(i)?,
            yaw_rate_radps: *self.yaw_rate_radps.get(i)?,
            airborne: *self.airborne.get(i)?,
            wall_contacts: *self.wall_contacts.get(i)?,
            uav_contacts: *self.uav_contacts.get(i)?,
            tof,
            doing: None,
        })
    }

    fn link(&self, i: usize) -> Option<LinkFrame> {
        let [filtered_db, raw_db] = [*self.link_filtered_db.get(i)?, *self.link_raw_db.get(i)?];
        Some(LinkFrame {
            uav: *self.link_uav.get(i)? as usize,
            true_db: *self.link_true_db.get(i)?,
            filtered_db: (!filtered_db.is_nan()).then_some(filtered_db),
            raw_db: (!raw_db.is_nan()).then_some(raw_db),
            silence: self.silence(i),
        })
    }

    /// Nothing in recordings of versions that did not write it.
    fn silence(&self, i: usize) -> Option<Silence> {
        let known = |silent_s: f32| (!silent_s.is_nan()).then_some(silent_s);
        match *self.link_silent_s.get(2 * i..2 * i + 2)? {
            [front_s, rear_s] => Some(Silence { front_s: known(front_s), rear_s: known(rear_s) }),
            _ => None,
        }
    }

    fn check(&self) -> Result<(), String> {
        let uavs = self.x_m.len();
        if uavs > UAVS_MAX {
            return Err(format!("{uavs} UAVs: expected at most {UAVS_MAX}"));
        }
        let lengths = [
            ("y_m", self.y_m.len()),
            ("heading_rad", self.heading_rad.len()),
            ("forward_mps", self.forward_mps.len()),
            ("lateral_mps", self.lateral_mps.len()),
            ("yaw_rate_radps", self.yaw_rate_radps.len()),
            ("airborne", self.airborne.len()),
            ("wall_contacts", self.wall_contacts.len()),
            ("uav_contacts", self.uav_contacts.len()),
        ];
        alike(uavs, "x_m", &lengths)?;
        if !self.tof_m.is_empty() {
            alike(4 * uavs, "x_m, times four", &[("tof_m", self.tof_m.len())])?;
            // A UAV reads all of its beams, or none.
            let is_half = |beams: &[f32]| {
                let read = beams.iter().filter(|beam_m| !beam_m.is_nan()).count();
                !(read == 0 || read == beams.len())
            };
            if let Some(uav) = self.tof_m.chunks(4).position(is_half) {
                let beams = self.tof_m.chunks(4).nth(uav).unwrap_or_default();
                return Err(format!("tof_m = {beams:?} of UAV {uav}: expected four numbers, or none"));
            }
        }
        let links = self.link_uav.len();
        let lengths = [
            ("link_true_db", self.link_true_db.len()),
            ("link_filtered_db", self.link_filtered_db.len()),
            ("link_raw_db", self.link_raw_db.len()),
        ];
        alike(links, "link_uav", &lengths)?;
        if !self.link_silent_s.is_empty() {
            alike(2 * links, "link_uav, twice", &[("link_silent_s", self.link_silent_s.len())])?;
        }
        if !self.head_mps.is_empty() {
            alike(3, "the head", &[("head_mps", self.head_mps.len())])?;
        }
        self.check_doing()?;
        if let Some(uav) = self.link_uav.iter().find(|uav| **uav as usize >= uavs) {
            return Err(format!("link_uav = {uav}: expected one of {uavs} UAVs"));
        }
        if links > uavs {
            return Err(format!("{links} links of {uavs} UAVs: expected at most one each"));
        }
        self.numbers()
    }

    fn numbers(&self) -> Result<(), String> {
        bounded(&[
            ("x_m", &self.x_m),
            ("y_m", &self.y_m),
            ("heading_rad", &self.heading_rad),
            ("forward_mps", &self.forward_mps),
            ("lateral_mps", &self.lateral_mps),
            ("yaw_rate_radps", &self.yaw_rate_radps),
            ("link_true_db", &self.link_true_db),
            ("head_mps", &self.head_mps),
        ])?;
        // NaN stands for none.
        let most = 10.0 * FARTHEST_M;
        for (name, list) in [
            ("tof_m", &self.tof_m),
            ("link_filtered_db", &self.link_filtered_db),
            ("link_raw_db", &self.link_raw_db),
            ("link_silent_s", &self.link_silent_s),
            ("launch_db", &self.launch_db),
        ] {
            if let Some(value) = list.iter().find(|value| value.abs() > most) {
                return Err(format!("{name} = {value}: expected a number within ±{most}"));
            }
        }
        few(&[("wall_contacts", &self.wall_contacts), ("uav_contacts", &self.uav_contacts)])?;
        let reach_m = self.head_reach_m;
        if !(0.0..=1e9).contains(&reach_m) {
            return Err(format!("head_reach_m = {reach_m}: expected a length"));
        }
        Ok(())
    }
}

impl Recordable for Frame {
    type Message = FrameMessage;
    const PROTO: &'static str = crate::mission::PROTO;
    const MESSAGE: &'static str = "Frame";
    const INPUT: Option<Described> = Some(INPUT);

    fn take(&mut self, message: &FrameMessage) -> Result<(), String> {
        message.pour(self)
    }

    fn fill(&self, message: &mut FrameMessage) {
        message.fill(self);
    }

    fn input(&self) -> Option<impl prost::Message> {
        InputMessage::of(self.input, self.leader)
    }

    fn take_input(&mut self, message: Option<&[u8]>) -> Result<(), String> {
        (self.input, self.leader) = match message {
            Some(bytes) => InputMessage::decode(bytes).map_err(|error| error.to_string())?.taken()?,
            None => (None, 0),
        };
        Ok(())
    }
}
