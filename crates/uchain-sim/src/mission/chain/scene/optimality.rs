//! The optimum in a course: its tunnel, its radio, its depths.

use std::sync::Arc;

use glam::Vec2;
use uchain_core::bounded;

use crate::{
    analyse::optimum::{AtHead, BottleneckTable, Long, Losses, MOST_LINKS, Optimum, TableKey, reach_m},
    map::Tunnel,
    mission::chain::Course,
    radio::Antenna,
};

/// Distance between the samples of a course's table (m), in tunnels short enough for [`SAMPLES`] of them.
const STEP_M: f64 = 0.05;
/// Most samples of a course's table.
const SAMPLES: f64 = 500.0;
/// The same where a loss takes a search, such as the way through the tunnel: hundreds of times the work.
const SAMPLES_WHERE_COSTLY: f64 = 120.0;

/// Losses between depths of a course.
struct LossesIn<'a>(&'a Course);

impl Losses for LossesIn<'_> {
    type Place = Option<Antenna>;

    fn place(&self, depth_m: f64) -> Option<Antenna> {
        self.0.antenna_at(depth_m)
    }

    fn db(&self, shallow: &Option<Antenna>, deep: &Option<Antenna>) -> f64 {
        let ends = shallow.as_ref().zip(deep.as_ref());
        ends.map_or(f64::NAN, |(shallow, deep)| self.0.loss_db(shallow, deep).into())
    }

    fn least_db(&self, shallow: &Option<Antenna>, deep: &Option<Antenna>) -> f64 {
        let ends = shallow.as_ref().zip(deep.as_ref());
        ends.map_or(f64::NEG_INFINITY, |(shallow, deep)| {
            self.0.least_loss_db(shallow.at.distance(deep.at)).into()
        })
    }

    fn least_at_db(&self, apart_m: f64) -> f64 {
        self.0.least_loss_db(apart_m as f32).into()
    }

    fn spot(&self, place: &Option<Antenna>) -> Vec2 {
        place.map_or(Vec2::NAN, |antenna| antenna.at)
    }
}

/// A head somewhere in a course: for those who ask several things of one place.
pub(crate) struct HeadOptimum<'a> {
    course: &'a Course,
    way: Way<'a>,
    s_min_db: f64,
}

enum Way<'a> {
    Short(AtHead<'a, LossesIn<'a>>),
    Long { long: &'a LongTunnel, head_m: f64 },
}

/// Samples within the reach of a link at the limit: fewer of a table than that, and the tunnel is a long one.
const TABLE_SHARE: f64 = 6.0;
/// The same where a loss takes a search.
const TABLE_SHARE_WHERE_COSTLY: f64 = 2.0;
/// Those of a long tunnel.
const LONG_SHARE: f64 = 24.0;
/// The same where a loss takes a search.
const LONG_SHARE_WHERE_COSTLY: f64 = 8.0;
/// Most links of a chain in a long tunnel.
const MOST_LONG_LINKS: usize = 200_000;

/// A tunnel too long for a table.
pub(crate) type LongTunnel = Long<Option<Antenna>>;

/// What the best chain in a course's tunnel comes to.
#[derive(Debug, Clone, Copy)]
pub struct CourseOptimum<'a> {
    course: &'a Course,
    tunnel: &'a Tunnel,
}

impl Course {
    /// Loss between UAVs in mid-tunnel at two depths, flying along it, noise off (dB); depth 0 is the base. `None`
    /// without a tunnel of known middle.
    pub fn loss_at_depths_db(&self, a_m: f64, b_m: f64) -> Option<f64> {
        let antennas = [a_m, b_m].map(|depth_m| self.antenna_at(depth_m));
        let [Some(a), Some(b)] = antennas else { return None };
        Some(f64::from(self.loss_db(&a, &b)))
    }

    /// The optimum in this course; `None` without a tunnel of known middle.
    pub fn optimum(&self) -> Option<CourseOptimum<'_>> {
        self.tunnel.as_ref().map(|tunnel| CourseOptimum { course: self, tunnel })
    }

    /// Distance between the samples of this course's table (m).
    fn step_m(&self, tunnel: &Tunnel) -> f64 {
        let samples = if self.radio.is_costly() { SAMPLES_WHERE_COSTLY } else { SAMPLES };
        STEP_M.max(tunnel.length_m() / samples)
    }

    /// The tunnel, if a table would be too coarse for links as good as the scenario asks for.
    fn long(&self, tunnel: &Tunnel) -> Option<&LongTunnel> {
        let decided = self.long.get_or_init(|| {
            let (step_m, depth_m) = (self.step_m(tunnel), tunnel.length_m());
            if step_m <= STEP_M {
                return None;
            }
            let (table_share, share) = if self.radio.is_costly() {
                (TABLE_SHARE_WHERE_COSTLY, LONG_SHARE_WHERE_COSTLY)
            } else {
                (TABLE_SHARE, LONG_SHARE)
            };
            let reach_m = reach_m(&LossesIn(self), depth_m, self.scenario.takeoff.s_min_db.into())?;
            (step_m * table_share > reach_m).then(|| Arc::new(Long::new(depth_m, share)))
        });
        decided.as_deref()
    }
}

impl HeadOptimum<'_> {
    /// [`CourseOptimum::optimum`] for this head.
    pub(crate) fn optimum(&self, links: usize) -> Optimum {
        match &self.way {
            Way::Short(at) => at.optimum(links),
            Way::Long { long, head_m } => {
                let links = bounded(links, 1, MOST_LONG_LINKS);
                long.optimum(&LossesIn(self.course), *head_m, links, self.s_min_db)
            }
        }
    }

    /// [`CourseOptimum::links_needed`] for this head.
    pub(crate) fn links_needed(&self) -> Option<usize> {
        match &self.way {
            Way::Short(at) => at.links_needed(self.s_min_db),
            Way::Long { long, head_m } => long.links_needed(&LossesIn(self.course), *head_m, self.s_min_db),
        }
    }
}

impl<'a> CourseOptimum<'a> {
    /// The tunnel.
    pub fn tunnel(&self) -> &'a Tunnel {
        self.tunnel
    }

    /// The best chains on samples of the depth. The first call draws the table, or takes it from a course of the same
    /// sweep that differs in other things. In a tunnel that is long for its links it is coarse, and not what
    /// [`Self::optimum`] goes by.
    pub fn table(&self) -> &'a BottleneckTable {
        let (course, tunnel) = (self.course, self.tunnel);
        let step_m = course.step_m(tunnel);
        let draw = || BottleneckTable::draw(&LossesIn(course), tunnel.length_m(), step_m, MOST_LINKS);
        course.table.get_or_init(|| match course.radio.key() {
            Some(radio) => course.tables.get(TableKey::new(course.map.walls(), tunnel, radio), draw),
            None => Arc::new(draw()),
        })
    }

    /// Loss between two depths (dB).
    pub fn loss_db(&self, a_m: f64, b_m: f64) -> f64 {
        self.course.loss_at_depths_db(a_m, b_m).unwrap_or(f64::NAN)
    }

    /// A head at this depth (m), clamped to the tunnel.
    pub(crate) fn head(&self, depth_m: f64) -> HeadOptimum<'a> {
        let course = self.course;
        let way = match course.long(self.tunnel) {
            Some(long) => Way::Long { long, head_m: bounded(depth_m, 0.0, self.tunnel.length_m()) },
            None => Way::Short(AtHead::new(LossesIn(course), self.table(), depth_m)),
        };
        HeadOptimum { course, way, s_min_db: course.scenario.takeoff.s_min_db.into() }
    }

    /// [`optimum`](crate::analyse::optimum::optimum) for a head at this depth (m).
    pub fn optimum(&self, head_depth_m: f64, links: usize) -> Optimum {
        self.head(head_depth_m).optimum(links)
    }

    /// [`links_needed`](crate::analyse::optimum::links_needed) for a head at this depth (m) and the scenario's
    /// `takeoff.s_min_db`.
    pub fn links_needed(&self, head_depth_m: f64) -> Option<usize> {
        self.head(head_depth_m).links_needed()
    }
}
