//! The numbers of a chain in the table of a sweep.

use super::{LinkSummary, Summary};
use crate::analyse::{Cell, Field, Kind};

/// What a chain came to.
pub(in super::super) const COLUMNS: [Field<Summary>; 22] = [
    ("sim_s", Kind::Number, |s| s.sim_s.into()),
    ("launches_s", Kind::Numbers, |s| Cell::list(s.launches_s.iter().copied())),
    ("launches", Kind::Count, |s| s.launches_s.len().into()),
    ("last_launch_s", Kind::Number, |s| s.launches_s.last().copied().into()),
    ("uavs", Kind::Count, |s| s.uavs.into()),
    ("relays_used", Kind::Count, |s| s.relays_used.into()),
    ("relays_needed", Kind::Count, |s| s.relays_needed.into()),
    ("bottleneck_gap_db", Kind::Single, |s| s.bottleneck_gap_db.into()),
    ("link_true_db", Kind::Singles, |s| Cell::list(s.links.iter().map(|link| link.true_db))),
    ("link_filtered_db", Kind::Singles, |s| Cell::list(s.links.iter().map(filtered_db))),
    ("spread_db", Kind::Single, |s| s.spread_db.into()),
    ("worst_link_db", Kind::Single, |s| s.worst_link_db.into()),
    ("converged_s", Kind::Number, |s| s.converged_s.into()),
    ("wall_contacts", Kind::Count, |s| s.wall_contacts.into()),
    ("uav_contacts", Kind::Count, |s| s.uav_contacts.into()),
    ("connected_fraction", Kind::Number, |s| s.connected_fraction.into()),
    ("below_limit_fraction", Kind::Number, |s| s.below_limit_fraction.into()),
    ("head_reach_m", Kind::Single, |s| s.head_reach_m.into()),
    ("head_flown_m", Kind::Single, |s| s.head_flown_m.into()),
    ("outcome", Kind::Text, |s| s.verdict.outcome().word().into()),
    ("verdict", Kind::Text, |s| s.verdict.to_string().as_str().into()),
    ("digest", Kind::Text, |s| s.digest.as_str().into()),
];

fn filtered_db(link: &LinkSummary) -> f32 {
    link.filtered_db.unwrap_or(f32::NAN)
}
