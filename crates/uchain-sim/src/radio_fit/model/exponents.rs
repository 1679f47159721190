//! The exponent of each link by itself, whether all agree, and what ordinary least squares says.

use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF as _};

use super::{
    Interval, LeastSquares,
    likelihood::{Likelihood, Share, Sums},
    places::Place,
};
use crate::radio_fit::Log;

/// Packets and places that a link's own exponent takes.
const PACKETS: f64 = 8.0;
const PLACES: usize = 4;

/// The exponent of one link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exponent {
    /// The link.
    pub link: String,
    /// Packets heard of it.
    pub heard: usize,
    /// By generalised least squares, share and length those of all links.
    pub alpha: Interval,
    /// By ordinary least squares (1).
    pub least_squares: f64,
    /// Its own loss at the reference distance (dB).
    pub reference_loss_db: f64,
}

/// Of all links that have packets and places enough.
pub(super) fn by_link(
    likelihood: &mut Likelihood,
    places: &[Place],
    log: &Log,
    share: Share,
    variance: f64,
) -> Vec<Exponent> {
    let mut all = Vec::new();
    for (link, name) in log.links.iter().enumerate() {
        let own: Vec<&Place> =
            places.iter().filter(|place| place.link == link && place.heard > 0.0).collect();
        let heard: f64 = own.iter().map(|place| place.heard).sum();
        let sums = likelihood.of_link(places, link, share);
        let line = sums.line();
        if heard < PACKETS || own.len() < PLACES || !line[1].is_finite() || sums.det() <= 0.0 {
            continue;
        }
        let half = 1.96 * (variance * sums.inverse()[2]).sqrt();
        all.push(Exponent {
            link: name.clone(),
            heard: heard as usize,
            alpha: Interval::around(line[1] / 10.0, half / 10.0),
            least_squares: plain(&own).line()[1] / 10.0,
            reference_loss_db: line[0],
        });
    }
    all
}

/// The chance of exponents so far apart if all were one: Cochran's Q.
pub(super) fn agree(exponents: &[Exponent]) -> Option<f64> {
    if exponents.len() < 2 {
        return None;
    }
    let weight = |one: &Exponent| {
        let error = (one.alpha.high - one.alpha.low) / (2.0 * 1.96);
        1.0 / (error * error).max(1e-12)
    };
    let total: f64 = exponents.iter().map(weight).sum();
    let mean = exponents.iter().map(|one| weight(one) * one.alpha.value).sum::<f64>() / total;
    let q: f64 =
        exponents.iter().map(|one| weight(one) * (one.alpha.value - mean) * (one.alpha.value - mean)).sum();
    let chi = ChiSquared::new((exponents.len() - 1) as f64).ok()?;
    Some(1.0 - chi.cdf(q))
}

fn plain(places: &[&Place]) -> Sums {
    let mut sums = Sums::default();
    for place in places {
        let n = place.heard;
        sums.xx[0] += n;
        sums.xx[1] += n * place.decades;
        sums.xx[2] += n * place.decades * place.decades;
        sums.xy[0] += n * place.loss_db;
        sums.xy[1] += n * place.decades * place.loss_db;
        sums.yy += n * place.loss_db * place.loss_db;
    }
    sums
}

/// The line of ordinary least squares with the intervals it claims.
pub(super) fn least_squares(places: &[Place]) -> LeastSquares {
    let heard: Vec<&Place> = places.iter().filter(|place| place.heard > 0.0).collect();
    let sums = plain(&heard);
    let line = sums.line();
    let squares: f64 = heard
        .iter()
        .map(|place| {
            let off_db = place.loss_db - line[0] - line[1] * place.decades;
            place.squares + place.heard * off_db * off_db
        })
        .sum();
    let variance = squares / (sums.xx[0] - 2.0).max(1.0);
    let half = sums.inverse().map(|inverse| 1.96 * (variance * inverse).max(0.0).sqrt());
    LeastSquares {
        reference_loss_db: Interval::around(line[0], half[0]),
        alpha: Interval::around(line[1] / 10.0, half[2] / 10.0),
    }
}
