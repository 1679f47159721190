//! How long a way is that is known by rounded places.

use glam::DVec3;

/// Length of a leg over the rounding of its ends (1): what rounding bends it by makes it longer by 10⁻⁴ at most.
const LEG: f64 = 64.0 * f32::EPSILON as f64;

/// Adds up a way place by place.
///
/// Near the middle of a map every step counts as it is. Where coordinates are large, a tick's step is as short as the
/// spacing of `f32`, and rounding to and fro would make a straight way longer: there steps are joined to legs that are
/// much longer than that, which end where the way turns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Way {
    /// Where the leg began, and where the way has come to (m).
    from: DVec3,
    at: DVec3,
    /// Of the legs so far, over ground and through the air (m).
    legs_m: (f64, f64),
}

impl Way {
    /// A way that starts there (m).
    pub(crate) fn from(at_m: DVec3) -> Self {
        Self { from: at_m, at: at_m, legs_m: (0.0, 0.0) }
    }

    /// Goes on to a place (m); `turns` if the direction may have changed where it was before.
    pub(crate) fn go(&mut self, at_m: DVec3, turns: bool) {
        if turns {
            self.end_leg();
        }
        self.at = at_m;
        let rounding_m = LEG * at_m.x.abs().max(at_m.y.abs());
        if (self.at - self.from).length() >= rounding_m {
            self.end_leg();
        }
    }

    fn end_leg(&mut self) {
        self.legs_m = (self.over_ground_m(), self.length_m());
        self.from = self.at;
    }

    /// Its length over ground (m).
    pub(crate) fn over_ground_m(&self) -> f64 {
        self.legs_m.0 + (self.at - self.from).truncate().length()
    }

    /// Its length (m).
    pub(crate) fn length_m(&self) -> f64 {
        self.legs_m.1 + (self.at - self.from).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a robot is after each tick at some speed, in `f32`; round a corner in the middle.
    fn places(far_m: f64, speed_mps: f64, heading_rad: f64) -> Vec<DVec3> {
        let (sin, cos) = libm::sincos(heading_rad);
        let at = |tick: u32| {
            let [before, after] =
                [tick.min(2000), tick.saturating_sub(2000)].map(|n| f64::from(n) * 0.05 * speed_mps);
            let (x, y) = (far_m + before * cos - after * sin, far_m + before * sin + after * cos);
            DVec3::new(f64::from(x as f32), f64::from(y as f32), 1.0)
        };
        (0..=4000).map(at).collect()
    }

    #[test]
    fn a_way_is_as_long_as_it_was_flown_however_far_from_the_middle() {
        for far_m in [0.0, 10.0, 1e4, 1e5] {
            for (speed_mps, heading_rad) in [(0.05, 0.0), (0.05, 0.5), (0.1, 2.4), (0.5, 4.0), (0.3, 1.57)] {
                let places = places(far_m, speed_mps, heading_rad);
                let mut way = Way::from(places[0]);
                for (tick, at) in places.iter().enumerate().skip(1) {
                    way.go(*at, tick == 2001);
                }
                let flown_m = 200.0 * speed_mps;
                for length_m in [way.over_ground_m(), way.length_m()] {
                    // The ends of both halves are rounded as well.
                    let most_m = 1e-3 * flown_m + 2.0 * far_m * f64::from(f32::EPSILON);
                    assert!((length_m - flown_m).abs() < most_m, "{length_m} for {flown_m} m, {far_m} m far");
                }
            }
        }
    }

    #[test]
    fn steps_added_up_as_they_are_make_a_slow_way_longer() {
        let places = places(1e5, 0.05, 0.5);
        let steps_m: f64 = places.iter().zip(&places[1..]).map(|(a, b)| a.distance(*b)).sum();
        assert!(steps_m > 1.2 * 10.0, "{steps_m}");
    }

    #[test]
    fn near_the_middle_every_step_counts() {
        let mut way = Way::from(DVec3::new(3.0, 1.0, 0.0));
        for at in [DVec3::new(3.0, 1.1, 0.0), DVec3::new(3.0, 1.0, 0.0), DVec3::new(3.0, 1.0, 0.5)] {
            way.go(at, false);
        }
        assert!((way.over_ground_m() - 0.2).abs() < 1e-9 && (way.length_m() - 0.7).abs() < 1e-9);
    }
}
