//! What a UAV is about, in words: overrides, walls, launches.

use uchain_core::chain::{
    Doing, LaunchHold, LinkParams, Override, PendingLaunch, Signal, TakeoffParams, WallSide,
};

use super::steady::{Steady, Turn};
use crate::{
    clock::time_s,
    mission::chain::{Course, Frame, LinkFrame, UavFrame},
    record::Gravity,
};

/// The numbers of a scenario that events tell.
#[derive(Debug)]
pub(super) struct Limits {
    link: LinkParams,
    takeoff: TakeoffParams,
    push_below_m: f32,
    spacing_db: f32,
}

impl Limits {
    pub(super) fn of(course: &Course) -> Self {
        let scenario = &course.scenario;
        Self {
            link: scenario.link.clone(),
            takeoff: scenario.takeoff.clone(),
            push_below_m: scenario.center.push_below_m,
            spacing_db: scenario.equalize.spacing_db,
        }
    }
}

/// What has been told of a UAV.
#[derive(Debug, Clone, Copy)]
pub(super) struct About {
    overridden: Steady<Override>,
    pushed_by: Steady<WallSide>,
    invalid_wall: Steady<WallSide>,
    launch: Steady<Option<LaunchHold>>,
}

/// A wall that a beam or two do not see is not invalid yet: noise does that every other second (ticks).
const WALL_TICKS: u64 = 12;

impl Default for About {
    fn default() -> Self {
        Self {
            overridden: Steady::patient(0),
            pushed_by: Steady::patient(0),
            invalid_wall: Steady::patient(WALL_TICKS),
            launch: Steady::patient(0),
        }
    }
}

impl About {
    /// Tells what has turned at a decision.
    pub(super) fn look(
        &mut self,
        index: usize,
        uav: &UavFrame,
        frame: &Frame,
        limits: &Limits,
        mut say: impl FnMut(Gravity, &'static str, &str),
    ) {
        let Some(doing) = uav.doing else {
            *self = Self::default();
            return;
        };
        let tick = frame.tick;
        let Turn { over, begins } = self.overridden.turn(doing.overridden, tick);
        if let Some((by, ticks)) = over {
            say(Gravity::Info, OVERRIDE_ENDS, &ended(by.word(), ticks));
        }
        if let Some(by) = begins {
            say(gravity(by), OVERRIDE_BEGINS, &overridden(by, index, frame, limits));
        }
        let Turn { over, begins } = self.pushed_by.turn(doing.pushed_by, tick);
        if let Some((_, ticks)) = over {
            say(Gravity::Info, OVERRIDE_ENDS, &ended(PUSH, ticks));
        }
        if let Some(side) = begins {
            say(Gravity::Info, OVERRIDE_BEGINS, &pushed(side, uav, limits));
        }
        let Turn { over, begins } = self.invalid_wall.turn(doing.invalid_wall(), tick);
        if let Some((side, ticks)) = over {
            let words = format!("its {} wall is valid again, after {:.1} s", side_word(side), time_s(ticks));
            say(Gravity::Info, "wall-valid", &words);
        }
        if let Some(side) = begins {
            say(Gravity::Info, "wall-invalid", &invalid(side, uav));
        }
        self.look_at_launch(uav.airborne, doing, tick, limits, say);
    }

    fn look_at_launch(
        &mut self,
        airborne: bool,
        doing: Doing,
        tick: u64,
        limits: &Limits,
        mut say: impl FnMut(Gravity, &'static str, &str),
    ) {
        if airborne {
            self.launch.forget();
            return;
        }
        let Turn { over, begins } = self.launch.turn(doing.launch.map(|launch| launch.held), tick);
        let s_min_db = limits.takeoff.s_min_db;
        match (doing.launch, begins) {
            (Some(PendingLaunch { loss_db, held: None }), Some(None)) => {
                let hold_s = limits.takeoff.launch_hold_s;
                let words = format!(
                    "launch armed: the link that will be its own reads {loss_db:.1} dB, takeoff.s_min_db = {s_min_db}; it takes \
                     off if that lasts for takeoff.launch_hold_s = {hold_s}"
                );
                say(Gravity::Info, "launch-armed", &words);
            }
            (Some(PendingLaunch { loss_db, held: Some(by) }), Some(_)) => {
                let why = held(by, limits);
                let words = format!(
                    "launch held: the link that will be its own reads {loss_db:.1} dB, takeoff.s_min_db = {s_min_db}, but {why}"
                );
                say(Gravity::Info, "launch-held", &words);
            }
            _ if over.is_some() => {
                let words = format!(
                    "launch disarmed: the link that will be its own reads no more than takeoff.s_min_db = {s_min_db} again"
                );
                say(Gravity::Info, "launch-disarmed", &words);
            }
            _ => {}
        }
    }
}

const OVERRIDE_BEGINS: &str = "override-begins";
const OVERRIDE_ENDS: &str = "override-ends";

/// The word of what is no [`Override`] of the forward speed: a wall is too near.
const PUSH: &str = "safety-push";

/// A flight that its links turn back is worse than one that they stop.
fn gravity(by: Override) -> Gravity {
    match by {
        Override::Retreat | Override::BackLost | Override::FrontLost => Gravity::Warning,
        _ => Gravity::Info,
    }
}

fn ended(word: &str, ticks: u64) -> String {
    format!("no longer overridden ({word}), after {:.1} s", time_s(ticks))
}

fn overridden(by: Override, index: usize, frame: &Frame, limits: &Limits) -> String {
    let link = &limits.link;
    let place = frame.links.iter().position(|link| link.uav == index);
    let back = place.and_then(|place| frame.links.get(place));
    let front = place.and_then(|place| frame.links.get(place.checked_sub(1)?));
    let reads = |key: &str, limit_db: f32| {
        let read_db = back.and_then(|back| read_db(back, link.signal));
        let read_db = read_db.map_or_else(|| "nothing".to_owned(), |db| format!("{db:.1} dB"));
        format!("its link toward the base reads {read_db}, link.{key} = {limit_db}")
    };
    let silent = |whence: &str, silent_s: Option<f32>| {
        let for_s = silent_s.map_or_else(String::new, |s| format!(" for {s:.1} s"));
        format!("it has heard nothing from {whence}{for_s}, link.lost_s = {}", link.lost_s)
    };
    let why = match by {
        Override::NeverHeard => "it stays, for it has heard nobody yet".to_owned(),
        Override::HeadStop => format!("it goes no farther, {}", reads("head_stop_db", link.head_stop_db)),
        Override::Retreat if index == frame.leader => {
            format!("it flies backward, {}", reads("head_back_db", link.head_back_db))
        }
        Override::Retreat => format!("it flies backward, {}", reads("relay_back_db", link.relay_back_db)),
        Override::BackLost => {
            let silent_s = back.and_then(|link| link.silence?.front_s);
            format!("it flies backward, {}", silent("the base's side", silent_s))
        }
        Override::FrontLost => {
            let silent_s = front.and_then(|link| link.silence?.rear_s);
            format!("it hovers, {}", silent("the head's side", silent_s))
        }
        Override::Spacing => {
            let spacing_db = limits.spacing_db;
            format!(
                "it backs away from a neighbour, the loss between them is below equalize.spacing_db = {spacing_db}"
            )
        }
        _ => "it flies otherwise than it wishes".to_owned(),
    };
    format!("overridden ({}): {why}", by.word())
}

/// What an override looked at.
fn read_db(link: &LinkFrame, signal: Signal) -> Option<f32> {
    match signal {
        Signal::Filtered => link.filtered_db,
        Signal::Raw => link.raw_db,
    }
}

fn pushed(side: WallSide, uav: &UavFrame, limits: &Limits) -> String {
    let nearest_m = uav.tof.map(|tof| match side {
        WallSide::Left => tof.nw_m.min(tof.sw_m),
        WallSide::Right => tof.ne_m.min(tof.se_m),
    });
    let beam = nearest_m.map_or_else(String::new, |m| format!(" reads {m:.2} m"));
    let (side, below_m) = (side_word(side), limits.push_below_m);
    format!(
        "overridden ({PUSH}): its {side} wall pushes it away, a beam{beam}, center.push_below_m = {below_m}"
    )
}

fn invalid(side: WallSide, uav: &UavFrame) -> String {
    let other = if side == WallSide::Left { WallSide::Right } else { WallSide::Left };
    let beams = uav.tof.map_or_else(String::new, |tof| {
        format!(
            " (front and rear beams: left {:.2} and {:.2} m, right {:.2} and {:.2} m)",
            tof.nw_m, tof.sw_m, tof.ne_m, tof.se_m
        )
    });
    format!("its {} wall is invalid, it steers by the {} one alone{beams}", side_word(side), side_word(other))
}

fn side_word(side: WallSide) -> &'static str {
    match side {
        WallSide::Left => "left",
        WallSide::Right => "right",
    }
}

fn held(by: LaunchHold, limits: &Limits) -> String {
    let TakeoffParams { after_previous_s, converged_db, .. } = limits.takeoff;
    match by {
        LaunchHold::Ahead => {
            format!("the UAV ahead has not flown for takeoff.after_previous_s = {after_previous_s} yet")
        }
        LaunchHold::Unlevelled => {
            format!("the chain has not levelled to takeoff.converged_db = {converged_db} yet")
        }
        LaunchHold::Silent => {
            format!("nothing has been heard for longer than link.lost_s = {}", limits.link.lost_s)
        }
    }
}
