//! Why a UAV of a chain does what it does, in words and numbers: its own account of itself, read out.

use serde_json::{Value, json};
use uchain_core::chain::{
    CenterLaw, Explanation, Follow, LinkEstimate, Override, Packet, Role, SpeedLaw, Stage, Tof, Walls,
};
use uchain_sim::mission::{
    Mission as _,
    chain::{Chain, Course},
};

use super::chain::Last;
use crate::problem::Problem;

/// What a UAV believes and asks for where a chain stands, most important first.
pub(super) fn why(course: &Course, chain: &Chain, last: Last, uav: usize) -> Result<Value, Problem> {
    let Some(mut told) = chain.explain(uav) else {
        let count = course.spawns.len();
        return Err(Problem::new(if uav < count {
            format!("the law of UAV {uav} does not explain itself")
        } else {
            format!("there is no UAV {uav}: expected 0 to {}", count - 1)
        }));
    };
    let frame = chain.frame();
    // Between two readings it steers by what it read last.
    told.walls = told.walls.or(last.doing.and_then(|doing| doing.walls));
    let asks_mps = told.estimates.allowed_mps.map(|allowed_mps| allowed_mps * told.speed_share);
    let says = chain.says(uav);
    let tof = last.tof;
    let mut words = Vec::new();
    stage(course, &told, &mut words);
    if told.stage == Stage::Flying {
        forward(course, &told, &mut words);
        let moves = told.estimates.allowed_mps.is_some_and(|allowed_mps| allowed_mps.abs() > STILL_MPS);
        if told.speed_share < 1.0 && moves {
            let percent = 100.0 * told.speed_share;
            words.push(format!("A wall is near ahead: it flies at {percent:.0} % of that."));
        }
        sideways(course, &told, tof.as_ref(), &mut words);
    }
    let link = |link: &LinkEstimate, variance_db2: Option<f32>| {
        link.raw_db.map(|raw_db| {
            json!({
                "filtered_db": link.filtered_db,
                "variance_db2": variance_db2,
                "raw_db": raw_db,
                "silent_s": link.silent_s,
            })
        })
    };
    Ok(json!({
        "reached": true,
        "tick": frame.tick,
        "uav": uav,
        "words": words,
        "role": told.role.word(),
        "place": told.place,
        "stage": told.stage.word(),
        "back": link(&told.estimates.back, told.back_variance_db2),
        "front": link(&told.estimates.front, told.front_variance_db2),
        "imbalance_db": told.imbalance_db,
        "dead_band_db": dead_band_db(course),
        "wish_mps": told.wish_mps,
        "allowed_mps": told.estimates.allowed_mps,
        "asks_mps": asks_mps,
        "overridden": told.overridden.map(Override::word),
        "follow": told.follow.word(),
        "walls": told.walls.map(Walls::word),
        "speed_share": told.speed_share,
        "backward": told.estimates.allowed_mps.is_some_and(|allowed_mps| allowed_mps < 0.0),
        "tof": tof.map(|tof| json!({ "nw_m": tof.nw_m, "ne_m": tof.ne_m, "sw_m": tof.sw_m, "se_m": tof.se_m })),
        "push_below_m": course.scenario.center.push_below_m,
        "tells": says.map(|packet| tells(&packet)),
    }))
}

fn tells(packet: &Packet) -> Value {
    json!({
        "place": packet.place,
        "ground_speed_mps": packet.ground_speed_mps,
        "flown_s": packet.flown_s,
        "follow": packet.follow.word(),
        "imbalance_db": packet.imbalance_db,
        "battery": packet.battery,
    })
}

/// Imbalance up to which it stays (dB).
fn dead_band_db(course: &Course) -> f32 {
    let p = &course.scenario.equalize;
    if p.law == SpeedLaw::BangBang { p.tolerance_db.max(p.bang_band_db) } else { p.tolerance_db }
}

/// On the ground, or on its way up.
fn stage(course: &Course, told: &Explanation, words: &mut Vec<String>) {
    let p = &course.scenario.takeoff;
    match told.stage {
        Stage::Waiting => words.push(match told.estimates.front.filtered_db {
            Some(loss_db) => format!(
                "It waits on the ground. It hears the UAV ahead at {loss_db:.1} dB, and takes off when that has been above \
                 {} dB for {} s.",
                p.s_min_db, p.launch_hold_s
            ),
            None => "It waits on the ground for its turn.".to_owned(),
        }),
        Stage::Rising => words.push(format!(
            "It rises for {} s and hovers for {} s before it flies by its laws.",
            p.rise_s, p.hover_s
        )),
        _ => {}
    }
}

/// Why it flies forward, backward, or stays.
fn forward(course: &Course, told: &Explanation, words: &mut Vec<String>) {
    let allowed_mps = told.estimates.allowed_mps.unwrap_or(0.0);
    if let Some(reason) = told.overridden {
        words.push(overridden(course, told, reason, allowed_mps));
    }
    match told.role {
        Role::Head if told.overridden.is_none() => {
            words.push(format!("It leads, and does what its pilot asks for: {}.", flies(allowed_mps)));
        }
        Role::Head => words.push(format!("Its pilot asks for {}.", flies(told.wish_mps))),
        Role::Relay if told.overridden == Some(Override::Spacing) => {}
        Role::Relay => words.push(levels(course, told)),
    }
}

fn levels(course: &Course, told: &Explanation) -> String {
    let Some(imbalance_db) = told.imbalance_db else {
        return "It has not heard both of its neighbours yet, and stays.".to_owned();
    };
    let size_db = imbalance_db.abs();
    let band_db = dead_band_db(course);
    if size_db <= band_db && band_db > 0.0 {
        return format!(
            "Its two links differ by {size_db:.1} dB, within the {band_db} dB that count as level: it stays."
        );
    }
    let which = if imbalance_db > 0.0 { "front link is" } else { "back link is" };
    let other = if imbalance_db > 0.0 { "back link" } else { "front link" };
    format!(
        "Its {which} {size_db:.1} dB worse than its {other}: to level them its law asks for {}.",
        flies(told.wish_mps)
    )
}

fn overridden(course: &Course, told: &Explanation, reason: Override, allowed_mps: f32) -> String {
    let p = &course.scenario.link;
    let back_db = told.estimates.back.filtered_db.unwrap_or(f32::NAN);
    let silent_s = |link: &LinkEstimate| link.silent_s.unwrap_or(f32::NAN);
    let flies = flies(allowed_mps);
    match reason {
        Override::NeverHeard => "It has heard nobody behind it yet, and may not fly forward.".to_owned(),
        Override::HeadStop => format!(
            "Its back link loses {back_db:.1} dB; above {} dB it may not fly forward until that is {} dB better: {flies}.",
            p.head_stop_db, p.hysteresis_db
        ),
        Override::Retreat => {
            let limit_db = if told.role == Role::Head { p.head_back_db } else { p.relay_back_db };
            format!("Its back link loses {back_db:.1} dB; above {limit_db} dB it has to go back: {flies}.")
        }
        Override::BackLost => format!(
            "It has heard nobody behind it for {:.1} s; after {} s the link counts as lost, and it has to go back: {flies}.",
            silent_s(&told.estimates.back),
            p.lost_s
        ),
        Override::FrontLost => format!(
            "It has heard nobody ahead of it for {:.1} s; after {} s the link counts as lost: it waits.",
            silent_s(&told.estimates.front),
            p.lost_s
        ),
        Override::Spacing => {
            let p = &course.scenario.equalize;
            let is_near = told.estimates.front.filtered_db.is_some_and(|loss_db| loss_db < p.spacing_db);
            let whom = if is_near { "ahead" } else { "behind" };
            format!("The UAV {whom} is nearer than {} dB, and it backs away from it: {flies}.", p.spacing_db)
        }
        _ => format!("Its wish is overridden: {flies}."),
    }
}

/// Below this it is said to stand (m/s).
const STILL_MPS: f32 = 0.0005;

/// A speed in words.
fn flies(speed_mps: f32) -> String {
    if speed_mps > STILL_MPS {
        format!("{speed_mps:.2} m/s forward")
    } else if speed_mps < -STILL_MPS {
        format!("{:.2} m/s backward", -speed_mps)
    } else {
        "standing still".to_owned()
    }
}

/// How it keeps off the walls.
fn sideways(course: &Course, told: &Explanation, tof: Option<&Tof>, words: &mut Vec<String>) {
    let p = &course.scenario.center;
    let pushed = tof.and_then(|tof| {
        let (left_m, right_m) = (tof.nw_m.min(tof.sw_m), tof.ne_m.min(tof.se_m));
        match (left_m < p.push_below_m, right_m < p.push_below_m) {
            (true, false) => Some(("left", left_m)),
            (false, true) => Some(("right", right_m)),
            _ => None,
        }
    });
    if let Some((side, near_m)) = pushed {
        words.push(format!(
            "The wall on its {side} is {near_m:.2} m away, less than {} m: it is pushed to the other side.",
            p.push_below_m
        ));
    }
    let asked = match told.follow {
        Follow::Centre => None,
        Follow::Left => Some("left"),
        Follow::Right => Some("right"),
    };
    let by = match (told.walls, asked) {
        (Some(Walls::Both), _) => "It keeps to the middle between both walls.".to_owned(),
        (Some(walls @ (Walls::Left | Walls::Right)), asked) => {
            let (side, other) = if walls == Walls::Left { ("left", "right") } else { ("right", "left") };
            match asked {
                Some(asked) if asked == side => format!("It follows the {side} wall, as the pilot chose."),
                _ => format!(
                    "It steers by the {side} wall alone: what it sees on its {other} runs otherwise, and is ignored."
                ),
            }
        }
        (None, _) if tof.is_none() => return,
        (None, _) => "It steers by no wall.".to_owned(),
    };
    let law = match p.law {
        CenterLaw::Wall => "",
        CenterLaw::Paper => " (Eq. 20 and 21 as printed)",
        CenterLaw::Firmware => " (the authors' firmware)",
    };
    words.push(by + law);
}
