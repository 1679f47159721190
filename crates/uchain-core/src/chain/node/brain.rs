//! A node as a brain: decisions as a whole, packets, and what it believes.

use super::{
    super::{
        Brain, Command, Doing, Estimates, Explanation, LaunchHold, Observation, Override, Packet,
        PendingLaunch, Stage, center::walls_of, equalize, equalize::spacing, takeoff::held,
    },
    Node, Role, estimate, piloted_mps,
};
use crate::bounded;

impl Brain for Node {
    fn decide(&mut self, seen: &Observation) -> Command {
        let level_mps = match self.ask(seen) {
            Some((back_db, front_db)) => equalize(back_db, front_db, &self.params.equalize),
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
        let is_flying = self.has_settled();
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
            wish_mps: self.bounded_wish_mps(seen),
            overridden: self.overridden(seen),
            follow: self.follow,
            walls: seen.tof.and_then(|tof| {
                walls_of(&tof, p.tof_range_m, self.forward_mps < 0.0, self.follow, &p.center)
            }),
            speed_share: self.centering.speed_share,
        })
    }

    fn doing(&self, seen: &Observation) -> Option<Doing> {
        Some(Doing {
            overridden: self.overridden(seen),
            follow: self.follow,
            walls: self.steered_by.walls,
            pushed_by: self.steered_by.pushed_by.filter(|_| self.has_settled()),
            launch: self.pending_launch(),
        })
    }
}

impl Node {
    /// What its pilot, or its law, wishes, within what it can fly (m/s).
    fn bounded_wish_mps(&self, seen: &Observation) -> f32 {
        let wish_mps = if self.role() == Role::Head { piloted_mps(seen) } else { self.wish_mps };
        let most_mps = self.params.equalize.v_max_mps;
        bounded(wish_mps, -most_mps, most_mps)
    }

    /// What made something else of its wish.
    fn overridden(&self, seen: &Observation) -> Option<Override> {
        if !self.has_settled() {
            return None;
        }
        let (p, wish_mps) = (&self.params, self.bounded_wish_mps(seen));
        // A head whose pilot asks for no more than it is allowed is overridden by nothing.
        if self.forward_mps != wish_mps {
            return match self.role() {
                Role::Head => self.head_guard.reason(&self.back, &p.link),
                Role::Relay => self.relay_guard.reason(&self.back, &self.front, &p.link),
            };
        }
        // Backing away from a neighbour is a part of the law, and not of what was asked for from elsewhere.
        let (back_db, front_db) = self.both_db().filter(|_| self.role() == Role::Relay)?;
        (spacing(back_db, front_db, &p.equalize) == Some(wish_mps)).then_some(Override::Spacing)
    }

    /// Its launch, as long as the chain needs one more UAV.
    fn pending_launch(&self) -> Option<PendingLaunch> {
        let p = &self.params;
        if self.airborne || self.role() == Role::Head {
            return None;
        }
        let loss_db = self.front.signal_db(p.takeoff.launch_signal).filter(|db| *db > p.takeoff.s_min_db)?;
        let is_lost = self.front.is_lost(&p.link);
        let held = if is_lost { Some(LaunchHold::Silent) } else { held(&self.front.neighbour(), &p.takeoff) };
        Some(PendingLaunch { loss_db, held })
    }
}
