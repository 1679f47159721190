//! The optimum in a course: its tunnel, its radio, its depths.

use std::sync::Arc;

use crate::analyse::optimum::{BottleneckTable, MOST_LINKS, Optimum, TableKey, links_needed, optimum};
use crate::{map::Tunnel, mission::chain::Course};

/// Distance between the samples of a course's table (m), in tunnels short enough for [`SAMPLES`] of them.
const STEP_M: f64 = 0.05;
/// Most samples of a course's table.
const SAMPLES: f64 = 500.0;
/// The same where a loss takes a search, such as the way through the tunnel: hundreds of times the work.
const SAMPLES_WHERE_COSTLY: f64 = 120.0;

/// What the best chain in a course's tunnel comes to.
#[derive(Debug, Clone, Copy)]
pub struct CourseOptimum<'a> {
    course: &'a Course,
    tunnel: &'a Tunnel,
    table: &'a BottleneckTable,
}

impl Course {
    /// Loss between UAVs in mid-tunnel at two depths, flying along it, noise off (dB); depth 0 is the base. `None`
    /// without a tunnel of known middle.
    pub fn loss_at_depths_db(&self, a_m: f64, b_m: f64) -> Option<f64> {
        let antennas = [a_m, b_m].map(|depth_m| self.antenna_at(depth_m));
        let [Some(a), Some(b)] = antennas else { return None };
        Some(f64::from(self.loss_db(&a, &b)))
    }

    /// The optimum in this course; `None` without a tunnel of known middle. The first call draws the
    /// table, or takes it from a course of the same sweep that differs in other things.
    pub fn optimum(&self) -> Option<CourseOptimum<'_>> {
        let tunnel = self.tunnel.as_ref()?;
        let loss_db = |a_m, b_m| self.loss_at_depths_db(a_m, b_m).unwrap_or(f64::NAN);
        let depth_m = tunnel.length_m();
        let samples = if self.radio.is_costly() { SAMPLES_WHERE_COSTLY } else { SAMPLES };
        let step_m = STEP_M.max(depth_m / samples);
        let draw = || BottleneckTable::new(loss_db, depth_m, step_m, MOST_LINKS);
        let table = self.table.get_or_init(|| match self.radio.key() {
            Some(radio) => self.tables.get(TableKey::new(self.map.walls(), tunnel, radio), draw),
            None => Arc::new(draw()),
        });
        Some(CourseOptimum { course: self, tunnel, table })
    }
}

impl<'a> CourseOptimum<'a> {
    /// The tunnel.
    pub fn tunnel(&self) -> &'a Tunnel {
        self.tunnel
    }

    /// The best chains on samples of the depth.
    pub fn table(&self) -> &'a BottleneckTable {
        self.table
    }

    /// Loss between two depths (dB).
    pub fn loss_db(&self, a_m: f64, b_m: f64) -> f64 {
        self.course.loss_at_depths_db(a_m, b_m).unwrap_or(f64::NAN)
    }

    /// [`optimum`] for a head at this depth (m).
    pub fn optimum(&self, head_depth_m: f64, links: usize) -> Optimum {
        optimum(&|a, b| self.loss_db(a, b), self.table, head_depth_m, links)
    }

    /// [`links_needed`] for a head at this depth (m) and the scenario's `takeoff.s_min_db`.
    pub fn links_needed(&self, head_depth_m: f64) -> Option<usize> {
        let s_min_db = f64::from(self.course.scenario.takeoff.s_min_db);
        links_needed(&|a, b| self.loss_db(a, b), self.table, head_depth_m, s_min_db)
    }
}
