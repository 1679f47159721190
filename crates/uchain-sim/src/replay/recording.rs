//! A recording of a known mission.

use std::{
    fs::File,
    io::{BufReader, Read},
    path::Path,
    sync::Arc,
};

use crate::{
    analyse::Digest,
    config::{ConfigError, Source},
    map::Map,
    mission::{Metrics as _, Mission as _, Recorded, Scene},
    pilot::{Asked, INPUTS_MAX},
    record::{
        Recorder, Snapshot as _,
        mcap::{About, Frames, Opened, PlayError, ReadError},
    },
    run::{FrameOf, InputOf, MetricsOf, SummaryOf},
};

/// A recording of what is flown in scenes of this kind, read from front to back. Memory: one record of the file, mostly a
/// chunk of 64 KiB and never more than 64 MiB, and the walls.
///
/// Nothing is believed unchecked: a damaged file is refused at the damage, and the frames before it are those that
/// were written. A file that was cut short, or that ends in zeros where it was not on the disk yet when the power went, is
/// read to its last whole chunk; [`Frames::end`] tells.
#[derive(Debug)]
pub struct Recording<R, S: Scene<Mission: Recorded>> {
    /// What it is of.
    pub about: About,
    /// The walls that were recorded.
    pub walls: Map,
    /// The frames that have not been read yet.
    pub frames: Frames<R, FrameOf<S>>,
    source: Source,
    extensions: S::Extensions,
}

/// Lays a scenario out in a map that was built before.
type ReadIn<S> = fn(&Source, Map, <S as Scene>::Extensions) -> Result<Arc<S>, ConfigError>;

impl<S: Scene<Mission: Recorded>> Recording<BufReader<File>, S> {
    /// Opens a recording; messages call it by its path.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        Opened::open(path).map(Self::from)
    }
}

impl<R: Read, S: Scene<Mission: Recorded>> From<Opened<R>> for Recording<R, S> {
    fn from(opened: Opened<R>) -> Self {
        Self {
            about: opened.about.clone(),
            walls: opened.walls.clone(),
            source: opened.source(),
            frames: opened.frames(),
            extensions: S::BUILTIN,
        }
    }
}

impl<R: Read, S: Scene<Mission: Recorded>> Recording<R, S> {
    /// Begins to read a recording; `label` names it in messages about its scenario.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, or damaged where it begins.
    pub fn read(input: R, label: &str) -> Result<Self, ReadError> {
        Opened::read(input, label).map(Self::from)
    }

    /// For a scenario that may use words which this program adds to those that are built in.
    #[must_use]
    pub fn with_extensions(self, extensions: S::Extensions) -> Self {
        Self { extensions, ..self }
    }

    /// The scene that was flown in, in the walls that were recorded; map files are not read. Frames with another number
    /// of robots are refused from here on. It is to be looked at: see [`Recording::scene_to_fly`].
    ///
    /// # Errors
    /// [`ReadError::Scenario`]: a scenario that this version does not know, or of another mission.
    pub fn scene(&mut self) -> Result<Arc<S>, ReadError> {
        self.scene_by(S::read_recorded)
    }

    /// Like [`Recording::scene`], if this program has all that was flown with, such as a law of somebody's own.
    ///
    /// # Errors
    /// [`ReadError::Scenario`]: a scenario that this version cannot fly, or of another mission.
    pub fn scene_to_fly(&mut self) -> Result<Arc<S>, ReadError> {
        self.scene_by(S::read_in)
    }

    fn scene_by(&mut self, read: ReadIn<S>) -> Result<Arc<S>, ReadError> {
        let map = self.walls.clone().with_offset_m(self.about.map_offset_m);
        let scene = read(&self.source, map, self.extensions).map_err(Box::new)?;
        self.frames.expect_crew(scene.crew());
        Ok(scene)
    }

    /// Reads what is left of the run, and gives what its pilot asked for; nothing if the scenario's script was flown.
    ///
    /// # Errors
    /// [`ReadError`]; more inputs than [`INPUTS_MAX`].
    pub fn inputs(&mut self) -> Result<Vec<Asked<InputOf<S>>>, ReadError> {
        let (mut frame, mut inputs) = (FrameOf::<S>::default(), Vec::new());
        while self.frames.read(&mut frame)? {
            let Some(input) = S::Mission::input_of(&frame) else { continue };
            let tick = frame.tick().saturating_sub(1);
            if inputs.len() == INPUTS_MAX {
                let why = format!("one input of the pilot more than {INPUTS_MAX}: expected at most these");
                return Err(ReadError::Frame { tick, why });
            }
            inputs.push(Asked { tick, input });
        }
        Ok(inputs)
    }

    /// Plays what is left of the run and sums it up; the scene is its own. Of a whole run that is the summary the run
    /// itself came to.
    ///
    /// # Errors
    /// [`PlayError`].
    pub fn summary(
        &mut self,
        scene: &Arc<S>,
        recorder: &mut impl Recorder<FrameOf<S>>,
    ) -> Result<SummaryOf<S>, PlayError> {
        self.play(scene, recorder).map(|(summary, _)| summary)
    }

    /// Like [`Recording::summary`], and gives what summed it up: it may know more than the summary, for pictures.
    ///
    /// # Errors
    /// [`PlayError`].
    pub fn play(
        &mut self,
        scene: &Arc<S>,
        recorder: &mut impl Recorder<FrameOf<S>>,
    ) -> Result<(SummaryOf<S>, MetricsOf<S>), PlayError> {
        let (mut metrics, mut digest) =
            (MetricsOf::<S>::of(scene.seeded(self.about.seed)), Digest::default());
        self.frames.play(&mut ((&mut metrics, &mut digest), recorder))?;
        Ok((metrics.sum_up(self.about.seed, digest.hex()), metrics))
    }
}
