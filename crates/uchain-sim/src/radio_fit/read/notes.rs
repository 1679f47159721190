//! What one should know of how a log was read.

use super::{
    ReadOptions,
    columns::Of,
    header::{Header, looks_meant},
};

/// What was met on the way.
#[derive(Debug, Default)]
pub(super) struct Counts {
    /// Packets that a gap in `seq` tells of.
    pub(super) gaps: usize,
    /// Places where `seq` starts anew.
    pub(super) breaks: usize,
    /// Packets without a place.
    pub(super) no_place: usize,
    /// Readings of exactly 0.
    pub(super) zeros: usize,
}

impl Counts {
    pub(super) fn words(&self, header: &Header, options: &ReadOptions, has_places: bool) -> Vec<String> {
        let mut notes = Vec::new();
        let is_rssi = header.losses.iter().any(|losses| losses.column.of == Of::Rssi);
        if is_rssi && options.tx_dbm.is_none() {
            notes.push(
                "the loss is taken as minus the received power, as packets sent with 0 dBm would have it: --tx-dbm says another power"
                    .to_owned(),
            );
        }
        if self.gaps > 0 {
            notes.push(format!("{} packets were not heard by gaps in seq, and are put on the straight way between those that were", self.gaps));
        }
        if self.breaks > 0 {
            notes.push(format!(
                "seq starts anew or leaps in {} places: no packet is counted as lost there",
                self.breaks
            ));
        }
        if self.no_place > 0 {
            notes.push(format!("{} packets without a place or distance are left out", self.no_place));
        }
        if self.zeros > 0 {
            notes.push(format!(
                "{} readings are exactly 0: where that stands for a packet that was not heard, add --lost 0",
                self.zeros
            ));
        }
        if !has_places {
            notes.push("distances only: all packets of a distance count as packets of one place".to_owned());
        }
        // Where names are mapped, what is not named is not meant.
        let unmeant = header
            .left_out
            .iter()
            .filter_map(|name| looks_meant(name))
            .filter(|_| options.mapping.is_empty());
        notes.extend(unmeant.map(|words| format!("not read: {words}")));
        notes
    }
}
