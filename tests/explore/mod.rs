//! A team explores rooms by scans and messages alone (Kim 2021).

mod graph;
mod input;
mod missions;
mod rooms;
mod team;
mod world;
