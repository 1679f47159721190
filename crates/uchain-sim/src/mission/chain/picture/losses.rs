//! Link losses over time, as in Laclau 2021, Fig. 4D: one box, or small ones with the same axes for a long chain.

use kuva::render::render::Scene;
use uchain_core::bounded;

use crate::draw::{
    colour::{self, GREY, LINES_MAX},
    loss::{self, Known},
    name::{
        Ending,
        key::{self, Entry},
        name_ends,
    },
    panel::{FIGURE_WIDTH, LEFT, Panel, TEXT_SMALL, caption, name_axes, round_step, rule, text, unclip},
};
use crate::mission::chain::{Course, Frame, History, LinkFrame, Summary};

/// Most points of one line; the picture is narrower than that.
const POINTS_MAX: usize = 2000;
/// Most small boxes; of a chain that is longer than all of them hold, evenly many UAVs are shown.
const BOXES_MAX: usize = 24;
const COLUMNS: usize = 3;
/// Height of the one box, of a small one, and what lies between two of those.
const HEIGHT: f64 = 260.0;
const SMALL_HEIGHT: f64 = 84.0;
const GAP: f64 = 34.0;
/// Room right of each small box for names, then numbers of the next one.
const NAMES: f64 = 54.0;
const NUMBERS: f64 = 26.0;
/// Pattern of a launch.
const LAUNCH: Option<&str> = Some("1.5 3");

/// What the upper part shows.
pub(crate) struct Losses<'a> {
    frames: Vec<&'a Frame>,
    /// UAVs by box.
    boxes: Vec<Vec<usize>>,
    /// Every so many UAVs are shown.
    step: usize,
    /// `None` where every signal launches.
    s_min_db: Option<f64>,
    end_s: f64,
    launches_s: &'a [f64],
    y_range: (f64, f64),
}

/// What is drawn of a link.
fn loss_db(link: &LinkFrame, known: Known) -> Option<f32> {
    match known {
        Known::Raw => link.raw_db,
        Known::Filtered => link.filtered_db,
        Known::True => Some(link.true_db),
    }
    .filter(|loss_db| loss_db.is_finite())
}

/// From behind.
const DRAWN: [Known; 3] = [Known::Raw, Known::Filtered, Known::True];

impl<'a> Losses<'a> {
    pub(crate) fn new(course: &Course, history: &'a History, summary: &'a Summary) -> Self {
        let frames = thinned(&history.frames);
        let s_min_db = Some(f64::from(course.scenario.takeoff.s_min_db)).filter(|s_min_db| *s_min_db > 0.0);
        let (mut low_db, mut high_db) =
            s_min_db.map_or((f64::INFINITY, f64::NEG_INFINITY), |s_min_db| (s_min_db - 8.0, s_min_db + 4.0));
        for link in frames.iter().flat_map(|frame| &frame.links) {
            for loss_db in DRAWN.iter().filter_map(|known| loss_db(link, *known)) {
                low_db = low_db.min(f64::from(loss_db));
                high_db = high_db.max(f64::from(loss_db));
            }
        }
        if low_db > high_db {
            (low_db, high_db) = (0.0, 100.0);
        }
        let uavs = summary.launches_s.len().max(1);
        let step = uavs.div_ceil(BOXES_MAX * LINES_MAX);
        let shown: Vec<usize> = (0..uavs).step_by(step).collect();
        let per_box = if shown.len() <= LINES_MAX {
            LINES_MAX
        } else {
            bounded(shown.len().div_ceil(BOXES_MAX), 1, LINES_MAX)
        };
        Self {
            frames,
            boxes: shown.chunks(per_box).map(<[usize]>::to_vec).collect(),
            step,
            s_min_db,
            end_s: summary.sim_s.max(1.0),
            launches_s: &summary.launches_s,
            y_range: ((low_db / 5.0).floor() * 5.0, (high_db / 5.0).ceil() * 5.0),
        }
    }

    fn is_one(&self) -> bool {
        self.boxes.len() == 1
    }

    /// Room above the boxes, for the key and the numbers of launches.
    pub(crate) fn above(&self) -> f64 {
        key::height(&self.entries(), LEFT) + if self.is_one() { 18.0 } else { 8.0 }
    }

    /// The boxes, the first one's top so far below the page's upper edge.
    pub(crate) fn panels(&self, top: f64) -> Vec<Panel> {
        if self.is_one() {
            return vec![Panel::new(top, HEIGHT, (0.0, self.end_s), self.y_range)];
        }
        let cell = (FIGURE_WIDTH - LEFT + NUMBERS) / COLUMNS as f64;
        let (x_step, y_step) = (round_step(self.end_s, 4), round_step(self.y_range.1 - self.y_range.0, 4));
        let panel = |place: usize| {
            let left = LEFT + cell * (place % COLUMNS) as f64;
            let top = top + (SMALL_HEIGHT + GAP) * (place / COLUMNS) as f64;
            let sides = (left, left + cell - NAMES - NUMBERS);
            let panel = Panel::within(sides, top, SMALL_HEIGHT, (0.0, self.end_s), self.y_range);
            panel.with_x_step(x_step).with_y_step(y_step)
        };
        (0..self.boxes.len()).map(panel).collect()
    }

    /// Draws boxes and key; the key is right above the first box.
    pub(crate) fn draw(&self, scene: &mut Scene, panels: &[Panel]) {
        let (Some(first), Some(last)) = (panels.first(), panels.last()) else { return };
        key::draw(scene, (first.left() - 8.0, first.top() - self.above()), &self.entries());
        for (uavs, panel) in self.boxes.iter().zip(panels) {
            panel.grid(scene);
            panel.clip(scene);
            for &uav in uavs {
                self.launch(scene, panel, uav);
            }
            if let Some(s_min_db) = self.s_min_db {
                loss::threshold(scene, panel, s_min_db);
            }
            for known in DRAWN {
                for &uav in uavs.iter().rev() {
                    loss::series(scene, panel, known, uav, self.link(uav, known));
                }
            }
            unclip(scene);
            name_ends(scene, panel, self.endings(uavs, panel));
        }
        // The last row may be short, but the axes are those of all.
        let right = panels.get(COLUMNS - 1).unwrap_or(last);
        let corner = Panel::within(
            (first.left(), right.right()),
            last.top(),
            last.bottom() - last.top(),
            (0.0, 1.0),
            (0.0, 1.0),
        );
        name_axes(scene, first, &corner, "time (s)", "loss of the link toward the base (dB)");
        if self.is_one() {
            self.launch_numbers(scene, first);
        }
        if self.step > 1 {
            let words = format!("Of {} UAVs every {}th is shown.", self.launches_s.len(), self.step);
            text(scene, (first.left(), corner.bottom() + 33.0), TEXT_SMALL, &words);
        }
    }

    /// Loss over time of the link behind one UAV; `None` where it is not there.
    fn link(&self, uav: usize, known: Known) -> impl Iterator<Item = Option<(f64, f64)>> {
        self.frames.iter().map(move |frame| {
            let loss_db = loss_db(frame.links.iter().find(|link| link.uav == uav)?, known)?;
            Some((frame.time_s(), f64::from(loss_db)))
        })
    }

    /// Names at the ends of lines, and that of the threshold where there is room for it.
    fn endings(&self, uavs: &[usize], panel: &Panel) -> Vec<Ending> {
        let of = |&uav: &usize| {
            let last = |known| self.link(uav, known).flatten().last();
            let (x, y) = last(Known::Filtered)
                .into_iter()
                .chain(last(Known::True))
                .max_by(|a, b| a.0.total_cmp(&b.0))?;
            let words =
                if uav == 0 && self.is_one() { "UAV 0, head".to_owned() } else { format!("UAV {uav}") };
            Some(Ending { at: panel.at(x, y), words, colour: colour::of_uav(uav) })
        };
        let threshold = self.s_min_db.filter(|_| self.is_one());
        let threshold = threshold.map(|s_min_db| loss::threshold_ending(panel, s_min_db));
        uavs.iter().filter_map(of).chain(threshold).collect()
    }

    /// A vertical mark at the launch.
    fn launch(&self, scene: &mut Scene, panel: &Panel, uav: usize) {
        if let Some(&launch_s) = self.launches_s.get(uav) {
            let (x, _) = panel.at(launch_s, 0.0);
            rule(scene, (x, panel.top()), (x, panel.bottom()), &colour::of_uav(uav), 1.0, LAUNCH);
        }
    }

    /// The UAVs' numbers above their launches, where there is room.
    fn launch_numbers(&self, scene: &mut Scene, panel: &Panel) {
        let mut free_from = f64::NEG_INFINITY;
        for (i, &launch_s) in self.launches_s.iter().enumerate() {
            let (x, _) = panel.at(launch_s, 0.0);
            if x >= free_from {
                caption(scene, (x, panel.top() - 4.0), &i.to_string(), &colour::INK);
                free_from = x + 16.0;
            }
        }
    }

    fn entries(&self) -> Vec<Entry> {
        let is_known = |known: &Known| {
            self.frames.iter().flat_map(|frame| &frame.links).any(|link| loss_db(link, *known).is_some())
        };
        let drawn: Vec<Known> = DRAWN.into_iter().filter(is_known).collect();
        let mut entries = loss::entries(&drawn);
        entries.extend(self.s_min_db.filter(|_| !self.is_one()).map(loss::threshold_entry));
        entries.push(Entry::new("launch", |scene, (x, y)| {
            rule(scene, (x, y - 6.0), (x, y + 6.0), &GREY, 1.0, LAUNCH);
        }));
        entries
    }
}

/// Evenly spaced frames, the last one included.
pub(crate) fn thinned(frames: &[Frame]) -> Vec<&Frame> {
    let step = frames.len().div_ceil(POINTS_MAX).max(1);
    let mut kept: Vec<&Frame> = frames.iter().step_by(step).collect();
    if step > 1 {
        kept.extend(frames.last());
    }
    kept
}
