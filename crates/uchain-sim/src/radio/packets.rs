//! The table `[packets]`: which of them arrive, and as what.

uchain_core::params! {
    /// Delivery of packets (Laclau 2021, §6.1).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct PacketParams {
        /// Share of packets lost at random (1).
        /// - Source: Laclau 2021, §6.1.2; none in the published runs
        pub drop_rate: f32 = 0.2, in 0.0..=1.0;
        /// Measured loss from which on no packet is delivered (dB); a link at or above it is not connected.
        /// - Source: the authors' simulator
        pub limit_db: f32 = 100.0, in -50.0..=1000.0;
        /// Width of the limit (dB): a packet of measured loss `s` arrives with chance `1 / (1 + exp((s - limit_db) / soft_db))`, half
        /// of them at the limit; 0 for a limit that all below it pass and none beyond.
        /// - Source: the shape: the transitional region of Zuniga & Krishnamachari 2004; the values are ours
        pub soft_db: f32 = 0.0, in 0.0..=50.0;
        /// Time from sending to hearing (ticks of 0.05 s).
        /// - Source: Laclau 2021, §6.1.1 (none)
        pub delay_ticks: u32 = 0, in 0..=1000;
        /// Whether packets of a chain are sent as bytes, as between drones, and arrive in their steps: a speed to 1 mm/s.
        /// - Source: ours (`uchain_core::wire`); at most 30 bytes, as in the authors' firmware
        pub wire: bool = false;
    }
}
