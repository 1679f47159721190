//! Logs whose truth is known, for tests: an exact normal field along a way, noise, and a limit.

use crate::{
    radio_fit::{Log, Sample},
    seed::{Seed, Source},
};

/// What is true of a log.
#[derive(Debug, Clone, Copy)]
pub(super) struct Truth {
    pub(super) reference_loss_db: f64,
    pub(super) alpha: f64,
    pub(super) sigma_db: f64,
    pub(super) sigma_static_db: f64,
    pub(super) correlation_m: f64,
    /// Loss from which on no packet is heard (dB).
    pub(super) limit_db: f64,
}

pub(super) const TRUTH: Truth = Truth {
    reference_loss_db: 35.0,
    alpha: 2.5,
    sigma_db: 3.0,
    sigma_static_db: 4.0,
    correlation_m: 2.0,
    limit_db: f64::INFINITY,
};

/// A walk straight away from an anchor: `places` places `step_m` apart from 0.5 m on, `packets` packets at each. On a line the
/// exponential correlation is a chain in which each place hangs on the one before alone, so the draw is exact.
pub(super) fn walk(seed: u64, truth: &Truth, places: usize, step_m: f64, packets: usize) -> Log {
    let mut stream = Seed(seed).stream(0, Source::Start);
    let mut normal = || f64::from(stream.normal());
    let stays = libm::exp(-step_m / truth.correlation_m);
    let mut x_db = truth.sigma_static_db * normal();
    let mut samples = Vec::new();
    for place in 0..places {
        if place > 0 {
            x_db = stays * x_db + truth.sigma_static_db * (1.0 - stays * stays).sqrt() * normal();
        }
        let distance_m = 0.5 + step_m * place as f64;
        let line_db = truth.reference_loss_db + 10.0 * truth.alpha * libm::log10(distance_m / 0.25);
        for _ in 0..packets {
            let loss_db = line_db + x_db + truth.sigma_db * normal();
            let loss_db = (loss_db < truth.limit_db).then_some(loss_db);
            let ends_m = [distance_m, 0.0, 0.0, 0.0, 0.0, 0.0];
            samples.push(Sample { line: samples.len() + 2, link: 0, loss_db, distance_m, ends_m });
        }
    }
    Log {
        label: "drawn".to_owned(),
        links: vec![String::new()],
        samples,
        has_places: true,
        notes: Vec::new(),
    }
}
