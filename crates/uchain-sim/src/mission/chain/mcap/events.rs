//! What happened, in words.

use foxglove::messages::{Log, log::Level};

use super::poses::body;
use crate::mission::chain::{Course, Frame, UavFrame};
use crate::record::mcap::scene::time;

/// `/log`: tells from one frame to the next what has happened.
pub(super) struct Events {
    limit_db: f32,
    uavs: Vec<Known>,
    said: Vec<Log>,
}

/// What is known of a UAV.
#[derive(Clone, Copy, Default)]
struct Known {
    airborne: bool,
    wall_contacts: u32,
    uav_contacts: u32,
    /// Its link toward the base is at or beyond the reception limit.
    lost: bool,
}

impl Events {
    pub(super) fn new(course: &Course) -> Self {
        let uavs = vec![Known::default(); course.spawns.len()];
        Self { limit_db: course.scenario.packets.limit_db, uavs, said: Vec::new() }
    }

    /// What has happened since the last frame.
    pub(super) fn update(&mut self, frame: &Frame) -> &[Log] {
        self.said.clear();
        for (index, (uav, now)) in self.uavs.iter_mut().zip(&frame.uavs).enumerate() {
            uav.look(index, now, frame.tick, &mut self.said);
        }
        if !frame.decision {
            return &self.said;
        }
        for link in &frame.links {
            let Some(uav) = self.uavs.get_mut(link.uav) else { continue };
            let lost = link.true_db >= self.limit_db;
            if lost != uav.lost {
                uav.lost = lost;
                let (level, what) = if lost { (Level::Error, "lost") } else { (Level::Info, "found again") };
                let words = format!(
                    "link toward the base {what}: {:.1} dB, reception ends at {} dB",
                    link.true_db, self.limit_db
                );
                self.said.push(log(frame.tick, link.uav, level, &words));
            }
        }
        &self.said
    }
}

impl Known {
    fn look(&mut self, index: usize, now: &UavFrame, tick: u64, said: &mut Vec<Log>) {
        let mut say = |level, words: &str| said.push(log(tick, index, level, words));
        match (self.airborne, now.airborne) {
            (false, true) => say(Level::Info, "took off"),
            (true, false) => say(Level::Error, "failed, and is out of the air"),
            _ => {}
        }
        if now.wall_contacts > self.wall_contacts {
            say(Level::Warning, "touched a wall");
        }
        if now.uav_contacts > self.uav_contacts {
            say(Level::Warning, "touched another UAV");
        }
        self.airborne = now.airborne;
        (self.wall_contacts, self.uav_contacts) = (now.wall_contacts, now.uav_contacts);
        if !now.airborne {
            self.lost = false;
        }
    }
}

fn log(tick: u64, uav: usize, level: Level, words: &str) -> Log {
    let name = if uav == 0 { "UAV 0, the head".to_owned() } else { format!("UAV {uav}") };
    Log {
        timestamp: Some(time(tick)),
        level: level.into(),
        message: format!("{name}: {words}"),
        name: body(uav),
        file: String::new(),
        line: 0,
    }
}
