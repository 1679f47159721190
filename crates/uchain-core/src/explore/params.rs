//! Every number of an exploration (Kim 2021, §7.2).

use super::{EdgeRule, StrategyKind, Taken};

crate::params! {
    /// How a team explores. All robots of a team fly by the same.
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct ExploreParams {
        /// Who chooses where to fly, and what robots do that would meet.
        /// - Source: Kim 2021, §7.2
        pub strategy: StrategyKind = StrategyKind::CSSG;
        /// Equal sectors of a star; sector 0 begins at the map's x axis.
        /// - Symbol: `I_max`
        /// - Source: Kim 2021, §7.2
        pub sectors: u16 = 18, in 4..=360;
        /// Range of a scan (m). A wall at exactly this distance is seen.
        /// - Symbol: `R_s`
        /// - Source: Kim 2021, §7.2
        pub r_s_m: f32 = 1.0, in 0.05..=100.0;
        /// Share of a frontier's radius that a move covers (1).
        /// - Symbol: α
        /// - Source: Kim 2021, §6.1.2
        pub alpha: f32 = 0.8, in 0.5..=0.95;
        /// Least distance of a new node to a node that sees it, as a share of `r_s_m` (1). But for it, and for the
        /// arcs that are spent on arrival, a robot would make nodes at a wall at the range of its scan for ever.
        /// - Symbol: `d_min`
        /// - Source: Kim 2021, Algorithm 1; the value is ours
        pub d_min_share: f32 = 0.1, in 0.0..=0.4;
        /// Whether an arc is a frontier as long as its mid-point, or an end of it that lies at a wide gap, is uncovered,
        /// instead of its mid-point alone. By mid-points alone two nodes that look through one door from both sides may
        /// cover each other's arcs, and the room behind is never seen; by ends a team flies up to a quarter more.
        /// - Source: Kim 2021, §4.1 (mid-points, and ends where there is a wide gap)
        pub arc_ends: bool = false;
        /// From what gap on an end counts, if ends do: how much shorter the sector beside it is than its own, as a share
        /// of `r_s_m` (1). With 0 all ends count; with more, those beside a wall that is near.
        /// - Source: ours; Kim 2021, §4.1, does not say what is wide
        pub arc_gap_share: f32 = 0.5, in 0.0..=1.0;
        /// How far inside another star a point of an arc must lie to be covered (m). Without it two nodes at one place
        /// would cover each other's arcs by the rounding of their distance.
        /// - Source: ours
        pub cover_margin_m: f32 = 0.001, in 0.0..=10.0;
        /// Radius of a robot, by which a scan grows obstacles (m).
        /// - Source: ours
        pub r_body_m: f32 = 0.1, in 0.0..=10.0;
        /// Air left between two robots on one level (m).
        /// - Source: ours
        pub clearance_m: f32 = 0.05, in 0.0..=10.0;
        /// Height of the lowest level (m).
        /// - Source: Kim 2021, §7.2
        pub level_low_m: f32 = 0.5, in 0.0..=100.0;
        /// Height between two levels (m). The second is flown unless robots meet, added ones lie above the third.
        /// - Source: Kim 2021, §7.2
        pub level_step_m: f32 = 0.5, in 0.01..=100.0;
        /// Which nodes are connected, beside those flown between.
        /// - Source: Kim 2021, Eq. 8
        pub edges: EdgeRule = EdgeRule::Visible;
        /// What targets that were announced this round are to a choice, beside conflicts; the same to every strategy.
        /// - Source: Kim 2021, Eq. 7
        pub taken: Taken = Taken::Ignored;
        /// What a metre of way costs, in metres of frontier arc, with the strategy `utility` (1).
        /// - Symbol: β
        /// - Source: Burgard 2005, Algorithm 1; the value is ours
        pub utility_beta: f32 = 1.0, in 0.0..=100.0;
        /// Difference of objectives (Eq. 7) or of ways to a hub that counts as none (m).
        /// - Source: ours
        pub tie_m: f32 = 0.001, in 0.0..=1.0;
        /// Difference of two turns that counts as none (rad).
        /// - Source: ours
        pub tie_turn_rad: f32 = 0.01, in 0.0..=1.0;
        /// Nodes of the whole team at which no more are made and all fly home: the bound on memory and time.
        /// - Source: ours
        pub nodes_max: u32 = 20_000, in 2..=1_000_000;
    }
}

impl ExploreParams {
    /// The level that is flown unless robots meet; the middle one of three.
    pub const USUAL_LEVEL: u16 = 1;

    /// Distance between two robots on one level below which they are in conflict (m).
    pub fn conflict_m(&self) -> f32 {
        2.0 * self.r_body_m + self.clearance_m
    }

    /// Height of a level (m), counted from 0.
    pub fn height_m(&self, level: u16) -> f32 {
        self.level_low_m + f32::from(level) * self.level_step_m
    }
}
