//! A decision in a few numbers, as a message.

use crate::mission::chain::Moment;

/// `uchain.Metrics`.
#[derive(Clone, Copy, PartialEq, prost::Message)]
pub(in crate::mission::chain::mcap) struct MetricsMessage {
    #[prost(uint32, tag = "1")]
    uavs: u32,
    #[prost(float, tag = "2")]
    head_reach_m: f32,
    #[prost(float, tag = "3")]
    worst_link_db: f32,
    #[prost(float, tag = "4")]
    spread_db: f32,
    #[prost(bool, tag = "5")]
    connected: bool,
    #[prost(uint32, tag = "6")]
    wall_contacts: u32,
    #[prost(uint32, tag = "7")]
    uav_contacts: u32,
}

impl From<Moment> for MetricsMessage {
    fn from(moment: Moment) -> Self {
        Self {
            uavs: moment.uavs as u32,
            head_reach_m: moment.head_reach_m,
            worst_link_db: moment.worst_link_db.unwrap_or(f32::NAN),
            spread_db: moment.spread_db.unwrap_or(f32::NAN),
            connected: moment.connected.unwrap_or_default(),
            wall_contacts: moment.wall_contacts,
            uav_contacts: moment.uav_contacts,
        }
    }
}
