//! A cache of tables that several courses share: most variants of a sweep leave tunnel and losses alone.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use super::BottleneckTable;
use crate::map::{Segment, Tunnel};

/// Tables kept, each up to 5 MB.
const KEPT: usize = 16;

/// All that a table depends on: walls, the way between them, and the model of the losses, by its
/// [`key`](crate::radio::RadioModel::key).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TableKey {
    walls: Vec<Segment>,
    tunnel: Tunnel,
    radio: String,
}

impl TableKey {
    pub(crate) fn new(walls: &[Segment], tunnel: &Tunnel, radio: String) -> Self {
        Self { walls: walls.to_vec(), tunnel: tunnel.clone(), radio }
    }
}

/// A table, as soon as somebody has drawn it.
type Place = Arc<OnceLock<Arc<BottleneckTable>>>;

/// The last few tables.
#[derive(Debug, Default)]
pub struct TableCache {
    kept: Mutex<VecDeque<(TableKey, Place)>>,
}

impl TableCache {
    /// The table of a key, drawn by the first thread that asks for it; others that want the same one wait.
    pub(crate) fn get(&self, key: TableKey, draw: impl FnOnce() -> BottleneckTable) -> Arc<BottleneckTable> {
        self.place(key).get_or_init(|| Arc::new(draw())).clone()
    }

    fn place(&self, key: TableKey) -> Place {
        // Nobody panics while holding the lock; were it so, what is kept would still be whole.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let known = kept.iter().position(|(known, _)| *known == key);
        // The one asked for last goes to the end, so that the one nobody asks for is the first to go.
        if let Some(entry) = known.and_then(|index| kept.remove(index)) {
            let place = entry.1.clone();
            kept.push_back(entry);
            return place;
        }
        if kept.len() >= KEPT {
            kept.pop_front();
        }
        let place = Place::default();
        kept.push_back((key, place.clone()));
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        config::builtin,
        map::Map,
        mission::chain::Course,
        radio::{Antenna, RadioModel},
    };

    fn corner(tables: &Arc<TableCache>, sets: &[&str]) -> std::sync::Arc<Course> {
        let sets: Vec<String> = sets.iter().flat_map(|set| set.split(' ')).map(ToOwned::to_owned).collect();
        let course = Course::read(&builtin("corner").unwrap(), &sets).unwrap();
        Arc::new(Course { tables: tables.clone(), ..(*course).clone() })
    }

    fn are_one(a: &Course, b: &Course) -> bool {
        std::ptr::eq(a.optimum().unwrap().table(), b.optimum().unwrap().table())
    }

    #[test]
    fn courses_of_one_tunnel_and_one_loss_share_a_chart_and_others_do_not() {
        let tables = Arc::default();
        let first = corner(&tables, &[]);
        for same in
            ["tof.noise_m=0.1", "radio.sigma_db=0.5", "chain.uavs=3", "duration_s=9", "takeoff.s_min_db=50"]
        {
            assert!(are_one(&first, &corner(&tables, &[same])), "{same}");
        }
        for other in [
            "radio.alpha_free=3",
            "radio.alpha_wall=5.5",
            "radio.reference_m=0.5",
            "radio.antenna_db=6",
            "radio.model=disc radio.range_m=4",
            "map.corridor.width_m=1.1",
            "chain.base_m=[1.1,0.0]",
            "chain.goal_m=[4.0,-5.0]",
        ] {
            let shared = corner(&tables, &[other]);
            assert!(!are_one(&first, &shared), "{other}");
            // What is shared is what a course would have drawn by itself.
            let alone = corner(&Arc::default(), &[other]);
            assert_eq!(shared.optimum().unwrap().table(), alone.optimum().unwrap().table(), "{other}");
        }
        assert!(!are_one(&first, &corner(&Arc::default(), &[])));
    }

    /// Twice what the scenario's own model says, and under a name or without one.
    #[derive(Debug)]
    struct Twice(Option<&'static str>, Arc<dyn RadioModel>);

    impl RadioModel for Twice {
        fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
            2.0 * self.1.loss_db(map, from, to)
        }

        fn key(&self) -> Option<String> {
            self.0.map(ToOwned::to_owned)
        }
    }

    #[test]
    fn models_of_ones_own_share_a_table_by_their_key_and_without_one_with_nobody() {
        let tables = Arc::default();
        let plain = corner(&tables, &[]);
        let with = |key| plain.with_radio("twice", Arc::new(Twice(key, plain.radio.clone())));
        let (first, second) = (with(Some("twice")), with(Some("twice")));
        assert!(are_one(&first, &second) && !are_one(&first, &plain) && !are_one(&first, &with(Some("two"))));
        let (alone, lonely) = (with(None), with(None));
        assert!(!are_one(&alone, &lonely) && !are_one(&alone, &first));
        assert_eq!(alone.optimum().unwrap().table(), first.optimum().unwrap().table());
    }

    #[test]
    fn no_more_charts_are_kept_than_there_is_room_for_and_the_latest_stay() {
        let course = corner(&Arc::default(), &[]);
        let (tables, tunnel) = (TableCache::default(), course.tunnel.clone().unwrap());
        let get = |alpha_free: f32, drawn: &mut usize| {
            tables.get(TableKey::new(&[], &tunnel, format!("free space {alpha_free}")), || {
                *drawn += 1;
                BottleneckTable::new(|_, _| 1.0, 1.0, 0.5, 1)
            });
        };
        let mut drawn = 0;
        for round in 1..=3 {
            (0..=KEPT).for_each(|alpha| get(alpha as f32, &mut drawn));
            assert_eq!(tables.kept.lock().unwrap().len(), KEPT);
            // One key too many for all: each has gone when its turn comes again.
            assert_eq!(drawn, round * (KEPT + 1));
        }
        get(KEPT as f32, &mut drawn);
        assert_eq!(drawn, 3 * (KEPT + 1));
    }
}
