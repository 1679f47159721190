//! The table `[radio]`: which model, and what it goes by.

use uchain_core::params::OutOfRange;

use super::PathLoss;
#[cfg(feature = "schema")]
use super::RadioKind;

/// How rock in the way raises the exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Shadowing {
    /// By the fraction of the segment inside rock.
    #[default]
    MeanExponent,
    /// By a step for every separate stretch of rock.
    WallCount,
}

uchain_core::params! {
    /// What a link loses. Model "path-loss": `loss = L0 + 10 α log10(max(d, d0) / d0)` (Laclau 2021, Eq. 22); "disc": L0
    /// within a range, and no link beyond.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct RadioParams {
        /// Which model.
        /// - Source: Laclau 2021, Eq. 22
        #[serde(skip_serializing_if = "is_path_loss")]
        #[schemars(schema_with = "words")]
        pub model: String = PathLoss::WORD.to_owned();
        /// Range of the model "disc" (m).
        /// - Symbol: `R_c`
        /// - Source: Kim 2021
        #[serde(skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.1, max = 1_000_000.0))]
        pub range_m: Option<f32> = None;
        /// Loss at the reference distance (dB).
        /// - Symbol: `L0`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: the authors' simulator; Laclau 2021, Eq. 22 omits it
        pub reference_loss_db: f32 = 35.0, in -50.0..=150.0;
        /// Reference distance (m); nearer antennas lose no less.
        /// - Symbol: `d0`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: the authors' simulator; Laclau 2021, Eq. 22 omits it
        pub reference_m: f32 = 0.25, in 0.001..=100.0;
        /// How rock in the way raises the exponent.
        /// - Source: Laclau 2021, §6.1.2
        pub shadowing: Shadowing = Shadowing::MeanExponent;
        /// Exponent where nothing stands in the way (1).
        /// - Symbol: `α`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: Laclau 2021, §6.1.2 (2 to 6); 2.5 in its Fig. 4A-C, 1.5 in Fig. 4D-F
        pub alpha_free: f32 = 2.0, in 0.0..=20.0;
        /// Exponent where the whole segment runs through rock; the largest exponent of "wall-count" (1).
        /// - Symbol: `α_wall`
        /// - Equation: `α = α_free + (α_wall - α_free) f`, f the fraction of the segment inside rock
        /// - Source: Laclau 2021, §6.1.2 (2 to 6); 4.0 in its Fig. 4
        pub alpha_wall: f32 = 6.0, in 0.0..=20.0;
        /// Step of the exponent for each stretch of rock, with "wall-count" (1).
        /// - Equation: `α = min(α_wall, α_free + step n)`, n the stretches of rock
        /// - Source: ours
        pub alpha_step: f32 = 2.0, in 0.0..=20.0;
        /// Loss per metre by which the way through the tunnel differs from the straight one (dB/m).
        /// - Equation: `loss = … + detour |tunnel distance - d|`
        /// - Source: the authors' simulator: 40 in Laclau 2021, Fig. 4D-F
        pub detour_db_per_m: f32 = 0.0, in 0.0..=1000.0;
        /// Loss of an antenna that sees its partner dead ahead, behind or abeam; none at ±45° and ±135° (dB).
        /// - Source: Laclau 2021, §6.1.2; the paper gives no number
        pub antenna_db: f32 = 0.0, in 0.0..=100.0;
        /// Standard deviation of a measured loss (dB).
        /// - Symbol: `σ`
        /// - Equation: `measured loss = loss + N(0, σ²)`
        /// - Source: the authors' simulator; Laclau 2021, §6.1.2 prints a variance of 3
        pub sigma_db: f32 = 3.0, in 0.0..=50.0;
    }
}

/// The words that every program has; a mission adds its own.
#[cfg(feature = "schema")]
fn words(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let words: Vec<_> = RadioKind::BUILTIN.iter().map(RadioKind::word_schema).collect();
    schemars::json_schema!({ "oneOf": words })
}

#[cfg(feature = "schema")]
impl RadioKind {
    fn word_schema(&self) -> serde_json::Value {
        serde_json::json!({ "type": "string", "const": self.word(), "description": self.meaning() })
    }

    /// Adds models of a program's own to what the schema of a table `[radio]` says of `model`.
    pub(crate) fn add_to_schema(own: &[Self], radio: &mut serde_json::Value) {
        if let Some(words) = radio["properties"]["model"]["oneOf"].as_array_mut() {
            words.extend(own.iter().map(Self::word_schema));
        }
    }
}

fn is_path_loss(model: &str) -> bool {
    model == PathLoss::WORD
}

impl RadioParams {
    /// Least and greatest range (m).
    pub(super) const RANGE_M: [f64; 2] = [0.1, 1_000_000.0];

    /// The first value outside its range, `range_m` included where it is written.
    ///
    /// # Errors
    /// [`OutOfRange`] names the field, what it is and what it may be.
    pub fn check_all(&self) -> Result<(), OutOfRange> {
        self.check()?;
        let [low, high] = Self::RANGE_M;
        match self.range_m {
            Some(range_m) if !(low as f32..=high as f32).contains(&range_m) => {
                Err(OutOfRange { key: "range_m", got: range_m.into(), low, high })
            }
            _ => Ok(()),
        }
    }

    /// What one should know of the table before a start: a range that the model does not go by.
    pub fn note(&self) -> Option<String> {
        let range_m = self.range_m.filter(|_| is_path_loss(&self.model))?;
        Some(format!(
            "radio.range_m = {range_m}: the model \"{}\" has no range; try --set radio.model=disc",
            PathLoss::WORD
        ))
    }
}
