//! What can be wrong with a map, with the numbers that say why.

use std::path::{Path, PathBuf};

/// Why a map, a corridor or a tunnel distance cannot be had.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// A quantity outside its range.
    #[error("{what} = {got}: must lie in {low}..={high}")]
    Range {
        /// The quantity, unit included.
        what: &'static str,
        /// What was given.
        got: f64,
        /// Least value allowed.
        low: f64,
        /// Greatest value allowed.
        high: f64,
    },
    /// A coordinate that is not a number, or that lies too far out for f32.
    #[error("corner {index} at ({x}, {y}) m: both coordinates must be numbers within ±{most} m")]
    Coordinate {
        /// Which corner, counted from 0 within its line or loop.
        index: usize,
        /// x as given (m).
        x: f64,
        /// y as given (m).
        y: f64,
        /// Greatest magnitude allowed (m).
        most: f64,
    },
    /// Too few or too many of something.
    #[error("{what}: {got}, must be {least} to {most}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        got: usize,
        /// Fewest allowed.
        least: usize,
        /// Most allowed.
        most: usize,
    },
    /// A leg of a centre line that has no room for the bends at its ends.
    #[error(
        "leg {leg} of the centre line is {length_m} m long; it has to be longer than the {needed_m} m that the corners at \
         its ends take up"
    )]
    LegTooShort {
        /// Which leg, counted from 0.
        leg: usize,
        /// Its length (m).
        length_m: f64,
        /// What the corners at its two ends take up (m).
        needed_m: f64,
    },
    /// A centre line that goes back the way it came.
    #[error(
        "corner {corner} of the centre line, at ({x}, {y}) m, goes back the way it came; turn by less than 180° there"
    )]
    TurnsBack {
        /// Which corner, counted from 0.
        corner: usize,
        /// Where (m).
        x: f64,
        /// Where (m).
        y: f64,
    },
    /// A bend whose inner wall would turn inside out.
    #[error(
        "corner {corner} bends with a radius of {bend_radius_m} m; half the width, {least_m} m, is the least"
    )]
    BendTooTight {
        /// Which corner, counted from 0.
        corner: usize,
        /// The radius asked for (m).
        bend_radius_m: f64,
        /// Half the width (m).
        least_m: f64,
    },
    /// Two walls that cross or touch where they must not.
    #[error("walls cross or touch near ({x:.3}, {y:.3}) m")]
    WallsCross {
        /// Where (m).
        x: f64,
        /// Where (m).
        y: f64,
    },
    /// A piece of rock that leaves no free space.
    #[error(
        "the piece of rock with a corner at ({x}, {y}) m surrounds the outer wall: no free space is left"
    )]
    AllRock {
        /// x as given (m).
        x: f64,
        /// y as given (m).
        y: f64,
    },
    /// A place that has to be in free space is in rock.
    #[error("({x}, {y}) m is in rock")]
    InRock {
        /// x in the map frame (m).
        x: f64,
        /// y in the map frame (m).
        y: f64,
    },
    /// Two places that are one: there is no way between them to speak of.
    #[error(
        "the two ends of the way are one place ({apart_m} m apart); expected at least {least_m} m between them"
    )]
    OnePlace {
        /// Distance between them (m).
        apart_m: f64,
        /// Least distance (m).
        least_m: f64,
    },
    /// Two places with no way between them.
    #[error(
        "no way leads from ({from_x}, {from_y}) to ({to_x}, {to_y}) m, at least none wider than about {cell_m:.3} m"
    )]
    NoWay {
        /// One place, in the map frame (m).
        from_x: f64,
        /// One place, in the map frame (m).
        from_y: f64,
        /// The other place, in the map frame (m).
        to_x: f64,
        /// The other place, in the map frame (m).
        to_y: f64,
        /// Size of the cells that were searched (m).
        cell_m: f64,
    },
    /// Two places with no way between them that is wide enough.
    #[error(
        "the way there is only {width_m:.2} m wide at ({x:.2}, {y:.2}) m; expected at least {needs_m:.2} m, what a UAV takes"
    )]
    TooNarrow {
        /// Where the widest way is narrowest, in the frame of the map's file (m).
        x: f64,
        /// Where the widest way is narrowest, in the frame of the map's file (m).
        y: f64,
        /// Its width there (m).
        width_m: f32,
        /// What is needed (m).
        needs_m: f32,
    },
    /// A file that cannot be read.
    #[error("{}: {why}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What went wrong.
        why: String,
    },
    /// A key of a map file that is absent or holds the wrong thing.
    #[error("{}: {key} = {got}: expected {expected}", file.display())]
    Key {
        /// The file.
        file: PathBuf,
        /// The key.
        key: &'static str,
        /// What it holds.
        got: String,
        /// What it should hold.
        expected: String,
    },
    /// The picture a map file names cannot be read.
    #[error("{}{why}", of_image(file, image))]
    Image {
        /// The map file whose key `image` names the picture.
        file: PathBuf,
        /// The picture.
        image: PathBuf,
        /// What went wrong.
        why: String,
    },
    /// A picture alone: nobody knows how large its pixels are.
    #[error("{}: a picture does not say how large its pixels are; say how many metres one is wide: {cell}", file.display(), cell = "--cell 0.05, or cell_m = 0.05 beside its file in a scenario")]
    NoScale {
        /// The picture.
        file: PathBuf,
    },
    /// This build was made without the feature `maps`.
    #[error("{}: this build reads no map files; build with the feature `maps`", file.display())]
    NoMapFiles {
        /// The file asked for.
        file: PathBuf,
    },
}

/// Where a picture is named; one that stands for itself is named once.
fn of_image(file: &Path, image: &Path) -> String {
    let file_name = file.display();
    if file == image {
        format!("{file_name}: ")
    } else {
        format!("{file_name}: image = {}: ", image.display())
    }
}

impl MapError {
    /// Whether it is about a file, or what is drawn in it, and not about a value of the scenario.
    pub(crate) fn is_of_a_file(&self) -> bool {
        matches!(
            self,
            Self::Read { .. }
                | Self::Key { .. }
                | Self::Image { .. }
                | Self::NoScale { .. }
                | Self::NoMapFiles { .. }
                | Self::Count { .. }
                | Self::WallsCross { .. }
                | Self::Coordinate { .. }
        )
    }
}
