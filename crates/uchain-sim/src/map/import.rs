//! What a map's file says besides its walls, and how the map came out of it.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How a map came out of its file.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Import {
    /// What kind of file it was: "SVG"; empty for a map that was no file.
    pub format: &'static str,
    /// What was read, dropped, guessed, merged or separated on the way.
    pub remarks: Vec<Remark>,
    /// Longitude and latitude of the file frame's origin (degrees, WGS 84), if the file knows where on Earth it lies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub about_deg: Option<[f64; 2]>,
}

/// What happened to a part of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RemarkKind {
    /// It was taken as it is.
    Read,
    /// It is not in the map.
    Dropped,
    /// The file does not say it; this was assumed.
    Guessed,
    /// Several of the file are one in the map.
    Merged,
    /// What lies over one another in the file is apart in the map.
    Separated,
}

/// So many parts of a file, what happened to them, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Remark {
    /// What happened.
    pub kind: RemarkKind,
    /// To how many.
    pub count: usize,
    /// What they are, and why: "text elements: a map has no words".
    pub what: String,
}

/// A place that a file has a name for: a station of a survey, a tile.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Where it lies in the file's own frame (m).
    pub at_m: [f64; 2],
    /// How high it lies (m), if the file says so.
    pub height_m: Option<f64>,
}

/// What it costs to be heard across a passage between two tiles.
#[derive(Debug, Clone, PartialEq)]
pub struct HeardAcross {
    /// Column and row of the tiles, in tiles from the middle of the one at the origin of the file's own frame.
    pub tiles: [[i32; 2]; 2],
    /// Side of a tile (m).
    pub tile_m: f64,
    /// The cost (1).
    pub cost: u32,
}

/// What walls are made of.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// What the file calls it.
    pub name: String,
    /// What a wall of it takes from a link (dB), if the file says so.
    pub loss_db: Option<f32>,
}

/// What lies outside of all walls, where nobody has drawn free areas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Outside {
    /// Rock, if three tenths or more of the faces of all walls look into what walls enclose; else free.
    #[default]
    Auto,
    /// Rock: free is what walls enclose.
    Rock,
    /// Free, up to the box around the drawing.
    Free,
}

impl Import {
    /// Nothing to tell of a file of this kind yet.
    pub fn of(format: &'static str) -> Self {
        Self { format, ..Self::default() }
    }

    /// What one should know of the map before a start: all that was not read as it is.
    pub fn note(&self) -> Option<String> {
        let other = self.remarks.iter().filter(|remark| remark.kind != RemarkKind::Read);
        let words: Vec<String> = other.map(ToString::to_string).collect();
        (!words.is_empty()).then(|| format!("the map, read as {}: {}", self.format, words.join("; ")))
    }

    /// A place of the file's own frame (m) as longitude and latitude (degrees, WGS 84), if it is known where on Earth it lies.
    pub fn to_degrees(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [lon, lat] = self.about_deg?;
        let [of_lon_m, of_lat_m] = metres_of_a_degree(lat);
        Some([lon + x / of_lon_m, lat + y / of_lat_m])
    }

    /// Adds a remark, unless it is about nothing.
    pub fn say(&mut self, kind: RemarkKind, count: usize, what: impl Into<String>) {
        if count > 0 {
            self.remarks.push(Remark { kind, count, what: printable(&what.into()) });
        }
    }
}

/// A name out of somebody's file as a terminal may show it: what would move its cursor, or turn the direction of what
/// follows, is a question mark.
pub(super) fn printable(name: &str) -> String {
    let moves = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    name.chars().map(|c| if moves(c) { '?' } else { c }).collect()
}

impl fmt::Display for RemarkKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Read => "read",
            Self::Dropped => "dropped",
            Self::Guessed => "guessed",
            Self::Merged => "merged",
            Self::Separated => "separated",
        })
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.kind, self.count, self.what)
    }
}

/// Metres of a degree of longitude and of one of latitude, at a latitude on the ellipsoid of WGS 84.
pub(super) fn metres_of_a_degree(latitude_deg: f64) -> [f64; 2] {
    // Half the long axis (m) and the square of the eccentricity: NIMA TR8350.2, table 3.1.
    const EQUATOR_M: f64 = 6_378_137.0;
    const ECCENTRICITY_2: f64 = 6.694_379_990_14e-3;
    let (sin, cos) = (libm::sin(latitude_deg.to_radians()), libm::cos(latitude_deg.to_radians()));
    let flattened = 1.0 - ECCENTRICITY_2 * sin * sin;
    let across_m = EQUATOR_M / flattened.sqrt();
    let along_m = across_m * (1.0 - ECCENTRICITY_2) / flattened;
    [(across_m * cos).to_radians(), along_m.to_radians()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_as_long_as_geodesists_say() {
        // Nautical almanacs: 110,574 m and 111,320 m at the equator, 111,132 m and 78,847 m at 45 degrees.
        for (latitude_deg, [of_lon_m, of_lat_m]) in
            [(0.0, [111_319.5, 110_574.3]), (45.0, [78_846.8, 111_131.8])]
        {
            let [x_m, y_m] = metres_of_a_degree(latitude_deg);
            assert!(
                (x_m - of_lon_m).abs() < 0.1 && (y_m - of_lat_m).abs() < 0.1,
                "{latitude_deg}: {x_m} {y_m}"
            );
        }
    }
}
