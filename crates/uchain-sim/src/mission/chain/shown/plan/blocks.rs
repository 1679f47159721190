//! Blocks of a plan's text.

use std::fmt::Write as _;

use super::{decimal, help, rounded};
use crate::mission::chain::{Place, Plan};

/// Most places that are listed to people, half of them from each end.
const PLACES_SHOWN: usize = 24;

/// What the plan stands on, one line each.
pub(super) fn assumptions(plan: &Plan) -> String {
    let assumed = &plan.assumptions;
    let mut text = "assumed\n".to_owned();
    let mut line = |name: &str, words: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {name:<10} {words}");
    };
    let map = &assumed.map;
    let keys = map.keys.iter().map(|(key, value)| format!("{key} = {value}")).collect::<Vec<_>>().join(", ");
    let keys = if keys.is_empty() { String::new() } else { format!(" ({keys})") };
    let [width_m, height_m] = map.size_m;
    let kind = if map.format.is_empty() { format!("[{}]", map.table) } else { map.format.to_owned() };
    line("map", &format!("{kind}{keys}: {width_m:.1} m x {height_m:.1} m, {} walls", map.walls));
    for remark in &map.remarks {
        line("", remark);
    }
    let radio = &assumed.radio;
    let mut words = match radio.range_m {
        _ if radio.goes_by.is_some() => {
            format!("{}: {}", radio.model, radio.goes_by.as_deref().unwrap_or_default())
        }
        Some(range_m) => {
            format!("{}: {} dB within {range_m} m, nothing beyond", radio.model, radio.reference_loss_db)
        }
        None => format!(
            "{}: {} dB at {} m, exponent {} in the open, {} through rock",
            radio.model, radio.reference_loss_db, radio.reference_m, radio.alpha_free, radio.alpha_wall
        ),
    };
    if radio.detour_db_per_m > 0.0 {
        let _ = write!(words, ", {} dB per metre of detour", radio.detour_db_per_m);
    }
    if radio.antenna_db > 0.0 {
        let _ = write!(words, ", antennas that lose up to {} dB", radio.antenna_db);
    }
    if let Some(in_place) = &radio.in_place {
        let _ = write!(words, "; {in_place}");
    }
    line("radio", &format!("{words}; noise of {} dB left out", radio.sigma_db));
    let whose = if plan.budget.is_some() { "" } else { "; a radio of your own: --budget" };
    line("limit", &format!("{} dB on every link (takeoff.s_min_db){whose}", assumed.s_min_db));
    let head = &assumed.head;
    let stay = match head.stay_s {
        stay_s if stay_s > 0.0 => format!("stays {:.1} min, then ", stay_s / 60.0),
        _ => String::new(),
    };
    line(
        "head",
        &match head.speed_mps {
            Some(speed_mps) => {
                let speed_mps = rounded(speed_mps);
                format!(
                    "{speed_mps} m/s in, {stay}{speed_mps} m/s back, ready after {} s",
                    rounded(head.ready_s)
                )
            }
            None => "does not fly forward: no times".to_owned(),
        },
    );
    let battery = &assumed.battery;
    line(
        "battery",
        &format!(
            "{:.1} min (chain.endurance_s), of which {} % stay in reserve",
            battery.endurance_s / 60.0,
            rounded(100.0 * battery.reserve)
        ),
    );
    line("best case", &assumed.best_case.join("; "));
    text
}

/// Where the relays stand.
pub(super) fn places(plan: &Plan) -> String {
    let Some(goal_m) = plan.rows.last().map(|row| row.depth_m).filter(|_| !plan.places.is_empty()) else {
        return String::new();
    };
    let mut text = format!("\nplaces with the head {goal_m:.2} m deep, in the map's own frame\n");
    text += "  relay      x (m)      y (m)  depth (m)  to base (dB)  to head (dB)  margin (dB)  takes off (min)  in the air (min)  battery left (min)\n";
    let shown = |place: &Place, text: &mut String| {
        let _ = writeln!(
            text,
            "  {:>5}  {:>9.2}  {:>9.2}  {:>9.2}  {:>12.1}  {:>12.1}  {:>11.1}  {:>15}  {:>16}  {:>18}",
            place.relay,
            place.x_m,
            place.y_m,
            place.depth_m,
            place.link_db,
            place.front_db,
            place.margin_db,
            decimal(place.launch_min),
            decimal(place.airborne_min),
            decimal(place.spare_min),
        );
    };
    let count = plan.places.len();
    if count <= PLACES_SHOWN {
        plan.places.iter().for_each(|place| shown(place, &mut text));
        return text;
    }
    let half = PLACES_SHOWN / 2;
    plan.places.iter().take(half).for_each(|place| shown(place, &mut text));
    let _ = writeln!(text, "      … {} more, all in places.csv", count - 2 * half);
    plan.places.iter().skip(count - half).for_each(|place| shown(place, &mut text));
    text
}

/// Whose battery does not last, and what would help.
pub(super) fn batteries(plan: &Plan) -> String {
    let Some(batteries) = &plan.batteries else { return String::new() };
    let short = batteries.short().count();
    let uavs = batteries.uavs.len();
    let mut text = format!(
        "\nbatteries: {} of {uavs} UAVs are home before {:.1} min of flight; the last lands {:.1} min after the head's take-off\n",
        uavs - short,
        batteries.usable_min,
        batteries.home_min,
    );
    if let Some(ways) = help(plan) {
        let _ = writeln!(text, "would help: {ways}");
    }
    text
}

/// How much hangs on limit and exponents.
pub(super) fn sensitivity(plan: &Plan) -> String {
    let words: Vec<String> = plan
        .sensitivity
        .variants
        .iter()
        .map(|variant| {
            let what = if variant.alpha == 0.0 {
                format!("s_min {:+} dB", variant.s_min_db)
            } else {
                format!("exponents {:+}", variant.alpha)
            };
            let relays = variant.relays.map_or_else(|| "no number".to_owned(), |relays| relays.to_string());
            format!("{what}: {relays}")
        })
        .collect();
    if words.is_empty() {
        String::new()
    } else {
        format!("\nrelays if one number is a little off: {}\n", words.join(", "))
    }
}

/// What the limit was worked out from, each threshold as path loss and as received power.
pub(super) fn budget(plan: &Plan) -> String {
    let Some(budgeted) = &plan.budget else { return String::new() };
    let budget = &budgeted.budget;
    let mut text = format!(
        "\nlink budget: {} dBm sent, antennas {} and {} dBi, {} dBm needed, {} dB of margin, {} MHz; free space loses {} dB at {} m\n",
        budget.tx_dbm,
        budget.tx_gain_dbi,
        budget.rx_gain_dbi,
        budget.sensitivity_dbm,
        budget.margin_db,
        budget.frequency_mhz,
        budgeted.reference_loss_db,
        rounded(budgeted.reference_m),
    );
    text += "  threshold           path loss (dB)  received (dBm)  beyond it\n";
    for threshold in &budgeted.thresholds {
        let _ = writeln!(
            text,
            "  {:<18}  {:>14}  {:>14}  {}",
            threshold.key, threshold.loss_db, threshold.received_dbm, threshold.what
        );
    }
    for threshold in budgeted.deaf() {
        let below_db = -threshold.above_sensitivity_db;
        let _ = writeln!(
            text,
            "  {} lies {below_db} dB below what the receiver hears: a link may be lost first; more margin_db moves it",
            threshold.key
        );
    }
    let sets: Vec<String> = budgeted.sets().iter().map(|set| format!("--set {set}")).collect();
    let _ = writeln!(text, "  to fly by it: {}", sets.join(" "));
    text
}

/// Most numbers of relays of which the share in reach is told.
const SHARES_SHOWN: usize = 12;

/// How much of the map is in reach.
pub(super) fn reach(plan: &Plan) -> String {
    let Some(reach) = &plan.everywhere else { return String::new() };
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let every = reach.share_within.len().div_ceil(SHARES_SHOWN).max(1);
    let last = reach.share_within.len().saturating_sub(1);
    let shares: Vec<String> = reach
        .share_within
        .iter()
        .enumerate()
        .filter(|(relays, _)| relays % every == 0 || *relays == last)
        .map(|(relays, share)| format!("{relays}: {}", percent(*share)))
        .collect();
    format!(
        "\neverywhere: {:.0} m² of free ground, of which {} are joined with the base; in reach with so many relays: {}\n",
        reach.free_area_m2,
        percent(reach.share_joined),
        shares.join(", ")
    )
}
