//! Frames of a chain, field by field.

use uchain_core::chain::{Doing, LaunchHold, PendingLaunch, PilotInput};

use super::{Frame, HeadFrame, LinkFrame, Silence, UavFrame};
use crate::record::{Difference, FieldDiff, Value, Whose};

pub(crate) fn differences(frame: &Frame, there: &Frame, found: &mut dyn FnMut(Difference)) {
    let mut look = FieldDiff { tick: frame.tick, found };
    look.at(Whose::Frame, own(frame), own(there));
    if frame.leader != there.leader {
        look.at(Whose::Frame, leader(frame), leader(there));
    }
    // What one of the two did not write cannot be compared.
    if let (Some(a), Some(b)) = (&frame.head, &there.head) {
        look.at(Whose::Frame, head(a), head(b));
    }
    // A flight by hand and one by the script that came of it are the same.
    if let (Some(a), Some(b)) = (frame.input, there.input) {
        look.at(Whose::Frame, input(a), input(b));
    }
    for (i, (a, b)) in frame.uavs.iter().zip(&there.uavs).enumerate() {
        look.at(Whose::One("UAV", i as u64), uav(a), uav(b));
        if let (Some(here), Some(there)) = (a.doing, b.doing) {
            look.at(Whose::One("UAV", i as u64), doing(here), doing(there));
        }
    }
    for (a, b) in frame.links.iter().zip(&there.links) {
        look.at(Whose::One("link of UAV", a.uav as u64), link(a), link(b));
        if let (Some(here), Some(there)) = (a.silence, b.silence) {
            look.at(Whose::One("link of UAV", a.uav as u64), silence(here), silence(there));
        }
    }
}

fn own(frame: &Frame) -> [(&'static str, Value); 5] {
    [
        ("tick", Value::Count(frame.tick)),
        ("decision", Value::Flag(frame.decision)),
        ("uavs", Value::Count(frame.uavs.len() as u64)),
        ("links", Value::Count(frame.links.len() as u64)),
        ("head_reach_m", Value::Number(frame.head_reach_m)),
    ]
}

fn leader(frame: &Frame) -> [(&'static str, Value); 1] {
    [("leader", Value::Count(frame.leader as u64))]
}

fn head(head: &HeadFrame) -> [(&'static str, Value); 3] {
    [
        ("pilot_mps", Value::Number(head.pilot_mps)),
        ("allowed_mps", Value::Number(head.allowed_mps)),
        ("asked_mps", Value::Number(head.asked_mps)),
    ]
}

fn input(input: PilotInput) -> [(&'static str, Value); 2] {
    [("input.speed_mps", Value::Number(input.speed_mps)), ("input.follow", Value::Count(input.follow as u64))]
}

fn silence(silence: Silence) -> [(&'static str, Value); 2] {
    [("front_silent_s", silence.front_s.into()), ("rear_silent_s", silence.rear_s.into())]
}

fn uav(uav: &UavFrame) -> [(&'static str, Value); 13] {
    let tof = uav.tof;
    [
        ("x_m", Value::Number(uav.x_m)),
        ("y_m", Value::Number(uav.y_m)),
        ("heading_rad", Value::Number(uav.heading_rad)),
        ("forward_mps", Value::Number(uav.forward_mps)),
        ("lateral_mps", Value::Number(uav.lateral_mps)),
        ("yaw_rate_radps", Value::Number(uav.yaw_rate_radps)),
        ("airborne", Value::Flag(uav.airborne)),
        ("wall_contacts", Value::Count(uav.wall_contacts.into())),
        ("uav_contacts", Value::Count(uav.uav_contacts.into())),
        ("tof.nw_m", tof.map(|tof| tof.nw_m).into()),
        ("tof.ne_m", tof.map(|tof| tof.ne_m).into()),
        ("tof.sw_m", tof.map(|tof| tof.sw_m).into()),
        ("tof.se_m", tof.map(|tof| tof.se_m).into()),
    ]
}

/// Choices by their numbers, as in `input`.
fn doing(doing: Doing) -> [(&'static str, Value); 6] {
    let count = |number: Option<u64>| number.map_or(Value::Absent, Value::Count);
    let held = |launch: PendingLaunch| launch.held.map(|held: LaunchHold| held as u64);
    [
        ("doing.overridden", count(doing.overridden.map(|by| by as u64))),
        ("doing.follow", Value::Count(doing.follow as u64)),
        ("doing.walls", count(doing.walls.map(|walls| walls as u64))),
        ("doing.pushed_by", count(doing.pushed_by.map(|side| side as u64))),
        ("doing.launch_db", doing.launch.map(|launch| launch.loss_db).into()),
        ("doing.launch_held", count(doing.launch.and_then(held))),
    ]
}

fn link(link: &LinkFrame) -> [(&'static str, Value); 4] {
    [
        ("uav", Value::Count(link.uav as u64)),
        ("true_db", Value::Number(link.true_db)),
        ("filtered_db", link.filtered_db.into()),
        ("raw_db", link.raw_db.into()),
    ]
}
