//! Points with colours, for viewers that draw no lines: Rerun.

use foxglove::messages::{PackedElementField, PointCloud, packed_element_field::NumericType};
use glam::Vec2;

use super::{
    MAP,
    palette::{self, Rgb},
    pose, time,
};
use crate::map::{Map, Segment};

/// Bytes of a point: three numbers and four parts of a colour.
const STRIDE: u32 = 16;

/// Points of walls are so far apart (m), ...
const WALL_STEP_M: f32 = 0.05;
/// ... or as far as it takes for no more than so many, and one for each loop of walls.
const WALL_POINTS: f32 = 10_000.0;

/// A message of points, filled again and again.
pub struct Cloud {
    fields: Vec<PackedElementField>,
    data: Vec<u8>,
}

impl Default for Cloud {
    fn default() -> Self {
        let (number, byte) = (NumericType::Float32, NumericType::Uint8);
        let fields = [
            ("x", 0, number),
            ("y", 4, number),
            ("z", 8, number),
            ("red", 12, byte),
            ("green", 13, byte),
            ("blue", 14, byte),
            ("alpha", 15, byte),
        ];
        let field = |(name, offset, kind): (&str, u32, NumericType)| PackedElementField {
            name: name.to_owned(),
            offset,
            r#type: kind.into(),
        };
        Self { fields: fields.map(field).to_vec(), data: Vec::new() }
    }
}

impl Cloud {
    /// No points any more.
    pub fn clear(&mut self) {
        self.data.clear();
    }

    /// One more.
    pub fn push(&mut self, [x_m, y_m, z_m]: [f32; 3], [r, g, b]: Rgb) {
        for number in [x_m, y_m, z_m] {
            self.data.extend(number.to_le_bytes());
        }
        self.data.extend([r, g, b, u8::MAX]);
    }

    /// A dot and two smaller steps ahead of it: where something is and whither it looks.
    pub fn push_body(&mut self, [x_m, y_m, z_m]: [f32; 3], heading_rad: f32, radius_m: f32, colour: Rgb) {
        let (sin, cos) = libm::sincosf(heading_rad);
        for ahead_m in [0.0, radius_m, 2.0 * radius_m] {
            self.push([x_m + ahead_m * cos, y_m + ahead_m * sin, z_m], colour);
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// As a message, at the end of a tick.
    pub fn message(&self, tick: u64) -> PointCloud {
        PointCloud {
            timestamp: Some(time(tick)),
            frame_id: MAP.to_owned(),
            pose: Some(pose(Vec2::ZERO)),
            point_stride: STRIDE,
            fields: self.fields.clone(),
            data: foxglove::bytes::Bytes::copy_from_slice(&self.data),
        }
    }
}

/// `/points/walls`: points along the walls, and the base station if there is one.
pub fn walls(map: &Map, base: Option<Vec2>) -> PointCloud {
    let mut cloud = Cloud::default();
    let length_m: f32 = map.walls().iter().map(|wall| wall.a.distance(wall.b)).sum();
    let step_m = WALL_STEP_M.max(length_m / WALL_POINTS);
    for corners in map.loops() {
        along(corners, step_m, |at| cloud.push([at.x, at.y, 0.0], palette::WALL));
    }
    if let Some(at) = base {
        cloud.push([at.x, at.y, 0.0], palette::BASE);
    }
    cloud.message(0)
}

/// Places on the way along a loop, the first one included.
fn along(corners: &[Segment], step_m: f32, mut place: impl FnMut(Vec2)) {
    let mut next_m = 0.0;
    for wall in corners {
        let length_m = wall.a.distance(wall.b);
        while next_m < length_m {
            place(wall.a.lerp(wall.b, next_m / length_m));
            next_m += step_m;
        }
        next_m -= length_m;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{config::builtin, mission::chain::Course};

    #[test]
    fn points_lie_along_all_walls_and_no_farther_apart_than_they_should() {
        let corner = Course::read(&builtin("corner").unwrap(), &[]).unwrap();
        let map = &corner.map;
        let mut places = Vec::new();
        for corners in map.loops() {
            along(corners, WALL_STEP_M, |at| places.push(at));
        }
        let length_m: f32 = map.walls().iter().map(|wall| wall.a.distance(wall.b)).sum();
        let expected = length_m / WALL_STEP_M;
        assert!(
            (places.len() as f32 - expected).abs() <= map.loops().count() as f32,
            "{} {expected}",
            places.len()
        );
        let near = |at: Vec2| {
            let to_wall_m = |wall: &Segment| {
                let way = wall.b - wall.a;
                let share = uchain_core::bounded((at - wall.a).dot(way) / way.length_squared(), 0.0, 1.0);
                at.distance(wall.a + way * share)
            };
            map.walls().iter().map(to_wall_m).fold(f32::INFINITY, f32::min)
        };
        assert!(places.iter().all(|&at| near(at) < 1.0e-4));
        let message = walls(map, Some(corner.base));
        assert_eq!(message.data.len(), (places.len() + 1) * STRIDE as usize);
    }

    #[test]
    fn however_long_the_walls_are_there_are_so_many_points_at_most() {
        let far = |x_m: f32, y_m: f32| Vec2::new(x_m, y_m) * 5_000.0;
        let corners = [far(0.0, 0.0), far(1.0, 0.0), far(1.0, 1.0), far(0.0, 1.0)];
        let sides: Vec<Segment> =
            (0..4).map(|i| Segment { a: corners[i], b: corners[(i + 1) % 4] }).collect();
        let mut points = 0;
        along(&sides, WALL_STEP_M.max(20_000.0 / WALL_POINTS), |_| points += 1);
        assert!((9_999..=10_001).contains(&points), "{points}");
    }
}
