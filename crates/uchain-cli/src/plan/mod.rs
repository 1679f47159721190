//! `uchain plan`: read, compute, write, print.

mod args;

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use uchain_sim::{
    map::Tunnel,
    mission::chain::{PlanSteps, PlanTable, plan},
    registry::{PlanArgument, PlanFor, PlanRequest, Registry},
};

use crate::{
    exit::Failure,
    output::{self, Folder},
};
pub(crate) use args::Plan;

pub(crate) fn compute(registry: Registry, asked: &Plan) -> Result<(), Failure> {
    let spinner = spinner(asked.say.progress());
    let what = PlanFor::find(&asked.what)?;
    let (course, uavs) = registry.plan_course(&PlanRequest {
        what: &what,
        sets: &asked.sets.set,
        uavs: asked.uavs,
        speed_mps: asked.speed,
        base_m: asked.base,
        heading_deg: asked.heading,
        goal_m: asked.goal,
        typed,
    })?;
    let folder = asked.out.folder(|| Folder::ours("plans", &output::folder_name(&asked.what), ""))?;
    let folder = folder.spares(&asked.what)?;
    let to_m = asked.to.or_else(|| course.tunnel.as_ref().map(Tunnel::length_m));
    let steps = PlanSteps::new(to_m.unwrap_or(1.0), asked.step);
    let plan = plan(&course, asked.to, steps.plan_m, uavs)?;
    let table = PlanTable::new(&plan, &steps);
    let picture = uchain_sim::mission::chain::plan_png(&plan, &table.answer())?;
    let json = serde_json::to_string_pretty(&plan)? + "\n";
    folder.write(&output::PLAN, json.as_bytes(), &picture, &[])?;
    spinner.finish_and_clear();
    asked.say.result(&json, || format!("{}files: {}\n", table.text(), folder.says(&output::PLAN)))
}

/// An argument as it may be typed.
fn typed(argument: PlanArgument<'_>) -> String {
    match argument {
        PlanArgument::Map(map) => map.to_owned(),
        PlanArgument::Base([x, y]) => format!("--base={x},{y}"),
        PlanArgument::Goal([x, y]) => format!("--goal={x},{y}"),
        PlanArgument::Heading(deg) => format!("--heading={deg}"),
    }
}

/// Turns on a terminal until the answer is there; large maps take seconds.
fn spinner(show: bool) -> ProgressBar {
    let target = if show { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let spinner = ProgressBar::with_draw_target(None, target)
        .with_message("planning")
        .with_finish(ProgressFinish::AndClear);
    // The template is a constant; were it wrong, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        spinner.set_style(style);
    }
    if show {
        spinner.enable_steady_tick(Duration::from_millis(100));
    }
    spinner
}
