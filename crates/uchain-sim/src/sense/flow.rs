//! Optic flow: forward speed over ground.

use crate::{seed::Stream, world::Body};

uchain_core::params! {
    /// Optic-flow sensor.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct FlowParams {
        /// Standard deviation of the measured forward speed (m/s).
        /// - Source: ours
        pub noise_mps: f32 = 0.02, in 0.0..=10.0;
    }
}

/// Measured instead of true speed.
#[derive(Debug, Clone)]
pub struct FlowNoise {
    stream: Stream,
    params: FlowParams,
}

impl FlowNoise {
    /// The sensor of one robot.
    pub fn new(stream: Stream, params: FlowParams) -> Self {
        Self { stream, params }
    }

    /// Forward ground speed of a body as measured (m/s); 0 on the ground, where nobody asks.
    pub fn read(&mut self, body: &Body) -> f32 {
        // Drawn in any case, so that the time of a take-off moves nobody's draws.
        let noise = self.stream.draw_normal();
        if body.airborne { body.forward_mps() + self.params.noise_mps * noise.value() } else { 0.0 }
    }
}
