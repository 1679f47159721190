//! Flights that the simulator recorded: what its UAVs saw, their packets as bytes.

use std::{error::Error, fs, path::Path};

use replay::{Frames, Record, TRACE_MAGIC};
use uchain_core::{
    chain::Observation,
    wire::{self, Message, SIZE_MAX},
};

use crate::steps::{Files, Preset, Uav};

/// Shows all chains of a trace to nodes.
pub(crate) fn fly(trace: &Path, files: &mut Files) -> Result<(), Box<dyn Error>> {
    let name = trace.display();
    let bytes = fs::read(trace).map_err(|error| format!("{name}: {error}"))?;
    let mut bytes = bytes.as_slice();
    let mut frames = Frames::open(&mut bytes, TRACE_MAGIC).map_err(|fault| format!("{name}: {fault}"))?;
    let mut uavs: Vec<Uav> = Vec::new();
    loop {
        let record = frames.read().map_err(|fault| format!("{name}: {fault}"))?;
        match Record::read(record).ok_or_else(|| format!("{name}: a record that cannot be read"))? {
            Record::Chain { .. } => uavs.clear(),
            Record::Uav { uav, role, params } => {
                let preset = Preset::ALL.into_iter().find(|preset| preset.params() == params);
                let preset = preset.ok_or_else(|| format!("{name}: UAV {uav} flies by no preset"))?;
                uavs.push(files.uav(uav, uav.into(), role, preset));
            }
            Record::Seen { uav, seen, .. } => {
                let node =
                    uavs.get_mut(usize::from(uav)).ok_or_else(|| format!("{name}: who is UAV {uav}?"))?;
                show(files, node, seen);
            }
            Record::End { .. } => return Ok(()),
        }
    }
}

fn show(files: &mut Files, uav: &mut Uav, mut seen: Observation) {
    let radio = seen.radio.take();
    let is_due = radio.is_some();
    for heard in radio.iter().flat_map(|slot| slot.heard()) {
        let mut bytes = [0; SIZE_MAX];
        let message = Message { from: heard.from, sequence: 0, packet: heard.packet };
        let length = wire::encode(&message, &mut bytes);
        files.hear(uav, &bytes[..length], heard.loss_db);
    }
    let _ = files.step(uav, seen, is_due);
}
