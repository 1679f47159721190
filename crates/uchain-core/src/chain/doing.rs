//! What a UAV is about, in a few words: what records keep of it at every decision.

use super::{Follow, Override, Walls};

/// What a UAV is about after a decision, for records: nothing in a flight depends on it. [`Explanation`](super::Explanation)
/// says more, to whoever asks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Doing {
    /// What its law, or its pilot, is overridden by.
    pub overridden: Option<Override>,
    /// The wall choice it flies by.
    pub follow: Follow,
    /// The walls that its centering steers by; `None` if by none, and until it has distances.
    pub walls: Option<Walls>,
    /// The wall that is so near that it is pushed away from it, whatever its law says (`center.push_below_m`).
    pub pushed_by: Option<WallSide>,
    /// On the ground: its launch, once the link that will be its own is weak enough for one more UAV
    /// (`takeoff.s_min_db`).
    pub launch: Option<PendingLaunch>,
}

impl Doing {
    /// The wall that centering leaves out though no pilot chose the other one.
    pub fn invalid_wall(&self) -> Option<WallSide> {
        match (self.follow, self.walls) {
            (Follow::Centre, Some(Walls::Left)) => Some(WallSide::Right),
            (Follow::Centre, Some(Walls::Right)) => Some(WallSide::Left),
            _ => None,
        }
    }
}

/// A wall as a UAV sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSide {
    /// To its left.
    Left,
    /// To its right.
    Right,
}

/// A launch that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PendingLaunch {
    /// Loss of the link that will be its own, by the signal a launch looks at (dB).
    pub loss_db: f32,
    /// What it waits for; `None`: it is armed, and takes off when the loss stays like this for `takeoff.launch_hold_s`.
    pub held: Option<LaunchHold>,
}

/// What holds a launch up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LaunchHold {
    /// The UAV ahead has not flown for long enough (`takeoff.after_previous_s`).
    Ahead,
    /// The flying chain has not levelled (`takeoff.launch`).
    Unlevelled,
    /// Nothing has been heard of the chain for longer than `link.lost_s`.
    Silent,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_that_the_pilot_did_not_want_is_not_called_invalid() {
        let by = |follow, walls| Doing { follow, walls, ..Doing::default() }.invalid_wall();
        assert_eq!(by(Follow::Centre, Some(Walls::Left)), Some(WallSide::Right));
        assert_eq!(by(Follow::Centre, Some(Walls::Right)), Some(WallSide::Left));
        assert_eq!(by(Follow::Left, Some(Walls::Left)), None);
        assert_eq!(by(Follow::Centre, Some(Walls::Both)), None);
        assert_eq!(by(Follow::Centre, None), None);
    }
}
