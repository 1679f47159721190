//! Who hears whom: robots within the range of messages, and those they pass on to.

use uchain_core::explore::{Message, Point, Ssg};

/// Groups of robots that hear each other this round.
#[derive(Debug)]
pub(super) struct Hearing {
    /// Range of messages (m); `None`: all of the map.
    range_m: Option<f32>,
    /// Per robot, the lowest index of its group.
    group: Vec<usize>,
}

impl Hearing {
    pub(super) fn new(robots: usize, range_m: Option<f32>) -> Self {
        Self { range_m, group: vec![0; robots] }
    }

    /// The robots of a robot's group, itself included, in index order.
    pub(super) fn group_of(&self, robot: usize) -> impl Iterator<Item = usize> + '_ {
        let group = self.group.get(robot);
        self.group.iter().enumerate().filter(move |(_, other)| Some(*other) == group).map(|(i, _)| i)
    }

    /// Robots are at these places now. Those that did not hear each other before tell each other all they know.
    pub(super) fn listen(&mut self, places: &[Point], stores: &mut [Ssg]) {
        let Some(range_m) = self.range_m else { return };
        let before = std::mem::take(&mut self.group);
        self.group = groups(places, range_m);
        for leader in 0..self.group.len() {
            let members: Vec<usize> = self.group_of(leader).filter(|&i| i != leader).collect();
            let is_new = members.iter().any(|&i| before.get(i) != before.get(leader));
            if self.group[leader] != leader || !is_new {
                continue;
            }
            for &member in &members {
                tell(stores, member, leader);
            }
            for &member in &members {
                tell(stores, leader, member);
            }
        }
    }
}

/// Per robot the lowest index that messages can come from or go to.
fn groups(places: &[Point], range_m: f32) -> Vec<usize> {
    let mut group: Vec<usize> = (0..places.len()).collect();
    for first in 0..places.len() {
        if group[first] != first {
            continue;
        }
        let mut open = vec![first];
        while let Some(i) = open.pop() {
            for (j, place) in places.iter().enumerate() {
                if group[j] != first && places[i].distance_m(*place) <= range_m {
                    group[j] = first;
                    open.push(j);
                }
            }
        }
    }
    group
}

/// One robot tells another one all nodes it knows, with their labels. What is known already changes nothing.
fn tell(stores: &mut [Ssg], from: usize, to: usize) {
    let Some(known) = stores.get(from) else { return };
    let reports: Vec<Message> =
        (0..known.len()).filter_map(|slot| known.report(slot)).map(Message::Node).collect();
    if let Some(store) = stores.get_mut(to) {
        for report in &reports {
            // Where the store is full, so it is.
            let _ = store.apply(report);
        }
    }
}
