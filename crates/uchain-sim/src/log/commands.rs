//! What the node asked for and believed, as a table in CSV.

use std::fmt::Write as _;

use uchain_core::chain::{Override, Walls};

use super::{Replay, Step};

const HEADER: &str = "line,time_s,decision,asked_forward_mps,asked_lateral_mps,asked_yaw_rate_radps,airborne,stage,\
                      back_filtered_db,back_variance_db2,back_silent_s,front_filtered_db,front_variance_db2,front_silent_s,\
                      imbalance_db,wish_mps,allowed_mps,overridden,follow,walls,speed_share\n";

impl Replay {
    /// A row for every step, with all digits: read again, a number has the same bits. A cell is empty where there is nothing,
    /// and the line where the log has a gap.
    pub fn csv(&self) -> String {
        let mut text = HEADER.to_owned();
        for step in &self.steps {
            row(&mut text, step);
        }
        text
    }
}

fn row(text: &mut String, step: &Step) {
    let Step { line, time_s, is_decision, command, why, .. } = step;
    let number = |value: Option<f32>| value.map(|value| value.to_string()).unwrap_or_default();
    let line = line.map(|line| line.to_string()).unwrap_or_default();
    let (back, front) = (why.estimates.back, why.estimates.front);
    let (stage, walls) = (why.stage.word(), why.walls.map_or("", Walls::word));
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "{line},{time_s},{},{},{},{},{},{stage}",
        u8::from(*is_decision),
        command.forward_mps,
        command.lateral_mps,
        command.yaw_rate_radps,
        u8::from(command.airborne)
    );
    let numbers = [
        back.filtered_db,
        why.back_variance_db2,
        back.silent_s,
        front.filtered_db,
        why.front_variance_db2,
        front.silent_s,
        why.imbalance_db,
        Some(why.wish_mps),
        why.estimates.allowed_mps,
    ];
    for value in numbers {
        let _ = write!(text, ",{}", number(value));
    }
    let overridden = why.overridden.map_or("", Override::word);
    let _ = writeln!(text, ",{overridden},{},{walls},{}", why.follow.word(), why.speed_share);
}
