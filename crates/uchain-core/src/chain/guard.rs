//! What a bad or lost link makes a UAV do, whatever its law wishes (Laclau 2021, §4.3).

use super::{LinkEnd, LinkParams};
use crate::smaller;

/// Why a UAV flies otherwise than its law, or its pilot, wishes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Override {
    /// A head that has heard nobody behind it yet stays.
    NeverHeard,
    /// The head's back link is too weak to go on (`head_stop_db`).
    HeadStop,
    /// The back link is so weak that it flies backward (`head_back_db`, `relay_back_db`).
    Retreat,
    /// The back link is lost (`lost_s`): it flies backward.
    BackLost,
    /// The front link is lost (`lost_s`): it hovers.
    FrontLost,
    /// A relay is nearer to a neighbour than `equalize.spacing_db` and backs away from it before it levels anything.
    Spacing,
}

impl Override {
    /// All there are. Records number them in this order, so new ones come last.
    pub const ALL: [Self; 6] =
        [Self::NeverHeard, Self::HeadStop, Self::Retreat, Self::BackLost, Self::FrontLost, Self::Spacing];

    /// In a word, for people and programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::NeverHeard => "never-heard",
            Self::HeadStop => "head-stop",
            Self::Retreat => "retreat",
            Self::BackLost => "back-lost",
            Self::FrontLost => "front-lost",
            Self::Spacing => "spacing",
        }
    }
}

/// A threshold that is left only `hysteresis_db` below where it was crossed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Latch {
    on: bool,
}

impl Latch {
    fn over(&mut self, loss_db: f32, threshold_db: f32, hysteresis_db: f32) -> bool {
        let limit_db = if self.on { threshold_db - hysteresis_db } else { threshold_db };
        self.on = loss_db > limit_db;
        self.on
    }
}

/// What the state of its back link allows the head to do.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HeadGuard {
    stop: Latch,
    back: Latch,
}

impl HeadGuard {
    /// The pilot's speed, or what overrides it (m/s). Before its first packet the head stays: it has no link
    /// to lose and does not know which way it would come back to one.
    pub fn limit(&mut self, wish_mps: f32, back: &LinkEnd, params: &LinkParams) -> f32 {
        let loss_db = back.signal_db(params.signal).unwrap_or(f32::NEG_INFINITY);
        let stop = self.stop.over(loss_db, params.head_stop_db, params.hysteresis_db);
        let retreat = self.back.over(loss_db, params.head_back_db, params.hysteresis_db);
        if retreat || back.is_lost(params) {
            smaller(wish_mps, -params.retreat_mps)
        } else if stop || back.loss_db().is_none() {
            smaller(0.0, wish_mps)
        } else {
            wish_mps
        }
    }

    /// What overrode the pilot the last time, if his wish was for more than that allows.
    pub fn reason(&self, back: &LinkEnd, params: &LinkParams) -> Option<Override> {
        let is_lost = back.is_lost(params).then_some(Override::BackLost);
        let retreats = || self.back.on.then_some(Override::Retreat);
        let stops = || self.stop.on.then_some(Override::HeadStop);
        let has_not_heard = || back.loss_db().is_none().then_some(Override::NeverHeard);
        is_lost.or_else(retreats).or_else(stops).or_else(has_not_heard)
    }
}

/// What the state of its links makes a relay do.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RelayGuard {
    back: Latch,
}

impl RelayGuard {
    /// The law's speed, or what overrides it (m/s): backward while the back link is too weak or lost,
    /// else hovering while the front link is lost.
    pub fn limit(&mut self, wish_mps: f32, back: &LinkEnd, front: &LinkEnd, params: &LinkParams) -> f32 {
        let loss_db = back.signal_db(params.signal).unwrap_or(f32::NEG_INFINITY);
        let retreat = self.back.over(loss_db, params.relay_back_db, params.hysteresis_db);
        if retreat || back.is_lost(params) {
            -params.retreat_mps
        } else if front.is_lost(params) {
            0.0
        } else {
            wish_mps
        }
    }

    /// What overrode its law the last time.
    pub fn reason(&self, back: &LinkEnd, front: &LinkEnd, params: &LinkParams) -> Option<Override> {
        let is_lost = back.is_lost(params).then_some(Override::BackLost);
        let retreats = || self.back.on.then_some(Override::Retreat);
        let hovers = || front.is_lost(params).then_some(Override::FrontLost);
        is_lost.or_else(retreats).or_else(hovers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::{End, KalmanParams, link::at};

    #[test]
    fn the_head_is_stopped_then_pulled_back_and_let_go_only_below_the_hysteresis() {
        let params = LinkParams::default();
        let mut guard = HeadGuard::default();
        assert_eq!(guard.limit(0.2, &at(69.0), &params), 0.2);
        assert_eq!(guard.limit(0.2, &at(71.0), &params), 0.0);
        assert_eq!(guard.limit(0.2, &at(76.0), &params), -0.2);
        assert_eq!(guard.limit(0.2, &at(73.0), &params), -0.2);
        assert_eq!(guard.limit(0.2, &at(71.0), &params), 0.0);
        assert_eq!(guard.limit(0.2, &at(68.0), &params), 0.0);
        assert_eq!(guard.limit(0.2, &at(66.0), &params), 0.2);
    }

    #[test]
    fn a_head_that_has_never_heard_the_base_stays() {
        let params = LinkParams::default();
        let mut silent = LinkEnd::new(End::Front);
        for _ in 0..20 {
            silent.hear(None, Some(0.0), 0.2, &KalmanParams::default(), &params);
        }
        assert_eq!(HeadGuard::default().limit(0.2, &silent, &params), 0.0);
    }

    #[test]
    fn a_relay_prefers_its_way_home_to_its_front_link() {
        let (kalman, params) = (KalmanParams::default(), LinkParams::default());
        let mut lost = at(50.0);
        for _ in 0..6 {
            lost.hear(None, Some(0.0), 0.2, &kalman, &params);
        }
        let mut guard = RelayGuard::default();
        assert_eq!(guard.limit(0.1, &at(50.0), &at(50.0), &params), 0.1);
        assert_eq!(guard.limit(0.1, &at(50.0), &lost, &params), 0.0);
        assert_eq!(guard.limit(0.1, &lost, &lost, &params), -0.2);
        assert_eq!(guard.limit(0.1, &at(81.0), &at(50.0), &params), -0.2);
    }
}
