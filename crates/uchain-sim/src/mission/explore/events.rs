//! What happened in an exploration, in words.

use uchain_core::explore::Purpose;

use super::{ExploreFrame, RobotFrame, Stopped};
use crate::record::{Event, Gravity};

/// Tells from one frame to the next what has happened.
#[derive(Debug, Default)]
pub(super) struct Events {
    robots: Vec<RobotFrame>,
    said: Vec<Event>,
}

impl Events {
    /// What has happened since the last frame.
    pub(super) fn update(&mut self, frame: &ExploreFrame) -> &[Event] {
        self.said.clear();
        for (i, now) in frame.robots.iter().enumerate() {
            let was = self.robots.get(i);
            let mut say = |gravity: Gravity, kind: &'static str, words: &str| {
                let text = format!("robot {i}: {words}");
                self.said.push(Event { tick: frame.tick, gravity, kind, robot: Some(i), text });
            };
            if was.is_none_or(|was| was.purpose != now.purpose) {
                say(Gravity::Info, "purpose", purpose(now.purpose));
            }
            if now.holds && was.is_none_or(|was| !was.holds) {
                say(Gravity::Info, "holds", "holds for another robot");
            }
            if was.is_some_and(|was| was.holds && !now.holds) {
                say(Gravity::Info, "hold-ends", "holds no longer");
            }
            if now.mfl && was.is_none_or(|was| was.level != now.level || !was.mfl) {
                say(Gravity::Info, "keeps-clear", &format!("keeps clear on level {}", now.level));
            }
            if was.is_some_and(|was| was.mfl && !now.mfl) {
                say(Gravity::Info, "keeps-clear-ends", &format!("is on its usual level {} again", now.level));
            } else if was.is_some_and(|was| was.level != now.level && !now.mfl) {
                say(Gravity::Info, "level", &format!("changes to level {}", now.level));
            }
            if now.wall_contacts > was.map_or(0, |was| was.wall_contacts) {
                say(Gravity::Warning, "wall-contact", "touched a wall");
            }
            if now.robot_contacts > was.map_or(0, |was| was.robot_contacts) {
                say(Gravity::Warning, "robot-contact", "touched another robot");
            }
            if now.level_passes > was.map_or(0, |was| was.level_passes) {
                say(Gravity::Warning, "level-pass", "came near a robot that changes its level");
            }
        }
        if let Some(why) = frame.stopped {
            let gravity = if why == Stopped::Explored { Gravity::Info } else { Gravity::Warning };
            let text = format!("over: {}", why.words());
            self.said.push(Event { tick: frame.tick, gravity, kind: "over", robot: None, text });
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
