//! A plan against depth: relays needed, worst link, time.

use kuva::render::{color::Color, render::Scene};

use crate::draw::{
    colour::{self, GREY},
    loss,
    name::{Ending, name_ends},
    panel::{Panel, rule, unclip},
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

fn home_min(row: &PlanRow) -> Option<f64> {
    row.home_min
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
            times: panel(2.0, (0.0, 1.1 * largest(home_min, largest(head_min, endurance_min)))),
        }
    }

    pub(crate) fn left(&self) -> f64 {
        self.relays.left()
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.times.bottom()
    }

    pub(crate) fn draw(&self, scene: &mut Scene) {
        let (head, relay, s_min_db) = (colour::of_uav(0), colour::of_uav(1), self.plan.s_min_db);
        let x_label = "depth of the head (m)";

        self.relays.axes(scene, x_label, "relays needed");
        self.relays.clip(scene);
        self.relays.line(scene, self.steps(), &relay, SOLID);
        let at_hand = self.plan.relays_available.map(|relays| relays as f64);
        let at_hand = at_hand.filter(|at_hand| self.relays.shows(*at_hand));
        if let Some(at_hand) = at_hand {
            level(scene, &self.relays, at_hand);
        }
        unclip(scene);
        let needed = ending(&self.relays, self.steps(), "needed", &relay);
        let at_hand = at_hand.map(|at_hand| level_ending(&self.relays, at_hand, "at hand"));
        name_ends(scene, &self.relays, needed.into_iter().chain(at_hand).collect());

        self.losses.axes(scene, x_label, "loss of the worst link (dB)");
        self.losses.clip(scene);
        loss::threshold(scene, &self.losses, s_min_db);
        loss::dashed_line(scene, &self.losses, self.along(one_fewer_db), &relay, DASHED);
        self.losses.line(scene, self.along(|row| row.bottleneck_db), &relay, SOLID);
        unclip(scene);
        let as_needed = ending(&self.losses, self.along(|row| row.bottleneck_db), "as needed", &relay);
        let one_fewer = ending(&self.losses, self.along(one_fewer_db), "one relay fewer", &relay);
        let threshold = loss::threshold_ending(&self.losses, s_min_db);
        name_ends(scene, &self.losses, as_needed.into_iter().chain(one_fewer).chain([threshold]).collect());

        self.times.axes(scene, x_label, "time (min)");
        self.times.clip(scene);
        self.times.line(scene, self.along(head_min), &head, SOLID);
        self.times.line(scene, self.along(relay_min), &relay, SOLID);
        loss::dashed_line(scene, &self.times, self.along(home_min), &head, DASHED);
        let endurance_min = self.plan.endurance_s / 60.0;
        level(scene, &self.times, endurance_min);
        let usable_min = self.plan.batteries.as_ref().map(|batteries| batteries.usable_min);
        let usable_min = usable_min.filter(|usable_min| *usable_min < endurance_min);
        if let Some(usable_min) = usable_min {
            level(scene, &self.times, usable_min);
        }
        unclip(scene);
        let arrives = ending(&self.times, self.along(head_min), "head is there", &head);
        let flies = ending(&self.times, self.along(relay_min), "relay 1 has flown", &relay);
        let home = ending(&self.times, self.along(home_min), "all are home", &head);
        let empty = level_ending(&self.times, endurance_min, "battery is empty");
        let usable = usable_min.map(|usable_min| level_ending(&self.times, usable_min, "reserve begins"));
        let names = arrives.into_iter().chain(flies).chain(home).chain([empty]).chain(usable);
        name_ends(scene, &self.times, names.collect());
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

/// Thickness of a solid and of a dashed line.
const SOLID: f64 = 2.0;
const DASHED: f64 = 1.4;

/// A thin line across a panel.
fn level(scene: &mut Scene, panel: &Panel, value: f64) {
    let (_, y) = panel.at(0.0, value);
    rule(scene, (panel.left(), y), (panel.right(), y), &GREY, 1.2, Some("6 4"));
}

fn level_ending(panel: &Panel, value: f64, words: &str) -> Ending {
    let (_, y) = panel.at(0.0, value);
    Ending { at: (panel.right(), y), words: words.to_owned(), colour: GREY }
}

/// The name of a line at its last point; none of an empty one.
fn ending(
    panel: &Panel,
    values: impl Iterator<Item = Option<(f64, f64)>>,
    words: &str,
    colour: &Color,
) -> Option<Ending> {
    let (x, y) = values.flatten().last()?;
    Some(Ending { at: panel.at(x, y), words: words.to_owned(), colour: colour.clone() })
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
