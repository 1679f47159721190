//! How near robots come to each other: beside, above and below.

use glam::DVec3;
use serde::Serialize;

use crate::record::{RobotFrame, TICKS_PER_S};

/// What was least between two robots over time, middle to middle. One is *below* the other if it is lower by more than
/// two radii; else they are *beside* each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Gap {
    /// The two, lower index first.
    pub robots: [u16; 2],
    /// Least distance through the air (m).
    pub least_m: f64,
    /// Least distance over ground while they were beside each other (m); `None` if they never were.
    pub beside_m: Option<f64>,
    /// Least difference of heights while one was in the downwash of the other (m): below it, and no farther over
    /// ground than the downwash's radius; `None` if none ever was.
    pub below_m: Option<f64>,
    /// How long one was in the downwash of the other (s).
    pub downwash_s: f64,
}

/// Watches all pairs.
#[derive(Debug)]
pub(super) struct Gaps {
    body_m: f64,
    downwash_m: f64,
    pairs: Vec<Pair>,
    /// Per robot, ticks in anybody's downwash.
    under: Vec<u64>,
}

/// The same, while it is counted.
#[derive(Debug, Clone, Copy)]
struct Pair {
    least_m: f64,
    beside_m: f64,
    below_m: f64,
    ticks: u64,
}

impl Gaps {
    /// For robots of a radius, with a downwash of a radius (m).
    pub(super) fn new(robots: u16, r_body_m: f32, downwash_m: f32) -> Self {
        let robots = usize::from(robots);
        let far = Pair { least_m: f64::INFINITY, beside_m: f64::INFINITY, below_m: f64::INFINITY, ticks: 0 };
        Self {
            body_m: 2.0 * f64::from(r_body_m),
            downwash_m: downwash_m.into(),
            pairs: vec![far; robots * robots.saturating_sub(1) / 2],
            under: vec![0; robots],
        }
    }

    /// One tick has passed.
    pub(super) fn look(&mut self, robots: &[RobotFrame]) {
        let place = |robot: &RobotFrame| DVec3::new(robot.x_m.into(), robot.y_m.into(), robot.z_m.into());
        for (j, under) in self.under.iter_mut().enumerate() {
            let Some(own) = robots.get(j).map(place) else { return };
            let is_above = |other: &RobotFrame| {
                let way = place(other) - own;
                way.z > self.body_m && way.truncate().length() <= self.downwash_m
            };
            *under += u64::from(robots.iter().any(is_above));
        }
        let ends = robots.iter().enumerate().flat_map(|(j, b)| robots.iter().take(j).map(move |a| (a, b)));
        for (pair, (a, b)) in self.pairs.iter_mut().zip(ends) {
            let way = place(b) - place(a);
            let (over_m, up_m) = (way.truncate().length(), way.z.abs());
            pair.least_m = pair.least_m.min(way.length());
            if up_m <= self.body_m {
                pair.beside_m = pair.beside_m.min(over_m);
            } else if over_m <= self.downwash_m {
                pair.below_m = pair.below_m.min(up_m);
                pair.ticks += 1;
            }
        }
    }

    /// All pairs, the nearest first.
    pub(super) fn gaps(&self) -> Vec<Gap> {
        let ends = (0..self.under.len() as u16).flat_map(|j| (0..j).map(move |i| [i, j]));
        let known = |m: f64| m.is_finite().then_some(m);
        let mut gaps: Vec<Gap> = ends
            .zip(&self.pairs)
            .map(|(robots, pair)| Gap {
                robots,
                least_m: pair.least_m,
                beside_m: known(pair.beside_m),
                below_m: known(pair.below_m),
                downwash_s: pair.ticks as f64 / TICKS_PER_S,
            })
            .collect();
        // The sort is stable: of equal ones the lower comes first.
        gaps.sort_by(|a, b| a.least_m.total_cmp(&b.least_m));
        gaps
    }

    /// Per robot, how long it was in the downwash of any other one (s).
    pub(super) fn downwash_s(&self) -> Vec<f64> {
        self.under.iter().map(|&ticks| ticks as f64 / TICKS_PER_S).collect()
    }
}

#[cfg(test)]
mod tests {
    use uchain_core::explore::Purpose;

    use super::*;

    fn at(x_m: f32, z_m: f32) -> RobotFrame {
        RobotFrame {
            x_m,
            y_m: 0.0,
            z_m,
            heading_rad: 0.0,
            level: 1,
            purpose: Purpose::Wait,
            moves: false,
            holds: false,
            mfl: false,
            wall_contacts: 0,
            robot_contacts: 0,
            level_passes: 0,
        }
    }

    #[test]
    fn the_lower_of_two_is_in_the_downwash_and_two_side_by_side_are_not() {
        let mut gaps = Gaps::new(3, 0.1, 0.3);
        // Robot 1 flies under robot 0; robot 2 stays away, then comes beside robot 0.
        gaps.look(&[at(0.0, 1.5), at(0.25, 0.5), at(3.0, 1.5)]);
        gaps.look(&[at(0.0, 1.5), at(0.0, 1.0), at(0.4, 1.5)]);
        assert_eq!(gaps.downwash_s(), [0.0, 0.1, 0.0]);
        let [near, beside, far] = gaps.gaps().try_into().unwrap();
        assert_eq!(near.robots, [0, 2]);
        assert!((near.beside_m.unwrap() - 0.4).abs() < 1e-6 && near.below_m.is_none(), "{near:?}");
        assert_eq!((beside.robots, beside.below_m, beside.beside_m), ([0, 1], Some(0.5), None));
        assert_eq!((beside.least_m, beside.downwash_s), (0.5, 0.1));
        assert_eq!((far.robots, far.downwash_s, far.beside_m), ([1, 2], 0.0, None));
    }
}
