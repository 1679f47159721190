//! The laws as a drone flies them: a loop of sense, decide, command. It asks for `uchain_core` alone, which needs neither
//! std nor a heap; what stands in for the drone here does not need them either.
//!
//! `cargo run --release --example embedded_node`
//!
//! ```text
//!   0 s: 0.00 m,  0.00 m/s
//!  20 s: 4.27 m,  0.06 m/s
//!  40 s: 4.50 m,  0.00 m/s
//!  60 s: 4.50 m,  0.00 m/s
//!  80 s: 4.50 m,  0.00 m/s
//! 100 s: 4.50 m,  0.00 m/s
//! back 57.5 dB, front 57.5 dB
//! ```

use uchain_core::chain::{
    BASE_ID, Brain as _, Command, Heard, Node, NodeParams, Observation, Packet, Role, Tof,
};

/// Rate of the control loop (Hz).
const LOOP_HZ: u32 = 20;

/// What the firmware has: sensors, a radio, motors. Replace each function by the one that asks the hardware.
struct Drone {
    /// Where it is in the tunnel (m). Only the stand-in for the world knows: the node is never told.
    at_m: f32,
    /// Its speed (m/s).
    speed_mps: f32,
    /// Half the width of the tunnel it is in the middle of (m).
    half_width_m: f32,
    /// What the radio driver sends next.
    outbox: Packet,
}

impl Drone {
    /// Loss over a tunnel, by its length (dB).
    fn loss_db(length_m: f32) -> f32 {
        35.0 + 5.0 * length_m
    }

    /// Forward ground speed by optic flow (m/s).
    fn optic_flow_mps(&self) -> f32 {
        self.speed_mps
    }

    /// The four diagonal beams (m).
    fn tof(&self) -> Tof {
        let clear_m = core::f32::consts::SQRT_2 * self.half_width_m;
        Tof { nw_m: clear_m, ne_m: clear_m, sw_m: clear_m, se_m: clear_m }
    }

    /// The packets that the radio driver has put by since the last decision: whose, how weak, what they say. A reading of
    /// the received power in dBm, its sign changed, is a loss.
    fn packets(&self) -> [Heard; 2] {
        // The head hovers at 9 m and has flown for a while; the base is at 0 m.
        let head = Packet { place: 0, flown_s: 60.0, ..Packet::default() };
        [
            Heard { from: 0, loss_db: Self::loss_db(9.0 - self.at_m), packet: head },
            Heard { from: BASE_ID, loss_db: Self::loss_db(self.at_m), packet: Packet::BASE },
        ]
    }

    /// Hands what the node says to the radio driver.
    fn send(&mut self, packet: Packet) {
        self.outbox = packet;
    }

    /// Asks the flight controller for a body velocity.
    fn fly(&mut self, command: Command) {
        self.speed_mps = if command.airborne { command.forward_mps } else { 0.0 };
        self.at_m += self.speed_mps / LOOP_HZ as f32;
    }
}

fn main() {
    // All tunables have published defaults; a few that one knows better are set.
    let mut params = NodeParams::default();
    params.takeoff.s_min_db = 60.0;
    let mut node = Node::new(Role::Relay, params);
    let mut drone = Drone { at_m: 0.0, speed_mps: 0.0, half_width_m: 0.4, outbox: Packet::default() };

    for tick in 0..LOOP_HZ * 120 {
        // ToF sensors bring something new at 10 Hz, and a decision is due at 5 Hz; in between there is nothing.
        let seen = Observation {
            place: Some(1),
            tof: tick.is_multiple_of(LOOP_HZ / 10).then(|| drone.tof()),
            radio: tick.is_multiple_of(LOOP_HZ / 5).then(|| drone.packets().into_iter().collect()),
            ground_speed_mps: Some(drone.optic_flow_mps()),
            ..Observation::default()
        };
        // Once a decision, before it is made.
        if seen.radio.is_some() {
            drone.send(node.say(&seen));
        }
        let command = node.decide(&seen);
        drone.fly(command);
        if tick.is_multiple_of(LOOP_HZ * 20) {
            println!("{:3} s: {:.2} m, {:5.2} m/s", tick / LOOP_HZ, drone.at_m, command.forward_mps);
        }
    }

    // The relay took off because the link to the head was too weak, and levelled its two links: half way.
    let link = node.estimates();
    println!(
        "back {:.1} dB, front {:.1} dB",
        link.back.filtered_db.unwrap_or(0.0),
        link.front.filtered_db.unwrap_or(0.0)
    );
    assert!((drone.at_m - 4.5).abs() < 0.3, "{} m", drone.at_m);
}
