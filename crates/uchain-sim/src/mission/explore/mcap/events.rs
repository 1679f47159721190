//! What happened in an exploration, in words.

use foxglove::messages::{Log, log::Level};
use uchain_core::explore::Purpose;

use super::body;
use crate::mission::explore::{ExploreFrame, RobotFrame, Stopped};
use crate::record::mcap::scene::time;

/// `/log`: tells from one frame to the next what has happened.
#[derive(Debug, Default)]
pub(super) struct Events {
    robots: Vec<RobotFrame>,
    said: Vec<Log>,
}

impl Events {
    /// What has happened since the last frame.
    pub(super) fn update(&mut self, frame: &ExploreFrame) -> &[Log] {
        self.said.clear();
        for (i, now) in frame.robots.iter().enumerate() {
            let was = self.robots.get(i);
            let mut say = |level: Level, words: &str| {
                self.said.push(log(frame.tick, &body(i), level, &format!("robot {i}: {words}")));
            };
            if was.is_none_or(|was| was.purpose != now.purpose) {
                say(Level::Info, purpose(now.purpose));
            }
            if now.holds && was.is_none_or(|was| !was.holds) {
                say(Level::Info, "holds for another robot");
            }
            if now.mfl && was.is_none_or(|was| was.level != now.level || !was.mfl) {
                say(Level::Info, &format!("keeps clear on level {}", now.level));
            }
            if now.wall_contacts > was.map_or(0, |was| was.wall_contacts) {
                say(Level::Warning, "touched a wall");
            }
            if now.robot_contacts > was.map_or(0, |was| was.robot_contacts) {
                say(Level::Warning, "touched another robot");
            }
            if now.level_passes > was.map_or(0, |was| was.level_passes) {
                say(Level::Warning, "came near a robot that changes its level");
            }
        }
        if let Some(why) = frame.stopped {
            let level = if why == Stopped::Explored { Level::Info } else { Level::Warning };
            self.said.push(log(frame.tick, "exploration", level, &format!("over: {}", why.words())));
        }
        self.robots.clone_from(&frame.robots);
        &self.said
    }
}

fn purpose(purpose: Purpose) -> &'static str {
    match purpose {
        Purpose::Explore => "explores",
        Purpose::Backtrack => "flies back to a frontier",
        Purpose::Home => "flies home",
        Purpose::Park => "is home",
        Purpose::Wait => "waits",
    }
}

fn log(tick: u64, name: &str, level: Level, words: &str) -> Log {
    Log {
        timestamp: Some(time(tick)),
        level: level.into(),
        message: words.to_owned(),
        name: name.to_owned(),
        file: String::new(),
        line: 0,
    }
}
