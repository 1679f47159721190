//! How much hangs on numbers that nobody knows to the decibel.

use std::sync::Arc;

use serde::Serialize;

use super::PlanError;
use crate::{
    map::Map,
    mission::chain::Course,
    radio::{Antenna, NO_LINK_DB, PathLoss, RadioModel, around},
};

/// How far the limit is moved (dB), and the exponents (1).
const LIMIT_DB: f32 = 1.0;
const EXPONENT: f32 = 0.1;
/// A link that loses so much more than the limit at best is no part of any chain that is looked at (dB): a relay moves less
/// than a sample from where it is first put, which changes its links by no more than a corner does.
const BEYOND_DB: f32 = 12.0;

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
    let model = around(radio, Arc::new(PathLoss::new(radio.clone(), &other.map).ok()?));
    let most_db = other.scenario.takeoff.s_min_db + BEYOND_DB;
    Some(other.with_radio(PathLoss::WORD, Arc::new(Within { model, most_db })))
}

/// A radio of which only links matter that lose no more than so much at best: of the others nobody asks what stands in their
/// way, which takes most of the time of a plan. They are no part of a chain that keeps every link within the limit.
#[derive(Debug)]
struct Within {
    model: Arc<dyn RadioModel>,
    most_db: f32,
}

impl RadioModel for Within {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        if self.model.least_loss_db(from.at.distance(to.at)) > self.most_db {
            return NO_LINK_DB;
        }
        self.model.loss_db(map, from, to)
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        let least_db = self.model.least_loss_db(apart_m);
        if least_db > self.most_db { NO_LINK_DB } else { least_db }
    }

    fn is_costly(&self) -> bool {
        self.model.is_costly()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::builtin;

    #[test]
    fn links_far_beyond_the_limit_change_no_number_of_relays() {
        for (name, sets) in [
            ("corner", &[][..]),
            ("circuit", &["radio.alpha_free=2.5"]),
            ("straight", &["radio.shadowing=wall-count"]),
        ] {
            let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
            let course = Course::read(&builtin(name).unwrap(), &sets).unwrap();
            let tunnel_m = course.tunnel.as_ref().unwrap().length_m();
            for change in [-EXPONENT, EXPONENT] {
                let (quick, mut slow) = (with_exponents(&course, change).unwrap(), (*course).clone());
                slow.scenario.radio.alpha_free += change;
                slow.scenario.radio.alpha_wall += change;
                let model = PathLoss::new(slow.scenario.radio.clone(), &slow.map).unwrap();
                let slow = slow.with_radio(PathLoss::WORD, Arc::new(model));
                for depth_m in [0.3 * tunnel_m, 0.7 * tunnel_m, tunnel_m] {
                    let links = [&quick, &slow].map(|of| of.optimum().unwrap().links_needed(depth_m));
                    assert_eq!(links[0], links[1], "{name} {change} {depth_m}");
                }
            }
        }
    }
}
