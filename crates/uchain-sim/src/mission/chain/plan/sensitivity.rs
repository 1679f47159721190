//! How much hangs on numbers that nobody knows to the decibel.

use std::sync::Arc;

use serde::Serialize;

use super::PlanError;
use crate::{
    mission::chain::Course,
    radio::{PathLoss, RadioModel},
};

/// How far the limit is moved (dB), and the exponents (1).
const LIMIT_DB: f32 = 1.0;
const EXPONENT: f32 = 0.1;

/// Relays for the depth asked for, if one number were a little different.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Sensitivity {
    /// One after the other. The exponents are those of the model "path-loss"; of another radio only the limit is moved.
    pub variants: Vec<Variant>,
}

/// One number a little different.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Variant {
    /// By how much `takeoff.s_min_db` is moved (dB).
    pub s_min_db: f64,
    /// By how much the exponents `radio.alpha_free` and `radio.alpha_wall` are moved (1).
    pub alpha: f64,
    /// Relays needed then; `None` where no number would do.
    pub relays: Option<usize>,
}

pub(super) fn sensitivity(
    course: &Course,
    goal_m: f64,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Sensitivity, PlanError> {
    let mut variants = Vec::with_capacity(4);
    let relays = |course: &Course| {
        let links = course.optimum().and_then(|optimum| optimum.links_needed(goal_m));
        links.map(|links| links - 1)
    };
    for change_db in [-LIMIT_DB, LIMIT_DB] {
        let mut other = course.clone();
        other.scenario.takeoff.s_min_db += change_db;
        variants.push(Variant { s_min_db: change_db.into(), alpha: 0.0, relays: relays(&other) });
    }
    for change in [-EXPONENT, EXPONENT] {
        if !go_on() {
            return Err(PlanError::Interrupted);
        }
        let Some(other) = with_exponents(course, change) else { continue };
        let alpha = (10.0 * f64::from(change)).round() / 10.0;
        variants.push(Variant { s_min_db: 0.0, alpha, relays: relays(&other) });
    }
    Ok(Sensitivity { variants })
}

/// The same with other exponents; `None` of a radio that has none.
fn with_exponents(course: &Course, change: f32) -> Option<Arc<Course>> {
    let mut other = course.clone();
    let radio = &mut other.scenario.radio;
    if radio.model != PathLoss::WORD {
        return None;
    }
    radio.alpha_free = (radio.alpha_free + change).max(0.0);
    radio.alpha_wall = (radio.alpha_wall + change).max(0.0);
    let model: Arc<dyn RadioModel> = Arc::new(PathLoss::new(radio.clone(), &other.map).ok()?);
    Some(other.with_radio(PathLoss::WORD, model))
}
