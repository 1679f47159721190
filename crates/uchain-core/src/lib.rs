//! What flies on the drone: the U-Chain laws of Laclau 2021, without a heap and without std.
//!
//! A drone feeds a [`chain::Node`] with an [`chain::Observation`] whenever a sensor or the radio has
//! something new, and flies the [`chain::Command`] it gets back. No position enters, anywhere: what a
//! robot may know is in [`seam`] and [`chain::Observation`], in plain `f32` fields with the unit in the
//! name. Equations are cited as in the paper: Laclau, Tempez, Ruffier, Natalizio, Mouret,
//! "Signal-Based Self-Organization of a Chain of UAVs for Subterranean Exploration", 2021.
//!
//! Conventions: x forward, y left, angles counter-clockwise; radio is a *loss* in dB, bigger is worse.
#![no_std]

pub mod chain;
pub mod params;
pub mod seam;
