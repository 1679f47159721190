//! Whether coordinates are degrees or metres, and how degrees become metres.

use geojson::{Feature, GeometryValue, JsonObject, Position};

use crate::map::{FRAME_MAX_M, Import, RemarkKind, import::metres_of_a_degree};

/// Largest extent of a map (m), hence of degrees that are meant (degrees): a map of 200 km.
const WIDEST_DEG: f64 = 2.0;

/// What a file's coordinates are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Frame {
    Metres,
    /// Longitude and latitude about a middle, and metres of a degree of each there.
    Degrees {
        middle_deg: [f64; 2],
        metres: [f64; 2],
    },
}

impl Frame {
    /// By the rule: metres are what a key, a member `units` or a `crs` says to be metres, and what lies beyond ±180 or ±90. All
    /// else is longitude and latitude (RFC 7946).
    pub(super) fn of(
        features: &[Feature],
        members: &JsonObject,
        metres: bool,
        import: &mut Import,
    ) -> Result<Self, String> {
        let mut box_deg = Bounds::default();
        for geometry in features.iter().filter_map(|feature| feature.geometry.as_ref()) {
            box_deg.take(&geometry.value);
        }
        let says_metres = metres || members.get("units").is_some_and(|units| units == "m");
        let [west, south, east, north] = [box_deg.low[0], box_deg.low[1], box_deg.high[0], box_deg.high[1]];
        let fits = west >= -180.0 && east <= 180.0 && south >= -90.0 && north <= 90.0;
        let why = if says_metres {
            "as the file or the key says"
        } else if let Some(name) = foreign_crs(members) {
            import.say(
                RemarkKind::Guessed,
                1,
                format!("unit: a crs is named ({name}), so coordinates are taken for metres"),
            );
            if let Some(about_deg) = about(members) {
                import.about_deg = Some(about_deg);
            }
            return Ok(Self::Metres);
        } else if !fits {
            "for they lie beyond ±180 or ±90"
        } else {
            if east - west > WIDEST_DEG || north - south > WIDEST_DEG {
                return Err(format!(
                    "it is {:.1} × {:.1} degrees large; expected a map of {WIDEST_DEG} at most: if its coordinates are metres, say \
                     `metres = true`",
                    east - west,
                    north - south
                ));
            }
            let middle_deg = [west.midpoint(east), south.midpoint(north)];
            let metres = metres_of_a_degree(middle_deg[1]);
            let [lon, lat] = middle_deg;
            let what = format!(
                "frame: degrees as metres about longitude {lon:.6}, latitude {lat:.6} (equirectangular, on the WGS 84 ellipsoid)"
            );
            import.say(RemarkKind::Guessed, 1, what);
            import.about_deg = Some(middle_deg);
            return Ok(Self::Degrees { middle_deg, metres });
        };
        import.say(RemarkKind::Read, 1, format!("frame: coordinates are metres, {why}"));
        import.about_deg = about(members);
        Ok(Self::Metres)
    }

    /// A position in metres.
    pub(super) fn place(&self, position: &[f64]) -> Result<[f64; 2], String> {
        let &[x, y, ..] = position else {
            return Err(format!("a position of {} numbers; expected x and y", position.len()));
        };
        let at_m = match self {
            Self::Metres => [x, y],
            Self::Degrees { middle_deg: [lon, lat], metres } => {
                [(x - lon) * metres[0], (y - lat) * metres[1]]
            }
        };
        if at_m.iter().all(|m| m.abs() <= FRAME_MAX_M) {
            Ok(at_m)
        } else {
            Err(format!("a position at ({x:e}, {y:e}); expected numbers within ±{FRAME_MAX_M} m"))
        }
    }
}

/// The place on Earth of a frame of metres, as this project writes it.
fn about(members: &JsonObject) -> Option<[f64; 2]> {
    let [lon, lat] = members.get("uchain")?.get("about_deg")?.as_array()?.as_slice() else { return None };
    let (lon, lat) = (lon.as_f64()?, lat.as_f64()?);
    (lon.abs() <= 180.0 && lat.abs() <= 90.0).then_some([lon, lat])
}

/// The name of a coordinate reference system (GeoJSON of 2008) other than longitude and latitude.
fn foreign_crs(members: &JsonObject) -> Option<String> {
    let name = members.get("crs")?.get("properties")?.get("name")?.as_str()?;
    let degrees = ["CRS84", "4326", "4979", "4258", "4269"].iter().any(|known| name.ends_with(known));
    (!degrees).then(|| name.chars().take(60).collect())
}

struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Default for Bounds {
    fn default() -> Self {
        Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] }
    }
}

impl Bounds {
    fn take(&mut self, value: &GeometryValue) {
        match value {
            GeometryValue::Point { coordinates } => self.see(coordinates),
            GeometryValue::MultiPoint { coordinates } | GeometryValue::LineString { coordinates } => {
                self.all(coordinates);
            }
            GeometryValue::MultiLineString { coordinates } | GeometryValue::Polygon { coordinates } => {
                for line in coordinates {
                    self.all(line);
                }
            }
            GeometryValue::MultiPolygon { coordinates } => {
                for line in coordinates.iter().flatten() {
                    self.all(line);
                }
            }
            GeometryValue::GeometryCollection { geometries } => {
                for geometry in geometries {
                    self.take(&geometry.value);
                }
            }
        }
    }

    fn all(&mut self, positions: &[Position]) {
        for at in positions {
            self.see(at);
        }
    }

    fn see(&mut self, at: &Position) {
        for (axis, &number) in at.as_slice().iter().take(2).enumerate() {
            self.low[axis] = self.low[axis].min(number);
            self.high[axis] = self.high[axis].max(number);
        }
    }
}
