//! From packets to a line, its noises and their intervals.

mod exponents;
mod intervals;
mod likelihood;
mod packets;
mod places;
mod search;
mod support;
#[cfg(test)]
mod tests;

use serde::Serialize;

use super::{FitError, Log};
use intervals::LineKnown;
use likelihood::Likelihood;
use packets::Counted;
use places::{Index, Place, blocks, places};
use search::{best, bounds, share_at, surface};

pub use exponents::Exponent;
pub use intervals::Interval;
pub use packets::{PacketLoss, Rate};

/// Fewest packets and places that anything is fitted to.
const LEAST: usize = 8;
const LEAST_PLACES: usize = 3;
/// Work of one likelihood (multiplications), which says how large blocks may be; and their bounds.
const WORK: f64 = 1.5e7;
const BLOCK: (f64, f64) = (60.0, 240.0);
/// How often packets that were not heard are weighed anew.
const ROUNDS: usize = 8;
/// Most residuals that are kept for a picture.
const RESIDUALS: usize = 4_000;

/// How a log is fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Distance at which the reference loss is said (m), `radio.reference_m`; nearer antennas lose no less.
    pub reference_m: f64,
}

impl Default for FitOptions {
    /// The reference of scenarios, 0.25 m.
    fn default() -> Self {
        Self { reference_m: 0.25 }
    }
}

/// What a log came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fit {
    /// The log.
    pub log: String,
    /// Packets and places.
    pub packets: PacketLoss,
    /// Places that packets were counted together at.
    pub places: usize,
    /// Side of the cells that stand for a place (m); 0 where each place is told by itself.
    pub cell_m: f64,
    /// Links by name.
    pub links: Vec<String>,
    /// Least and greatest distance of a packet that was heard (m).
    pub distance_m: [f64; 2],
    /// Reference distance (m).
    pub reference_m: f64,
    /// Loss at the reference distance (dB), `radio.reference_loss_db`.
    pub reference_loss_db: Interval,
    /// Exponent (1), `radio.alpha_free`.
    pub alpha: Interval,
    /// Covariance of the two: of the loss (dB²), of both (dB), of the exponent (1).
    pub covariance: [f64; 3],
    /// Standard deviation of what is new at every packet (dB), `radio.sigma_db`.
    pub sigma_db: Interval,
    /// Standard deviation of what stays with the place (dB), `radio.sigma_static_db`.
    pub sigma_static_db: Interval,
    /// Distance over which the latter falls to a share of 1/e (m), `radio.correlation_m`.
    pub correlation_m: Interval,
    /// Share of the variance that stays with the place (1).
    pub static_share: f64,
    /// Twice the logarithm of how much likelier the log is with shadowing that stays than without.
    pub static_evidence: f64,
    /// Ordinary least squares: what one gets who takes all packets for independent.
    pub least_squares: LeastSquares,
    /// The exponent of each link by itself.
    pub exponents: Vec<Exponent>,
    /// Chance (1) of exponents so far apart if all links had the same; `None` of one link.
    pub exponents_agree: Option<f64>,
    /// Why the data do not support a fit; none if they do.
    pub refusals: Vec<String>,
    /// What one should know before using it.
    pub warnings: Vec<String>,
    /// How the log was read.
    pub notes: Vec<String>,
    /// For the picture.
    #[serde(skip)]
    pub residuals: Vec<Residual>,
}

/// The line of ordinary least squares.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LeastSquares {
    /// Loss at the reference distance (dB).
    pub reference_loss_db: Interval,
    /// Exponent (1).
    pub alpha: Interval,
}

/// A packet that was heard, against the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// Which link.
    pub link: usize,
    /// Which packet of the log.
    pub sample: usize,
    /// Distance (m).
    pub distance_m: f64,
    /// Loss (dB).
    pub loss_db: f64,
    /// Loss by the line (dB).
    pub line_db: f64,
    /// Shadowing of the place, as the fit has it (dB).
    pub static_db: f64,
}

impl Fit {
    /// Mean loss at a distance (dB), and its standard error (dB).
    pub fn loss_db(&self, distance_m: f64) -> (f64, f64) {
        let x = 10.0 * libm::log10(distance_m.max(self.reference_m) / self.reference_m);
        let [a, b, c] = self.covariance;
        (self.reference_loss_db.value + x * self.alpha.value, (a + 2.0 * x * b + x * x * c).max(0.0).sqrt())
    }

    /// Whether shadowing that stays with the place is told from noise (at 95 %).
    pub fn has_static(&self) -> bool {
        self.static_evidence > 5.99
    }
}

/// Shadowing at all places by the fit (dB): what is to be expected there beside the line.
fn shadowing(
    likelihood: &mut Likelihood,
    places: &[Place],
    share: likelihood::Share,
    line: [f64; 2],
) -> Vec<f64> {
    let mut all_db = vec![0.0; places.len()];
    for index in 0..likelihood.blocks.len() {
        let members = likelihood.blocks[index].places.clone();
        let solved = likelihood.factor(places, index, share);
        let columns = solved.solved(members.len());
        let pulls: Vec<(usize, f64)> = solved
            .indices
            .iter()
            .zip(columns)
            .map(|((_, place), [one, decades, loss])| (*place, loss - line[0] * one - line[1] * decades))
            .collect();
        for member in members {
            let r = |place: usize| {
                share.rho * libm::exp(-places[member].apart_m(&places[place]) / share.length_m)
            };
            all_db[member] = pulls.iter().map(|(place, pull)| r(*place) * pull).sum();
        }
    }
    all_db
}

/// Fits a log.
///
/// # Errors
/// Too few packets or places, a reference that is none, losses without a likelihood. Data that do not support the fit are
/// told in [`Fit::refusals`].
pub fn fit(log: &Log, options: &FitOptions) -> Result<Fit, FitError> {
    let reference_m = options.reference_m;
    if !(0.001..=100.0).contains(&reference_m) {
        let (option, got) = ("--reference-m", reference_m.to_string());
        return Err(FitError::Option {
            option,
            got,
            expected: "expected metres, from 0.001 to 100".to_owned(),
        });
    }
    let (mut places, index, cell_m) = places(log, reference_m);
    let heard_at = places.iter().filter(|place| place.heard > 0.0).count();
    let heard = log.heard();
    if heard < LEAST || heard_at < LEAST_PLACES {
        let (label, places) = (log.label.clone(), heard_at);
        return Err(FitError::TooFew { label, heard, places, least: LEAST, least_places: LEAST_PLACES });
    }
    let (bounds, spacing_m, extent_m) = bounds(&places);
    let most = uchain_core::bounded((3.0 * WORK / places.len() as f64).sqrt(), BLOCK.0, BLOCK.1);
    let mut likelihood = Likelihood::new(&places, blocks(&places, most as usize));
    let none = || FitError::NoLikelihood { label: log.label.clone() };

    let mut top = best(&mut likelihood, &places, bounds, None);
    let mut curve = None;
    let has_lost = places.iter().any(|place| place.lost > 0.0);
    let mut expected_db = Vec::new();
    let readings = || log.samples.iter().filter_map(|sample| sample.loss_db);
    for round in 0..if has_lost { ROUNDS } else { 0 } {
        let share = share_at(top.point);
        let sigma_db = (top.at.variance(likelihood.free) * (1.0 - share.rho)).sqrt();
        for _ in 0..2 {
            let line = likelihood.at(&places, share).sums.line();
            let static_db = shadowing(&mut likelihood, &places, share, line);
            let expected = places.iter().zip(&static_db);
            expected_db = expected.map(|(place, x_db)| line[0] + line[1] * place.decades + x_db).collect();
            curve = Counted::new(readings(), &places, &expected_db).curve(sigma_db);
            let Some(curve) = &curve else { break };
            packets::count_lost(&mut places, &expected_db, curve, sigma_db);
            likelihood.count(&places);
        }
        if curve.is_none() {
            // Lost by chance: they say nothing of the loss.
            places.iter_mut().for_each(Place::forget_lost);
            likelihood.count(&places);
            if round == 0 {
                break;
            }
        }
        top = best(&mut likelihood, &places, bounds, Some(top.point));
    }
    if !top.deviance.is_finite() {
        return Err(none());
    }
    let surface = surface(&mut likelihood, &places, bounds, top.point);
    let share = share_at(surface.best.point);
    let variance = surface.best.at.variance(likelihood.free);
    let LineKnown { line, covariance } = intervals::line(&mut likelihood, &places, &surface);
    let white = likelihood.at(&places, likelihood::Share { rho: 0.0, length_m: spacing_m });
    let static_evidence = (white.deviance(likelihood.free) - surface.best.deviance).max(0.0);
    let [sigma_db, sigma_static_db, correlation_m] =
        intervals::noises(&surface, likelihood.free, heard as f64);
    let static_db = shadowing(&mut likelihood, &places, share, line);
    let at_places = places.iter().zip(&static_db);
    let by_place_db: Vec<f64> =
        at_places.map(|(place, x_db)| line[0] + line[1] * place.decades + x_db).collect();
    let expected_db = if expected_db.is_empty() { by_place_db } else { expected_db };
    let packets = Counted::new(readings(), &places, &expected_db).told(&places, &expected_db, curve);
    let z = 1.96;
    let half = covariance.map(|squared| z * squared.max(0.0).sqrt());
    let near_far =
        log.samples.iter().filter(|sample| sample.loss_db.is_some()).map(|sample| sample.distance_m);
    let (near_m, far_m) = near_far.fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), m| (l.min(m), h.max(m)));
    let exponents = exponents::by_link(&mut likelihood, &places, log, share, variance);
    let mut fit = Fit {
        log: log.label.clone(),
        packets,
        places: heard_at,
        cell_m,
        links: log.links.clone(),
        distance_m: [near_m, far_m],
        reference_m,
        reference_loss_db: Interval::around(line[0], half[0]),
        alpha: Interval::around(line[1] / 10.0, half[2] / 10.0),
        covariance: [covariance[0], covariance[1] / 10.0, covariance[2] / 100.0],
        sigma_db,
        sigma_static_db,
        correlation_m,
        static_share: share.rho,
        static_evidence,
        least_squares: exponents::least_squares(&places),
        exponents_agree: exponents::agree(&exponents),
        exponents,
        refusals: Vec::new(),
        warnings: Vec::new(),
        notes: log.notes.clone(),
        residuals: residuals(log, &index, &static_db, line, reference_m),
    };
    if !(fit.alpha.value.is_finite() && fit.reference_loss_db.high.is_finite()) {
        return Err(none());
    }
    support::judge(&mut fit, &support::Seen { places: &places, spacing_m, extent_m });
    Ok(fit)
}

/// Every so many packets against the fit.
fn residuals(log: &Log, index: &Index, static_db: &[f64], line: [f64; 2], reference_m: f64) -> Vec<Residual> {
    let every = log.heard().div_ceil(RESIDUALS).max(1);
    let heard = log.samples.iter().enumerate().filter(|(_, sample)| sample.loss_db.is_some());
    let told = heard.step_by(every).filter_map(|(nth, sample)| {
        let place = index.find(sample);
        Some(Residual {
            link: sample.link,
            sample: nth,
            distance_m: sample.distance_m,
            loss_db: sample.loss_db?,
            line_db: line[0] + line[1] * libm::log10(sample.distance_m.max(reference_m) / reference_m),
            static_db: place.and_then(|place| static_db.get(place)).copied().unwrap_or_default(),
        })
    });
    told.collect()
}
