//! A plan by a radio that was fitted: with its best line, with the line as good and as bad as the fit leaves open, and with
//! room for shadowing that stays.

use serde::Serialize;

use super::{PlanRequest, PlanRequestError, Registry};
use crate::{mission::chain::Course, radio_fit::Fit};

/// Ends of a 95 % interval, and the 5 % of links that lose more, in standard deviations.
const Z: f64 = 1.96;
const Z_LINK: f64 = 1.645;
/// Longest link that is looked for (m).
const FAR_M: f64 = 1e5;

/// Relays by a fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedPlan {
    /// The scenario or map.
    pub scenario: String,
    /// Depth that is planned for (m).
    pub to_m: f64,
    /// Loss that no link may exceed (dB), `takeoff.s_min_db`.
    pub s_min_db: f64,
    /// Length at which a link in free sight loses as much by the fit (m), and the standard error of the loss there (dB).
    pub reach_m: f64,
    /// Standard error of the line there (dB).
    pub error_db: f64,
    /// Longest distance that the log has (m): farther out the line is prolonged.
    pub farthest_m: f64,
    /// One after the other.
    pub cases: Vec<FittedCase>,
}

/// Relays for one line.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedCase {
    /// `fit`, `low`, `high`, or `margin`.
    pub case: &'static str,
    /// Loss at the reference distance (dB).
    pub reference_loss_db: f64,
    /// Exponent (1).
    pub alpha: f64,
    /// Loss that links are planned for (dB).
    pub limit_db: f64,
    /// Relays needed; `None` where no number would do.
    pub relays: Option<usize>,
}

impl FittedPlan {
    /// In words, a row for every case.
    pub fn text(&self) -> String {
        use std::fmt::Write as _;
        let mut text = String::new();
        let Self { scenario, to_m, s_min_db, reach_m, error_db, farthest_m, .. } = self;
        // Writing to a String cannot fail, here and below.
        let _ = writeln!(
            text,
            "plan of {scenario} down to {to_m:.1} m, links of at most {s_min_db} dB, {reach_m:.2} m long in free sight"
        );
        for FittedCase { case, reference_loss_db, alpha, limit_db, relays } in &self.cases {
            let relays = relays.map_or("no number of relays will do".to_owned(), |relays| match relays {
                1 => "1 relay".to_owned(),
                relays => format!("{relays} relays"),
            });
            let about = match *case {
                "fit" => "by the fit",
                "low" => "as little loss as the fit leaves open (2.5 %)",
                "high" => "as much loss as the fit leaves open (97.5 %)",
                _ => "by the fit, 95 % of links within the limit",
            };
            let _ = writeln!(
                text,
                "  {relays:<10} {about}: L0 {reference_loss_db:.1} dB, alpha {alpha:.2}, planned for {limit_db:.1} dB"
            );
        }
        let _ = writeln!(
            text,
            "  In it: what the log leaves open of the line ({error_db:.1} dB at that length), and in the last row shadowing that \
             stays. Not in it: walls, whose exponent is the scenario's; that links of one chain fail together or apart: a chain of k \
             links, each within the limit 95 times of 100, is whole 0.95^k of the times if they are independent, which understates \
             it (Agrawal and Patwari 2009)."
        );
        if reach_m > farthest_m {
            let _ = writeln!(
                text,
                "  warning: the log ends at {farthest_m:.2} m, short of such a link: the line is prolonged, and may not go on so"
            );
        }
        text
    }
}

impl Registry {
    /// The relays that a scenario or a map takes with a radio as it was fitted, down to a depth (m; the tunnel's end if
    /// `None`).
    ///
    /// # Errors
    /// Those of [`Self::plan_course`], a fit that its data do not support, a depth beyond the tunnel's end.
    pub fn plan_fitted(
        self,
        asked: &PlanRequest<'_>,
        fit: &Fit,
        to_m: Option<f64>,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<FittedPlan>, PlanRequestError> {
        let sets = |reference_loss_db: f64, alpha: f64, limit_db: Option<f64>| -> Vec<String> {
            let own = [
                "radio.model=path-loss".to_owned(),
                format!("radio.reference_m={:?}", fit.reference_m),
                format!("radio.reference_loss_db={reference_loss_db:?}"),
                format!("radio.alpha_free={alpha:?}"),
            ];
            let limit = limit_db.map(|limit_db| format!("takeoff.s_min_db={limit_db:?}"));
            // What somebody writes over the scenario comes first: the fit is what was asked for.
            asked.sets.iter().cloned().chain(own).chain(limit).collect()
        };
        let course = |sets: &[String]| {
            let request = PlanRequest { sets, ..*asked };
            self.plan_course(&request).map(|made| made.course)
        };
        let (l0_db, alpha) = (fit.reference_loss_db.value, fit.alpha.value);
        let best = course(&sets(l0_db, alpha, None))?;
        let Some(tunnel_m) = best.tunnel.as_ref().map(crate::map::Tunnel::length_m) else {
            return Err(PlanRequestError::Map(best.no_tunnel().to_string()));
        };
        let to_m = to_m.unwrap_or(tunnel_m);
        if !(to_m > 0.0 && to_m <= tunnel_m + 0.01) {
            let words = format!("--to {to_m}: the tunnel ends at {tunnel_m:.2} m");
            return Err(PlanRequestError::Map(words));
        }
        let s_min_db = f64::from(best.scenario.takeoff.s_min_db);
        let decades = ((s_min_db - l0_db) / (10.0 * alpha)).max(0.0);
        let reach_m = (fit.reference_m * libm::exp10(decades.min(12.0))).min(FAR_M);
        let (_, error_db) = fit.loss_db(reach_m);
        // The lines that lose most and least at that length, of all that the interval there holds.
        let x = 10.0 * libm::log10(reach_m / fit.reference_m);
        let [a, b, c] = fit.covariance;
        let pull = if error_db > 0.0 { [(a + x * b) / error_db, (b + x * c) / error_db] } else { [0.0; 2] };
        let bent = |z: f64| (l0_db + z * pull[0], (alpha + z * pull[1]).max(0.0));
        let margin_db = if fit.has_static() { Z_LINK * fit.sigma_static_db.value } else { 0.0 };
        let mut cases = Vec::with_capacity(4);
        for (case, (reference_loss_db, alpha), margin_db) in [
            ("fit", (l0_db, alpha), 0.0),
            ("low", bent(-Z), 0.0),
            ("high", bent(Z), 0.0),
            ("margin", (l0_db, alpha), margin_db),
        ] {
            if !go_on() {
                return Ok(None);
            }
            let limit_db = s_min_db - margin_db;
            let relays = if case == "fit" {
                relays(&best, to_m)
            } else {
                let limit = (margin_db > 0.0).then_some(limit_db);
                relays(&*course(&sets(reference_loss_db, alpha, limit))?, to_m)
            };
            cases.push(FittedCase { case, reference_loss_db, alpha, limit_db, relays });
        }
        let (scenario, farthest_m) = (best.scenario.name.clone(), fit.distance_m[1]);
        Ok(Some(FittedPlan { scenario, to_m, s_min_db, reach_m, error_db, farthest_m, cases }))
    }
}

fn relays(course: &Course, to_m: f64) -> Option<usize> {
    let links = course.optimum().and_then(|optimum| optimum.links_needed(to_m));
    links.map(|links| links - 1)
}
