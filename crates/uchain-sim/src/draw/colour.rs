//! One colour per UAV, the same in every panel.

use kuva::render::color::Color;

/// Told apart by most eyes, dark enough for thin lines on white.
const FEW: [[u8; 3]; 8] = [
    [0xd6, 0x27, 0x28],
    [0x1f, 0x77, 0xb4],
    [0x2c, 0xa0, 0x2c],
    [0xff, 0x7f, 0x0e],
    [0x94, 0x67, 0xbd],
    [0x8c, 0x56, 0x4b],
    [0x17, 0xa2, 0xb8],
    [0xe3, 0x5f, 0xa8],
];

/// Stops of a ramp for longer chains: red at the head to violet at the base.
const RAMP: [[u8; 3]; 6] = [
    [0xd6, 0x27, 0x28],
    [0xf0, 0x9a, 0x1a],
    [0x6f, 0xa8, 0x2c],
    [0x17, 0xa2, 0xa8],
    [0x2f, 0x5f, 0xc4],
    [0x7a, 0x2f, 0x9e],
];

/// Of UAV `index` among `count`.
pub(crate) fn of_uav(index: usize, count: usize) -> Color {
    rgb(mixed(index, count))
}

/// The same, lighter: what is estimated.
pub(crate) fn of_estimate(index: usize, count: usize) -> Color {
    rgb(mixed(index, count).map(|c| 0.45 * c + 0.55 * 255.0))
}

fn mixed(index: usize, count: usize) -> [f32; 3] {
    if count <= FEW.len() {
        return FEW[index % FEW.len()].map(f32::from);
    }
    let along = index.min(count - 1) as f32 / (count - 1) as f32 * (RAMP.len() - 1) as f32;
    let stop = (along as usize).min(RAMP.len() - 2);
    let share = along - stop as f32;
    let (from, to) = (RAMP[stop], RAMP[stop + 1]);
    std::array::from_fn(|i| (1.0 - share) * f32::from(from[i]) + share * f32::from(to[i]))
}

fn rgb([r, g, b]: [f32; 3]) -> Color {
    Color::Rgb(r as u8, g as u8, b as u8)
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
