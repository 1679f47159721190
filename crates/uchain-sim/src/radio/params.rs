//! The table `[radio]`: which model, and what it goes by.

use uchain_core::params::OutOfRange;

#[cfg(feature = "schema")]
use super::RadioKind;
use super::{Disc, LossTable, MultiWall, PathLoss, Slopes, Visibility};

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

/// By which law a measured loss differs from the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Fading {
    /// White noise in dB, of `sigma_db`.
    #[default]
    White,
    /// A steady part and a scattered one of `rician_k_db`, drawn anew for every packet.
    Rician,
}

/// By what the way through the tunnel between two UAVs is known, for `detour_db_per_m`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Detour {
    /// The shortest way through the map.
    #[default]
    Geodesic,
    /// The difference of what both have flown forward: it drifts with every step sideways and every corner cut short.
    /// The base's is 0, and so is a UAV's where it waits.
    Odometer,
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
        /// Range of the model "disc", and of others but "path-loss" that need none: no link is longer (m).
        /// - Symbol: `R_c`
        /// - Source: Kim 2021; 50 in Gazebo's RFComms
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
        /// By what the way through the tunnel is known: the shortest one, or the difference of two odometers. Antennas without
        /// one (a place in a picture) go by the shortest way.
        /// - Source: the authors' simulator ("odometer"); ours ("geodesic")
        pub detour: Detour = Detour::Geodesic;
        /// Loss of an antenna that sees its partner dead ahead, behind or abeam; none at ±45° and ±135° (dB).
        /// - Source: Laclau 2021, §6.1.2; the paper gives no number
        pub antenna_db: f32 = 0.0, in 0.0..=100.0;
        /// Whether every model loses `reference_loss_db` at `reference_m`. If not, "log-distance" and "visibility" lose 40 dB at
        /// 1 m as in Gazebo, "multi-wall" and "two-slope" what free space does, and "p1238" what its formula says;
        /// "path-loss" and "disc" have no other loss, and "table" always has those of its file.
        /// - Source: ours
        pub align: bool = true;
        /// Exponent of "log-distance" and "visibility", and that of "two-slope" near by (1).
        /// - Symbol: `n`
        /// - Equation: `loss = L0 + 10 n log10(max(d, d0) / d0)`
        /// - Source: Gazebo's RFComms and the SubT simulator (`fading_exponent`)
        pub exponent: f32 = 2.5, in 0.0..=20.0;
        /// Frequency (MHz), for what "p1238", "multi-wall" and "two-slope" lose at 1 m where nothing is aligned.
        /// - Symbol: `f`
        /// - Source: a Crazyradio's 2.4 GHz
        pub frequency_mhz: f32 = 2400.0, in 300.0..=100_000.0;
        /// Distance power loss coefficient of "p1238", in dB a decade (1): of 1.8 to 2 GHz 28 in homes, 30 in offices, 22 in shops; of
        /// 2.4 GHz 30 in offices.
        /// - Symbol: `N`
        /// - Equation: `loss = 20 log10 f + N log10 d + Lf(n) - 28`, no floor between: `Lf = 0`
        /// - Source: Recommendation ITU-R P.1238-7 (2012), Eq. 1 and Table 2
        pub p1238_n: f32 = 30.0, in 0.0..=200.0;
        /// Where the slope of "two-slope" changes (m).
        /// - Symbol: `d_b`
        /// - Equation: `loss = L0 + 10 n log10(d_b / d0) + 10 n_far log10(d / d_b)` beyond
        /// - Source: the shape: Zhang 2003 (free space near by, a waveguide beyond); the value is ours
        pub break_m: f32 = 20.0, in 0.001..=100_000.0;
        /// Exponent of "two-slope" beyond `break_m` (1).
        /// - Symbol: `n_far`
        /// - Source: ours
        pub exponent_far: f32 = 1.2, in 0.0..=20.0;
        /// What a light wall takes of "multi-wall", where the map does not say (dB).
        /// - Symbol: `L_w1`
        /// - Equation: `loss = L_free + Σ k_i L_wi`
        /// - Source: COST 231, final report, 4.7.2
        pub wall_light_db: f32 = 3.4, in 0.0..=100.0;
        /// What a heavy wall, or one of unknown material, takes of "multi-wall", where the map does not say (dB).
        /// - Symbol: `L_w2`
        /// - Equation: `loss = L_free + Σ k_i L_wi`
        /// - Source: COST 231, final report, 4.7.2
        pub wall_heavy_db: f32 = 6.9, in 0.0..=100.0;
        /// By how much the exponent of "visibility" grows for each unit of cost (1).
        /// - Source: the SubT simulator (`visibilityCostToFadingExponent`)
        pub exponent_per_cost: f32 = 0.2, in 0.0..=20.0;
        /// Greatest cost over which "visibility" has a link (1).
        /// - Source: the SubT simulator (`commsCostMax`)
        pub cost_max: u32 = 15, in 0..=254;
        /// File of the model "table": losses between the places of a regular grid, in the frame of the map, as CSV with the
        /// columns x1_m, y1_m, x2_m, y2_m and loss_db, or as NPZ with the arrays x_m (n), y_m (m) and loss_db (m, n, m, n). A
        /// path starts at the folder of the scenario.
        /// - Source: ours; the losses are whoever's made the file
        #[serde(skip_serializing_if = "Option::is_none")]
        pub table_file: Option<String> = None;
        /// Standard deviation of a measured loss (dB).
        /// - Symbol: `σ`
        /// - Equation: `measured loss = loss + N(0, σ²)`
        /// - Source: the authors' simulator; Laclau 2021, §6.1.2 prints a variance of 3
        pub sigma_db: f32 = 3.0, in 0.0..=50.0;
        /// By which law a measured loss differs from the true one.
        /// - Source: Laclau 2021, §6.1.2 (white)
        pub fading: Fading = Fading::White;
        /// Power of the steady part over that of the scattered one, with fading "rician" (dB); far below 0 it is Rayleigh's.
        /// - Symbol: `K`
        /// - Equation: `measured loss = loss - 10 log10 |h|²`, `E |h|² = 1`
        /// - Source: Rice 1945; the value is ours
        pub rician_k_db: f32 = 6.0, in -100.0..=60.0;
        /// Steps of a reading (dB); none if 0.
        /// - Source: 1 dB of radios such as the nRF51822 and the nRF24
        pub quantum_db: f32 = 0.0, in 0.0..=20.0;
        /// Least loss that a receiver reads, where it is saturated (dB); none if left out.
        /// - Source: ours
        #[serde(skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = -50.0, max = 1000.0))]
        pub least_reading_db: Option<f32> = None;
        /// Standard deviation over receivers of what each reads too much, at all times (dB); what arrives does not hang on it.
        /// - Source: ours
        pub reading_offset_db: f32 = 0.0, in 0.0..=30.0;
        /// Standard deviation over UAVs of what the antenna of each loses more than the others', at all times, both ways (dB),
        /// cut at three of them.
        /// - Source: ours
        pub antenna_offset_db: f32 = 0.0, in 0.0..=30.0;
        /// Standard deviation of the loss of a UAV that turns in place: every antenna has a pattern of its own about its body,
        /// with three lobes at most (dB).
        /// - Source: ours
        pub yaw_db: f32 = 0.0, in 0.0..=30.0;
        /// Standard deviation of what stays in place of fading (dB): a loss of its own for every pair of places, the same both
        /// ways and at all times, drawn by the seed of the run and cut at four standard deviations.
        /// - Symbol: `σ_X`
        /// - Equation: `loss = … + X(p, q)`, `E X(p, q) X(p', q') = σ_X² exp(-(|p - p'| + |q - q'|) / c)`
        /// - Source: Gudmundson 1991, at both ends
        pub sigma_static_db: f32 = 0.0, in 0.0..=30.0;
        /// Way on which what stays in place falls to 1/e of itself, with `sigma_static_db` (m).
        /// - Symbol: `c`
        /// - Source: ours, between 0.21 m (Agrawal & Patwari 2009) and 6 m (3GPP TR 38.901, Table 7.5-6, indoor office without
        ///   line of sight)
        pub correlation_m: f32 = 2.0, in 0.01..=1000.0;
        /// Seed of what stays in place, the same for all runs and known to a plan; that of the run, and unknown to a plan, if
        /// left out.
        /// - Source: ours
        #[serde(skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = 4_294_967_295.0))]
        pub shadowing_seed: Option<u64> = None;
        /// Loss of an antenna that stands on the floor, such as that of a UAV that waits (dB).
        /// - Source: ours
        pub ground_db: f32 = 0.0, in 0.0..=100.0;
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

    /// The first value outside its range, those that may be left out included where they are written.
    ///
    /// # Errors
    /// [`OutOfRange`] names the field, what it is and what it may be.
    pub fn check_all(&self) -> Result<(), OutOfRange> {
        self.check()?;
        let [low, high] = Self::RANGE_M;
        let [least, most] = [-50.0, 1000.0];
        if let Some(got) = self.least_reading_db.map(f64::from).filter(|got| !(least..=most).contains(got)) {
            return Err(OutOfRange { key: "least_reading_db", got, low: least, high: most });
        }
        if let Some(got) = self.shadowing_seed.filter(|seed| *seed > u64::from(u32::MAX)) {
            let high = f64::from(u32::MAX);
            return Err(OutOfRange { key: "shadowing_seed", got: got as f64, low: 0.0, high });
        }
        match self.range_m {
            Some(range_m) if !(low as f32..=high as f32).contains(&range_m) => {
                Err(OutOfRange { key: "range_m", got: range_m.into(), low, high })
            }
            _ => Ok(()),
        }
    }

    /// Where a model's loss is known (m), and which it is (dB): at the reference, or its own at a metre.
    pub(super) fn known(&self, at_a_metre_db: f32) -> (f32, f32) {
        if self.align { (self.reference_m, self.reference_loss_db) } else { (1.0, at_a_metre_db) }
    }

    /// `20 log10(4π f / c)` (dB).
    pub(super) fn free_space_at_a_metre_db(&self) -> f32 {
        20.0 * libm::log10f(self.frequency_mhz) - 27.552
    }

    /// What one should know of the table before a start: values that the model does not go by.
    pub fn note(&self) -> Option<String> {
        if let Some(range_m) = self.range_m.filter(|_| is_path_loss(&self.model)) {
            return Some(format!(
                "radio.range_m = {range_m}: the model \"{}\" has no range; try --set radio.model=disc",
                PathLoss::WORD
            ));
        }
        let model = self.model.as_str();
        let own: &[&str] = match model {
            PathLoss::WORD => {
                &["shadowing", "alpha_free", "alpha_wall", "alpha_step", "detour_db_per_m", "antenna_db"]
            }
            Disc::WORD => &[],
            Slopes::LOG_DISTANCE => &["align", "exponent"],
            Slopes::P1238 => &["align", "frequency_mhz", "p1238_n"],
            Slopes::TWO_SLOPE => &["align", "exponent", "frequency_mhz", "break_m", "exponent_far"],
            MultiWall::WORD => &["align", "frequency_mhz", "wall_light_db", "wall_heavy_db"],
            LossTable::WORD => &["table_file"],
            Visibility::WORD => &["align", "exponent", "exponent_per_cost", "cost_max"],
            // What a model of a program's own goes by is its own business.
            _ => return None,
        };
        let (p, by_default) = (self, Self::default());
        let other = [
            ("shadowing", p.shadowing != by_default.shadowing),
            ("alpha_free", p.alpha_free != by_default.alpha_free),
            ("alpha_wall", p.alpha_wall != by_default.alpha_wall),
            ("alpha_step", p.alpha_step != by_default.alpha_step),
            ("detour_db_per_m", p.detour_db_per_m != by_default.detour_db_per_m),
            ("antenna_db", p.antenna_db != by_default.antenna_db),
            ("align", p.align != by_default.align),
            ("exponent", p.exponent != by_default.exponent),
            ("frequency_mhz", p.frequency_mhz != by_default.frequency_mhz),
            ("p1238_n", p.p1238_n != by_default.p1238_n),
            ("break_m", p.break_m != by_default.break_m),
            ("exponent_far", p.exponent_far != by_default.exponent_far),
            ("wall_light_db", p.wall_light_db != by_default.wall_light_db),
            ("wall_heavy_db", p.wall_heavy_db != by_default.wall_heavy_db),
            ("exponent_per_cost", p.exponent_per_cost != by_default.exponent_per_cost),
            ("cost_max", p.cost_max != by_default.cost_max),
            ("table_file", p.table_file.is_some()),
        ];
        let unused = other.iter().filter(|(key, is_set)| *is_set && !own.contains(key));
        let unused: Vec<String> = unused.map(|(key, _)| format!("radio.{key}")).collect();
        (!unused.is_empty())
            .then(|| format!("{}: the model \"{model}\" does not go by it", unused.join(", ")))
    }
}
