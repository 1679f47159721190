//! The question that a relay's law answers: what is known of its two links.

use super::super::{LinkEstimate, Tof};

/// What a relay levels its two links by at one decision: see [`Node::prepare`](super::Node::prepare).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Levelling {
    /// Loss of the link toward the base, by the signal it decides on (dB).
    pub back_db: f32,
    /// Loss of the link toward the head, by the signal it decides on (dB).
    pub front_db: f32,
    /// All it makes of the link toward the base.
    pub back: LinkEstimate,
    /// All it makes of the link toward the head.
    pub front: LinkEstimate,
    /// Its place in the chain, as far as it knows.
    pub place: u16,
    /// Its own forward ground speed by optic flow (m/s); `None` without a measurement.
    pub ground_speed_mps: Option<f32>,
    /// Distances to the walls, if they were measured at this instant.
    pub tof: Option<Tof>,
}
