//! What people see of a chain.

mod history;
pub(super) mod plan;
mod words;

use std::sync::Arc;

use serde::Serialize;

use super::{Chain, Course, Moment, Summary, Timeline};
use crate::{
    mission::{self, Keep, Logbook, Shown},
    record::RecordError,
};

pub use history::ThinnedHistory;
pub use plan::{PlanSteps, PlanTable, everywhere_csv, places_csv, places_geojson};

impl Shown for Chain {
    type History = ThinnedHistory;
    type Timeline = Timeline;
    const RUNS_TO_THE_END: bool = true;

    fn text(summary: &Summary, wall_s: Option<f64>, files: &str) -> String {
        words::text(summary, wall_s, files)
    }

    #[cfg(feature = "sweep")]
    fn columns() -> &'static [crate::analyse::Field<Summary>] {
        &super::metrics::COLUMNS
    }

    fn logbook(
        course: &Arc<Course>,
        frames: Option<Keep>,
    ) -> Result<Option<Box<dyn Logbook<Self>>>, RecordError> {
        super::logbook::logbook(course, frames)
    }

    #[cfg(feature = "draw")]
    fn picture(
        course: &Arc<Course>,
        history: &mut ThinnedHistory,
        _: &super::Metrics,
        summary: &Summary,
    ) -> Result<Vec<u8>, crate::draw::DrawError> {
        super::run_png(course, history.to_the_end(), summary)
    }
}

/// Moments of a chain.
#[derive(Debug, Serialize)]
pub struct Moments {
    moments: Vec<Moment>,
}

impl mission::Timeline for Timeline {
    type Mission = Chain;
    type Kept = Moments;

    fn of(course: &Course, wanted: usize) -> Self {
        Self::new(wanted, course.scenario.link.lost_s)
    }

    fn kept(self) -> Moments {
        Moments { moments: self.into_moments() }
    }

    fn table(kept: &Moments, rows: usize) -> String {
        words::table(&kept.moments, rows)
    }
}
