//! `uchain radio map`: losses from a place to all of a map, or along its tunnel.

use std::{fmt::Write as _, sync::Arc};

use serde::Serialize;
use uchain_sim::{
    glam::Vec2,
    map::Map as Walls,
    radio_map::{LossAlong, LossMap},
    registry::{PlanFor, PlanRequest, RadioIn, Registry, Spot},
};

use super::args::Map;
use crate::{
    exit::{Failure, OURS},
    output::{Folder, LOSSES, folder_name, inputs},
    plan::typed,
    waiting::spinner,
};

/// Most rows of a tunnel's losses that are printed.
const ROWS: usize = 12;
/// Places along a tunnel, and how far they lie apart at least (m).
const PLACES: usize = 1_000;
const STEP_M: f64 = 0.05;

/// What is left of losses for programs.
#[derive(Debug, Serialize)]
struct Numbers<'a, T: Serialize> {
    name: &'a str,
    #[serde(flatten)]
    losses: &'a T,
    version: &'static str,
}

/// What is written, and what is said.
struct Made {
    json: String,
    csv: String,
    png: Vec<u8>,
    text: String,
}

pub(super) fn map(registry: Registry, asked: &Map) -> Result<(), Failure> {
    let waiting = spinner(asked.say.progress(), "asking the radio");
    let made = if asked.along { along(registry, asked)? } else { everywhere(registry, asked)? };
    let folder = asked.out.folder(|| Folder::ours("radiomaps", &folder_name(&asked.what), ""))?;
    let folder = folder.spares(&inputs(&asked.what))?;
    folder.write(&LOSSES, made.json.as_bytes(), &made.png, &[made.csv.as_bytes()])?;
    waiting.finish_and_clear();
    asked.say.result(&made.json, || format!("{}files: {}\n", made.text, folder.says(&LOSSES)))
}

fn everywhere(registry: Registry, asked: &Map) -> Result<Made, Failure> {
    let RadioIn { name, map, radio, limit_db, base } = registry.radio(&asked.what, &asked.sets.set)?;
    let Some(radio) = radio else {
        let words = format!(
            "{name}: its robots hear each other within a range, whatever is lost; add --set radio.model=path-loss"
        );
        return Err(Failure::Map(words));
    };
    let from = match &asked.from {
        Some(spot) => place(&map, spot)?,
        None => base.ok_or_else(|| {
            Failure::Usage(format!("{}: say from where, --from=X,Y in the map's own frame (m); `uchain map plot {}` draws it with its coordinates", asked.what, asked.what))
        })?,
    };
    let losses = LossMap::of(&map, &*radio, from, limit_db);
    let mut text = String::new();
    let [x, y] = losses.from_m;
    let [columns, rows] = losses.size;
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{name}: from ({x:.2}, {y:.2}), noise off, {columns} by {rows} cells of {:.2} m\n\
         within {limit_db} dB: {:.1} % of the free area, the farthest {:.2} m away",
        losses.cell_m,
        100.0 * losses.share_within,
        losses.farthest_m
    );
    let json = serde_json::to_string(&Numbers { name: &name, losses: &losses, version: OURS })? + "\n";
    Ok(Made { json, csv: losses.csv(), png: losses.png(&map, &name)?, text })
}

/// A place that was typed, in the map's frame.
fn place(map: &Arc<Walls>, spot: &Spot) -> Result<Vec2, Failure> {
    let at_m = match spot {
        Spot::At(at_m) => *at_m,
        Spot::Named(name) => {
            let named = map.places().iter().find(|place| place.name == *name);
            named.map(|place| place.at_m).ok_or_else(|| {
                Failure::Map(format!(
                    "--from {name}: the map names no such place; X,Y in its own frame will do"
                ))
            })?
        }
    };
    let at = map.to_local(at_m);
    if map.in_rock(at) {
        let [x, y] = at_m;
        return Err(Failure::Map(format!("--from={x},{y}: that is in rock; expected free space")));
    }
    Ok(at)
}

fn along(registry: Registry, asked: &Map) -> Result<Made, Failure> {
    let what = PlanFor::find(&asked.what)?;
    let made_for = registry.plan_course(&PlanRequest {
        what: &what,
        sets: &asked.sets.set,
        uavs: None,
        speed_mps: None,
        base: asked.from.as_ref(),
        heading_deg: None,
        goal: asked.goal.as_ref(),
        cell_m: None,
        from: None,
        to: None,
        to_farthest: true,
        budget: None,
        typed,
    })?;
    let course = &*made_for.course;
    let name = &course.scenario.name;
    let Some(tunnel) = &course.tunnel else {
        let words = format!("{name}: no tunnel is known to go along; add --goal=X,Y, where it ends");
        return Err(Failure::Map(words));
    };
    let places = 1 + ((tunnel.length_m() / STEP_M) as usize).min(PLACES - 1);
    let depths = (0..=places).map(|step| tunnel.length_m() * step as f64 / places as f64);
    let places = depths.map(|depth_m| (depth_m, tunnel.at(depth_m).0));
    let limit_db = f64::from(course.scenario.takeoff.s_min_db);
    let losses = LossAlong::of(&course.map, &*course.radio, course.base, limit_db, places);
    let mut text = String::new();
    let [x, y] = losses.from_m;
    // Writing to a String cannot fail, here and below.
    let _ =
        writeln!(text, "{name}: from ({x:.2}, {y:.2}) along {:.1} m of tunnel, noise off", tunnel.length_m());
    let passes: Vec<String> = losses.passes_m.iter().take(8).map(|depth_m| format!("{depth_m:.2}")).collect();
    let _ = match passes.as_slice() {
        [] => writeln!(text, "the loss never passes {limit_db} dB"),
        _ => writeln!(text, "the loss passes {limit_db} dB at {} m", passes.join(", ")),
    };
    let every = losses.points.len().div_ceil(ROWS).max(1);
    for point in losses.points.iter().step_by(every) {
        let _ = writeln!(text, "  {:>8.2} m {:>8.1} dB", point.depth_m, point.loss_db);
    }
    let json = serde_json::to_string(&Numbers { name, losses: &losses, version: OURS })? + "\n";
    Ok(Made { json, csv: losses.csv(), png: losses.png(name)?, text })
}
