//! Narrow phase and contact solver, by rapier: walls and bodies, each body switched on only within reach of a contact.

use glam::Vec2;
use rapier2d::prelude::*;

use super::{Body, BroadPhase, NeighbourGrid, Solved};
use crate::{clock::TICK_S, map::Map, world::body::on_levels};

/// How near surfaces must come to count as touching (m); rapier holds them this close.
const TOUCH_M: f32 = 0.001;
/// Sub-steps of one tick.
const SUBSTEPS: usize = 4;
/// How far they must part for the contact to be over (m).
const PART_M: f32 = 0.002;

/// Contacts of the bodies under velocity commands, among each other, with walls, and with whoever flies to a waypoint in
/// their way: that one is pushed by nobody (kinematic).
pub(in crate::world) struct Contacts {
    physics: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    radius_m: f32,
    broad_phase: BroadPhase,
    on_wall: Vec<bool>,
    /// Pairs that touch, ascending, lower index first.
    touching: Vec<(u32, u32)>,
    still_touching: Vec<(u32, u32)>,
    steps: u64,
    /// Whether bodies can be on different levels.
    on_levels: bool,
}

impl core::fmt::Debug for Contacts {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Contacts")
            .field("broad_phase", &self.broad_phase)
            .field("touching", &self.touching)
            .finish_non_exhaustive()
    }
}

/// Balls touch if they are of one level, which is their user data; walls go through all levels.
struct OneLevel;

impl PhysicsHooks for OneLevel {
    fn filter_contact_pair(&self, pair: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let level = |handle| pair.colliders.get(handle).map(|collider| collider.user_data);
        let with_wall = pair.rigid_body1.is_none() || pair.rigid_body2.is_none();
        (with_wall || level(pair.collider1) == level(pair.collider2)).then(SolverFlags::default)
    }
}

/// A level as user data: 0 and −0 are the same one.
fn level_bits(body: &Body) -> u128 {
    u128::from((body.level_m + 0.0).to_bits())
}

/// All balls, switched off, and the map's walls. What rapier keeps from step to step has a say in the last bits of what
/// it solves, so this is where every run begins.
fn build(map: &Map, radius_m: f32, bodies: &[Body], handles: &mut Vec<RigidBodyHandle>) -> PhysicsWorld {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vec2::ZERO;
    let settings = &mut physics.integration_parameters;
    settings.dt = TICK_S;
    settings.num_solver_iterations = SUBSTEPS;
    // A UAV is 0.12 m wide: tolerances in tenths of a millimetre, and contacts foreseen as far as
    // one tick can carry a body.
    settings.normalized_allowed_linear_error = 0.0002;
    settings.normalized_prediction_distance = 0.1;
    settings.contact_recycling = false;

    if let Some(walls) = map.collider_shape() {
        physics.insert_collider(ColliderBuilder::new(walls).friction(0.0).restitution(0.0), None);
    }
    let hooks = if on_levels(bodies) { ActiveHooks::FILTER_CONTACT_PAIRS } else { ActiveHooks::empty() };
    handles.clear();
    handles.extend(bodies.iter().map(|body| {
        let rigid = if body.kinematic {
            RigidBodyBuilder::kinematic_position_based()
        } else {
            RigidBodyBuilder::dynamic()
        };
        let rigid = rigid.lock_rotations().can_sleep(false).enabled(false);
        let disc = ColliderBuilder::ball(radius_m).friction(0.0).restitution(0.0).active_hooks(hooks);
        physics.insert(rigid, disc.user_data(level_bits(body))).0
    }));
    physics
}

impl Contacts {
    pub(in crate::world) fn new(map: &Map, radius_m: f32, bodies: &[Body], solved: Solved) -> Self {
        let count = bodies.len();
        let mut handles = Vec::with_capacity(count);
        Self {
            physics: build(map, radius_m, bodies, &mut handles),
            handles,
            radius_m,
            broad_phase: BroadPhase::new(count, solved),
            on_wall: vec![false; count],
            touching: Vec::with_capacity(count),
            still_touching: Vec::with_capacity(count),
            steps: 0,
            on_levels: on_levels(bodies),
        }
    }

    /// Nobody touches anything: bit for bit as new. The walls' shape is the map's own and is not built again.
    pub(in crate::world) fn reset(&mut self, map: &Map, bodies: &[Body]) {
        if self.steps > 0 || self.on_levels || on_levels(bodies) {
            self.physics = build(map, self.radius_m, bodies, &mut self.handles);
        }
        self.broad_phase.reset();
        self.on_wall.fill(false);
        self.touching.clear();
        self.still_touching.clear();
        self.steps = 0;
        self.on_levels = on_levels(bodies);
    }

    /// A body has come into others' way, by another level or from the ground.
    pub(in crate::world) fn ask_next(&mut self, body: usize) {
        self.broad_phase.ask_next(body);
    }

    /// Moves every body by one tick and counts the contacts that begin. `neighbours` knows where everybody is.
    pub(in crate::world) fn advance(&mut self, map: &Map, neighbours: &NeighbourGrid, bodies: &mut [Body]) {
        self.broad_phase.look(map, neighbours, bodies, self.radius_m);
        for (i, body) in bodies.iter_mut().enumerate() {
            if body.airborne && !self.broad_phase.is_near(i) {
                let from = body.at;
                body.glide(TICK_S);
                self.broad_phase.spend(i, body.at.distance(from));
            } else if !body.airborne {
                self.broad_phase.forget(i);
            }
        }
        self.take_out();
        if !self.broad_phase.near().is_empty() {
            self.solve(bodies);
        }
        self.count_walls(map, bodies);
        self.count_uavs(bodies);
    }

    /// Ticks in which rapier had anything to do.
    pub(in crate::world) fn steps(&self) -> u64 {
        self.steps
    }

    /// Takes those out of rapier who are near nothing any more.
    fn take_out(&mut self) {
        for &uav in
            self.broad_phase.near_before().iter().filter(|uav| !self.broad_phase.is_near(**uav as usize))
        {
            self.on_wall[uav as usize] = false;
            if let Some(rigid) = self.physics.bodies.get_mut(self.handles[uav as usize]) {
                rigid.set_enabled(false);
            }
        }
    }

    /// Lets rapier move those who are near something.
    fn solve(&mut self, bodies: &mut [Body]) {
        for &uav in self.broad_phase.near() {
            let body = &bodies[uav as usize];
            if let Some(rigid) = self.physics.bodies.get_mut(self.handles[uav as usize]) {
                rigid.set_enabled(true);
                rigid.set_translation(body.at, true);
                if body.kinematic {
                    rigid.set_next_kinematic_translation(body.at + body.velocity_mps * TICK_S);
                } else {
                    rigid.set_linvel(body.velocity_mps, true);
                }
                if let Some(&disc) = rigid.colliders().first().filter(|_| self.on_levels)
                    && let Some(disc) = self.physics.colliders.get_mut(disc)
                {
                    disc.user_data = level_bits(body);
                }
            }
        }
        self.physics.step_with_events(&OneLevel, &());
        self.steps += 1;
        for uav in 0..self.broad_phase.near().len() {
            let uav = self.broad_phase.near()[uav] as usize;
            if bodies[uav].kinematic {
                bodies[uav].glide(TICK_S);
            } else if let Some(rigid) = self.physics.bodies.get(self.handles[uav]) {
                bodies[uav].follow(rigid.translation(), rigid.linvel(), TICK_S);
            }
            self.broad_phase.forget(uav);
        }
    }

    /// One begin-touch is one contact.
    fn count_walls(&mut self, map: &Map, bodies: &mut [Body]) {
        for &uav in self.broad_phase.near() {
            let (body, on_wall) = (&mut bodies[uav as usize], &mut self.on_wall[uav as usize]);
            if body.kinematic {
                continue;
            }
            let limit_m = self.radius_m + if *on_wall { PART_M } else { TOUCH_M };
            let touches = map.clearance_m(body.at) <= limit_m;
            body.wall_contacts += u32::from(touches && !*on_wall);
            *on_wall = touches;
        }
    }

    fn count_uavs(&mut self, bodies: &mut [Body]) {
        self.still_touching.clear();
        for &pair in self.broad_phase.pairs() {
            let (i, j) = (pair.0 as usize, pair.1 as usize);
            let touched = self.touching.binary_search(&pair).is_ok();
            let limit_m = 2.0 * self.radius_m + if touched { PART_M } else { TOUCH_M };
            if bodies[i].at.distance(bodies[j].at) <= limit_m {
                self.still_touching.push(pair);
                bodies[i].uav_contacts += u32::from(!touched);
                bodies[j].uav_contacts += u32::from(!touched);
            }
        }
        std::mem::swap(&mut self.touching, &mut self.still_touching);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use uchain_core::chain::Command;

    use super::*;
    use crate::{
        map::{Vertex, corridor},
        world::{MotionParams, Start, Waypoint, World},
    };

    /// The walls' shape in rapier, which is shared with the map.
    fn walls(world: &World) -> Option<*const dyn Shape> {
        let mut colliders = world.contacts.as_ref()?.physics.colliders.iter();
        let walls = colliders.find(|(_, collider)| collider.parent().is_none());
        walls.map(|(_, walls)| Arc::as_ptr(&walls.shared_shape().0))
    }

    #[test]
    fn a_reset_begins_with_another_rapier_and_the_same_walls() {
        let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
        let map = Arc::new(corridor(&[vertex(0.0), vertex(10.0)], 1.0, false).unwrap().0);
        let start = Waypoint { at: Vec2::new(2.0, 0.0), z_m: 0.0, heading_rad: 1.57 };
        let mut world = World::new(map.clone(), MotionParams::default(), [Start::by_velocity(start)]);
        let shape = map.collider_shape().map(|shape| Arc::as_ptr(&shape.0));
        world.act(&[Command { forward_mps: 0.3, airborne: true, ..Command::default() }]);
        (0..60).for_each(|_| world.advance());
        assert_eq!((world.bodies()[0].wall_contacts, world.solver_steps() > 0), (1, true));
        let is_switched_on = |world: &World| {
            world
                .contacts
                .as_ref()
                .is_some_and(|contacts| contacts.physics.bodies.iter().all(|(_, body)| body.is_enabled()))
        };
        assert!(is_switched_on(&world));
        world.reset([start]).unwrap();
        assert!(!is_switched_on(&world));
        assert!(shape.is_some() && walls(&world) == shape);
    }
}
