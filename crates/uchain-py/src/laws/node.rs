//! The brain of a chain's UAV, driven by hand.

use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::{prelude::*, types::PyDict};
use uchain_core::chain::{self, Brain as _, NodeParams, Walls};

use super::{level::range, params::from_keywords, seen::Observation, words};

/// All that a UAV may ask of its body.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Command {
    /// Forward velocity (m/s).
    forward_mps: f32,
    /// Leftward velocity (m/s).
    lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    yaw_rate_radps: f32,
    /// In the air, or asking to be.
    airborne: bool,
}

#[pymethods]
impl Command {
    fn __repr__(&self) -> String {
        let Self { forward_mps, lateral_mps, yaw_rate_radps, airborne } = self;
        let airborne = if *airborne { "True" } else { "False" };
        format!(
            "Command(forward_mps={forward_mps}, lateral_mps={lateral_mps}, yaw_rate_radps={yaw_rate_radps}, \
             airborne={airborne})"
        )
    }
}

/// What a UAV tells whoever hears it.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Packet {
    /// Its place in the chain, 0 leads it.
    place: u16,
    /// Its forward ground speed by optic flow (m/s).
    ground_speed_mps: f32,
    /// For how long it has been in the air (s).
    flown_s: f32,
    /// The wall choice it flies by: "centre", "left", "right".
    follow: &'static str,
    /// Largest imbalance of two links from here to the head, by the relays' own estimates (dB).
    imbalance_db: f32,
    /// Share of its battery's charge that is left (0 to 1), if it measures it.
    battery: Option<f32>,
}

#[pymethods]
impl Packet {
    fn __repr__(&self) -> String {
        let Self { place, ground_speed_mps, imbalance_db, .. } = self;
        format!("Packet(place={place}, ground_speed_mps={ground_speed_mps}, imbalance_db={imbalance_db})")
    }
}

/// What a UAV makes of its two links; None before the first packet.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Estimates {
    /// Filtered loss toward the base (dB).
    back_db: Option<f32>,
    /// Loss of the last packet from there, as measured (dB).
    back_raw_db: Option<f32>,
    /// For how long nothing was heard from there (s).
    back_silent_s: Option<f32>,
    /// Filtered loss toward the head (dB).
    front_db: Option<f32>,
    /// Loss of the last packet from there, as measured (dB).
    front_raw_db: Option<f32>,
    /// For how long nothing was heard from there (s).
    front_silent_s: Option<f32>,
    /// Forward speed by laws and overrides, before it slows down near walls (m/s); None while it cannot fly freely.
    allowed_mps: Option<f32>,
}

#[pymethods]
impl Estimates {
    fn __repr__(&self) -> String {
        let told = |value: Option<f32>| value.map_or("None".to_owned(), |value| value.to_string());
        let (back, front, allowed) = (told(self.back_db), told(self.front_db), told(self.allowed_mps));
        format!("Estimates(back_db={back}, front_db={front}, allowed_mps={allowed})")
    }
}

/// What a UAV believes, and why it asks for what it asks.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Explanation {
    /// "head" or "relay".
    role: &'static str,
    /// Its place in the chain; None if it was never told.
    place: Option<u16>,
    /// "waiting", "rising" or "flying".
    stage: &'static str,
    /// Loss of the front link minus that of the back link (dB); None until both were heard.
    imbalance_db: Option<f32>,
    /// Forward speed that its law, or its pilot, wishes (m/s).
    wish_mps: f32,
    /// What its wish was overridden by, if it was.
    overridden: Option<&'static str>,
    /// The wall choice it flies by.
    follow: &'static str,
    /// The walls that it steers by: "both", "left", "right"; None without distances.
    walls: Option<&'static str>,
    /// Share of its forward speed that its distances to the walls leave it (0 to 1).
    speed_share: f32,
}

#[pymethods]
impl Explanation {
    fn __repr__(&self) -> String {
        let Self { role, stage, wish_mps, .. } = self;
        let overridden = self.overridden.as_ref().map_or(String::new(), |by| format!(", overridden by {by}"));
        format!("<uchain.laws.Explanation: {role}, {stage}, wishes {wish_mps} m/s{overridden}>")
    }
}

/// The brain of one UAV of a chain, as it flies (Laclau 2021, Algorithm 1 and section 4.3): it takes off, filters its
/// links, levels them or follows its pilot, and stays in mid-tunnel.
///
/// `role` is "relay" or "head"; whoever is told place 0 is the head. Parameters are dicts with the keys of a scenario's
/// tables `kalman`, `equalize`, `center`, `takeoff`, `link`.
///
/// Raises `TypeError` of an unknown parameter, `ValueError` of one out of its range.
///
/// >>> from uchain.laws import Heard, Node, Observation
/// >>> relay = Node("relay", takeoff={"rise_s": 0.0, "hover_s": 0.0})
/// >>> relay.decide(Observation(place=1, heard=[])).airborne  # nothing heard, no reason to fly
/// False
#[pyclass(frozen, module = "uchain.laws")]
pub(super) struct Node(Mutex<chain::Node>);

impl Node {
    fn node(&self) -> MutexGuard<'_, chain::Node> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Node {
    #[new]
    #[pyo3(signature = (role="relay", *, kalman=None, equalize=None, center=None, takeoff=None, link=None, tof_range_m=2.0))]
    fn new(
        role: &str,
        kalman: Option<&Bound<'_, PyDict>>,
        equalize: Option<&Bound<'_, PyDict>>,
        center: Option<&Bound<'_, PyDict>>,
        takeoff: Option<&Bound<'_, PyDict>>,
        link: Option<&Bound<'_, PyDict>>,
        tof_range_m: f32,
    ) -> PyResult<Self> {
        let params = NodeParams {
            kalman: from_keywords(kalman)?,
            equalize: from_keywords(equalize)?,
            center: from_keywords(center)?,
            takeoff: from_keywords(takeoff)?,
            link: from_keywords(link)?,
            tof_range_m: range(tof_range_m)?,
        };
        let role = words::choice("role", role, &words::ROLES)?;
        Ok(Self(Mutex::new(chain::Node::new(role, params))))
    }

    /// One decision: what it asks of its body.
    fn decide(&self, seen: &Observation) -> Command {
        let chain::Command { forward_mps, lateral_mps, yaw_rate_radps, airborne } =
            self.node().decide(&seen.0);
        Command { forward_mps, lateral_mps, yaw_rate_radps, airborne }
    }

    /// What it tells whoever hears it, before it decides on the same observation.
    fn say(&self, seen: &Observation) -> Packet {
        let packet = self.node().say(&seen.0);
        Packet {
            place: packet.place,
            ground_speed_mps: packet.ground_speed_mps,
            flown_s: packet.flown_s,
            follow: packet.follow.word(),
            imbalance_db: packet.imbalance_db,
            battery: packet.battery,
        }
    }

    /// What it makes of its two links.
    #[getter]
    fn estimates(&self) -> Estimates {
        let chain::Estimates { back, front, allowed_mps } = self.node().estimates();
        Estimates {
            back_db: back.filtered_db,
            back_raw_db: back.raw_db,
            back_silent_s: back.silent_s,
            front_db: front.filtered_db,
            front_raw_db: front.raw_db,
            front_silent_s: front.silent_s,
            allowed_mps,
        }
    }

    /// What it believes now, and why it asks for what it asks, given what it sees.
    fn explain(&self, seen: &Observation) -> Option<Explanation> {
        let told = self.node().explain(&seen.0)?;
        Some(Explanation {
            role: told.role.word(),
            place: told.place,
            stage: told.stage.word(),
            imbalance_db: told.imbalance_db,
            wish_mps: told.wish_mps,
            overridden: told.overridden.map(chain::Override::word),
            follow: told.follow.word(),
            walls: told.walls.map(Walls::word),
            speed_share: told.speed_share,
        })
    }

    fn __repr__(&self) -> String {
        format!("<uchain.laws.Node: {}>", self.node().role().word())
    }
}
