//! The radio of a scenario, or of a map file alone.

use std::{path::Path, sync::Arc};

use glam::Vec2;

use super::{PlanRequest, Registry};
use crate::{
    config::{ConfigError, Document, Source, kind_of_map},
    map::Map,
    mission::{
        chain::{Course, Scenario},
        explore::Site,
    },
    radio::RadioModel,
    scene::{lay_map, lay_radio},
};

/// A radio in its map.
#[derive(Debug, Clone)]
pub struct RadioIn {
    /// The scenario's name, or the map's.
    pub name: String,
    /// The map.
    pub map: Arc<Map>,
    /// What a link loses; `None` of robots that hear each other within a range, whatever is lost.
    pub radio: Option<Arc<dyn RadioModel>>,
    /// Loss that a relay's link may have (dB), `takeoff.s_min_db`; of explorers, where packets end, `packets.limit_db`.
    pub limit_db: f64,
    /// The base station in the map's frame, if there is one.
    pub base: Option<Vec2>,
}

impl Registry {
    /// The radio by the name of a scenario, or by the path of a scenario or of a map file; `sets` (`key=value`) are written over
    /// it.
    ///
    /// ```
    /// use uchain_sim::registry::Registry;
    /// let there = Registry::default().radio("corner", &["takeoff.s_min_db=64".to_owned()]).unwrap();
    /// assert!(there.radio.is_some() && there.base.is_some() && there.limit_db == 64.0);
    /// ```
    ///
    /// # Errors
    /// No scenario is called so, it cannot be read, or it is no map.
    pub fn radio(self, what: &str, sets: &[String]) -> Result<RadioIn, ConfigError> {
        if let Some(kind) = kind_of_map(Path::new(what)) {
            let source = PlanRequest::bare(what);
            let mut all = vec![format!("map.{kind}.file={what}"), "chain.base_m=[0.0, 0.0]".to_owned()];
            all.extend(sets.iter().cloned());
            let known = self.known();
            let document = Document::parse(&source, &all, &known)?;
            let scenario = Scenario::unchecked(&document)?;
            let (map, _) = lay_map(&scenario.map, scenario.chain.base_m, &document)?;
            let radio = lay_radio(&scenario.radio, &map, self.extensions::<Course>().radios, &document)?;
            return Ok(RadioIn {
                name: scenario.name,
                map: Arc::new(map),
                radio: Some(radio),
                limit_db: scenario.takeoff.s_min_db.into(),
                base: None,
            });
        }
        let scene = self.read(&Source::find(what)?, sets)?;
        let (name, map) = (scene.name().to_owned(), scene.map().clone());
        if let Some(course) = scene.get::<Course>() {
            let (radio, limit_db) = (course.radio.clone(), course.scenario.takeoff.s_min_db.into());
            return Ok(RadioIn { name, map, radio: Some(radio), limit_db, base: Some(course.base) });
        }
        let site = scene.get::<Site>();
        let limit_db = site.map_or(0.0, |site| site.scenario.packets.limit_db.into());
        Ok(RadioIn { name, map, radio: site.and_then(|site| site.radio.clone()), limit_db, base: None })
    }
}
