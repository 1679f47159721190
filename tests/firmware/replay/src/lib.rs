//! Flies recorded observations again, on a microcontroller and on a host: what a brain asks for and what it believes, bit
//! by bit, with the instructions of every call.
//!
//! A *trace* holds what every UAV could know, instant by instant ([`Record`]); the simulator writes it. [`replay`] shows it
//! to the same laws and writes a *result*, rows of plain numbers ([`rows`]). Results of the simulator, of a host and of a
//! chip are equal byte for byte, or the laws have not the same bits everywhere.
//!
//! Bytes come and go through [`Input`] and [`Output`]: no file, no clock, and without explorers no heap. Whatever stands in
//! a trace, nothing panics: what cannot be read is a [`Fault`].
#![no_std]

#[cfg(feature = "explore")]
extern crate alloc;

mod chain;
mod fault;
mod frames;
mod laws;
mod meter;
pub mod rows;
#[cfg(feature = "explore")]
pub mod team;
mod trace;

pub use chain::UAVS_MAX;
pub use fault::{Cause, Fault};
pub use frames::{FRAME_MAX, Frames, Input, Output, Short};
pub use meter::{Call, Count, Heap, Meter, Tally, Unmetered};
#[cfg(feature = "explore")]
pub use trace::{DRAWS_MAX, SECTORS_MAX};
pub use trace::{Record, TRACE_MAGIC, TooLong, TraceWriter};

use chain::Chain;
use meter::Metered;
use rows::RowWriter;

/// Version of trace and result; it goes up with every change of either.
pub const VERSION: u8 = 1;

/// A fault that is planted, so that a comparison that finds none is known to look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Plant {
    /// None.
    #[default]
    None,
    /// Whatever [`equalize`](uchain_core::chain::equalize) gives is the next larger `f32`.
    Equalize,
    /// The first reading of a trace is the next larger `f32`: the loss of one packet, or one return of one scan.
    Reading,
}

/// Flies a trace again and writes what came of it.
///
/// # Errors
/// [`Fault`]: what of the trace cannot be read. Rows up to there have been written.
pub fn replay(
    input: &mut impl Input,
    output: &mut impl Output,
    meter: &mut impl Meter,
    plant: Plant,
) -> Result<Tally, Fault> {
    let mut frames = Frames::open(input, TRACE_MAGIC)?;
    let mut rows = RowWriter::begin(output);
    let mut metered = Metered::new(meter);
    let mut chain = Chain::new(plant);
    #[cfg(feature = "explore")]
    let mut team = team::Flight::new(plant);
    loop {
        let place = frames.count();
        let bytes = frames.read()?;
        let record = Record::read(bytes).ok_or(Fault { place, cause: Cause::Malformed })?;
        let done = match record {
            Record::Chain { name, uavs } => {
                #[cfg(feature = "explore")]
                team.leave(&mut metered);
                rows.mission(name);
                chain.begin(uavs)
            }
            Record::Uav { uav, role, params } => chain.join(uav, role, params),
            Record::Seen { tick, uav, seen } => chain.see(tick, uav, seen, &mut metered, &mut rows),
            Record::End { records } => {
                #[cfg(feature = "explore")]
                team.leave(&mut metered);
                frames.end(records)?;
                rows.end();
                return Ok(metered.tally);
            }
            #[cfg(feature = "explore")]
            Record::Team { name, robots, alone, params } => {
                team.leave(&mut metered);
                rows.mission(name);
                team.begin(robots, alone, params, &mut metered)
            }
            #[cfg(feature = "explore")]
            Record::Scanned { robot, pose, scan } => team.perceive(robot, pose, scan, &mut metered),
            #[cfg(feature = "explore")]
            Record::Heard { message } => team.hear(&message, &mut metered),
            #[cfg(feature = "explore")]
            Record::Announces { robot, draws } => team.announce(robot, &draws, &mut metered),
            #[cfg(feature = "explore")]
            Record::Rules { round } => team.rule(round, &mut metered, &mut rows),
        };
        done.map_err(|cause| Fault { place, cause })?;
    }
}
