//! What a UAV is about, in the numbers of `uchain.proto`.

use uchain_core::chain::{Doing, Follow, LaunchHold, Override, PendingLaunch, WallSide, Walls};

use super::FrameMessage;
use crate::{
    mission::chain::UavFrame,
    record::mcap::{alike, number, set, word},
};

/// Words by their numbers in `uchain.proto`.
const FOLLOWS: [Follow; 3] = [Follow::Centre, Follow::Left, Follow::Right];
const WALLS: [Option<Walls>; 4] = [None, Some(Walls::Both), Some(Walls::Left), Some(Walls::Right)];
const SIDES: [Option<WallSide>; 3] = [None, Some(WallSide::Left), Some(WallSide::Right)];
/// Those of a launch from 1 on; 0 is none.
const HELD: [Option<LaunchHold>; 4] =
    [None, Some(LaunchHold::Ahead), Some(LaunchHold::Unlevelled), Some(LaunchHold::Silent)];
/// `overridden` of a UAV that does not say what it is about.
const UNSAID: u32 = 0;
/// Of one that nothing overrides. Those of [`Override::ALL`] follow.
const NOTHING: u32 = 1;

/// What a UAV is about, as numbers.
#[derive(Clone, Copy)]
struct DoingCodes {
    overridden: u32,
    follow: u32,
    walls: u32,
    pushed_by: u32,
    launch: u32,
    /// NaN without a launch (dB).
    launch_db: f32,
}

fn codes(doing: Option<Doing>) -> DoingCodes {
    let Some(Doing { overridden, follow, walls, pushed_by, launch }) = doing else {
        return DoingCodes {
            overridden: UNSAID,
            follow: 0,
            walls: 0,
            pushed_by: 0,
            launch: 0,
            launch_db: f32::NAN,
        };
    };
    DoingCodes {
        overridden: overridden.map_or(NOTHING, |by| NOTHING + 1 + number(&Override::ALL, by)),
        follow: number(&FOLLOWS, follow),
        walls: number(&WALLS, walls),
        pushed_by: number(&SIDES, pushed_by),
        launch: launch.map_or(0, |launch| 1 + number(&HELD, launch.held)),
        launch_db: launch.map_or(f32::NAN, |launch| launch.loss_db),
    }
}

fn decoded(codes: DoingCodes) -> Result<Option<Doing>, String> {
    let overridden = match codes.overridden {
        UNSAID => return Ok(None),
        NOTHING => None,
        by => Some(word("overridden, less two,", &Override::ALL, by - NOTHING - 1)?),
    };
    let launch = match codes.launch {
        0 => None,
        held => {
            let held = word("launch, less one,", &HELD, held - 1)?;
            Some(PendingLaunch { loss_db: codes.launch_db, held })
        }
    };
    if launch.is_some() == codes.launch_db.is_nan() {
        let DoingCodes { launch, launch_db, .. } = codes;
        return Err(format!(
            "launch_db = {launch_db} with launch = {launch}: expected a loss with a launch, else NaN"
        ));
    }
    Ok(Some(Doing {
        overridden,
        follow: word("follow", &FOLLOWS, codes.follow)?,
        walls: word("walls", &WALLS, codes.walls)?,
        pushed_by: word("pushed_by", &SIDES, codes.pushed_by)?,
        launch,
    }))
}

impl FrameMessage {
    /// Empty lists where nobody says what it is about.
    pub(super) fn fill_doing(&mut self, uavs: &[UavFrame]) {
        let said = if uavs.iter().any(|uav| uav.doing.is_some()) { uavs } else { &[] };
        set(&mut self.overridden, said.iter().map(|uav| codes(uav.doing).overridden));
        set(&mut self.follow, said.iter().map(|uav| codes(uav.doing).follow));
        set(&mut self.walls, said.iter().map(|uav| codes(uav.doing).walls));
        set(&mut self.pushed_by, said.iter().map(|uav| codes(uav.doing).pushed_by));
        set(&mut self.launch, said.iter().map(|uav| codes(uav.doing).launch));
        set(&mut self.launch_db, said.iter().map(|uav| codes(uav.doing).launch_db));
    }

    /// Nothing where nobody said, and in recordings of versions that did not write it.
    pub(super) fn doing(&self, i: usize) -> Result<Option<Doing>, String> {
        let codes = || {
            Some(DoingCodes {
                overridden: *self.overridden.get(i)?,
                follow: *self.follow.get(i)?,
                walls: *self.walls.get(i)?,
                pushed_by: *self.pushed_by.get(i)?,
                launch: *self.launch.get(i)?,
                launch_db: *self.launch_db.get(i)?,
            })
        };
        codes().map_or(Ok(None), decoded)
    }

    /// As many of everything as UAVs, or nothing.
    pub(super) fn check_doing(&self) -> Result<(), String> {
        if !self.overridden.is_empty() {
            alike(self.x_m.len(), "x_m", &[("overridden", self.overridden.len())])?;
        }
        let lengths = [
            ("follow", self.follow.len()),
            ("walls", self.walls.len()),
            ("pushed_by", self.pushed_by.len()),
            ("launch", self.launch.len()),
            ("launch_db", self.launch_db.len()),
        ];
        alike(self.overridden.len(), "overridden", &lengths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_a_uav_can_be_about_comes_back_as_it_was() {
        let overrides = std::iter::once(None).chain(Override::ALL.map(Some));
        let launches =
            std::iter::once(None).chain(HELD.map(|held| Some(PendingLaunch { loss_db: 61.5, held })));
        let launches: Vec<_> = launches.collect();
        for overridden in overrides {
            for (follow, walls, pushed_by) in FOLLOWS.iter().flat_map(|follow| {
                WALLS.iter().flat_map(move |walls| SIDES.map(|side| (*follow, *walls, side)))
            }) {
                for &launch in &launches {
                    let doing = Some(Doing { overridden, follow, walls, pushed_by, launch });
                    assert_eq!(decoded(codes(doing)), Ok(doing));
                }
            }
        }
        assert_eq!(decoded(codes(None)), Ok(None));
    }

    #[test]
    fn numbers_without_a_word_are_refused_with_what_there_is() {
        let of = |change: fn(&mut DoingCodes)| {
            let mut codes = codes(Some(Doing::default()));
            change(&mut codes);
            decoded(codes).unwrap_err()
        };
        assert_eq!(of(|codes| codes.overridden = 8), "overridden, less two, = 6: expected less than 6");
        assert_eq!(of(|codes| codes.walls = 4), "walls = 4: expected less than 4");
        assert_eq!(
            of(|codes| (codes.launch, codes.launch_db) = (5, 60.0)),
            "launch, less one, = 4: expected less than 4"
        );
        assert!(of(|codes| codes.launch = 1).starts_with("launch_db = NaN with launch = 1"));
        assert!(of(|codes| codes.launch_db = 60.0).starts_with("launch_db = 60 with launch = 0"));
    }
}
