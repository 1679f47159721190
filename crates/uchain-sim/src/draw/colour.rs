//! What colours mean, the same in every picture. Told apart by colour-blind eyes as well: Okabe and Ito, Color Universal
//! Design.

use kuva::render::color::Color;
use uchain_core::bounded;

/// By number of a UAV; with more of them colours come again, and numbers or boxes of their own tell them apart.
const UAVS: [[u8; 3]; 6] = [
    [0xd5, 0x5e, 0x00],
    [0x00, 0x72, 0xb2],
    [0x00, 0x9e, 0x73],
    [0xe6, 0x9f, 0x00],
    [0xcc, 0x79, 0xa7],
    [0x56, 0xb4, 0xe9],
];

/// The first of them are dark.
const DARK: usize = 2;

/// A link that is so much better or worse than the threshold is as good or bad as links are (dB).
const SHADES_DB: f64 = 20.0;
/// Stops of a link's colour: good, at the threshold, bad. The middle one is yellow, darkened for a light ground.
const LINK: [[u8; 3]; 3] = [[0x00, 0x72, 0xb2], [0xc9, 0xb4, 0x00], [0xd5, 0x5e, 0x00]];

/// Most lines in one box over time; there are as many colours.
pub(crate) const LINES_MAX: usize = UAVS.len();

/// Of the UAV, robot or line of this number.
pub(crate) fn of_uav(index: usize) -> Color {
    rgb(UAVS[index % UAVS.len()].map(f64::from))
}

/// The same, lighter: what stays in the background.
pub(crate) fn light_of_uav(index: usize) -> Color {
    rgb(UAVS[index % UAVS.len()].map(|channel| 0.45 * f64::from(channel) + 0.55 * 255.0))
}

/// What is legible on the colour of a UAV.
pub(crate) fn ink_on_uav(index: usize) -> Color {
    if index % UAVS.len() < DARK { FREE } else { INK }
}

/// Of a link by its loss against the threshold of a launch (dB).
pub(crate) fn of_link(loss_db: f64, s_min_db: f64) -> Color {
    let worse = (loss_db - s_min_db) / SHADES_DB;
    // A loss that is no number is as bad as any.
    let worse = if worse.is_nan() { 1.0 } else { bounded(worse, -1.0, 1.0) };
    let (from, to, share) =
        if worse < 0.0 { (LINK[0], LINK[1], worse + 1.0) } else { (LINK[1], LINK[2], worse) };
    rgb(std::array::from_fn(|i| (1.0 - share) * f64::from(from[i]) + share * f64::from(to[i])))
}

fn rgb([r, g, b]: [f64; 3]) -> Color {
    Color::Rgb(r.round() as u8, g.round() as u8, b.round() as u8)
}

/// Text and outlines.
pub(crate) const INK: Color = Color::Rgb(0x22, 0x22, 0x22);
/// Marks that stay in the background.
pub(crate) const GREY: Color = Color::Rgb(0x8a, 0x8a, 0x8a);
/// Rock.
pub(crate) const ROCK: Color = Color::Rgb(0xd9, 0xd5, 0xcf);
/// Free space.
pub(crate) const FREE: Color = Color::Rgb(0xff, 0xff, 0xff);
/// Walls.
pub(crate) const WALL: Color = Color::Rgb(0x55, 0x4d, 0x45);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_is_blue_yellow_or_vermilion_by_its_loss_against_the_threshold() {
        let colour = |loss_db| of_link(loss_db, 60.0);
        assert_eq!(colour(-400.0), colour(40.0));
        assert_eq!(colour(40.0), Color::Rgb(0x00, 0x72, 0xb2));
        assert_eq!(colour(60.0), Color::Rgb(0xc9, 0xb4, 0x00));
        assert_eq!(colour(80.0), Color::Rgb(0xd5, 0x5e, 0x00));
        assert_eq!(colour(f64::NAN), colour(80.0));
        assert_eq!(colour(50.0), Color::Rgb(101, 147, 89), "halfway between blue and yellow");
    }
}
