//! The answer in one sentence, and what would help.

use std::fmt::Write as _;

use super::rounded;
use crate::{
    analyse::optimum::MOST_LINKS,
    mission::chain::{Batteries, Plan, PlanRow},
};

/// What the planner wants to know, in one sentence.
pub(in crate::mission::chain) fn answer(plan: &Plan) -> String {
    let Some(last) = plan.rows.last() else { return "There is nothing to plan.".to_owned() };
    let depth_m = rounded(last.depth_m);
    let mut sentence = match plan.uavs_needed {
        None => {
            let s_min_db = rounded(plan.s_min_db);
            format!(
                "{depth_m} m cannot be had with links of {s_min_db} dB and up to {} relays",
                MOST_LINKS - 1
            )
        }
        Some(1) => format!("{depth_m} m need no relay (1 UAV)"),
        Some(2) => format!("{depth_m} m need 1 relay (2 UAVs)"),
        Some(uavs) => format!("{depth_m} m need {} relays ({uavs} UAVs)", uavs - 1),
    };
    if let Some((uavs, relays)) = plan.uavs_needed.zip(last.relays_needed) {
        if relays + 1 < uavs {
            let _ = write!(sentence, " on the way and {relays} at the end");
        }
        if uavs > MOST_LINKS {
            let _ = write!(sentence, ", more than {MOST_LINKS} UAVs are too many");
        } else if too_few(plan, last) {
            let at_hand = plan.relays_available.unwrap_or_default() + 1;
            let _ = write!(sentence, ", {at_hand} at hand: too few");
        }
        times(plan, last, &mut sentence);
    }
    if !last.feasible {
        // The way back is not counted in it.
        let home_from_m = plan.batteries.as_ref().and_then(|batteries| batteries.home_from_m);
        let is_one_way =
            |depth_m: f64| plan.batteries.is_some() && home_from_m.is_none_or(|home_m| home_m < depth_m);
        let _ = match (plan.feasible_to_m, plan.rows.first()) {
            (Some(depth_m), _) => {
                let one_way = if is_one_way(depth_m) { " one way" } else { "" };
                write!(sentence, "; {} m can be done{one_way}", rounded(depth_m))
            }
            // Between the base and the first row; said already, from how deep all come home.
            (None, _) if plan.uavs_needed.is_some() && home_from_m.is_some() => Ok(()),
            (None, first) => {
                let first_m = first.map_or(0.0, |first| rounded(first.depth_m));
                write!(sentence, "; not even {first_m} m can be done")
            }
        };
    }
    sentence + "."
}

fn times(plan: &Plan, last: &PlanRow, sentence: &mut String) {
    let Some(time_min) = last.time_min else { return };
    let _ = write!(sentence, "; the head is there after {time_min:.1} min");
    if let Some(cut) = cut(plan) {
        let _ = write!(sentence, " ({cut})");
    }
    if let Some(first_min) = last.first_relay_min {
        let _ = write!(sentence, "; the first relay then has hovered {first_min:.1} min");
    }
    let endurance_min = plan.endurance_s / 60.0;
    let Some(batteries) = plan.batteries.as_ref().filter(|_| !too_long(plan, last)) else {
        let _ = write!(sentence, "; a battery lasts {endurance_min:.1} min: too long");
        if let Some(batteries) = &plan.batteries {
            short(batteries, sentence);
            home(batteries, sentence);
        }
        return;
    };
    let (home_min, usable_min) = (batteries.home_min, batteries.usable_min);
    if batteries.all_home {
        let _ =
            write!(sentence, "; all are home after {home_min:.1} min; a battery lasts {usable_min:.1} min");
        if usable_min < endurance_min {
            let _ = write!(sentence, " and the reserve");
        }
        sentence.push_str(": long enough");
        return;
    }
    short(batteries, sentence);
    home(batteries, sentence);
}

/// Who is short of battery, and by how much.
fn short(batteries: &Batteries, sentence: &mut String) {
    let usable_min = batteries.usable_min;
    let mut short = batteries.short();
    let Some(first) = short.next() else { return };
    let _ = write!(
        sentence,
        "; {} is short of battery by {:.1} min: it has flown {:.1} of {usable_min:.1} min when it is home",
        name(first.uav),
        -first.spare_min,
        first.airborne_min
    );
    match (short.next(), short.last()) {
        (Some(next), Some(last)) => {
            let _ = write!(sentence, ", and so are relays {} to {}", next.uav, last.uav);
        }
        (Some(next), None) => {
            let _ = write!(sentence, ", and so is {}", name(next.uav));
        }
        _ => {}
    }
}

/// From how deep all come home.
fn home(batteries: &Batteries, sentence: &mut String) {
    let _ = match batteries.home_from_m {
        Some(depth_m) => write!(sentence, "; all come home from {} m", rounded(depth_m)),
        None => write!(sentence, "; from nowhere do all come home"),
    };
}

/// What would bring all home, where not all come home.
pub(in crate::mission::chain) fn help(plan: &Plan) -> Option<String> {
    let batteries = plan.batteries.as_ref().filter(|batteries| !batteries.all_home)?;
    let mut ways = Vec::new();
    if let Some(speed_mps) = batteries.speed_needed_mps {
        // Rounded up: a little slower would not do.
        let speed_mps = (1000.0 * speed_mps).ceil() / 1000.0;
        let v_max_mps = plan.assumptions.head.v_max_mps;
        ways.push(match speed_mps {
            fast if fast > FASTEST_MPS => format!("a head at {speed_mps} m/s, which none here flies"),
            fast if fast > v_max_mps => {
                format!(
                    "a head at {speed_mps} m/s (--speed {speed_mps} --set equalize.v_max_mps={speed_mps})"
                )
            }
            _ => format!("a head at {speed_mps} m/s (--speed {speed_mps})"),
        });
    }
    if let Some(endurance_s) = batteries.endurance_needed_s {
        let endurance_s = endurance_s.ceil();
        let minutes = endurance_s / 60.0;
        ways.push(format!("batteries of {minutes:.1} min (--set chain.endurance_s={endurance_s})"));
    }
    if let Some(uavs) = batteries.relief_uavs {
        let s = if uavs == 1 { "" } else { "s" };
        ways.push(format!("relief: {uavs} more UAV{s} to take the places of those that are short"));
    }
    Some(ways.join("; "))
}

/// Fastest that a pilot may ask for (m/s).
const FASTEST_MPS: f64 = 1.0;

fn name(uav: usize) -> String {
    if uav == 0 { "the head".to_owned() } else { format!("relay {uav}") }
}

/// Why the head is slower than asked, if it is.
pub(super) fn cut(plan: &Plan) -> Option<String> {
    let asked_mps = rounded(plan.speed_asked_mps?);
    let flown_mps = rounded(plan.speed_mps.unwrap_or_default());
    Some(format!("{asked_mps} m/s asked, cut to equalize.v_max_mps = {flown_mps}"))
}

/// On the way or there.
pub(super) fn too_few(plan: &Plan, row: &PlanRow) -> bool {
    let so_far = plan.launches.iter().filter(|launch| launch.depth_m <= row.depth_m);
    plan.relays_available.is_some_and(|relays| so_far.count() > relays)
}

pub(super) fn too_long(plan: &Plan, row: &PlanRow) -> bool {
    row.time_min.is_some_and(|time_min| 60.0 * time_min > plan.endurance_s)
}
