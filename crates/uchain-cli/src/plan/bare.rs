//! What to plan for: a scenario, or a bare ROS map made into one.

use std::path::Path;

use uchain_sim::config::{Course, PilotStep, Source};

use crate::{args::Plan, exit::Failure};

/// UAVs at hand where nobody says: as many as any chain may have.
const UAVS_MAX: usize = 1000;
/// The head's speed where nobody says (m/s).
const SPEED_MPS: f32 = 0.2;

/// The tunnel, with the chain and the speed asked for. Nothing is flown, so nobody asks whether all UAVs find
/// room to wait.
#[expect(clippy::default_trait_access, reason = "the type of a pilot's `follow` is the core's")]
pub(super) fn course(asked: &Plan) -> Result<Course, Failure> {
    let (source, mut sets) =
        if is_map(&asked.what) { bare(asked)? } else { (Source::find(&asked.what)?, Vec::new()) };
    sets.extend(asked.base.map(|[x, y]| format!("chain.base_m=[{x:?}, {y:?}]")));
    sets.extend(asked.goal.map(|[x, y]| format!("chain.goal_m=[{x:?}, {y:?}]")));
    sets.extend(asked.heading.map(|deg| format!("chain.heading_deg={deg:?}")));
    sets.extend_from_slice(&asked.set);
    let mut course = Course::read(&source, &sets)?;

    match asked.uavs {
        Some(uavs) => course.scenario.chain.uavs = usize::from(uavs),
        None if is_map(&asked.what) => course.scenario.chain.uavs = UAVS_MAX,
        None => {}
    }
    if let Some(speed_mps) = asked.speed {
        let pilot = &mut course.scenario.pilot;
        match pilot.iter_mut().find(|step| step.speed_mps > 0.0) {
            Some(step) => step.speed_mps = speed_mps,
            None => pilot.push(PilotStep { start_s: 0.0, speed_mps, follow: Default::default() }),
        }
    }
    Ok(course)
}

fn is_map(what: &str) -> bool {
    let end = Path::new(what).extension();
    end.is_some_and(|end| end.eq_ignore_ascii_case("yaml") || end.eq_ignore_ascii_case("yml"))
}

/// A scenario around a ROS map: one UAV at the base, ahead of it the goal.
fn bare(asked: &Plan) -> Result<(Source, Vec<String>), Failure> {
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
    let source = Source { label: asked.what.clone(), text, folder: std::path::PathBuf::new() };
    Ok((source, vec![format!("map.ros.file={}", asked.what)]))
}
