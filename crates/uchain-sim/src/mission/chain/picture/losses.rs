//! Link losses over time, as in Laclau 2021, Fig. 4D.

use kuva::render::render::Scene;
use uchain_core::bounded;

use crate::draw::{
    colour::{self, GREY, INK},
    panel::{Panel, ROW, caption, legend, rule, unclip},
};
use crate::mission::chain::{Course, Frame, History, Summary};

/// Most points of one line; the picture is narrower than that.
const POINTS_MAX: usize = 2000;
/// Most UAVs named in the legend.
const NAMED_MAX: usize = 10;

/// What the upper panel shows.
pub(crate) struct Losses<'a> {
    frames: Vec<&'a Frame>,
    uavs: usize,
    /// `None` where every signal launches.
    s_min_db: Option<f64>,
    end_s: f64,
    launches_s: &'a [f64],
    y_range: (f64, f64),
}

impl<'a> Losses<'a> {
    pub(crate) fn new(course: &Course, history: &'a History, summary: &'a Summary) -> Self {
        let frames = thinned(&history.frames);
        let s_min_db = Some(f64::from(course.scenario.takeoff.s_min_db)).filter(|s_min_db| *s_min_db > 0.0);
        let (mut low_db, mut high_db) =
            s_min_db.map_or((f64::INFINITY, f64::NEG_INFINITY), |s_min_db| (s_min_db - 8.0, s_min_db + 4.0));
        for link in frames.iter().flat_map(|frame| &frame.links) {
            for loss_db in
                [Some(link.true_db), link.filtered_db].into_iter().flatten().filter(|l| l.is_finite())
            {
                low_db = low_db.min(f64::from(loss_db));
                high_db = high_db.max(f64::from(loss_db));
            }
        }
        if low_db > high_db {
            (low_db, high_db) = (0.0, 100.0);
        }
        Self {
            frames,
            uavs: summary.launches_s.len().max(1),
            s_min_db,
            end_s: summary.sim_s.max(1.0),
            launches_s: &summary.launches_s,
            y_range: ((low_db / 5.0).floor() * 5.0, (high_db / 5.0).ceil() * 5.0),
        }
    }

    pub(crate) fn x_range(&self) -> (f64, f64) {
        (0.0, self.end_s)
    }

    pub(crate) fn y_range(&self) -> (f64, f64) {
        self.y_range
    }

    /// High enough for the legend.
    pub(crate) fn height(&self) -> f64 {
        250.0_f64.max(ROW * (self.named().count() + 5) as f64 + 8.0)
    }

    /// UAVs named in the legend: all of a short chain, some of a long one.
    fn named(&self) -> impl Iterator<Item = usize> + use<> {
        let last = self.uavs - 1;
        let steps = bounded(last, 1, NAMED_MAX - 1);
        (0..=steps.min(last)).map(move |i| i * last / steps)
    }

    pub(crate) fn draw(&self, scene: &mut Scene, panel: &Panel) {
        panel.axes(scene, "time (s)", "loss of the link toward the base (dB)");
        panel.clip(scene);
        self.launches(scene, panel);
        for i in 0..self.uavs {
            let stroke = colour::of_estimate(i, self.uavs);
            panel.line(scene, self.link(i, |link| link.filtered_db), &stroke, 0.8);
        }
        for i in (0..self.uavs).rev() {
            let stroke = colour::of_uav(i, self.uavs);
            panel.line(scene, self.link(i, |link| Some(link.true_db)), &stroke, 1.6);
        }
        if let Some(s_min_db) = self.s_min_db {
            let (left, y) = panel.at(0.0, s_min_db);
            rule(scene, (left, y), (panel.right(), y), &INK, 1.2, Some("6 4"));
        }
        unclip(scene);
        self.legend(scene, panel);
    }

    /// Loss over time of the link behind one UAV; `None` where it is not there.
    fn link(
        &self,
        uav: usize,
        loss_db: impl Fn(&crate::mission::chain::LinkFrame) -> Option<f32>,
    ) -> impl Iterator<Item = Option<(f64, f64)>> {
        self.frames.iter().map(move |frame| {
            let loss_db = loss_db(frame.links.iter().find(|link| link.uav == uav)?)?;
            loss_db.is_finite().then(|| (frame.time_s(), f64::from(loss_db)))
        })
    }

    /// A vertical mark per launch, with the UAV's number above the box where there is room.
    fn launches(&self, scene: &mut Scene, panel: &Panel) {
        for (i, &launch_s) in self.launches_s.iter().enumerate() {
            let (x, _) = panel.at(launch_s, 0.0);
            let stroke = colour::of_uav(i, self.uavs);
            rule(scene, (x, panel.top()), (x, panel.bottom()), &stroke, 1.0, Some("1.5 3"));
        }
    }

    fn launch_numbers(&self, scene: &mut Scene, panel: &Panel) {
        let mut free_from = f64::NEG_INFINITY;
        for (i, &launch_s) in self.launches_s.iter().enumerate() {
            let (x, _) = panel.at(launch_s, 0.0);
            if x >= free_from {
                caption(scene, (x, panel.top() - 4.0), &i.to_string(), &colour::of_uav(i, self.uavs));
                free_from = x + 16.0;
            }
        }
    }

    fn legend(&self, scene: &mut Scene, panel: &Panel) {
        self.launch_numbers(scene, panel);
        let mut row = 0;
        for i in self.named() {
            let name = if i == 0 { "UAV 0, head".to_owned() } else { format!("UAV {i}") };
            let (x, y) = legend(scene, panel, row, &name);
            rule(scene, (x - 8.0, y), (x + 8.0, y), &colour::of_uav(i, self.uavs), 2.0, None);
            row += 1;
        }
        let mut mark = |content: &str, width: f64, stroke, dash| {
            row += 1;
            let (x, y) = legend(scene, panel, row, content);
            rule(scene, (x - 8.0, y), (x + 8.0, y), stroke, width, dash);
        };
        mark("true", 1.8, &GREY, None);
        mark("filtered", 0.8, &GREY, None);
        if let Some(s_min_db) = self.s_min_db {
            mark(&format!("s_min {s_min_db} dB"), 1.2, &INK, Some("6 4"));
        }
        mark("launch", 1.0, &GREY, Some("1.5 3"));
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
