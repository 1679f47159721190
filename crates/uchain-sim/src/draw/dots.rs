//! Dots on maps, each with its number.

use std::f64::consts::TAU;

use kuva::render::{color::Color, render::Scene};

use super::{
    colour::{self, FREE, INK},
    panel::{LETTER, Panel, caption, dot, rule},
};

/// Radius of a dot with its number inside, with the number beside, and on the ground.
const WIDE: f64 = 7.0;
const SMALL: f64 = 4.0;
const GROUND: f64 = 2.5;
/// Digits that have room inside.
const DIGITS_INSIDE: usize = 2;
/// Dots on the ground this near to the one before share a line of numbers.
const NEAR: f64 = 24.0;
/// Half of a number's height.
const HALF_HEIGHT: f64 = 5.0;
/// Places looked for around a dot.
const RINGS: usize = 7;
const DIRECTIONS: usize = 12;

/// Somebody on a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Somebody {
    pub(crate) number: usize,
    /// On the page.
    pub(crate) at: (f64, f64),
    pub(crate) in_the_air: bool,
}

/// Numbers that stand at one place.
struct Words {
    text: String,
    /// Whose dot they belong to.
    at: (f64, f64),
}

/// A box of the page: its middle, and half of its size.
#[derive(Clone, Copy)]
struct Taken {
    middle: (f64, f64),
    half: (f64, f64),
}

impl Taken {
    fn meets(&self, other: &Self) -> bool {
        (self.middle.0 - other.middle.0).abs() < self.half.0 + other.half.0
            && (self.middle.1 - other.middle.1).abs() < self.half.1 + other.half.1
    }
}

/// Draws dots and numbers. A number stands inside its dot where there is room, else beside it; those on the ground, who wait
/// in a row, share a line of numbers.
pub(crate) fn draw(scene: &mut Scene, panel: &Panel, everybody: &[Somebody]) {
    let has_room = |one: &Somebody| {
        let apart = |other: &Somebody| libm::hypot(one.at.0 - other.at.0, one.at.1 - other.at.1) > 2.0 * WIDE;
        one.in_the_air
            && one.number.to_string().len() <= DIGITS_INSIDE
            && everybody.iter().all(|other| other.number == one.number || apart(other))
    };
    let inside: Vec<bool> = everybody.iter().map(has_room).collect();
    let mut taken: Vec<Taken> = Vec::new();
    // The head comes last, on top.
    for (one, inside) in everybody.iter().zip(&inside).rev() {
        let radius = match (one.in_the_air, inside) {
            (_, true) => WIDE,
            (true, false) => SMALL,
            (false, false) => GROUND,
        };
        let fill = if one.in_the_air { colour::of_uav(one.number) } else { FREE };
        dot(scene, one.at, radius, &fill, &INK);
        taken.push(Taken { middle: one.at, half: (radius, radius) });
        if *inside {
            caption_on(scene, one.at, &one.number.to_string(), &colour::ink_on_uav(one.number));
        }
    }
    let beside = everybody.iter().zip(&inside).filter(|(_, inside)| !**inside).map(|(one, _)| one);
    for words in shared(beside) {
        let half = (0.5 * LETTER * words.text.chars().count() as f64 + 1.0, HALF_HEIGHT);
        let middle = place(panel, words.at, half, &taken);
        taken.push(Taken { middle, half });
        if libm::hypot(middle.0 - words.at.0, middle.1 - words.at.1) > half.0 + 2.0 * WIDE {
            rule(scene, words.at, middle, &INK, 0.4, None);
        }
        background(scene, middle, half);
        caption_on(scene, middle, &words.text, &INK);
    }
}

/// The nearest place beside a dot that is free; far off rather than nowhere.
fn place(panel: &Panel, at: (f64, f64), half: (f64, f64), taken: &[Taken]) -> (f64, f64) {
    let beside = |ring: usize, step: usize| {
        let (sin, cos) = libm::sincos(TAU * (step as f64 / DIRECTIONS as f64 - 0.25));
        let away = WIDE + 4.0 + 9.0 * ring as f64;
        (at.0 + cos * (away + half.0 - HALF_HEIGHT), at.1 + sin * away)
    };
    let is_free = |middle: &(f64, f64)| {
        let wanted = Taken { middle: *middle, half };
        let fits = middle.0 - half.0 > panel.left()
            && middle.0 + half.0 < panel.right()
            && middle.1 - half.1 > panel.top()
            && middle.1 + half.1 < panel.bottom();
        fits && !taken.iter().any(|other| other.meets(&wanted))
    };
    let mut all = (0..RINGS).flat_map(|ring| (0..DIRECTIONS).map(move |step| beside(ring, step)));
    all.find(is_free).unwrap_or(at)
}

/// Numbers beside dots: a line for each in the air, and one for those who wait side by side on the ground.
fn shared<'a>(everybody: impl Iterator<Item = &'a Somebody>) -> Vec<Words> {
    let mut rows: Vec<Vec<Somebody>> = Vec::new();
    for one in everybody {
        let joins = |row: &Vec<Somebody>| {
            row.last().is_some_and(|last| {
                let distance = libm::hypot(last.at.0 - one.at.0, last.at.1 - one.at.1);
                !last.in_the_air && !one.in_the_air && last.number + 1 == one.number && distance < NEAR
            })
        };
        match rows.last_mut() {
            Some(row) if joins(row) => row.push(*one),
            _ => rows.push(vec![*one]),
        }
    }
    let words = |row: &Vec<Somebody>| {
        let (first, last) = (row.first()?, row.last()?);
        let text = match row.len() {
            1 => first.number.to_string(),
            2 => format!("{}, {}", first.number, last.number),
            _ => format!("{}–{}", first.number, last.number),
        };
        Some(Words { text, at: row.get(row.len() / 2)?.at })
    };
    rows.iter().filter_map(words).collect()
}

fn background(scene: &mut Scene, (x, y): (f64, f64), half: (f64, f64)) {
    scene.add(kuva::render::render::Primitive::Rect {
        x: x - half.0,
        y: y - half.1,
        width: 2.0 * half.0,
        height: 2.0 * half.1,
        fill: FREE,
        stroke: None,
        stroke_width: None,
        opacity: Some(0.7),
    });
}

fn caption_on(scene: &mut Scene, (x, y): (f64, f64), words: &str, ink: &Color) {
    caption(scene, (x, y + 3.5), words, ink);
}
