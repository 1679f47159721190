//! The table `[faults]`: what can go wrong with a radio beyond chance, and UAVs that fail.

use serde::{Deserialize, Serialize};

uchain_core::params! {
    /// Planned faults of a mission; none by default.
    #[derive(Serialize, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct FaultConfig {
        /// Chance that a burst of losses begins at a packet, per packet and link end (1).
        /// - Source: Gilbert 1960
        pub burst_rate: f32 = 0.0, in 0.0..=1.0;
        /// Mean length of a burst (packets).
        /// - Source: Gilbert 1960
        pub burst_packets: f32 = 10.0, in 1.0..=100_000.0;
        /// Links that work one way only.
        pub deaf: Vec<Deaf> = Vec::new();
        /// UAVs that fail: from then on they neither fly nor speak.
        pub dead: Vec<Dead> = Vec::new();
    }
}

uchain_core::params! {
    /// A UAV that hears nothing from one side for a while.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Deaf {
        /// The UAV, 0 = head; one of the chain.
        pub uav: usize, in 0..=999;
        /// The neighbour it does not hear.
        pub side: DeafSide;
        /// From when on (s).
        /// - Source: ours
        #[serde(default)]
        pub start_s: f64, in 0.0..=86_400.0;
        /// Until when (s), later than `start_s`; to the end if left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = 86_400.0))]
        pub stop_s: Option<f64>;
    }
}

/// A side, as in a scenario file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum DeafSide {
    /// Toward the base.
    Back,
    /// Toward the head.
    Front,
}

uchain_core::params! {
    /// A UAV that fails for good. Its neighbours listen to the next UAV in line from that moment on, their filters going
    /// on with what they knew of the old link.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Dead {
        /// The UAV, 0 = head; one of the chain.
        pub uav: usize, in 0..=999;
        /// When (s).
        pub start_s: f64, in 0.0..=86_400.0;
    }
}
