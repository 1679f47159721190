//! Kim 2021 (CSSG): cooperative multi-robot exploration.

mod comparison;
mod cooperation;
mod fig10;
mod fig11;
mod fig9;
mod table1;

pub(super) use cooperation::COOPERATION;
pub(super) use fig9::FIG9;
pub(super) use fig10::FIG10;
pub(super) use fig11::FIG11;
pub(super) use table1::TABLE1;
