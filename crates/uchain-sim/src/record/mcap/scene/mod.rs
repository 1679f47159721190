//! What recordings of all missions show alike, in Foxglove's messages: the frame of the map, time, walls, bodies.

mod cloud;
mod palette;

use foxglove::messages::{
    ArrowPrimitive, Color, CubePrimitive, CylinderPrimitive, FrameTransform, LinePrimitive, Log, Point3,
    Pose, Quaternion, SceneEntity, SceneUpdate, TextPrimitive, Timestamp, Vector3, line_primitive::Type,
    log::Level,
};
use glam::Vec2;

use crate::{
    clock::{TICK_NS, TICKS_PER_S},
    map::{Map, Segment},
    record::{Event, Gravity},
};

pub use cloud::{Cloud, walls};
pub use palette::{GROUNDED, Rgb, color, crew, link};

/// The frame all places are in.
pub const MAP: &str = "map";

/// Simulated time.
pub fn time(tick: u64) -> Timestamp {
    let (seconds, rest) = (tick / TICKS_PER_S as u64, tick % TICKS_PER_S as u64);
    Timestamp::new_checked(seconds as u32, (rest * TICK_NS) as u32).unwrap_or(Timestamp::MIN)
}

/// What happened, by the name of the frame of whom it happened to.
pub fn log(event: &Event, name: String) -> Log {
    let level = match event.gravity {
        Gravity::Info => Level::Info,
        Gravity::Warning => Level::Warning,
        Gravity::Error => Level::Error,
    };
    Log {
        timestamp: Some(time(event.tick)),
        level: level.into(),
        message: event.text.clone(),
        name,
        file: String::new(),
        line: 0,
    }
}

/// A direction in the plane.
pub fn rotation(heading_rad: f32) -> Quaternion {
    let (z, w) = libm::sincos(f64::from(heading_rad) / 2.0);
    Quaternion { x: 0.0, y: 0.0, z, w }
}

/// A frame in its parent: where it lies (m), and how it is turned (rad).
pub fn transform(parent: &str, child: String, [x, y]: [f64; 2], heading_rad: f32) -> FrameTransform {
    FrameTransform {
        timestamp: Some(time(0)),
        parent_frame_id: parent.to_owned(),
        child_frame_id: child,
        translation: Some(Vector3 { x, y, z: 0.0 }),
        rotation: Some(rotation(heading_rad)),
    }
}

/// Height of a UAV's body (m).
const BODY_M: f64 = 0.04;
/// Side of the base station (m).
const BASE_M: f64 = 0.12;
/// Height of a number beside a body (pixels).
const NUMBER_PX: f64 = 14.0;

/// Something to see, in a frame of its own or another one's.
pub fn entity(id: &str, frame_id: String) -> SceneEntity {
    SceneEntity { timestamp: Some(time(0)), frame_id, id: id.to_owned(), ..SceneEntity::default() }
}

/// A place in the plane (m).
pub fn pose(at: Vec2) -> Pose {
    let position = Some(Vector3 { x: at.x.into(), y: at.y.into(), z: 0.0 });
    Pose { position, orientation: Some(rotation(0.0)) }
}

/// A place in the plane (m).
pub fn point(at: Vec2) -> Point3 {
    Point3 { x: at.x.into(), y: at.y.into(), z: 0.0 }
}

/// `/map`: the walls, and the base station if there is one.
pub fn map(map: &Map, base: Option<Vec2>) -> SceneUpdate {
    let outline = |walls: &[Segment]| LinePrimitive {
        r#type: Type::LineLoop.into(),
        pose: Some(pose(Vec2::ZERO)),
        thickness: 2.0,
        scale_invariant: true,
        points: walls.iter().map(|wall| point(wall.a)).collect(),
        color: Some(color(palette::WALL)),
        ..LinePrimitive::default()
    };
    let walls = SceneEntity { lines: map.loops().map(outline).collect(), ..entity("walls", MAP.to_owned()) };
    let base = base.map(|at| CubePrimitive {
        pose: Some(pose(at)),
        size: Some(Vector3 { x: BASE_M, y: BASE_M, z: BASE_M }),
        color: Some(color(palette::BASE)),
    });
    let base = base.map(|cube| SceneEntity { cubes: vec![cube], ..entity("base", MAP.to_owned()) });
    SceneUpdate { deletions: Vec::new(), entities: std::iter::once(walls).chain(base).collect() }
}

/// A body in its own frame, with its number beside it.
pub fn disc_and_arrow(frame_id: String, number: usize, radius_m: f32, color: Color) -> SceneEntity {
    let beside = Vec2::new(0.0, 2.5 * radius_m);
    let radius_m = f64::from(radius_m);
    let disc = CylinderPrimitive {
        pose: Some(pose(Vec2::ZERO)),
        size: Some(Vector3 { x: 2.0 * radius_m, y: 2.0 * radius_m, z: BODY_M }),
        bottom_scale: 1.0,
        top_scale: 1.0,
        color: Some(color),
    };
    let arrow = ArrowPrimitive {
        pose: Some(pose(Vec2::ZERO)),
        shaft_length: 1.5 * radius_m,
        shaft_diameter: 0.2 * radius_m,
        head_length: 0.8 * radius_m,
        head_diameter: 0.6 * radius_m,
        color: Some(color),
    };
    let text = TextPrimitive {
        pose: Some(pose(beside)),
        billboard: true,
        font_size: NUMBER_PX,
        scale_invariant: true,
        color: Some(color),
        text: number.to_string(),
    };
    let id = frame_id.clone();
    let (cylinders, arrows, texts) = (vec![disc], vec![arrow], vec![text]);
    SceneEntity { frame_locked: true, cylinders, arrows, texts, ..entity(&id, frame_id) }
}
