//! What happened in a chain, in words.

mod about;
mod steady;

use super::{Course, Frame, UavFrame};
use crate::record::{Event, Gravity};
use about::{About, Limits};

/// Tells from one frame to the next what has happened.
#[derive(Debug)]
pub(super) struct Events {
    limit_db: f32,
    limits: Limits,
    uavs: Vec<Known>,
    said: Vec<Event>,
}

/// What is known of a UAV.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    airborne: bool,
    wall_contacts: u32,
    uav_contacts: u32,
    /// Its link toward the base is at or beyond the reception limit.
    lost: bool,
    about: About,
}

impl Events {
    pub(super) fn new(course: &Course) -> Self {
        let uavs = vec![Known::default(); course.spawns.len()];
        Self {
            limit_db: course.scenario.packets.limit_db,
            limits: Limits::of(course),
            uavs,
            said: Vec::new(),
        }
    }

    /// What has happened since the last frame.
    pub(super) fn update(&mut self, frame: &Frame) -> &[Event] {
        self.said.clear();
        for (index, (uav, now)) in self.uavs.iter_mut().zip(&frame.uavs).enumerate() {
            uav.look(index, now, frame.tick, &mut self.said);
        }
        if !frame.decision {
            return &self.said;
        }
        for (index, (uav, now)) in self.uavs.iter_mut().zip(&frame.uavs).enumerate() {
            let said = &mut self.said;
            let say = |gravity, kind, words: &str| said.push(event(frame.tick, index, gravity, kind, words));
            uav.about.look(index, now, frame, &self.limits, say);
        }
        for link in &frame.links {
            let Some(uav) = self.uavs.get_mut(link.uav) else { continue };
            let lost = link.true_db >= self.limit_db;
            if lost != uav.lost {
                uav.lost = lost;
                let (gravity, kind, what) = if lost {
                    (Gravity::Error, "link-lost", "lost")
                } else {
                    (Gravity::Info, "link-found", "found again")
                };
                let words = format!(
                    "link toward the base {what}: {:.1} dB, reception ends at {} dB",
                    link.true_db, self.limit_db
                );
                self.said.push(event(frame.tick, link.uav, gravity, kind, &words));
            }
        }
        &self.said
    }
}

impl Known {
    fn look(&mut self, index: usize, now: &UavFrame, tick: u64, said: &mut Vec<Event>) {
        let mut say = |gravity, kind, words: &str| said.push(event(tick, index, gravity, kind, words));
        match (self.airborne, now.airborne) {
            (false, true) => say(Gravity::Info, "took-off", "took off"),
            (true, false) => say(Gravity::Error, "failed", "failed, and is out of the air"),
            _ => {}
        }
        if now.wall_contacts > self.wall_contacts {
            say(Gravity::Warning, "wall-contact", "touched a wall");
        }
        if now.uav_contacts > self.uav_contacts {
            say(Gravity::Warning, "uav-contact", "touched another UAV");
        }
        self.airborne = now.airborne;
        (self.wall_contacts, self.uav_contacts) = (now.wall_contacts, now.uav_contacts);
        if !now.airborne {
            self.lost = false;
        }
    }
}

#[cfg(test)]
mod tests;

fn event(tick: u64, uav: usize, gravity: Gravity, kind: &'static str, words: &str) -> Event {
    let name = if uav == 0 { "UAV 0, the head".to_owned() } else { format!("UAV {uav}") };
    Event { tick, gravity, kind, robot: Some(uav), text: format!("{name}: {words}") }
}
