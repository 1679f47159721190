//! A head and three relays fly down a tunnel, by every preset, with whatever goes wrong on the way.

use std::{error::Error, fs, path::Path};

use uchain_core::{
    chain::{BASE_ID, Follow, Observation, Packet, PilotInput, Role},
    wire::{self, Message, SIZE_MAX},
};

use crate::{
    steps::{Files, Preset},
    trace,
    world::{Body, Chance},
};

/// How long each preset is flown for (ticks of 0.05 s).
const TICKS: u32 = 3_000;
/// Who falls silent, and when (ticks): whoever is behind comes one place nearer to the head.
const FALLEN: (usize, u32) = (2, 2_000);

pub(crate) fn write(folder: &Path, recorded: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let mut files = Files::default();
    for preset in Preset::ALL {
        fly(preset, &mut files);
    }
    if let Some(recorded) = recorded {
        trace::fly(recorded, &mut files)?;
    }
    files.end();
    fs::create_dir_all(folder)?;
    fs::write(folder.join("asked.bin"), files.asked)?;
    fs::write(folder.join("expected.bin"), files.expected)?;
    Ok(())
}

fn fly(preset: Preset, files: &mut Files) {
    let mut chance = Chance::new(preset as u32 + 1);
    let period = (preset.params().equalize.decision_s * 20.0 + 0.5) as u32;
    let mut uavs: Vec<_> = (0..4)
        .map(|number: u8| {
            let role = if number == 0 { Role::Head } else { Role::Relay };
            files.uav(number, 40 + u16::from(number), role, preset)
        })
        .collect();
    let mut bodies = [Body::default(); 4];
    // What each said last, and where it was: it is heard by the next decision.
    let mut said: [Vec<u8>; 4] = Default::default();

    for tick in 0..TICKS {
        let has_fallen = |uav: usize| uav == FALLEN.0 && tick >= FALLEN.1;
        for uav in 0..uavs.len() {
            if has_fallen(uav) {
                continue;
            }
            // Decisions are not all due at once, and nobody hears anybody for a while.
            let is_due = tick % period == uav as u32 % period;
            let is_deaf = (1_400..1_480).contains(&tick) && uav == 1;
            let body = bodies[uav];
            if is_due && !is_deaf {
                for other in (0..said.len()).filter(|other| *other != uav && !has_fallen(*other)) {
                    if !said[other].is_empty() && !chance.happens(0.2) {
                        let loss_db = body.loss_db(bodies[other].at_m, &mut chance);
                        files.hear(&mut uavs[uav], &said[other], loss_db);
                    }
                }
                let mut base = [0; SIZE_MAX];
                let sequence = (tick / period) as u8;
                let message = Message { from: BASE_ID, sequence, packet: Packet::BASE };
                let length = wire::encode(&message, &mut base);
                let loss_db = body.loss_db(0.0, &mut chance);
                files.hear(&mut uavs[uav], &base[..length], loss_db);
            }
            let place = if uav > FALLEN.0 && tick >= FALLEN.1 { uav - 1 } else { uav };
            let seen = Observation {
                place: (tick % 20 == 0 || tick == FALLEN.1).then_some(place as u16),
                tof: (tick % 2 == 0).then(|| body.tof(&mut chance)),
                radio: None,
                ground_speed_mps: (!chance.happens(0.05)).then(|| body.speed_mps + chance.within(0.02)),
                battery: chance.happens(0.5).then(|| 1.0 - tick as f32 / 6_000.0),
                pilot: (uav == 0).then(|| pilot(tick)),
            };
            let (bytes, command) = files.step(&mut uavs[uav], seen, is_due);
            if is_due {
                said[uav] = bytes;
            }
            if command.airborne {
                bodies[uav].fly(command.forward_mps, command.lateral_mps);
            }
        }
    }
}

/// Into the tunnel, along one wall and the other, and part of the way back.
fn pilot(tick: u32) -> PilotInput {
    match tick {
        0..800 => PilotInput { speed_mps: 0.2, follow: Follow::Centre },
        800..1_600 => PilotInput { speed_mps: 0.3, follow: Follow::Left },
        1_600..2_400 => PilotInput { speed_mps: 0.25, follow: Follow::Right },
        _ => PilotInput { speed_mps: -0.2, follow: Follow::Centre },
    }
}
