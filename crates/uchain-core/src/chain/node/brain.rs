//! A node as a brain: decisions as a whole, packets, and what it believes.

use super::{
    super::{Brain, Command, Estimates, Explanation, Observation, Packet, Stage, center::walls_of, equalize},
    Node, Role, estimate, piloted_mps,
};
use crate::bounded;

impl Brain for Node {
    fn decide(&mut self, seen: &Observation) -> Command {
        let level_mps = match self.prepare(seen) {
            Some(asked) => equalize(asked.back_db, asked.front_db, &self.params.equalize),
            None => 0.0,
        };
        self.conclude(seen, level_mps)
    }

    fn say(&self, seen: &Observation) -> Packet {
        Packet {
            place: seen.place.unwrap_or(self.place),
            ground_speed_mps: seen.ground_speed_mps.unwrap_or(0.0),
            flown_s: self.flown_s(),
            follow: self.follow,
            imbalance_db: self.worst_imbalance_db,
            is_base: false,
            battery: seen.battery,
            own: [0; 8],
        }
    }

    fn estimates(&self) -> Estimates {
        Estimates {
            back: estimate(&self.back),
            front: estimate(&self.front),
            allowed_mps: self.has_settled().then_some(self.forward_mps),
        }
    }

    fn explain(&self, seen: &Observation) -> Option<Explanation> {
        let p = &self.params;
        let (wish_mps, reason) = match self.role() {
            Role::Head => (piloted_mps(seen), self.head_guard.reason(&self.back, &p.link)),
            Role::Relay => (self.wish_mps, self.relay_guard.reason(&self.back, &self.front, &p.link)),
        };
        let is_flying = self.has_settled();
        let wish_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
        Some(Explanation {
            role: self.role(),
            place: (self.place != Self::LAST).then_some(self.place),
            stage: match (self.airborne, is_flying) {
                (false, _) => Stage::Waiting,
                (true, false) => Stage::Rising,
                (true, true) => Stage::Flying,
            },
            estimates: self.estimates(),
            back_variance_db2: self.back.variance_db2(),
            front_variance_db2: self.front.variance_db2(),
            imbalance_db: self.imbalance_db(),
            wish_mps,
            // A head whose pilot asks for no more than it is allowed is overridden by nothing.
            overridden: reason.filter(|_| is_flying && self.forward_mps != wish_mps),
            follow: self.follow,
            walls: seen.tof.and_then(|tof| {
                walls_of(&tof, p.tof_range_m, self.forward_mps < 0.0, self.follow, &p.center)
            }),
            speed_share: self.centering.speed_share,
        })
    }
}
