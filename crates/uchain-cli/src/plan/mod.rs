//! `uchain plan`: read, compute, write, print.

mod args;

use indicatif::ProgressBar;
use uchain_sim::{
    map::Tunnel,
    mission::chain::{
        Course, Plan as Planned, PlanOptions, PlanSteps, PlanTable, RESERVE, Reach, everywhere_csv,
        everywhere_png, places_csv, places_geojson, plan_png, plan_while,
    },
    registry::{PlanArgument, PlanFlight, PlanFor, PlanRequest, Registry},
};

use crate::{
    exit::Failure,
    monitor::{interrupted, listen_for_interrupt},
    output::{self, Folder},
    waiting::spinner,
};
use args::To;
pub(crate) use args::{Plan, spot};

/// Keys that a link budget works out.
const BUDGETED: [&str; 6] = [
    "takeoff.s_min_db",
    "radio.reference_loss_db",
    "link.head_stop_db",
    "link.head_back_db",
    "link.relay_back_db",
    "packets.limit_db",
];

pub(crate) fn compute(registry: Registry, asked: &Plan) -> Result<(), Failure> {
    let spinner = spinner(asked.say.progress(), "planning");
    listen_for_interrupt();
    asked.map.fits(&asked.what)?;
    if asked.budget.is_some() {
        let is_budgeted = |set: &&String| {
            BUDGETED.iter().any(|key| set.split('=').next().is_some_and(|of| of.trim() == *key))
        };
        if let Some(set) = asked.sets.set.iter().find(is_budgeted) {
            let words = format!("--set {set}: --budget works this out; leave one of the two away");
            return Err(Failure::Usage(words));
        }
    }
    let what = PlanFor::find(&asked.what)?;
    // With --from, --to is a station, even if its name is a number.
    let (to_m, to_station) = match (&asked.to, &asked.map.from) {
        (None, _) => (None, None),
        (Some(to), Some(_)) => (None, Some(to.station.as_str())),
        (Some(To { depth_m: Some(to_m), .. }), None) => (Some(*to_m), None),
        (Some(_), None) => {
            let words =
                "--to: a station ends a branch that begins at --from STATION; a depth is a number of metres";
            return Err(Failure::Usage(words.to_owned()));
        }
    };
    let made_for = registry.plan_course(&PlanRequest {
        what: &what,
        sets: &asked.sets.set,
        uavs: asked.uavs,
        speed_mps: asked.speed,
        base: asked.base.as_ref(),
        heading_deg: asked.heading,
        goal: asked.goal.as_ref(),
        cell_m: asked.map.cell,
        from: asked.map.from.as_deref(),
        to: to_station,
        to_farthest: asked.everywhere,
        budget: asked.budget.as_ref(),
        typed,
    })?;
    let folder = asked.out.folder(|| Folder::ours("plans", &output::folder_name(&asked.what), ""))?;
    let folder = folder.spares(&output::inputs(&asked.what))?;
    let course = &*made_for.course;
    let deepest_m = to_m.or_else(|| course.tunnel.as_ref().map(Tunnel::length_m));
    let steps = PlanSteps::new(deepest_m.unwrap_or(1.0), asked.step);
    let options = PlanOptions {
        to_m,
        step_m: steps.plan_m,
        uavs: made_for.uavs,
        stay_s: 60.0 * asked.stay.unwrap_or_default(),
        reserve: asked.reserve.unwrap_or(RESERVE),
    };
    let mut plan = plan_while(course, &options, &mut || !interrupted())?;
    plan.budget = made_for.budget;
    let everywhere = asked.everywhere.then(|| course.relays_everywhere()).transpose();
    let everywhere = everywhere.map_err(|cause| Failure::Map(format!("--everywhere: {cause}")))?;
    plan.everywhere = everywhere.as_ref().map(Reach::of);
    if let Some(seeds) = asked.fly {
        fly(course, &mut plan, seeds, &spinner)?;
    }
    let table = PlanTable::new(&plan, &steps);
    let picture = plan_png(course, &plan, &table.answer())?;
    let json = serde_json::to_string_pretty(&plan)? + "\n";
    let (csv, geojson) = (places_csv(&plan), places_geojson(&plan, &made_for.course.map));
    let mut others = vec![csv.into_bytes(), geojson.into_bytes()];
    let names = match &everywhere {
        Some(everywhere) => {
            others.push(everywhere_csv(&course.map, everywhere).into_bytes());
            others.push(everywhere_png(course, everywhere)?);
            output::PLAN_EVERYWHERE
        }
        None => output::PLAN,
    };
    let others: Vec<&[u8]> = others.iter().map(Vec::as_slice).collect();
    folder.write(&names, json.as_bytes(), &picture, &others)?;
    spinner.finish_and_clear();
    asked.say.result(&json, || format!("{}files: {}\n", table.text(), folder.says(&names)))
}

/// Flies the plan, and notes what came of it.
fn fly(course: &Course, plan: &mut Planned, seeds: u64, spinner: &ProgressBar) -> Result<(), Failure> {
    let flight = PlanFlight::new(course, plan)?;
    let go_on = |done: usize| {
        spinner.set_message(format!("flying, {done} of {seeds} done"));
        !interrupted()
    };
    plan.flown = Some(flight.fly(seeds, &go_on)?);
    Ok(())
}

/// An argument as it may be typed.
pub(crate) fn typed(argument: PlanArgument<'_>) -> String {
    match argument {
        PlanArgument::Map(map) => map.to_owned(),
        PlanArgument::Base([x, y]) => format!("--base={x},{y}"),
        PlanArgument::Goal([x, y]) => format!("--goal={x},{y}"),
        PlanArgument::Heading(deg) => format!("--heading={deg}"),
        PlanArgument::Cell(cell_m) => format!("--cell={cell_m}"),
        PlanArgument::From(name) => format!("--from={name}"),
        PlanArgument::To(name) => format!("--to={name}"),
        PlanArgument::Budget => "--budget".to_owned(),
    }
}
