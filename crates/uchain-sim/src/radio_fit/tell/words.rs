//! A fit in words, and as a table `[radio]`.

use std::fmt::Write as _;

use crate::radio_fit::{Fit, Interval};

/// Links that are listed.
const LISTED: usize = 12;
/// A limit that is sharper than this is a step (dB).
const SOFT_DB: f64 = 0.2;

impl Interval {
    /// Its ends, with "or less" and "or more" where the data do not bound it.
    fn words(&self, decimals: usize) -> String {
        let Self { low, high, is_open_below, is_open_above, .. } = *self;
        match (is_open_below, is_open_above) {
            (true, true) => "not bounded".to_owned(),
            (true, false) => format!("{high:.decimals$} or less"),
            (false, true) => format!("{low:.decimals$} or more"),
            (false, false) => format!("{low:.decimals$} to {high:.decimals$}"),
        }
    }
}

impl Fit {
    /// Everything in words.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let [near_m, far_m] = self.distance_m;
        let packets = &self.packets;
        let s = if self.links.len() == 1 { "" } else { "s" };
        // Writing to a String cannot fail, here and below.
        let _ = writeln!(
            text,
            "{}: {} packets heard of {}, {} link{s}, {} places, {near_m:.2} to {far_m:.2} m apart",
            self.log,
            packets.heard,
            packets.sent,
            self.links.len(),
            self.places
        );
        let mut row = |name: &str, of: &Interval, unit: &str, decimals: usize| {
            let unit = format!("{unit:<3}");
            let _ =
                writeln!(text, "  {name:<26}{:>8.decimals$} {unit} (95 %: {})", of.value, of.words(decimals));
        };
        row(&format!("loss at {} m, L0", self.reference_m), &self.reference_loss_db, "dB", 1);
        row("exponent, alpha", &self.alpha, "", 2);
        row("noise, new every time", &self.sigma_db, "dB", 2);
        row("shadowing that stays", &self.sigma_static_db, "dB", 2);
        row("correlation length", &self.correlation_m, "m", 2);
        let _ = writeln!(
            text,
            "  {:.0} % of the variance stays with the place; least squares would claim an exponent of {:.2} ({})",
            100.0 * self.static_share,
            self.least_squares.alpha.value,
            self.least_squares.alpha.words(2)
        );
        match (packets.limit_db, packets.width_db) {
            (Some(limit_db), Some(width_db)) => {
                let _ = writeln!(
                    text,
                    "  half of the packets are lost at {limit_db:.1} dB (12 to 88 % within {:.1} dB), and {:.1} % by chance",
                    4.0 * width_db,
                    100.0 * packets.random
                );
            }
            _ if packets.heard < packets.sent => {
                let _ = writeln!(text, "  {:.1} % of the packets are lost by chance", 100.0 * packets.random);
            }
            _ => {}
        }
        for rate in &packets.rates {
            let _ = writeln!(
                text,
                "    at {:>5.1} dB {:>5.1} % of {} packets lost (95 %: {:.1} to {:.1})",
                rate.loss_db,
                100.0 * rate.per,
                rate.sent,
                100.0 * rate.low,
                100.0 * rate.high
            );
        }
        if self.exponents.len() > 1 {
            for one in self.exponents.iter().take(LISTED) {
                let _ = writeln!(
                    text,
                    "  link {:<12} exponent {:>5.2} (95 %: {}), least squares {:.2}, {} packets",
                    one.link,
                    one.alpha.value,
                    one.alpha.words(2),
                    one.least_squares,
                    one.heard
                );
            }
            if self.exponents.len() > LISTED {
                let _ = writeln!(text, "  … and {} links more", self.exponents.len() - LISTED);
            }
        }
        for note in &self.notes {
            let _ = writeln!(text, "note: {note}");
        }
        for warning in &self.warnings {
            let _ = writeln!(text, "warning: {warning}");
        }
        for refusal in &self.refusals {
            let _ = writeln!(text, "refused: {refusal}");
        }
        if let Some(toml) = self.radio_toml() {
            let _ = write!(text, "\n{toml}");
        }
        text
    }

    /// Values of `[radio]` and `[packets]`, as `key=value` for `--set`; none where the data do not support a fit.
    pub fn sets(&self) -> Vec<String> {
        let keys = self.keys();
        keys.into_iter().map(|(table, key, value, _)| format!("{table}.{key}={value:?}")).collect()
    }

    fn keys(&self) -> Vec<(&'static str, &'static str, f64, String)> {
        if !self.refusals.is_empty() {
            return Vec::new();
        }
        let round = |value: f64| (value * 1000.0).round() / 1000.0;
        let about = |of: &Interval, decimals: usize| format!("95 %: {}", of.words(decimals));
        let mut keys = vec![
            ("radio", "reference_m", self.reference_m, String::new()),
            (
                "radio",
                "reference_loss_db",
                round(self.reference_loss_db.value),
                about(&self.reference_loss_db, 1),
            ),
            ("radio", "alpha_free", round(self.alpha.value), about(&self.alpha, 2)),
        ];
        if self.has_static() {
            keys.extend([
                ("radio", "sigma_db", round(self.sigma_db.value), about(&self.sigma_db, 2)),
                (
                    "radio",
                    "sigma_static_db",
                    round(self.sigma_static_db.value),
                    about(&self.sigma_static_db, 2),
                ),
                ("radio", "correlation_m", round(self.correlation_m.value), about(&self.correlation_m, 2)),
            ]);
        } else {
            let sigma_db = libm::hypot(self.sigma_db.value, self.sigma_static_db.value);
            keys.push(("radio", "sigma_db", round(sigma_db), "all of it as noise".to_owned()));
        }
        if let Some(limit_db) = self.packets.limit_db {
            keys.push((
                "packets",
                "limit_db",
                round(limit_db),
                "half of the packets are lost there".to_owned(),
            ));
            if let Some(soft_db) = self.packets.width_db.filter(|width_db| *width_db >= SOFT_DB) {
                keys.push(("packets", "soft_db", round(soft_db), String::new()));
            }
            keys.push(("packets", "drop_rate", round(self.packets.random), "whatever the loss".to_owned()));
        } else if self.packets.heard < self.packets.sent {
            keys.push(("packets", "drop_rate", round(self.packets.random), "whatever the loss".to_owned()));
        }
        keys
    }

    /// The tables `[radio]` and, where packets were lost, `[packets]`, ready for a scenario; `None` where the data do not
    /// support a fit.
    pub fn radio_toml(&self) -> Option<String> {
        let keys = self.keys();
        let mut text = String::new();
        let mut open = "";
        for (table, key, value, about) in &keys {
            if open != *table {
                let _ = writeln!(text, "[{table}]");
                open = table;
            }
            let line = format!("{key} = {value:?}");
            let line = if about.is_empty() { line } else { format!("{line:<30}# {about}") };
            let _ = writeln!(text, "{line}");
        }
        (!keys.is_empty()).then_some(text)
    }
}
