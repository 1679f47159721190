//! The tunnel between two places of a map that nobody drew a centre line for.

use glam::Vec2;

use super::path::{are_two_places, cells_wanted};
use crate::map::{CentreLine, Map, MapError, NARROWEST_M};

/// Most cells that are searched for the way; where it takes more, the tunnel graph knows it sooner and better.
const MOST_CELLS: f64 = 1_000_000.0;

impl Map {
    /// The middle of the tunnel between two places, for somebody who needs so much room on all sides (m): by
    /// [`Map::centre_path`] where a million cells are enough for it and it finds a way, else by
    /// [`Map::tunnel_graph`].
    ///
    /// # Errors
    /// An end in rock; ends less than 1 mm apart; no way between them, or none that is wide enough.
    pub fn tunnel_between(&self, from: Vec2, to: Vec2, radius_m: f32) -> Result<CentreLine, MapError> {
        are_two_places(self, from, to)?;
        if cells_wanted(self, from, to) <= MOST_CELLS {
            match self.centre_path(from, to) {
                Err(MapError::NoWay { .. }) => {}
                found => return found,
            }
        }
        let graph = self.tunnel_graph()?;
        if let Some(line) = graph.way_for(self, from, to, radius_m) {
            return Ok(line);
        }
        let [from_x, from_y, to_x, to_y] = [from.x, from.y, to.x, to.y].map(f64::from);
        let Some(tight) = graph.way(self, from, to) else {
            return Err(MapError::NoWay { from_x, from_y, to_x, to_y, cell_m: NARROWEST_M });
        };
        let (at, room_m) = self.narrowest_on(&tight);
        let [x, y] = self.offset_m();
        let (x, y) = (f64::from(at.x) + x, f64::from(at.y) + y);
        Err(MapError::TooNarrow { x, y, width_m: 2.0 * room_m, needs_m: 2.0 * radius_m })
    }

    /// Where the walls come nearest to a line, and how near (m).
    fn narrowest_on(&self, line: &CentreLine) -> (Vec2, f32) {
        let mut narrowest = (line.at(0.0).0, f32::INFINITY);
        let mut along_m = 0.0;
        while along_m <= line.length_m() {
            let at = line.at(along_m).0;
            let room_m = self.clearance_m(at);
            if room_m < narrowest.1 {
                narrowest = (at, room_m);
            }
            // No wall is nearer than the clearance: by so much no place is skipped that is much narrower.
            along_m += room_m.max(NARROWEST_M as f32) / 4.0;
        }
        narrowest
    }
}
