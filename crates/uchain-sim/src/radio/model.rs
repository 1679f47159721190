//! What a link loses, noise off: the question that a run, the optimum, a plan and a note ask alike.

use std::{fmt::Debug, sync::Arc};

use glam::Vec2;

use super::{
    Disc, LossTable, MultiWall, PathLoss, RadioParams, Slopes, TableError, Visibility, around::around,
};
use crate::{
    map::{Map, MapError},
    seed::Seed,
};

/// Loss of a link that carries nothing (dB): beyond every `packets.limit_db`, whatever noise takes off it, and a number
/// like any other for charts and files.
pub const NO_LINK_DB: f32 = 2_000.0;

/// A loss as a number: what is none carries nothing.
pub(crate) fn finite_db(loss_db: f32) -> f32 {
    if loss_db.is_finite() { loss_db } else { NO_LINK_DB }
}

/// One end of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Antenna {
    /// Place (m).
    pub at: Vec2,
    /// Direction of the body that carries it (rad); `None` for the base station, which has no rotors.
    pub heading_rad: Option<f32>,
    /// Whether it stands on the floor: `radio.ground_db`.
    pub on_ground: bool,
    /// Which robot carries it; `None` for the base station, and for one that nobody carries yet, such as a planned one.
    pub carrier: Option<u16>,
    /// Way that it has been carried forward so far, backward taken off (m): what an odometer shows. `None` without one.
    pub odometer_m: Option<f32>,
}

impl Antenna {
    /// That of a robot in the air.
    pub fn flying(at: Vec2, heading_rad: f32) -> Self {
        Self { heading_rad: Some(heading_rad), ..at.into() }
    }

    /// The same of a robot with a number.
    #[must_use]
    pub fn carried_by(self, carrier: u16) -> Self {
        Self { carrier: Some(carrier), ..self }
    }

    /// The same with an odometer that shows so much (m).
    #[must_use]
    pub fn carried_forward(self, odometer_m: f32) -> Self {
        Self { odometer_m: Some(odometer_m), ..self }
    }

    /// The same on the floor, if it is.
    #[must_use]
    pub fn on_ground(self, on_ground: bool) -> Self {
        Self { on_ground, ..self }
    }
}

impl From<Vec2> for Antenna {
    /// An antenna without direction, above the floor.
    fn from(at: Vec2) -> Self {
        Self { at, heading_rad: None, on_ground: false, carrier: None, odometer_m: None }
    }
}

/// How much a link loses between two places in a map. It knows no time: equal places lose equally, in a run, in the optimum
/// it is measured by and, but for [`RadioModel::seeded`], in a plan. What is heard of a packet is up to a [`Channel`](super::Channel).
///
/// ```
/// use std::sync::Arc;
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, map::Map, mission::chain::{Course, plan}, radio::{Antenna, RadioModel}};
///
/// /// Half a decibel a centimetre, through whatever there is.
/// #[derive(Debug)]
/// struct Linear;
///
/// impl RadioModel for Linear {
///     fn loss_db(&self, _: &Map, from: &Antenna, to: &Antenna) -> f32 {
///         35.0 + 5.0 * from.at.distance(to.at)
///     }
/// }
///
/// let straight = Course::read(&builtin("straight").unwrap(), &[]).unwrap();
/// let course = straight.with_radio("linear", Arc::new(Linear));
/// // 60 dB are 5 m: two relays within 13.5 m, and the head.
/// assert_eq!(plan(&course, None, 1.0, None).unwrap().uavs_needed, Some(3));
/// ```
pub trait RadioModel: Debug + Send + Sync {
    /// Loss between two antennas (dB), the same both ways. [`NO_LINK_DB`] where nothing is heard; what is not finite
    /// counts as that.
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32;

    /// What a link over a straight distance (m) loses at best (dB), whatever the map and the antennas' directions: no more
    /// than [`Self::loss_db`] of any two antennas so far apart, to the last bit, and not falling with the distance. Searches
    /// skip what it rules out, and tunnels of kilometres are planned by it. Minus infinity: nobody knows.
    fn least_loss_db(&self, _apart_m: f32) -> f32 {
        f32::NEG_INFINITY
    }

    /// What names the losses: models of equal keys lose the same in equal maps, so that runs of a sweep share what takes
    /// long to work out, the table of the optimum. It begins with the model's name and holds all parameters. `None`:
    /// nothing is shared.
    fn key(&self) -> Option<String> {
        None
    }

    /// Whether a loss takes a search through the map, hundreds of times the work of a formula: tables of losses are then
    /// drawn on fewer samples.
    fn is_costly(&self) -> bool {
        false
    }

    /// The model of one run, where a loss depends on its seed, such as a shadow that stays in place: the run asks it, and so
    /// does the optimum that the run is measured by; a plan asks the model itself, which knows no seed. `None`: no loss does.
    /// A model that was made of another one in this way gives that of another seed just so.
    fn seeded(&self, _seed: Seed) -> Option<Arc<dyn RadioModel>> {
        None
    }
}

/// Makes a model of what the table `[radio]` says, for one map.
pub type MakeRadio = fn(&RadioParams, &Map) -> Result<Arc<dyn RadioModel>, RadioError>;

/// A model that a scenario may name.
///
/// ```
/// use std::sync::Arc;
/// use uchain_sim::{
///     config::builtin,
///     map::Map,
///     mission::{Scene as _, chain::{ChainExtensions, Course}},
///     radio::{Antenna, RadioKind, RadioModel},
///     registry::{AnyMission, Of, Registry},
/// };
///
/// /// So much a metre, through whatever there is.
/// #[derive(Debug)]
/// struct Linear { db_per_m: f32 }
///
/// impl RadioModel for Linear {
///     fn loss_db(&self, _: &Map, from: &Antenna, to: &Antenna) -> f32 {
///         35.0 + self.db_per_m * from.at.distance(to.at)
///     }
/// }
///
/// const LINEAR: RadioKind = RadioKind::new("linear", "So much a metre.", |table, _| {
///     Ok(Arc::new(Linear { db_per_m: 2.5 * table.alpha_free }))
/// });
/// static MISSIONS: [&dyn AnyMission; 1] =
///     [&Of::<Course>::with(ChainExtensions { radios: &[LINEAR], ..Course::BUILTIN })];
/// let sets = ["radio.model=linear".to_owned()];
/// assert!(Registry::new(&MISSIONS).read(&builtin("corner").unwrap(), &sets).is_ok());
/// assert!(Registry::default().read(&builtin("corner").unwrap(), &sets).is_err());
/// ```
#[derive(Debug, Clone, Copy)]
pub struct RadioKind {
    word: &'static str,
    meaning: &'static str,
    make: MakeRadio,
}

impl RadioKind {
    /// The models that every program has.
    pub const BUILTIN: [Self; 8] = {
        let [log_distance, p1238, two_slope] = Slopes::KINDS;
        [
            PathLoss::KIND,
            Disc::KIND,
            log_distance,
            MultiWall::KIND,
            p1238,
            LossTable::KIND,
            two_slope,
            Visibility::KIND,
        ]
    };

    /// A model by its word in a scenario and what it means in a sentence, for `uchain explain` and editors.
    pub const fn new(word: &'static str, meaning: &'static str, make: MakeRadio) -> Self {
        Self { word, meaning, make }
    }

    /// Its word in a scenario.
    pub const fn word(&self) -> &'static str {
        self.word
    }

    /// What it means.
    pub const fn meaning(&self) -> &'static str {
        self.meaning
    }

    /// The model for one map, as the table `[radio]` has it, with what else the table asks for around it.
    ///
    /// # Errors
    /// What the model cannot do with the table or the map.
    pub fn make(&self, params: &RadioParams, map: &Map) -> Result<Arc<dyn RadioModel>, RadioError> {
        (self.make)(params, map).map(|model| around(params, model))
    }
}

/// Why there is no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RadioError {
    /// The map does not have what the model asks of it.
    #[error("radio.{key}: {cause}")]
    Map {
        /// The key of `[radio]` that asks for it.
        key: &'static str,
        /// What the map said.
        cause: MapError,
    },
    /// `radio.table_file` is no table of losses.
    #[error("radio.table_file: {file}: {cause}")]
    Table {
        /// The file.
        file: String,
        /// What is wrong with it, and where.
        cause: TableError,
    },
    /// A value of `[radio]` that the model cannot take.
    #[error("radio.{key} = {got}: {expected}")]
    Value {
        /// The key of `[radio]`.
        key: &'static str,
        /// What it is.
        got: String,
        /// What it may be.
        expected: String,
    },
}
