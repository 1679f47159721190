//! What a log of losses says about the radio that made it: exponent, loss at a reference distance, the noise that is new at
//! every packet and the one that stays with the place, how far the latter reaches, and where packets are lost; each with its
//! 95 % interval, and in words where the data do not support a fit.
//!
//! Samples along a way are not independent: shadowing stays with the place, and two places near each other share most of
//! it (Gudmundson 1991). An ordinary least-squares line takes them for independent, and its intervals are several times too
//! narrow. Here the line is fitted by generalised least squares within a restricted maximum likelihood of
//! `loss = L0 + 10 α log10(max(d, d0) / d0) + X(place) + W`, X normal with a correlation of `exp(-(|Δp| + |Δq|) / D)` between
//! links whose ends lie Δp and Δq apart, W normal and new every time. Packets that were sent and not heard are censored:
//! of them is known that they lost more than what is heard at their place.
//!
//! ```
//! use uchain_sim::radio_fit::{FitOptions, Log, ReadOptions, fit};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut text = "distance_m,loss_db\n".to_owned();
//! for step in 1..=40 {
//!     let (d_m, noise_db) = (0.5 * f64::from(step), [0.4, -1.1, 0.9, -0.2][step as usize % 4]);
//!     text += &format!("{d_m},{}\n", 35.0 + 25.0 * libm::log10(d_m / 0.25) + noise_db);
//! }
//! let log = Log::of(&text, "walk.csv", None, &ReadOptions::default())?;
//! let fit = fit(&log, &FitOptions::default())?;
//! assert!((fit.alpha.value - 2.5).abs() < 0.2 && fit.alpha.low < 2.5 && fit.alpha.high > 2.5);
//! assert!(fit.refusals.is_empty() && fit.radio_toml().unwrap().contains("alpha_free"));
//! # Ok(())
//! # }
//! ```

mod model;
mod read;
mod tell;

use std::io;

pub use model::{Exponent, Fit, FitOptions, Interval, LeastSquares, PacketLoss, Rate, Residual, fit};
pub use read::{LOG_MAX_BYTES, Log, Mapping, ReadOptions, SAMPLES_MAX, Sample, about_columns, template};

/// Why there is no fit at all. Data that were read and do not support one are no error: [`Fit::refusals`].
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The file cannot be read.
    #[error("{label}: cannot read it: {cause}")]
    Read {
        /// The file.
        label: String,
        /// What the system said.
        cause: io::Error,
    },
    /// The file as a whole is none.
    #[error("{label}: {why}")]
    Whole {
        /// The file.
        label: String,
        /// What was expected.
        why: String,
    },
    /// A line.
    #[error("{label}:{line}: {why}")]
    Line {
        /// The file.
        label: String,
        /// The line, from 1.
        line: usize,
        /// What was found, and expected.
        why: String,
    },
    /// A cell.
    #[error("{label}:{line}: {column} = {got}: {expected}")]
    Cell {
        /// The file.
        label: String,
        /// The line, from 1.
        line: usize,
        /// The column, as the file calls it.
        column: String,
        /// What stands there.
        got: String,
        /// What was expected.
        expected: String,
    },
    /// An option.
    #[error("{option} = {got}: {expected}")]
    Option {
        /// Which.
        option: &'static str,
        /// What it is.
        got: String,
        /// What it may be.
        expected: String,
    },
    /// Too few heard packets, or all from one place.
    #[error(
        "{label}: {heard} packets heard at {places} places: expected at least {least} at {least_places} places or more"
    )]
    TooFew {
        /// The file.
        label: String,
        /// How many packets have a loss.
        heard: usize,
        /// At how many places.
        places: usize,
        /// How many it takes.
        least: usize,
        /// At how many places.
        least_places: usize,
    },
    /// The likelihood has no number anywhere.
    #[error(
        "{label}: the likelihood of these losses is no number anywhere; are they in dB, and distances in metres?"
    )]
    NoLikelihood {
        /// The file.
        label: String,
    },
}
