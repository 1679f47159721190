//! What people see of an exploration.

mod words;

use std::sync::Arc;

use serde::Serialize;

use super::{Exploration, ExploreFrame, ExploreHistory, ExploreSummary, ExploreTimeline, Progress, Site};
use crate::{
    mission::{self, Graph, Keep, Logbook, Shown},
    record::RecordError,
};

impl Shown for Exploration {
    type History = ExploreHistory;
    type Timeline = ExploreTimeline;
    /// Nobody knows how long it takes.
    const RUNS_TO_THE_END: bool = false;
    /// The explored map as a ROS map, and what robots were about over time.
    const FILES: &'static [&'static str] = &["map.pgm", "map.yaml", "states.png"];

    fn text(summary: &ExploreSummary, wall_s: Option<f64>, files: &str) -> String {
        words::text(summary, wall_s, files)
    }

    #[cfg(feature = "sweep")]
    fn columns() -> &'static [crate::analyse::Field<ExploreSummary>] {
        &super::metrics::COLUMNS
    }

    fn logbook(
        site: &Arc<Site>,
        frames: Option<Keep>,
    ) -> Result<Option<Box<dyn Logbook<Self>>>, RecordError> {
        super::logbook::logbook(site, frames)
    }

    fn graph(history: &ExploreHistory) -> Option<Graph> {
        Some(super::logbook::graph(history))
    }

    #[cfg(feature = "draw")]
    fn picture(
        site: &Arc<Site>,
        history: &mut ExploreHistory,
        metrics: &super::ExploreMetrics,
        summary: &ExploreSummary,
    ) -> Result<Vec<u8>, crate::draw::DrawError> {
        super::explore_png(site, history, &metrics.survey(), summary)
    }

    #[cfg(feature = "draw")]
    fn files(
        site: &Arc<Site>,
        history: &mut ExploreHistory,
        summary: &ExploreSummary,
    ) -> Result<Vec<Vec<u8>>, crate::draw::DrawError> {
        let states = super::states_png(site, history, summary)?;
        let r_s_m = site.scenario.params.r_s_m;
        let map = super::RosMap::explored(&site.map, site.ground(), &history.nodes, r_s_m);
        Ok(vec![map.pgm, map.yaml.into_bytes(), states])
    }
}

impl mission::History for ExploreHistory {
    type Mission = Exploration;

    fn of(_: &Site) -> Self {
        Self::default()
    }

    fn progress(&self, frame: &ExploreFrame) -> String {
        let (time_s, rounds, nodes, hubs) = (frame.time_s(), frame.rounds, self.nodes.len(), frame.hubs);
        format!("{time_s:.0} s, round {rounds}: {nodes} nodes, {hubs} with a frontier")
    }
}

/// Rounds of an exploration.
#[derive(Debug, Serialize)]
pub struct Rounds {
    progress: Vec<Progress>,
}

impl mission::Timeline for ExploreTimeline {
    type Mission = Exploration;
    type Kept = Rounds;

    fn of(_: &Site, wanted: usize) -> Self {
        Self::new(wanted)
    }

    fn kept(self) -> Rounds {
        Rounds { progress: self.into_rounds() }
    }

    fn table(kept: &Rounds, rows: usize) -> String {
        words::table(&kept.progress, rows)
    }
}
