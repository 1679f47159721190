//! From a data sheet to the limit of a link: transmit power, antennas and receiver give the path loss that a link may have.
//!
//! Everything here is path loss: what is lost between two antennas. The authors' `radio.reference_loss_db = 35` is a reading of
//! received power (its sign turned round) at 0.25 m, with their transmitter in it; a budget puts the free-space loss in its place,
//! and never mixes the two.

mod read;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use uchain_core::chain::{LinkParams, TakeoffParams};

use super::{PacketParams, RadioParams};

pub use read::BudgetError;

/// Speed of light (m/s).
const LIGHT_MPS: f64 = 299_792_458.0;

uchain_core::params! {
    /// What a radio sends and what it hears.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct LinkBudget {
        /// Transmit power (dBm).
        pub tx_dbm: f64, in -100.0..=60.0;
        /// Gain of the antenna that sends (dBi).
        #[serde(default)]
        pub tx_gain_dbi: f64, in -40.0..=40.0;
        /// Gain of the antenna that hears (dBi).
        #[serde(default)]
        pub rx_gain_dbi: f64, in -40.0..=40.0;
        /// Weakest power that the receiver still reads (dBm).
        pub sensitivity_dbm: f64, in -150.0..=0.0;
        /// Margin kept for fading (dB).
        /// - Source: ours
        #[serde(default = "default_margin_db")]
        pub margin_db: f64, in 0.0..=100.0;
        /// Carrier frequency (MHz).
        /// - Source: ours
        #[serde(default = "default_frequency_mhz")]
        pub frequency_mhz: f64, in 1.0..=300_000.0;
    }
}

fn default_margin_db() -> f64 {
    10.0
}

fn default_frequency_mhz() -> f64 {
    2450.0
}

impl LinkBudget {
    /// A Crazyflie at 2 Mbit/s: the nRF51822 at 0 dBm with −85 dBm sensitivity at that rate (its product specification), chip
    /// antennas of 0 dBi, and 20 dB of margin, so that relays turn round before a link is lost. A power amplifier, which some
    /// boards have, is left out: the budget is one that no board falls short of for want of it.
    pub const CRAZYFLIE: Self = Self {
        tx_dbm: 0.0,
        tx_gain_dbi: 0.0,
        rx_gain_dbi: 0.0,
        sensitivity_dbm: -85.0,
        margin_db: 20.0,
        frequency_mhz: 2450.0,
    };

    /// Power that is received over a path loss (dBm).
    pub fn received_dbm(&self, loss_db: f64) -> f64 {
        self.tx_dbm + self.tx_gain_dbi + self.rx_gain_dbi - loss_db
    }

    /// Path loss at which the receiver hears nothing more (dB).
    pub fn loss_at_sensitivity_db(&self) -> f64 {
        self.received_dbm(0.0) - self.sensitivity_dbm
    }

    /// Path loss that a link may have, the margin kept (dB).
    pub fn most_loss_db(&self) -> f64 {
        self.loss_at_sensitivity_db() - self.margin_db
    }

    /// Loss of free space at a distance (dB): `20 log10(4 π d f / c)` (Friis 1946).
    ///
    /// ```
    /// use uchain_sim::radio::LinkBudget;
    /// let at_a_metre_db = LinkBudget::CRAZYFLIE.free_space_db(1.0);
    /// assert!((at_a_metre_db - 40.2).abs() < 0.05);
    /// ```
    pub fn free_space_db(&self, distance_m: f64) -> f64 {
        20.0 * libm::log10(4.0 * PI * distance_m * self.frequency_mhz * 1e6 / LIGHT_MPS)
    }

    /// What it comes to in a scenario that says so much of radio and thresholds.
    pub fn applied(
        &self,
        radio: &RadioParams,
        takeoff: &TakeoffParams,
        link: &LinkParams,
        packets: &PacketParams,
    ) -> Budgeted {
        let s_min_db = self.most_loss_db();
        let moved_db = |threshold_db: f32| f64::from(threshold_db) - f64::from(takeoff.s_min_db) + s_min_db;
        let overrides = [
            ("link.head_stop_db", "the head stops", link.head_stop_db),
            ("link.head_back_db", "the head flies back", link.head_back_db),
            ("link.relay_back_db", "a relay flies back", link.relay_back_db),
        ]
        .map(|(key, what, threshold_db)| (key, what, moved_db(threshold_db)));
        let limit_db = if f64::from(packets.limit_db) > f64::from(takeoff.s_min_db) {
            self.loss_at_sensitivity_db()
        } else {
            moved_db(packets.limit_db)
        };
        let mut thresholds = vec![("takeoff.s_min_db", "no link is to lose more", s_min_db)];
        thresholds.extend(overrides);
        thresholds.push(("packets.limit_db", "nothing more is heard", limit_db));
        let threshold = |(key, what, loss_db): (&'static str, &'static str, f64)| Threshold {
            key,
            what,
            loss_db: tenth(loss_db),
            received_dbm: tenth(self.received_dbm(loss_db)),
            above_sensitivity_db: tenth(self.received_dbm(loss_db) - self.sensitivity_dbm),
        };
        Budgeted {
            budget: *self,
            reference_m: f64::from(radio.reference_m),
            reference_loss_db: tenth(self.free_space_db(f64::from(radio.reference_m))),
            thresholds: thresholds.into_iter().map(threshold).collect(),
        }
    }
}

/// To a tenth of a decibel: nobody knows a radio better.
fn tenth(value_db: f64) -> f64 {
    (10.0 * value_db).round() / 10.0
}

/// A budget as it stands in a scenario.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budgeted {
    /// What was given.
    #[serde(flatten)]
    pub budget: LinkBudget,
    /// `radio.reference_m` (m).
    pub reference_m: f64,
    /// The free-space loss there (dB): `radio.reference_loss_db`.
    pub reference_loss_db: f64,
    /// Every threshold, from good to bad.
    pub thresholds: Vec<Threshold>,
}

/// A threshold as path loss and as received power.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Threshold {
    /// Its key in a scenario.
    pub key: &'static str,
    /// What happens beyond it.
    pub what: &'static str,
    /// Path loss (dB).
    pub loss_db: f64,
    /// The power that is received there (dBm).
    pub received_dbm: f64,
    /// How much more that is than the receiver needs (dB); negative: it hears nothing any more.
    pub above_sensitivity_db: f64,
}

impl Budgeted {
    /// What it writes over the scenario, `key=value`.
    pub fn sets(&self) -> Vec<String> {
        let reference = ("radio.reference_loss_db", self.reference_loss_db);
        let thresholds = self.thresholds.iter().map(|threshold| (threshold.key, threshold.loss_db));
        std::iter::once(reference)
            .chain(thresholds)
            .map(|(key, value_db)| format!("{key}={value_db:?}"))
            .collect()
    }

    /// The thresholds below what the receiver hears.
    pub fn deaf(&self) -> impl Iterator<Item = &Threshold> {
        self.thresholds
            .iter()
            .filter(|threshold| threshold.above_sensitivity_db < 0.0 && threshold.key != "packets.limit_db")
    }
}
