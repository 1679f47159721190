//! The numbers of an exploration in the table of a sweep.

use super::ExploreSummary;
use crate::analyse::{Cell, Field, Kind};

/// What an exploration came to.
pub(in super::super) const COLUMNS: [Field<ExploreSummary>; 34] = [
    ("strategy", Kind::Text, |s| Cell::word(&s.strategy)),
    ("vehicle", Kind::Text, |s| Cell::word(&s.vehicle)),
    ("robots", Kind::Count, |s| u32::from(s.robots).into()),
    ("sim_s", Kind::Number, |s| s.sim_s.into()),
    ("iterations", Kind::Count, |s| s.iterations.into()),
    ("moves", Kind::Numbers, |s| Cell::list(s.moves.iter().copied())),
    ("holds", Kind::Numbers, |s| Cell::list(s.holds.iter().copied())),
    ("distance_m", Kind::Numbers, |s| Cell::list(s.distance_m.iter().copied())),
    ("distance_mean_m", Kind::Number, |s| s.distance_mean_m().into()),
    ("distance_3d_m", Kind::Numbers, |s| Cell::list(s.distance_3d_m.iter().copied())),
    ("mfl_s", Kind::Number, |s| s.mfl_s.into()),
    ("coverage", Kind::Number, |s| s.coverage.into()),
    ("coverage_t50_s", Kind::Number, |s| s.coverage_t50_s.into()),
    ("coverage_t90_s", Kind::Number, |s| s.coverage_t90_s.into()),
    ("coverage_t100_s", Kind::Number, |s| s.coverage_t100_s.into()),
    ("overlap", Kind::Number, |s| s.overlap.into()),
    ("balance", Kind::Number, |s| s.balance.into()),
    ("nodes", Kind::Numbers, |s| Cell::list(s.nodes.iter().copied())),
    ("nodes_total", Kind::Count, |s| s.nodes.iter().sum::<u32>().into()),
    ("edges", Kind::Count, |s| s.edges.into()),
    ("hubs_left", Kind::Count, |s| s.hubs_left.into()),
    ("unseen_m2", Kind::Number, |s| s.unseen_m2.into()),
    ("unseen_behind_m2", Kind::Number, |s| s.unseen_behind_m2.into()),
    ("shut_off_m2", Kind::Number, |s| s.shut_off_m2.into()),
    ("wall_contacts", Kind::Count, |s| s.wall_contacts.into()),
    ("robot_contacts", Kind::Count, |s| s.robot_contacts.into()),
    ("level_passes", Kind::Count, |s| s.level_passes.into()),
    ("downwash_s", Kind::Numbers, |s| Cell::list(s.downwash_s.iter().copied())),
    ("downwash_total_s", Kind::Number, |s| s.downwash_s.iter().sum::<f64>().into()),
    ("moves_total", Kind::Count, |s| s.moves.iter().sum::<u32>().into()),
    ("holds_total", Kind::Count, |s| s.holds.iter().sum::<u32>().into()),
    ("outcome", Kind::Text, |s| s.verdict.outcome().word().into()),
    ("verdict", Kind::Text, |s| s.verdict.to_string().as_str().into()),
    ("digest", Kind::Text, |s| s.digest.as_str().into()),
];
