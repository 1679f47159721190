//! `uchain radio fit`: read a log, fit it, plan with it, write, say.

use serde::Serialize;
use uchain_sim::{
    radio_fit::{self, FitOptions, Log, ReadOptions, template},
    registry::{FittedPlan, PlanFor, PlanRequest, Registry},
};

use super::args::Fit;
use crate::{
    exit::{Failure, OURS},
    monitor::{interrupted, listen_for_interrupt},
    output::{self, FIT, FIT_REFUSED, Folder, folder_name, inputs},
    plan::typed,
    print,
    waiting::spinner,
};

/// What is left of a fit for programs.
#[derive(Debug, Serialize)]
struct Numbers<'a> {
    #[serde(flatten)]
    fit: &'a radio_fit::Fit,
    /// Keys of a scenario, as --set takes them; none where the data do not support a fit.
    sets: Vec<String>,
    plan: Option<&'a FittedPlan>,
    version: &'static str,
}

pub(super) fn fit(registry: Registry, asked: &Fit) -> Result<(), Failure> {
    let Some(log) = asked.log.as_ref().filter(|_| !asked.template) else { return print(&template()) };
    let waiting = spinner(asked.say.progress(), "fitting");
    listen_for_interrupt();
    let (mapping, lost, link) = (asked.columns.clone().unwrap_or_default(), asked.lost, asked.link.clone());
    let options = ReadOptions { mapping, tx_dbm: asked.tx_dbm, lost, link };
    let read = Log::read(log, asked.anchors.as_deref(), &options)?;
    let defaults = FitOptions::default();
    let reference_m = asked.reference_m.unwrap_or(defaults.reference_m);
    let fit = radio_fit::fit(&read, &FitOptions { reference_m })?;
    let plan = match &asked.plan {
        Some(what) if fit.refusals.is_empty() => Some(plan(registry, asked, what, &fit)?),
        _ => None,
    };
    let picture = fit.png()?;
    let numbers = Numbers { fit: &fit, sets: fit.sets(), plan: plan.as_ref(), version: OURS };
    let json = serde_json::to_string_pretty(&numbers)? + "\n";
    let label = log.display().to_string();
    let folder = asked.out.folder(|| Folder::ours("fits", &folder_name(&label), ""))?;
    let mut read_from = vec![log.clone()];
    read_from.extend(asked.anchors.clone());
    read_from.extend(asked.plan.iter().flat_map(|what| inputs(what)));
    let folder = folder.spares(&read_from)?;
    let toml = fit.radio_toml();
    let (names, others): (&output::Names, Vec<&[u8]>) = match &toml {
        Some(toml) => (&FIT, vec![toml.as_bytes()]),
        None => (&FIT_REFUSED, Vec::new()),
    };
    folder.write(names, json.as_bytes(), &picture, &others)?;
    waiting.finish_and_clear();
    asked.say.result(&json, || {
        let plan = plan.as_ref().map(|plan| format!("\n{}", plan.text())).unwrap_or_default();
        format!("{}{plan}files: {}\n", fit.text(), folder.says(names))
    })?;
    if fit.refusals.is_empty() {
        Ok(())
    } else {
        Err(Failure::NoFit { log: label, why: fit.refusals.join("; ") })
    }
}

fn plan(registry: Registry, asked: &Fit, what: &str, fit: &radio_fit::Fit) -> Result<FittedPlan, Failure> {
    let what = PlanFor::find(what)?;
    let request = PlanRequest {
        what: &what,
        sets: &asked.sets.set,
        uavs: None,
        speed_mps: None,
        base: asked.base.as_ref(),
        heading_deg: None,
        goal: asked.goal.as_ref(),
        cell_m: None,
        from: None,
        to: None,
        to_farthest: false,
        budget: None,
        typed,
    };
    let plan = registry.plan_fitted(&request, fit, asked.to, &mut || !interrupted())?;
    plan.ok_or(Failure::Interrupted)
}
