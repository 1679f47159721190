//! One frame in a few numbers.

use serde::Serialize;

use crate::mission::chain::{Frame, LinkFrame};

/// One instant of a run in a few numbers, for tables and plots.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Moment {
    /// Simulated time at the end of the frame's tick (s).
    pub time_s: f64,
    /// UAVs in the air.
    pub uavs: usize,
    /// Tunnel distance from the base to the head (m).
    pub head_reach_m: f32,
    /// Largest true loss of any link (dB); `None` without a link.
    pub worst_link_db: Option<f32>,
    /// Largest minus smallest true loss (dB); `None` without two links.
    pub spread_db: Option<f32>,
    /// The head flies, and every link was heard within `link.lost_s`, both ways; `None` if a recording does not say.
    pub connected: Option<bool>,
    /// Wall contacts begun so far.
    pub wall_contacts: u32,
    /// Contacts between UAVs begun so far.
    pub uav_contacts: u32,
}

impl Moment {
    /// A frame's numbers; a link that is silent for longer than `lost_s` connects nobody (s).
    pub fn of(frame: &Frame, lost_s: f32) -> Self {
        Self {
            time_s: frame.time_s(),
            uavs: frame.uavs.iter().filter(|uav| uav.airborne).count(),
            head_reach_m: frame.head_reach_m,
            worst_link_db: frame.links.iter().map(|link| link.true_db).max_by(f32::total_cmp),
            spread_db: spread_db(&frame.links),
            connected: frame.is_connected(lost_s),
            wall_contacts: frame.uavs.iter().map(|uav| uav.wall_contacts).sum(),
            uav_contacts: frame.uavs.iter().map(|uav| uav.uav_contacts).sum::<u32>() / 2,
        }
    }
}

/// Largest minus smallest true loss (dB); `None` without two links.
pub(crate) fn spread_db(links: &[LinkFrame]) -> Option<f32> {
    if links.len() < 2 {
        return None;
    }
    let low = links.iter().map(|link| link.true_db).fold(f32::INFINITY, f32::min);
    let high = links.iter().map(|link| link.true_db).fold(f32::NEG_INFINITY, f32::max);
    Some(high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_link_has_no_spread() {
        let link = |true_db| LinkFrame { uav: 0, true_db, filtered_db: None, raw_db: None, silence: None };
        assert_eq!(spread_db(&[link(50.0)]), None);
        assert_eq!(spread_db(&[link(50.0), link(57.0), link(52.0)]), Some(7.0));
    }
}
