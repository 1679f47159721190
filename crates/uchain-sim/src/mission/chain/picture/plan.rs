//! A plan against depth: relays needed, worst link, time.

use kuva::render::{color::Color, render::Scene};

use crate::draw::{
    colour::{self, GREY, INK},
    panel::{Panel, legend, rule, unclip},
};
use crate::mission::chain::{Plan, PlanRow};

/// Height of each of the three boxes.
const HEIGHT: f64 = 150.0;
/// Room between two boxes, for the numbers and the label of the depth.
const GAP: f64 = 52.0;

/// Three panels, one below the other, on the same axis of depth.
pub(crate) struct Sheet<'a> {
    plan: &'a Plan,
    relays: Panel,
    losses: Panel,
    times: Panel,
}

/// What a row says in one panel, if it says anything there.
type Value = fn(&PlanRow) -> Option<f64>;

fn relays(row: &PlanRow) -> Option<f64> {
    row.relays_needed.map(|relays| relays as f64)
}

fn one_fewer_db(row: &PlanRow) -> Option<f64> {
    row.bottleneck_by_links_db.get(row.relays_needed?.checked_sub(1)?).copied()
}

fn head_min(row: &PlanRow) -> Option<f64> {
    row.time_min
}

fn relay_min(row: &PlanRow) -> Option<f64> {
    row.first_relay_min
}

impl<'a> Sheet<'a> {
    pub(crate) fn new(plan: &'a Plan, top: f64) -> Self {
        let end_m = plan.rows.last().map_or(1.0, |row| row.depth_m).max(0.1);
        let panel = |place: f64, range| Panel::new(top + place * (HEIGHT + GAP), HEIGHT, (0.0, end_m), range);
        let largest = |value: Value, least: f64| plan.rows.iter().filter_map(value).fold(least, f64::max);
        // What is at hand shows as well, if it is not far above.
        let most = largest(relays, 1.0);
        let highest =
            most.max(plan.relays_available.map_or(0.0, |relays| relays as f64).min(most + 3.0)) + 1.0;
        let endurance_min = plan.endurance_s / 60.0;
        Self {
            plan,
            relays: panel(0.0, (0.0, highest)).with_y_step((highest / 6.0).ceil()),
            losses: panel(1.0, loss_range(plan)),
            times: panel(2.0, (0.0, 1.1 * largest(head_min, endurance_min))),
        }
    }

    pub(crate) fn left(&self) -> f64 {
        self.relays.left()
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.times.bottom()
    }

    pub(crate) fn draw(&self, scene: &mut Scene) {
        let (deep, light) = (colour::of_uav(1, 2), colour::of_estimate(1, 2));
        let head = colour::of_uav(0, 2);

        self.relays.axes(scene, "depth of the head (m)", "relays needed");
        self.relays.clip(scene);
        self.relays.line(scene, self.steps(), &deep, 1.8);
        let at_hand = self.plan.relays_available.map(|relays| relays as f64);
        if let Some(at_hand) = at_hand {
            level(scene, &self.relays, at_hand, &GREY);
        }
        unclip(scene);
        mark(scene, &self.relays, 0, "needed", &deep, 1.8, None);
        if at_hand.is_some_and(|at_hand| self.relays.shows(at_hand)) {
            mark(scene, &self.relays, 1, "at hand", &GREY, 1.2, DASHED);
        }

        self.losses.axes(scene, "depth of the head (m)", "worst link at best (dB)");
        self.losses.clip(scene);
        self.losses.line(scene, self.along(one_fewer_db), &light, 1.2);
        self.losses.line(scene, self.along(|row| row.bottleneck_db), &deep, 1.8);
        level(scene, &self.losses, self.plan.s_min_db, &INK);
        unclip(scene);
        mark(scene, &self.losses, 0, "as needed", &deep, 1.8, None);
        mark(scene, &self.losses, 1, "one fewer", &light, 1.2, None);
        mark(scene, &self.losses, 2, &format!("s_min {} dB", self.plan.s_min_db), &INK, 1.2, DASHED);

        self.times.axes(scene, "depth of the head (m)", "time (min)");
        self.times.clip(scene);
        self.times.line(scene, self.along(head_min), &head, 1.8);
        self.times.line(scene, self.along(relay_min), &deep, 1.8);
        level(scene, &self.times, self.plan.endurance_s / 60.0, &INK);
        unclip(scene);
        mark(scene, &self.times, 0, "head there", &head, 1.8, None);
        mark(scene, &self.times, 1, "relay 1 flies", &deep, 1.8, None);
        mark(scene, &self.times, 2, "endurance", &INK, 1.2, DASHED);
    }

    fn along(&self, value: Value) -> impl Iterator<Item = Option<(f64, f64)>> {
        self.plan.rows.iter().map(move |row| value(row).map(|value| (row.depth_m, value)))
    }

    /// Relays needed against depth; each number holds from the row before, for it is safe to have it there.
    fn steps(&self) -> impl Iterator<Item = Option<(f64, f64)>> {
        let mut from_m = 0.0;
        self.plan.rows.iter().flat_map(move |row| {
            let before_m = std::mem::replace(&mut from_m, row.depth_m);
            [before_m, row.depth_m].map(|depth_m| relays(row).map(|relays| (depth_m, relays)))
        })
    }
}

const DASHED: Option<&str> = Some("6 4");

/// A dashed line across a panel.
fn level(scene: &mut Scene, panel: &Panel, value: f64, stroke: &Color) {
    let (_, y) = panel.at(0.0, value);
    rule(scene, (panel.left(), y), (panel.right(), y), stroke, 1.2, DASHED);
}

fn mark(
    scene: &mut Scene,
    panel: &Panel,
    row: usize,
    content: &str,
    stroke: &Color,
    width: f64,
    dash: Option<&str>,
) {
    let (x, y) = legend(scene, panel, row, content);
    rule(scene, (x - 8.0, y), (x + 8.0, y), stroke, width, dash);
}

/// Around `s_min`; a chain with one relay too few may be far worse, and is cut off.
fn loss_range(plan: &Plan) -> (f64, f64) {
    const ABOVE_DB: f64 = 20.0;
    let (mut low_db, mut high_db) = (plan.s_min_db - 15.0, plan.s_min_db + 5.0);
    for loss_db in plan.rows.iter().flat_map(|row| [row.bottleneck_db, one_fewer_db(row)]).flatten() {
        low_db = low_db.min(loss_db);
        high_db = high_db.max(loss_db.min(plan.s_min_db + ABOVE_DB));
    }
    ((low_db / 5.0).floor() * 5.0, (high_db / 5.0).ceil() * 5.0)
}
