//! Laclau 2021 (U-Chain): a relay chain of UAVs that equalizes the losses of its links.

mod exploration;
mod fig4abc;
mod fig4d;
mod fig4e;
mod fig4f;
mod fig6;
mod page;
mod trace;

pub(super) use exploration::Exploration;
pub(super) use fig4abc::FIG4ABC;
pub(super) use fig4d::FIG4D;
pub(super) use fig4e::FIG4E;
pub(super) use fig4f::FIG4F;
pub(super) use fig6::FIG6;
