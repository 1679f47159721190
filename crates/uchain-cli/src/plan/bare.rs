//! What to plan for: a scenario, or a bare map made into one.

use std::{path::Path, sync::Arc};

use uchain_sim::{
    config::{ConfigError, Source, kind_of_map},
    mission::chain::{Course, PilotStep},
    registry::Registry,
};

use super::Plan;
use crate::exit::Failure;

/// The head's speed where nobody says (m/s).
const SPEED_MPS: f32 = 0.2;

/// A `--set` made of another argument: its assignment, and what was typed for it.
struct Short {
    assignment: String,
    typed: String,
}

/// The tunnel with the speed asked for, and the UAVs at hand if anybody said how many. Nothing is flown, so nobody
/// asks whether all of them find room to wait.
#[expect(clippy::default_trait_access, reason = "the type of a pilot's `follow` is the core's")]
pub(super) fn course(registry: Registry, asked: &Plan) -> Result<(Course, Option<usize>), Failure> {
    let key = key_of_file(&asked.what);
    let is_map = key.is_some();
    let source = if is_map { bare(asked)? } else { Source::find(&asked.what)? };
    let shorts = shorts(asked, key.as_deref());
    let typed = asked.sets.set.iter().cloned();
    let sets: Vec<String> = shorts.iter().map(|short| short.assignment.clone()).chain(typed).collect();
    let scene = registry.chain(&source, &sets).map_err(|error| explain(error, asked, &shorts))?;
    let mut course = Arc::unwrap_or_clone(scene);

    let uavs = asked.uavs.or((!is_map).then_some(course.scenario.chain.uavs));
    if let Some(speed_mps) = asked.speed {
        let pilot = &mut course.scenario.pilot;
        match pilot.iter_mut().find(|step| step.speed_mps > 0.0) {
            Some(step) => step.speed_mps = speed_mps,
            None => pilot.push(PilotStep { start_s: 0.0, speed_mps, follow: Default::default() }),
        }
    }
    Ok((course, uavs))
}

/// The key that a bare map's file goes to; `None` for a scenario.
fn key_of_file(what: &str) -> Option<String> {
    kind_of_map(Path::new(what)).map(|kind| format!("map.{kind}.file"))
}

fn shorts(asked: &Plan, key: Option<&str>) -> Vec<Short> {
    let point = |key: &str, flag: &str, at: Option<[f64; 2]>| {
        at.map(|[x, y]| Short {
            assignment: format!("{key}=[{x:?}, {y:?}]"),
            typed: format!("{flag}={x},{y}"),
        })
    };
    let map = key.map(|key| Short { assignment: format!("{key}={}", asked.what), typed: asked.what.clone() });
    let heading = asked.heading.map(|deg| Short {
        assignment: format!("chain.heading_deg={deg:?}"),
        typed: format!("--heading={deg}"),
    });
    let base = point("chain.base_m", "--base", asked.base);
    let goal = point("chain.goal_m", "--goal", asked.goal);
    [map, base, goal, heading].into_iter().flatten().collect()
}

/// Names what was typed; of a bare map's own faults nobody typed a key.
fn explain(error: ConfigError, asked: &Plan, shorts: &[Short]) -> Failure {
    match error {
        ConfigError::Map { key, cause, .. } if key_of_file(&asked.what).as_ref() == Some(&key) => {
            let cause = cause.to_string();
            let says_where = cause.starts_with(&asked.what);
            Failure::Map(if says_where { cause } else { format!("{}: {cause}", asked.what) })
        }
        error => {
            shorts.iter().fold(error, |error, short| error.typed_as(&short.assignment, &short.typed)).into()
        }
    }
}

/// A scenario around a map: one UAV at the base, ahead of it the goal.
fn bare(asked: &Plan) -> Result<Source, Failure> {
    let missing = match (asked.base, asked.goal) {
        (Some(_), Some(_)) => None,
        (None, Some(_)) => Some("--base X,Y"),
        (Some(_), None) => Some("--goal X,Y"),
        (None, None) => Some("--base X,Y and --goal X,Y"),
    };
    if let Some(missing) = missing {
        return Err(Failure::BareMap { map: asked.what.clone(), missing });
    }
    let stem = Path::new(&asked.what).file_stem().unwrap_or_default().to_string_lossy();
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
    let name: String = stem.chars().take(64).map(plain).collect();
    let text = format!(
        "name = \"{name}\"\nduration_s = 1.0\n[chain]\nuavs = 1\n[[pilot]]\nstart_s = 0.0\nspeed_mps = {SPEED_MPS:?}\n"
    );
    Ok(Source { label: asked.what.clone(), text, folder: std::path::PathBuf::new() })
}
