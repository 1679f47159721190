//! Every number of a quadrotor.

crate::params! {
    /// A quadrotor and its law. Only `explore.vehicle = "quadrotor"` heeds it. A gain is an angular or vertical
    /// acceleration per error (p), or per error of its rate (d). Inertia is that of a flat disc of radius `arm_m`.
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct QuadrotorParams {
        /// Mass (kg).
        /// - Symbol: M
        /// - Source: Kim 2021, §7.2 (0.3; its §8.1 has 0.038)
        pub mass_kg: f32 = 0.3, in 0.005..=50.0;
        /// Distance of each rotor from the middle (m).
        /// - Symbol: l
        /// - Source: Kim 2021, §7.2 (0.2; its §8.1 has 0.1)
        pub arm_m: f32 = 0.2, in 0.01..=2.0;
        /// Greatest thrust of all rotors over the weight (1).
        /// - Source: ours
        pub thrust_to_weight: f32 = 2.0, in 1.2..=10.0;
        /// Torque of a rotor's drag per thrust (m), by which it turns about the vertical.
        /// - Source: ours
        pub drag_arm_m: f32 = 0.016, in 0.001..=1.0;
        /// Roll: gain on the angle (1/s²).
        /// - Symbol: `k_p,φ`
        /// - Source: Kim 2021, §7.2
        pub roll_p_per_s2: f32 = 50.7, in 0.1..=1000.0;
        /// Roll: gain on the rate (1/s).
        /// - Symbol: `k_d,φ`
        /// - Source: Kim 2021, §7.2
        pub roll_d_per_s: f32 = 20.7, in 0.1..=100.0;
        /// Pitch: gain on the angle (1/s²).
        /// - Symbol: `k_p,θ`
        /// - Source: Kim 2021, §7.2
        pub pitch_p_per_s2: f32 = 42.1, in 0.1..=1000.0;
        /// Pitch: gain on the rate (1/s).
        /// - Symbol: `k_d,θ`
        /// - Source: Kim 2021, §7.2
        pub pitch_d_per_s: f32 = 16.4, in 0.1..=100.0;
        /// Height: gain on the height (1/s²).
        /// - Symbol: `k_p,z`
        /// - Source: Kim 2021, §7.2
        pub height_p_per_s2: f32 = 15.0, in 0.1..=1000.0;
        /// Height: gain on the speed of climb (1/s).
        /// - Symbol: `k_d,z`
        /// - Source: Kim 2021, §7.2
        pub height_d_per_s: f32 = 7.2, in 0.1..=100.0;
        /// Yaw: gain on the angle (1/s²).
        /// - Symbol: `k_p,ψ`
        /// - Source: Kim 2021, §7.2
        pub yaw_p_per_s2: f32 = 18.8, in 0.1..=1000.0;
        /// Yaw: gain on the rate (1/s).
        /// - Symbol: `k_d,ψ`
        /// - Source: Kim 2021, §7.2
        pub yaw_d_per_s: f32 = 9.9, in 0.1..=100.0;
        /// Go-to: speed over ground per distance to go (1/s).
        /// - Source: ours
        pub go_to_per_s: f32 = 1.0, in 0.05..=10.0;
        /// Go-to: acceleration per error of speed (1/s).
        /// - Source: ours
        pub speed_per_s: f32 = 4.0, in 0.1..=50.0;
        /// Greatest tilt asked for (degrees).
        /// - Source: ours
        pub tilt_max_deg: f32 = 20.0, in 1.0..=60.0;
        /// Greatest yaw rate asked for (rad/s).
        /// - Source: ours
        pub yaw_max_radps: f32 = 2.0, in 0.05..=20.0;
        /// How near it has to be to its place to have arrived (m).
        /// - Source: ours
        pub arrive_m: f32 = 0.02, in 0.0001..=1.0;
        /// How slow it has to be to have arrived (m/s).
        /// - Source: ours
        pub arrive_mps: f32 = 0.05, in 0.0001..=10.0;
        /// How near its heading has to be to the one asked for, to have arrived (degrees).
        /// - Source: ours
        pub arrive_deg: f32 = 3.0, in 0.01..=180.0;
        /// Whether a robot that has arrived scans and decides as if it stood at the very place it was sent to, which
        /// makes rounds, nodes and targets those of a point mass; if not, it does from where it hovers.
        pub snap: bool = true;
    }
}
