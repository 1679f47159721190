//! How far from the base a place is, through the tunnel.

use std::sync::{Arc, OnceLock};

use glam::Vec2;

use crate::map::{Geodesic, MOST_CORNERS, Map, MapError, Trail, Tunnel};

/// Places along a tunnel that may see where a UAV waits.
const ALONG: u32 = 1_000;

/// Distances from the base through free space. They take long to prepare on a map of many corners, and a plan needs
/// none of them: so that is left to the first who asks.
///
/// On a map of more than [`MOST_CORNERS`] corners of rock, distances are those along the middle of the tunnel.
#[derive(Debug, Clone)]
pub struct FromBase {
    base: Vec2,
    way: Way,
}

#[derive(Debug, Clone)]
enum Way {
    Shortest(Arc<OnceLock<Option<Geodesic>>>),
    Along(Box<Tunnel>),
    /// More corners than a search may take.
    TooLong(Box<MapError>),
}

impl FromBase {
    /// From a base in a map.
    ///
    /// # Errors
    /// Those of [`Map::geodesic`]; of too many corners only [`Self::along`] knows what to make.
    pub(super) fn new(map: &Map, base: Vec2) -> Result<Self, MapError> {
        let way = match map.check_geodesic(base) {
            Ok(()) => Way::Shortest(Arc::default()),
            Err(cause @ MapError::Count { .. }) => Way::TooLong(Box::new(cause)),
            Err(cause) => return Err(cause),
        };
        Ok(Self { base, way })
    }

    /// The same, now that the tunnel is known, or is not.
    ///
    /// # Errors
    /// Too many corners and no tunnel.
    pub(super) fn along(self, tunnel: Option<&Tunnel>) -> Result<Self, MapError> {
        let way = match (self.way, tunnel) {
            (Way::TooLong(_), Some(tunnel)) => Way::Along(Box::new(tunnel.clone())),
            (Way::TooLong(cause), None) => return Err(*cause),
            (way, _) => way,
        };
        Ok(Self { way, ..self })
    }

    /// Where distances are measured from (m).
    pub fn source(&self) -> Vec2 {
        self.base
    }

    /// Whether distances are those along the middle of the tunnel.
    pub fn is_along_the_tunnel(&self) -> bool {
        matches!(self.way, Way::Along(_))
    }

    /// Whether a way leads to a place. `known` are places that one leads to.
    pub(crate) fn leads_to(&self, map: &Map, known: impl Iterator<Item = Vec2>, p: Vec2) -> bool {
        if map.sees(self.base, p) || known.into_iter().any(|known| map.sees(known, p)) {
            return true;
        }
        match &self.way {
            Way::Shortest(_) => self.follow_m(map, &mut Trail::default(), p).is_some(),
            Way::Along(tunnel) => (0..=ALONG).any(|i| {
                let (at, _) = tunnel.at(tunnel.length_m() * f64::from(i) / f64::from(ALONG));
                map.sees(at, p)
            }),
            Way::TooLong(_) => false,
        }
    }

    /// Prepares what takes long, so that no tick of a run has to.
    pub(crate) fn prepare(&self, map: &Map) {
        if let Way::Shortest(known) = &self.way {
            self.shortest(known, map);
        }
    }

    fn shortest<'k>(&self, known: &'k OnceLock<Option<Geodesic>>, map: &Map) -> Option<&'k Geodesic> {
        known.get_or_init(|| map.geodesic(self.base).ok()).as_ref()
    }

    /// Distance of a place for somebody who travels (m), as [`Geodesic::follow_m`] has it; `None` in rock and out of
    /// reach. `map` is the map this came from.
    pub fn follow_m(&self, map: &Map, trail: &mut Trail, p: Vec2) -> Option<f32> {
        match &self.way {
            Way::Shortest(known) => self.shortest(known, map)?.follow_m(map, trail, p),
            Way::Along(tunnel) => (!map.in_rock(p)).then(|| tunnel.depth_m(p).max(0.0) as f32),
            Way::TooLong(_) => None,
        }
    }

    /// What a run should say of it.
    pub(super) fn note(&self) -> Option<String> {
        self.is_along_the_tunnel().then(|| {
            format!(
                "the map has more than {MOST_CORNERS} corners of rock: how far the head gets is measured along the middle \
                 of the tunnel, not along the shortest way"
            )
        })
    }
}
