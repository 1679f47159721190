//! Whether the data support a fit: what makes it none (no table for a scenario comes of it), and what one should know.

use super::{Fit, places::Place};

/// Distances have to span so much (1), and their places be so many.
const SPAN: f64 = 2.0;
const PLACES: usize = 5;
/// A fall of the mean loss with the distance by so much of the rise of the line over all distances is no line (1).
const FALL: f64 = 0.5;
/// Bins of distances, and packets that one needs.
const BINS: usize = 8;
const IN_BIN: f64 = 5.0;
/// Links whose exponents agree with less chance than this do not (1).
const AGREE: f64 = 0.01;
/// A limit is near if so many packets were lost (1).
const LOST: f64 = 0.02;

/// What else is known of the data.
pub(super) struct Seen<'a> {
    pub(super) places: &'a [Place],
    pub(super) spacing_m: f64,
    pub(super) extent_m: f64,
}

pub(super) fn judge(fit: &mut Fit, seen: &Seen<'_>) {
    let (mut refusals, mut warnings) = (Vec::new(), Vec::new());
    let [near_m, far_m] = fit.distance_m;
    let near_m = near_m.max(fit.reference_m);
    if far_m / near_m < SPAN {
        refusals.push(format!(
            "distances from {near_m:.2} to {far_m:.2} m tell no exponent: expected the farthest at least {SPAN} times the nearest"
        ));
    }
    let mut distances: Vec<f64> =
        seen.places.iter().filter(|place| place.heard > 0.0).map(|place| place.distance_m).collect();
    distances.sort_by(f64::total_cmp);
    distances.dedup_by(|a, b| (*a - *b).abs() < 0.02 * b.max(0.01));
    if distances.len() < PLACES {
        refusals.push(format!(
            "{} distances that differ are too few: expected at least {PLACES}, a line and what stays with a place cannot be told apart",
            distances.len()
        ));
    }
    if fit.alpha.low <= 0.0 {
        refusals.push(format!(
            "the exponent's interval, {:.2} to {:.2}, holds 0 or less: the loss may not rise with the distance at all",
            fit.alpha.low, fit.alpha.high
        ));
    }
    if let Some(Fall { from, to, by_db, error_db }) = fall(seen.places) {
        let rise_db = 10.0 * fit.least_squares.alpha.value * libm::log10(far_m / near_m);
        let words = format!(
            "the mean loss falls with the distance, by {by_db:.1} dB from {:.2} to {:.2} m ({:.1} to {:.1} dB)",
            from.0, to.0, from.1, to.1
        );
        if by_db > FALL * rise_db.max(0.0) && by_db > 3.0 * error_db {
            refusals.push(format!(
                "{words}, and the line rises by {rise_db:.1} dB over all distances: no line describes that"
            ));
        } else if by_db > 3.0 * error_db.max(0.5) {
            warnings.push(format!(
                "{words}: shadowing, or a wave off floor and walls, more than a line knows of"
            ));
        }
    }
    exponents(fit, &mut refusals, &mut warnings);
    shadowing(fit, seen, &mut warnings);
    packets(fit, &mut warnings);
    (fit.refusals, fit.warnings) = (refusals, warnings);
}

fn exponents(fit: &Fit, refusals: &mut Vec<String>, warnings: &mut Vec<String>) {
    let (Some(agree), true) = (fit.exponents_agree, fit.exponents.len() > 1) else { return };
    let by = |of: fn(&super::Exponent) -> f64| {
        let values = fit.exponents.iter().map(of);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), value| (l.min(value), h.max(value)))
    };
    let ((low, high), (plain_low, plain_high)) = (by(|one| one.alpha.value), by(|one| one.least_squares));
    let words = format!(
        "exponents of the {} links range from {low:.2} to {high:.2} ({plain_low:.2} to {plain_high:.2} by least squares)",
        fit.exponents.len()
    );
    if agree < AGREE {
        refusals.push(format!(
            "{words}, more than their intervals allow (chance {agree:.3}): one exponent over all of them describes none; fit links by \
             themselves with --link NAME"
        ));
    } else if high - low > 0.5 || plain_high - plain_low > 0.5 {
        warnings.push(format!(
            "{words}; their intervals allow one for all (chance {agree:.2}), which is a mean over links, and no link's own"
        ));
    }
}

fn shadowing(fit: &Fit, seen: &Seen<'_>, warnings: &mut Vec<String>) {
    let Seen { spacing_m, extent_m, .. } = *seen;
    if !fit.has_static() {
        warnings.push(
            "shadowing that stays with the place is not told from noise: all of it counts as noise"
                .to_owned(),
        );
        return;
    }
    let length = &fit.correlation_m;
    if length.is_open_above || length.value > extent_m {
        warnings.push(format!(
            "the correlation length is not bounded above: {:.2} m or more, the walk spans {extent_m:.2} m; a longer walk would tell",
            length.low
        ));
    }
    if length.is_open_below || length.value < spacing_m {
        warnings.push(format!(
            "the correlation length is not bounded below: {:.2} m or less, places lie {spacing_m:.2} m apart; slower steps would tell",
            length.high
        ));
    }
    if fit.cell_m > 0.3 * length.value {
        warnings.push(format!(
            "packets are counted together in cells of {:.2} m, which is not small against the correlation length of {:.2} m: some of what stays counts as noise",
            fit.cell_m, length.value
        ));
    }
}

fn packets(fit: &Fit, warnings: &mut Vec<String>) {
    let packets = &fit.packets;
    let lost = 1.0 - packets.heard as f64 / packets.sent.max(1) as f64;
    if packets.limit_db.is_none() && lost > LOST {
        warnings.push(format!(
            "{:.0} % of the packets were not heard, no more of those that should lose most: taken as lost by chance, and the limit of the radio is not reached",
            100.0 * lost
        ));
    }
}

/// Where the mean loss falls most.
struct Fall {
    from: (f64, f64),
    to: (f64, f64),
    by_db: f64,
    error_db: f64,
}

/// The greatest fall from one bin of distances to a farther one. Bins hold about as many packets each.
fn fall(places: &[Place]) -> Option<Fall> {
    let mut heard: Vec<&Place> = places.iter().filter(|place| place.heard > 0.0).collect();
    heard.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    let total: f64 = heard.iter().map(|place| place.heard).sum();
    let most = (total / BINS as f64).max(IN_BIN);
    // Packets, distance, loss, loss squared.
    let mut bins: Vec<[f64; 4]> = Vec::new();
    for place in heard {
        let n = place.heard;
        let more =
            [n, n * place.distance_m, n * place.loss_db, n * place.loss_db * place.loss_db + place.squares];
        match bins.last_mut() {
            Some(bin) if bin[0] + 0.5 * n <= most => {
                for (sum, more) in bin.iter_mut().zip(more) {
                    *sum += more;
                }
            }
            _ => bins.push(more),
        }
    }
    let told: Vec<(f64, f64, f64)> = bins
        .iter()
        .filter(|[n, ..]| *n >= IN_BIN)
        .map(|[n, distance, loss, squares]| {
            let mean = loss / n;
            (distance / n, mean, ((squares / n - mean * mean).max(0.0) / n).sqrt())
        })
        .collect();
    let pairs = told.iter().enumerate().flat_map(|(nth, a)| told.iter().skip(nth + 1).map(move |b| (a, b)));
    let greatest = pairs.max_by(|(a, b), (c, d)| (a.1 - b.1).total_cmp(&(c.1 - d.1)))?;
    let (from, to) = greatest;
    let by_db = from.1 - to.1;
    (by_db > 0.0).then(|| Fall {
        from: (from.0, from.1),
        to: (to.0, to.1),
        by_db,
        error_db: libm::hypot(from.2, to.2),
    })
}
