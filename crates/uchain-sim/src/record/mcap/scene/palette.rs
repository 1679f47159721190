//! The colours of recordings: the ones that pages and pictures have, told apart by those who do not see red or green
//! (Okabe and Ito).

use foxglove::messages::Color;
use uchain_core::bounded;

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// UAVs and robots by id; 0 is the head.
const CREW: [Rgb; 6] = [
    [0xD5, 0x5E, 0x00],
    [0x00, 0x72, 0xB2],
    [0x00, 0x9E, 0x73],
    [0xE6, 0x9F, 0x00],
    [0xCC, 0x79, 0xA7],
    [0x56, 0xB4, 0xE9],
];

/// A link at `takeoff.s_min_db`, and those that are far better and far worse.
const LINKS: [Rgb; 3] = [[0x00, 0x72, 0xB2], [0xF0, 0xE4, 0x42], [0xD5, 0x5E, 0x00]];

/// A link this much better than `takeoff.s_min_db` is good, one this much worse is bad (dB).
const SHADES_DB: f32 = 20.0;

/// Walls on dark ground, which is what viewers have unless told otherwise.
pub(super) const WALL: Rgb = [0xB8, 0xAF, 0xA4];
/// The base station.
pub(super) const BASE: Rgb = [0xEE, 0xEE, 0xEE];
/// Who is on the ground.
pub const GROUNDED: Rgb = [0x80, 0x80, 0x80];

/// The colour of a UAV or robot. They repeat after six: all have their numbers beside them.
pub fn crew(id: usize) -> Rgb {
    CREW.get(id % CREW.len()).copied().unwrap_or(GROUNDED)
}

/// The colour of a link by its loss: blue, yellow, vermilion, linear in between.
pub fn link(loss_db: f32, s_min_db: f32) -> Rgb {
    let worse = bounded((loss_db - s_min_db) / SHADES_DB, -1.0, 1.0);
    let [good, middle, bad] = LINKS;
    let (end, share) = if worse < 0.0 { (good, -worse) } else { (bad, worse) };
    let part =
        |i: usize| (f32::from(middle[i]) + (f32::from(end[i]) - f32::from(middle[i])) * share).round() as u8;
    [part(0), part(1), part(2)]
}

/// As Foxglove has it.
pub fn color(rgb: Rgb) -> Color {
    let [r, g, b] = rgb.map(|part| f64::from(part) / 255.0);
    Color { r, g, b, a: 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_is_blue_20_db_below_s_min_yellow_at_it_and_vermilion_20_db_above() {
        assert_eq!([40.0, 39.0, -300.0].map(|db| link(db, 60.0)), [LINKS[0]; 3]);
        assert_eq!(link(60.0, 60.0), LINKS[1]);
        assert_eq!([80.0, 300.0].map(|db| link(db, 60.0)), [LINKS[2]; 2]);
        assert_eq!(link(70.0, 60.0), [0xE3, 0xA1, 0x21]);
    }

    #[test]
    fn every_uav_has_a_colour_and_the_first_six_have_their_own() {
        let first: Vec<Rgb> = (0..6).map(crew).collect();
        assert!((0..6).all(|i| (0..i).all(|j| first[i] != first[j])));
        assert_eq!(crew(usize::MAX), first[usize::MAX % 6]);
    }
}
