//! What a page sees of a mission: its scene, its frames, its numbers over time, and why somebody does what he does.

mod chain;
mod explore;
mod graph;
mod why;

use serde_json::{Value, json};
use uchain_sim::{
    map::Map,
    mission::{Recorded, Scene, Shown},
    pilot::Asked,
    record::Recorder,
    run::{FrameOf, InputOf, MetricsOf},
};

use crate::{
    problem::Problem,
    told::{Input, Since},
};

/// A scene of which a page knows what there is to see.
pub(crate) trait Viewed: Scene<Mission: Recorded + Shown> {
    /// What is kept of a run besides its frames.
    type Extra: Default + Recorder<FrameOf<Self>> + Send;

    /// The mission in a word, and what there is to see of its scene.
    fn of_its_kind(&self) -> (&'static str, Value);

    /// Radius of what flies (m).
    fn radius_m(&self) -> f32;

    /// What its pilot asks for, if it has one and may ask for that.
    fn input(input: Input) -> Result<InputOf<Self>, Problem>;

    /// The same for a page.
    fn shown(input: &InputOf<Self>) -> Option<Input>;

    /// The scenario in TOML, every value written out; with the inputs of a flight by hand, if there are any, as its script.
    fn to_text(&self, inputs: &[Asked<InputOf<Self>>]) -> Result<String, Problem>;

    /// Names of the numbers over time.
    fn columns(&self) -> Vec<String>;

    /// Whether a frame is a row of them.
    fn is_row(frame: &FrameOf<Self>) -> bool;

    /// The numbers of a frame.
    fn row(&self, frame: &FrameOf<Self>, metrics: &MetricsOf<Self>, to: &mut Vec<f32>);

    /// What sensors read last, which frames between two readings do not say.
    type Read: Default + std::fmt::Debug;

    /// Takes in what is read in a frame.
    fn read_on(read: &mut Self::Read, frame: &FrameOf<Self>);

    /// What a film keeps of a frame, given what was read up to it.
    fn kept(frame: &FrameOf<Self>, read: &Self::Read) -> FrameOf<Self>;

    /// How much memory such a frame takes (bytes).
    fn bytes(frame: &FrameOf<Self>) -> usize;

    /// A frame for a page.
    fn frame_json(&self, frame: &FrameOf<Self>, extra: &Self::Extra, exact: bool) -> Result<String, Problem>;

    /// Why somebody does what he does, where a mission stands, and given what was read up to there.
    fn why(
        &self,
        mission: &<Self as Scene>::Mission,
        read: &Self::Read,
        robot: usize,
    ) -> Result<Value, Problem>;

    /// The history of a graph, from what a page knows on; nothing of a mission that makes none.
    fn graph(extra: &Self::Extra, from: Since) -> Value;
}

/// A map for a page: loops of corners, each x and y (m).
pub(crate) fn map_json(map: &Map) -> Value {
    let corners = |walls: &[uchain_sim::map::Segment]| -> Vec<f32> {
        walls.iter().flat_map(|wall| [wall.a.x, wall.a.y]).collect()
    };
    let loops: Vec<Vec<f32>> = map.loops().map(corners).collect();
    let (low, high) = map.bounds();
    json!({ "loops": loops, "bounds": [low.x, low.y, high.x, high.y], "offset_m": map.offset_m() })
}

/// The scenario of a scene, as it was read.
fn whole_text<S: Scene>(scene: &S) -> Result<String, Problem> {
    scene.to_toml().map_err(Problem::new)
}
