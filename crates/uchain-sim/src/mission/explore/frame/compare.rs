//! Frames of an exploration, field by field.

use uchain_core::explore::NodeId;

use super::{ExploreFrame, LabelFrame, NodeFrame, RobotFrame};
use crate::record::{Difference, FieldDiff, Value, Whose};

pub(crate) fn differences(frame: &ExploreFrame, there: &ExploreFrame, found: &mut dyn FnMut(Difference)) {
    let mut look = FieldDiff { tick: frame.tick, found };
    look.at(Whose::Frame, own(frame), own(there));
    for (i, (a, b)) in frame.robots.iter().zip(&there.robots).enumerate() {
        look.at(Whose::One("robot", i as u64), robot(a), robot(b));
    }
    for (a, b) in frame.nodes.iter().zip(&there.nodes) {
        look.at(node_of(a.id), node(a), node(b));
        for (x, y) in a.sectors.iter().zip(&b.sectors) {
            let sector = |sector: &uchain_core::explore::Sector| {
                [
                    ("sector.label", Value::Count(sector.label as u64)),
                    ("sector.r_m", Value::Number(sector.r_m)),
                ]
            };
            look.at(node_of(a.id), sector(x), sector(y));
        }
    }
    for (a, b) in frame.labels.iter().zip(&there.labels) {
        look.at(node_of(a.node), change(a), change(b));
    }
    for (a, b) in frame.edges.iter().flatten().zip(there.edges.iter().flatten()) {
        let end = |end: &uchain_core::explore::NodeId| {
            [("edge.robot", Value::Count(end.robot.into())), ("edge.number", Value::Count(end.number.into()))]
        };
        look.at(Whose::Frame, end(a), end(b));
    }
}

fn node_of(id: NodeId) -> Whose {
    Whose::OneOf([("node", id.number.into()), ("robot", id.robot.into())])
}

fn own(frame: &ExploreFrame) -> [(&'static str, Value); 9] {
    [
        ("tick", Value::Count(frame.tick)),
        ("rounds", Value::Count(frame.rounds.into())),
        ("decision", Value::Flag(frame.decision)),
        ("robots", Value::Count(frame.robots.len() as u64)),
        ("nodes", Value::Count(frame.nodes.len() as u64)),
        ("labels", Value::Count(frame.labels.len() as u64)),
        ("edges", Value::Count(frame.edges.len() as u64)),
        ("hubs", Value::Count(frame.hubs.into())),
        ("stopped", frame.stopped.map_or(Value::Absent, |why| Value::Count(why as u64))),
    ]
}

fn robot(robot: &RobotFrame) -> [(&'static str, Value); 12] {
    [
        ("x_m", Value::Number(robot.x_m)),
        ("y_m", Value::Number(robot.y_m)),
        ("z_m", Value::Number(robot.z_m)),
        ("heading_rad", Value::Number(robot.heading_rad)),
        ("level", Value::Count(robot.level.into())),
        ("purpose", Value::Count(robot.purpose as u64)),
        ("moves", Value::Flag(robot.moves)),
        ("holds", Value::Flag(robot.holds)),
        ("mfl", Value::Flag(robot.mfl)),
        ("wall_contacts", Value::Count(robot.wall_contacts.into())),
        ("robot_contacts", Value::Count(robot.robot_contacts.into())),
        ("level_passes", Value::Count(robot.level_passes.into())),
    ]
}

fn node(node: &NodeFrame) -> [(&'static str, Value); 7] {
    [
        ("robot", Value::Count(node.id.robot.into())),
        ("number", Value::Count(node.id.number.into())),
        ("at_m.x", Value::Number(node.at_m[0])),
        ("at_m.y", Value::Number(node.at_m[1])),
        ("believed_m.x", Value::Number(node.believed_m[0])),
        ("believed_m.y", Value::Number(node.believed_m[1])),
        ("sectors", Value::Count(node.sectors.len() as u64)),
    ]
}

fn change(change: &LabelFrame) -> [(&'static str, Value); 4] {
    [
        ("robot", Value::Count(change.node.robot.into())),
        ("number", Value::Count(change.node.number.into())),
        ("sector", Value::Count(change.sector.into())),
        ("label", Value::Count(change.label as u64)),
    ]
}
