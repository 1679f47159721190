//! When a node was on the ground, and when something overrode it, as bands behind its lines.

use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};
use uchain_core::chain::{Override, Stage};

use super::{Entry, GREY, Panel, Step, colour};

/// How much of a band is seen.
const OPACITY: f64 = 0.3;
/// And of the time on the ground.
const GROUND_OPACITY: f64 = 0.14;

/// What a band stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Ground,
    Rising,
    Overridden(Override),
}

impl State {
    fn of(step: &Step) -> Option<Self> {
        match (step.why.stage, step.why.overridden) {
            (Stage::Waiting, _) => Some(Self::Ground),
            (Stage::Rising, _) => Some(Self::Rising),
            (_, by) => by.map(Self::Overridden),
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Ground => "on the ground",
            Self::Rising => "rising",
            Self::Overridden(by) => by.word(),
        }
    }

    fn ink(self) -> (Color, f64) {
        match self {
            Self::Ground => (GREY, GROUND_OPACITY),
            Self::Rising => (GREY, OPACITY),
            Self::Overridden(by) => {
                let number = Override::ALL.iter().position(|other| *other == by).unwrap_or(0);
                (colour::of_uav(number), OPACITY)
            }
        }
    }
}

/// Spans of time (s), one after the other.
pub(super) struct Bands(Vec<(f64, f64, State)>);

impl Bands {
    pub(super) fn of(steps: &[Step]) -> Self {
        let mut bands: Vec<(f64, f64, State)> = Vec::new();
        let mut under_way: Option<(f64, State)> = None;
        for step in steps.iter().filter(|step| step.is_decision) {
            let state = State::of(step);
            if under_way.map(|(_, state)| state) == state {
                continue;
            }
            if let Some((from_s, state)) = under_way {
                bands.push((from_s, step.time_s, state));
            }
            under_way = state.map(|state| (step.time_s, state));
        }
        if let (Some((from_s, state)), Some(last)) = (under_way, steps.last()) {
            bands.push((from_s, last.time_s, state));
        }
        Self(bands)
    }

    pub(super) fn draw(&self, scene: &mut Scene, panel: &Panel, start_s: f64) {
        for &(from_s, to_s, state) in &self.0 {
            let ((left, _), (right, _)) = (panel.at(from_s - start_s, 0.0), panel.at(to_s - start_s, 0.0));
            // However short, it is seen.
            let width = (right - left).max(0.7);
            let corner = (left, panel.top());
            scene.add(area(corner, (width, panel.bottom() - panel.top()), state));
        }
    }

    /// What they mean, for the key.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut there: Vec<State> = Vec::new();
        for (.., state) in &self.0 {
            if !there.contains(state) {
                there.push(*state);
            }
        }
        let entry = |state: State| {
            Entry::new(state.words(), move |scene, (x, y)| {
                scene.add(area((x - 8.0, y - 5.0), (16.0, 10.0), state));
            })
        };
        there.into_iter().map(entry).collect()
    }
}

fn area((x, y): (f64, f64), (width, height): (f64, f64), state: State) -> Primitive {
    let (fill, opacity) = state.ink();
    Primitive::Rect { x, y, width, height, fill, stroke: None, stroke_width: None, opacity: Some(opacity) }
}
