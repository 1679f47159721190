//! An exploration laid out in its map: everything a run needs, shared by many runs.

mod starts;
#[cfg(test)]
mod tests;

use std::sync::{Arc, OnceLock};

use glam::Vec2;
use uchain_core::explore::Ssg;

use super::{
    Exploration, ExploreScenario, SiteExtensions,
    config::{KEYS, KNOWN},
};
use crate::{
    config::{ConfigError, Document, Keys, Source},
    map::Map,
    mission::{
        Scene,
        explore::{Ground, Width, width_but_for_m},
    },
    radio::{Disc, PacketParams, RadioModel},
    scene::{in_rock, lay_map, lay_radio, outside, to_a_micrometre},
};
use starts::Lattice;

/// Share of the ground from which on it is worth a note (1).
const NOTED: f64 = 0.005;

/// An exploration laid out in its map. Everything in it has been checked; nothing changes any more.
#[derive(Debug, Clone)]
pub struct Site {
    /// What was asked for.
    pub scenario: ExploreScenario,
    /// The place, shared with all that fly in it.
    pub map: Arc<Map>,
    /// What links between robots lose, noise off; `None`: all hear all.
    pub radio: Option<Arc<dyn RadioModel>>,
    /// Where the robots start, in order, before the seed moves them (m).
    pub spawns: Vec<Vec2>,
    /// Where robots start instead of `start_m`, if that has no room.
    moved: Option<String>,
    /// What robots know before their first scan.
    empty: Ssg,
    /// Surveyed by the first [`Site::ground`], shared by all runs.
    ground: OnceLock<Ground>,
}

impl Site {
    /// Reads, checks and lays out an exploration.
    ///
    /// ```
    /// use uchain_sim::{mission::explore::Site, config::builtin};
    /// let site = Site::read(&builtin("apartment").unwrap(), &["explore.robots=2".to_owned()]).unwrap();
    /// assert_eq!(site.spawns.len(), 2);
    /// ```
    ///
    /// # Errors
    /// Those of [`ExploreScenario::parse`]; a map that cannot be read or built; a robot in rock, nearer to a wall
    /// than it may come, or nearer to another one than they may come, wherever the seed puts them.
    pub fn read(source: &Source, sets: &[String]) -> Result<Arc<Self>, ConfigError> {
        <Self as Scene>::lay(&Document::parse(source, sets, &KNOWN)?, None, &(), Self::BUILTIN)
    }

    /// What robots know before their first scan.
    pub(super) fn empty_store(&self) -> &Ssg {
        &self.empty
    }

    /// What of the map a robot can reach, in cells.
    pub fn ground(&self) -> &Ground {
        self.ground.get_or_init(|| Ground::survey(&self.map, &self.spawns, &self.scenario.params))
    }

    /// What one should know of the radio: a table that says what is not gone by, and robots that may not hear each other
    /// where they could meet.
    fn radio_notes(&self) -> Vec<String> {
        let Some(radio) = &self.scenario.radio else { return Vec::new() };
        let PacketParams { drop_rate, .. } = self.scenario.packets;
        let both = (1.0 - drop_rate) * (1.0 - drop_rate);
        let deaf = (drop_rate > 0.0).then(|| {
            format!(
                "packets.drop_rate = {drop_rate}: in {:.0} of 100 rounds two robots side by side do not hear each other, and \
                 then none gives way; try --set packets.drop_rate=0",
                100.0 * (1.0 - both)
            )
        });
        radio.note().into_iter().chain(deaf).collect()
    }

    /// The same scenario with a radio of one's own between robots, and with its `[packets]` over it. `word` is what the
    /// scenario says from now on (`radio.model`): a recording tells whose radio it was. There is no range of messages
    /// beside it.
    #[must_use]
    pub fn with_radio(&self, word: &str, radio: Arc<dyn RadioModel>) -> Arc<Self> {
        let mut site = self.clone();
        word.clone_into(&mut site.scenario.radio.get_or_insert_default().model);
        site.scenario.team.range_m = None;
        site.radio = Some(radio);
        Arc::new(site)
    }

    /// What one should know before the start: another start than asked for, ground that robots of this size cannot reach, or may miss.
    pub fn notes(&self) -> Vec<String> {
        let (ground, params) = (self.ground(), &self.scenario.params);
        let (reach_m2, shut_off_m2) = (ground.area_m2(), ground.shut_off_m2());
        let mut notes: Vec<String> = self
            .map
            .import()
            .note()
            .into_iter()
            .chain(self.moved.iter().cloned())
            .chain(self.radio_notes())
            .collect();
        if shut_off_m2 > NOTED * reach_m2 {
            notes.push(format!(
                "{shut_off_m2:.1} m2 of free ground lie behind passages narrower than {} m, two explore.r_body_m: robots \
                 cannot get there; {reach_m2:.1} m2 are in reach",
                2.0 * params.r_body_m
            ));
        }
        let passages = ground.passages();
        let narrow_m2 = passages.area_m2();
        let pieces = passages.pieces();
        if let Some(narrowest) = pieces.iter().min_by(|a, b| a.width_m.total_cmp(&b.width_m))
            && narrow_m2 > NOTED * reach_m2
        {
            let [x_m, y_m] = self.map.offset_m();
            let [x_m, y_m] = [f64::from(narrowest.at.x) + x_m, f64::from(narrowest.at.y) + y_m];
            let parts = pieces.iter().map(|piece| (piece.width_m, piece.area_m2)).collect();
            let width = Width::seen(params);
            let remedy =
                width_but_for_m(parts, NOTED * reach_m2).and_then(|width_m| width.remedy(width_m, reach_m2));
            let remedy = remedy.map(|remedy| format!(": {remedy}")).unwrap_or_default();
            let (places, share) = (pieces.len(), 100.0 * narrow_m2 / reach_m2);
            notes.push(format!(
                "{narrow_m2:.1} of {reach_m2:.1} m2 in reach ({share:.0} %) lie in or behind passages narrower than \
                 {:.2} m, in {places} place{}, the narrowest {:.2} m wide near ({x_m:.2}, {y_m:.2}) m: stars may not look \
                 through{remedy}",
                passages.least_m(),
                if places == 1 { "" } else { "s" },
                narrowest.width_m,
            ));
        }
        notes
    }
}

impl Scene for Site {
    type Mission = Exploration;
    type Shared = ();
    type Extensions = SiteExtensions;
    const BUILTIN: SiteExtensions = SiteExtensions { strategies: &[], radios: &[] };
    const KIND: &'static str = "an exploration";
    const ROBOT: &'static str = "robot";
    const KEYS: &'static Keys = &KEYS;

    fn describe(document: &Document<'_>, extensions: SiteExtensions) -> Result<[String; 2], ConfigError> {
        let scenario = ExploreScenario::from_document(document, extensions)?;
        Ok([scenario.name, scenario.description])
    }

    #[cfg(feature = "schema")]
    fn schema(extensions: SiteExtensions) -> serde_json::Value {
        super::config::schema(extensions)
    }

    fn takes(document: &Document<'_>, extensions: SiteExtensions) -> bool {
        ExploreScenario::unchecked(document, extensions).is_ok()
    }

    fn lay(
        document: &Document<'_>,
        map: Option<Map>,
        (): &(),
        extensions: SiteExtensions,
    ) -> Result<Arc<Self>, ConfigError> {
        let scenario = ExploreScenario::from_document(document, extensions)?;
        let around_m = scenario.team.spawns_m.first().copied().unwrap_or_default();
        let map = match map {
            Some(map) => map,
            None => lay_map(&scenario.map, around_m, document)?.0,
        };
        let radio: Option<Arc<dyn RadioModel>> = match (&scenario.radio, scenario.team.range_m) {
            (Some(radio), _) => Some(lay_radio(radio, &map, extensions.radios, document)?),
            (None, Some(range_m)) => Some(Arc::new(Disc { range_m, loss_db: 0.0 })),
            (None, None) => None,
        };
        let spawns = places(&scenario, &map, document)?;
        let moved = moved(&scenario, &map, &spawns);
        let empty = Ssg::new(scenario.params.clone(), scenario.team.robots).map_err(|refusal| {
            let got = scenario.team.robots.to_string();
            document.invalid("explore", &got, format!("no graph can be made of these parameters: {refusal}"))
        })?;
        let (map, ground) = (Arc::new(map), OnceLock::new());
        Ok(Arc::new(Self { scenario, map, radio, spawns, moved, empty, ground }))
    }

    fn name(&self) -> &str {
        &self.scenario.name
    }

    fn duration_s(&self) -> f64 {
        self.scenario.duration_s
    }

    fn crew(&self) -> usize {
        self.spawns.len()
    }

    fn map(&self) -> &Arc<Map> {
        &self.map
    }

    fn notes(&self) -> Vec<String> {
        Self::notes(self)
    }

    fn to_toml(&self) -> Result<String, toml::ser::Error> {
        self.scenario.to_toml()
    }
}

/// One start per robot, with room for robots and for what the seed adds.
fn places(scenario: &ExploreScenario, map: &Map, document: &Document<'_>) -> Result<Vec<Vec2>, ConfigError> {
    let (team, params) = (&scenario.team, &scenario.params);
    let robots = usize::from(team.robots);
    let invalid = |key: String, got: String, expected: String| {
        Err(ConfigError::Invalid { at: document.origin(&key), key, got, expected })
    };
    let wander_m = team.scatter_m * core::f32::consts::SQRT_2;
    let wall_m = params.r_body_m + wander_m;
    let apart_m = params.conflict_m() + 2.0 * wander_m;
    if team.spawns_m.is_empty() {
        if let Some([x_m, y_m]) = team.start_m
            && let Some(outside) = outside(map, map.to_local([x_m, y_m]))
        {
            let got = format!("[{x_m}, {y_m}]");
            return invalid("explore.start_m".to_owned(), got, format!("{outside}; expected a place in it"));
        }
        let lattice = Lattice::new(map, wall_m, apart_m);
        let first = match team.start_m {
            Some(at_m) => lattice.nearest(map.to_local(at_m)),
            None => lattice.roomiest(),
        };
        let places = first.map_or_else(Vec::new, |first| lattice.places(first, robots));
        if places.len() == robots {
            return Ok(places);
        }
        let fewer = if places.is_empty() {
            String::new()
        } else {
            format!(": --set explore.robots={}", places.len())
        };
        let expected = format!(
            "expected room for all of them side by side, {apart_m:.3} m apart and {wall_m:.3} m from walls; there is \
             room for {}{fewer}",
            places.len()
        );
        return invalid("explore.robots".to_owned(), robots.to_string(), expected);
    }
    if team.spawns_m.len() < robots {
        let got = format!("{} places", team.spawns_m.len());
        let [x_m, y_m] = team.spawns_m[0];
        let expected = format!(
            "must be one place per robot at least (explore.robots = {robots}); to have places found around the first, \
             add: --set 'explore.spawns_m=[]' --set 'explore.start_m=[{x_m:?}, {y_m:?}]'"
        );
        return invalid("explore.spawns_m".to_owned(), got, expected);
    }
    let mut spawns: Vec<Vec2> = Vec::with_capacity(robots);
    for (i, &place) in team.spawns_m.iter().enumerate().take(robots) {
        let at = map.to_local(place);
        let [x_m, y_m] = place.map(to_a_micrometre);
        let robot = format!("robot {i} would start at ({x_m}, {y_m}) m");
        let wrong = |expected| {
            invalid(format!("explore.spawns_m.{i}"), format!("[{}, {}]", place[0], place[1]), expected)
        };
        if let Some(in_rock) = in_rock(map, at) {
            return wrong(format!("{robot}, which is {in_rock}; expected free space"));
        }
        let clearance_m = map.clearance_m(at);
        if clearance_m < wall_m {
            return wrong(format!(
                "{robot}, {clearance_m:.3} m from a wall; expected at least {wall_m:.3} m: r_body_m, and scatter_m \
                 both ways"
            ));
        }
        if let Some((other, far_m)) =
            spawns.iter().map(|other| other.distance(at)).enumerate().find(|(_, far_m)| *far_m < apart_m)
        {
            return wrong(format!(
                "{robot}, {far_m:.3} m from robot {other}; expected at least {apart_m:.3} m: two r_body_m, \
                 clearance_m, and scatter_m of both"
            ));
        }
        spawns.push(at);
    }
    Ok(spawns)
}

/// Says where robots start if `start_m` has no room for one.
fn moved(scenario: &ExploreScenario, map: &Map, spawns: &[Vec2]) -> Option<String> {
    let (team, first) = (&scenario.team, spawns.first()?);
    let [x_m, y_m] = team.start_m.filter(|_| team.spawns_m.is_empty())?;
    let asked = map.to_local([x_m, y_m]);
    let room_m = scenario.params.r_body_m + team.scatter_m * core::f32::consts::SQRT_2;
    let why = if map.in_rock(asked) {
        "is in rock".to_owned()
    } else if map.clearance_m(asked) < room_m {
        format!("is {:.3} m from a wall, which is no room for a robot", map.clearance_m(asked))
    } else {
        return None;
    };
    let [east_m, north_m] = map.offset_m();
    let (at_x_m, at_y_m) = (f64::from(first.x) + east_m, f64::from(first.y) + north_m);
    Some(format!(
        "explore.start_m = [{x_m}, {y_m}] {why}: robots start around ({at_x_m:.2}, {at_y_m:.2}) m, {:.2} m from there",
        first.distance(asked)
    ))
}
