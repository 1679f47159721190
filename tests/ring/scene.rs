//! A scenario of a ring: its keys, its checks, and the room it is laid out in.

use std::sync::Arc;

use glam::Vec2;
use serde::{Deserialize, Serialize};
use uchain_core::params::Key;
use uchain_sim::{
    config::{
        Check, ConfigError, Document, Heading, Keys, MapConfig,
        help::{schema_of, schema_with_table},
    },
    map::Map,
    mission::Scene,
    scene::lay_map,
    world::Waypoint,
};

use super::{Ring, Z_M};

uchain_core::params! {
    /// Robots that fly round a ring.
    #[derive(Serialize, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct RingConfig {
        /// Robots.
        /// - Source: ours
        pub robots: u16 = 3, in 2..=100;
        /// Radius of the ring (m).
        /// - Source: ours
        pub radius_m: f32 = 1.0, in 0.2..=100.0;
        /// Speed over ground (m/s).
        /// - Source: ours
        pub speed_mps: f32 = 0.5, in 0.01..=20.0;
    }
}

/// The table that makes a scenario one of a ring.
const RING: Key = Key { name: "ring", range: None, doc: "Robots that fly round a ring." };

/// The file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    #[serde(default)]
    description: String,
    duration_s: f64,
    map: MapConfig,
    ring: RingConfig,
}

/// A ring laid out in its room.
#[derive(Debug)]
pub(crate) struct RingScene {
    heading: Heading,
    pub(crate) ring: RingConfig,
    pub(super) duration_s: f64,
    pub(super) map: Arc<Map>,
    middle: Vec2,
}

impl RingScene {
    /// The direction of a place from the middle of the ring (rad).
    pub(super) fn angle_rad(&self, at: Vec2) -> f32 {
        let from_middle = at - self.middle;
        libm::atan2f(from_middle.y, from_middle.x)
    }

    /// The place on the ring in this direction, along the ring.
    pub(super) fn on_ring(&self, angle_rad: f32) -> Waypoint {
        let (sin, cos) = libm::sincosf(angle_rad);
        let at = self.middle + self.ring.radius_m * Vec2::new(cos, sin);
        Waypoint { at, z_m: Z_M, heading_rad: angle_rad + core::f32::consts::FRAC_PI_2 }
    }

    fn checked(document: &Document<'_>) -> Result<(Heading, RingConfig), ConfigError> {
        let File { name, description, duration_s, map, ring } = document.values()?;
        let heading = Heading { name, description, duration_s, map };
        let check = Check { document };
        check.heading(&heading)?;
        check.ranged(RING.name, ring.check())?;
        Ok((heading, ring))
    }
}

impl Scene for RingScene {
    type Mission = Ring;
    type Shared = ();
    type Extensions = ();
    const BUILTIN: () = ();
    const KIND: &'static str = "a ring";
    const ROBOT: &'static str = "robot";
    const KEYS: &'static Keys = &Keys {
        marker: Some(RING.name),
        tables: &[("", &[RING]), (RING.name, RingConfig::KEYS)],
        renamed: &[],
    };

    fn schema((): ()) -> serde_json::Value {
        schema_with_table(&RING, [schema_of::<RingConfig>()])
    }

    fn describe(document: &Document<'_>, (): ()) -> Result<[String; 2], ConfigError> {
        Self::checked(document).map(|(heading, _)| [heading.name, heading.description])
    }

    fn takes(document: &Document<'_>, (): ()) -> bool {
        document.values::<File>().is_ok()
    }

    fn lay(document: &Document<'_>, map: Option<Map>, (): &(), (): ()) -> Result<Arc<Self>, ConfigError> {
        let (heading, ring) = Self::checked(document)?;
        let map = match map {
            Some(map) => map,
            None => lay_map(&heading.map, [0.0; 2], document)?.0,
        };
        let (low, high) = map.bounds();
        let middle = low.midpoint(high);
        let room_m = map.clearance_m(middle);
        if map.in_rock(middle) || room_m < ring.radius_m + 0.1 {
            let expected = format!("must leave 0.1 m to walls: the middle is {room_m:.3} m from the nearest");
            return Err(document.invalid("ring.radius_m", &ring.radius_m.to_string(), expected));
        }
        Ok(Arc::new(Self { duration_s: heading.duration_s, heading, ring, map: Arc::new(map), middle }))
    }

    fn name(&self) -> &str {
        &self.heading.name
    }

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn crew(&self) -> usize {
        self.ring.robots.into()
    }

    fn map(&self) -> &Arc<Map> {
        &self.map
    }

    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    fn to_toml(&self) -> Result<String, toml::ser::Error> {
        let Heading { name, description, duration_s, map } = self.heading.clone();
        toml::to_string(&File { name, description, duration_s, map, ring: self.ring.clone() })
    }
}
