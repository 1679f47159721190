//! What shadows that stay in place do to a plan: relays of the best chain that knows them, of places planned without them, and
//! of Eq. 12 flown.

use std::sync::Arc;

use uchain_sim::{
    mission::{
        Scene as _,
        chain::{Course, Summary},
    },
    record::RecordError,
    run::run,
    sweep::Run,
};

use crate::{
    Item, Outcome, PaperError, RunCache, Table,
    experiment::{Experiment, each_run, inline_scenario},
};

pub(crate) const SHADOWING: Item = Item {
    id: "shadowing",
    title: "what shadows that stay in place do to a plan (no paper's)",
    run: regenerate,
};

const REPLICATES: u64 = 60;
/// Standard deviations of what stays in place (dB).
const STATIC_DB: [f64; 4] = [0.0, 2.0, 4.0, 8.0];
/// Where the head is to be (m): six links of Eq. 22 at 59.8 dB, and five would be 61.3 dB.
const GOAL_M: f64 = 26.0;
/// Most relays.
const RELAYS: usize = 18;
/// Quantiles that are told (%).
const QUANTILES: [f64; 3] = [0.05, 0.5, 0.95];

/// How far apart UAVs wait (m), in rows beside the base, so that all hear the chain as the base does.
const APART_M: f64 = 0.15;
/// A row, from the middle outward.
const ROW: [f64; 7] = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0];
/// The head (m/s): slow enough for the chain to level behind it.
const HEAD_MPS: f64 = 0.05;

/// The head stops at the goal, and the tunnel goes on.
fn tunnel() -> String {
    let uavs = 0..=RELAYS;
    let rows = RELAYS / ROW.len() + 1;
    let place = |uav: usize| {
        let (row, aside) = (uav / ROW.len(), ROW[uav % ROW.len()]);
        format!("[{:.2}, {:.2}]", (rows - row) as f64 * APART_M, aside * APART_M)
    };
    let spawns: Vec<String> = uavs.map(place).collect();
    let stop_s = (GOAL_M - rows as f64 * APART_M) / HEAD_MPS;
    format!(
        "name = \"shadowing\"\nduration_s = 900.0\n[map.corridor]\ncentre_line_m = [[-6.0, 0.0], [{}, 0.0]]\nwidth_m = 2.0\n\
         [chain]\nuavs = {}\nbase_m = [0.0, 0.0]\nspawns_m = [{}]\ngoal_m = [{GOAL_M}, 0.0]\nheading_deg = 0.0\n\
         [[pilot]]\nstart_s = 0.0\nspeed_mps = {HEAD_MPS}\n[[pilot]]\nstart_s = {stop_s:.0}.0\nspeed_mps = 0.0\n",
        GOAL_M + 6.0,
        RELAYS + 1,
        spawns.join(", ")
    )
}

/// One draw of the shadows.
struct Draw {
    /// Relays of the best chain that knows them; `None`: no chain holds.
    knows: Option<usize>,
    /// Fewest relays whose places, planned without them, hold.
    planned: Option<usize>,
    /// Whether the plan's own number does, at the plan's places.
    plan_holds: bool,
    /// Eq. 12 flown.
    flown: Summary,
    /// The head has come all the way, and every link is within the limit at the end.
    flight_holds: bool,
}

fn draw(course: &Arc<Course>, one: Run) -> Result<Draw, RecordError> {
    let s_min_db = f64::from(course.scenario.takeoff.s_min_db);
    let seeded = course.seeded(one.seed);
    let needed = |course: &Course| course.optimum().and_then(|best| best.links_needed(GOAL_M));
    let holds = |relays: usize| {
        let places = course.optimum().map(|best| best.optimum(GOAL_M, relays + 1).depths_m);
        places.is_some_and(|depths_m| {
            depths_m.windows(2).all(|pair| {
                let loss_db = <[f64; 2]>::try_from(pair)
                    .ok()
                    .and_then(|[deep_m, shallow_m]| seeded.loss_at_depths_db(shallow_m, deep_m));
                loss_db.is_some_and(|loss_db| loss_db <= s_min_db + ROUNDING_DB)
            })
        })
    };
    let flown = run(course, one.seed, &mut ())?;
    let flight_holds = f64::from(flown.head_reach_m) > GOAL_M - ARRIVED_M
        && flown.links.iter().all(|link| f64::from(link.true_db) <= s_min_db + LEVEL_DB);
    Ok(Draw {
        knows: needed(&seeded).map(|links| links.saturating_sub(1)),
        planned: (0..=RELAYS).find(|&relays| holds(relays)),
        plan_holds: needed(course).is_some_and(|links| holds(links.saturating_sub(1))),
        flown,
        flight_holds,
    })
}

/// Links at the limit are within it.
const ROUNDING_DB: f64 = 1e-3;
/// A head that stops so near to the goal has arrived (m).
const ARRIVED_M: f64 = 1.0;
/// Noise moves links that a launch holds at the limit by so much (dB).
const LEVEL_DB: f64 = 1.0;

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let mut outcome = Outcome {
        setup: format!(
            "A straight tunnel, {GOAL_M} m deep, {RELAYS} relays at hand, s_min 60 dB, Eq. 22 with X(p, q) of some standard \
             deviation and 2 m of correlation (`radio.sigma_static_db`), {REPLICATES} draws of X. (a) the best chain that knows X, \
             (b) the best places without X, with as many relays as it takes until every link holds with it, (c) Eq. 12 flown \
             for 900 s with this project's defaults, the head at {HEAD_MPS} m/s to the goal: relays in the air at the end. A \
             flight holds if its head is within {ARRIVED_M} m of the goal and every link within {LEVEL_DB} dB of s_min."
        ),
        ..Outcome::default()
    };
    let mut shown = Table::for_report(&[
        "static (dB)",
        "(a) knows X",
        "(b) planned without X",
        "a plan without X holds as it is",
        "(c) flown",
        "flights that arrive and hold",
    ]);
    let mut single = Table::new(
        "shadowing",
        &[
            "sigma_static_db",
            "replicate",
            "knows",
            "planned",
            "plan_holds",
            "flown",
            "flight_holds",
            "reach_m",
        ],
    );
    for sigma_db in STATIC_DB {
        let set = format!("radio.sigma_static_db={sigma_db}");
        let source = inline_scenario("shadowing", tunnel());
        let experiment = Experiment { source, sets: &[&set], vary: &[], replicates: REPLICATES };
        let draws: Vec<Draw> = each_run(experiment, draw)?.into_iter().flatten().collect();
        let count =
            |holds: fn(&&Draw) -> bool| format!("{} of {}", draws.iter().filter(holds).count(), draws.len());
        shown.rows.push(vec![
            format!("{sigma_db}"),
            quantiles(&draws.iter().map(|draw| draw.knows).collect::<Vec<_>>()),
            quantiles(&draws.iter().map(|draw| draw.planned).collect::<Vec<_>>()),
            count(|draw| draw.plan_holds),
            quantiles(&draws.iter().map(|draw| Some(draw.flown.relays_used)).collect::<Vec<_>>()),
            count(|draw| draw.flight_holds),
        ]);
        let words = |relays: Option<usize>| relays.map_or_else(String::new, |relays| relays.to_string());
        for (replicate, draw) in draws.iter().enumerate() {
            single.rows.push(vec![
                sigma_db.to_string(),
                replicate.to_string(),
                words(draw.knows),
                words(draw.planned),
                draw.plan_holds.to_string(),
                draw.flown.relays_used.to_string(),
                draw.flight_holds.to_string(),
                format!("{:.3}", draw.flown.head_reach_m),
            ]);
        }
    }
    outcome.tables = vec![shown, single];
    outcome.notes = vec![
        format!(
            "Relays at 5, 50 and 95 % of the draws; \"more\" where {RELAYS} are not enough. (a) looks like a gain: whoever knows X \
             puts relays where links happen to be good. A planner does not know it, and is told (b) and (c)."
        ),
        "Each link of a plan has to hold, and links fail together where they share a place: independent links understate how \
         often a route fails (Agrawal & Patwari 2009). Here the links of one draw share X."
            .to_owned(),
        "Flown, a chain lies between the two: Eq. 12 levels the losses it hears, X included, so that it need not know X to profit \
         from it, but it looks for level links, not for the best places, and a head may wait behind a link that it has to itself."
            .to_owned(),
    ];
    Ok(outcome)
}

/// 5, 50 and 95 % of some numbers of relays; what is none is more than any.
fn quantiles(relays: &[Option<usize>]) -> String {
    let mut sorted: Vec<usize> = relays.iter().map(|relays| relays.unwrap_or(usize::MAX)).collect();
    sorted.sort_unstable();
    let at = |share: f64| {
        let rank = (share * sorted.len() as f64).ceil() as usize;
        match sorted.get(rank.saturating_sub(1)) {
            Some(&usize::MAX) | None => "more".to_owned(),
            Some(relays) => relays.to_string(),
        }
    };
    QUANTILES.map(at).join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_the_least_number_that_is_enough_for_so_many_draws() {
        let relays: Vec<Option<usize>> = (1..=20).map(Some).collect();
        assert_eq!(quantiles(&relays), "1, 10, 19");
        let with_none = [vec![None, None], relays].concat();
        assert_eq!(quantiles(&with_none), "2, 11, more");
    }
}
