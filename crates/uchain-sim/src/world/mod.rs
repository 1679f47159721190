//! One world for all that fly, and the walls around them: the only room that moves anything.
//!
//! A body takes velocities, or it flies to waypoints. Each way keeps its own solver and its own tolerance of touch: those
//! who take velocities are stopped by walls and bodies in their way (`velocity`), those who fly to waypoints are stopped
//! by nothing, and what they overlap is counted (`waypoint`). Bodies on different levels never touch.

mod body;
mod motion;
mod neighbours;
mod velocity;
mod waypoint;

use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::Command;

use crate::{clock::TICK_S, map::Map};
pub use body::Body;
pub use motion::{Motion, Start, WorldError};
use neighbours::NeighbourGrid;
pub use velocity::MotionParams;
use velocity::{BroadPhase, Contacts, Solved};
use waypoint::Overlaps;
pub use waypoint::{PointMass, Quadrotor, QuadrotorParams, Vehicle, Waypoint};

/// All bodies of a run and the walls around them.
///
/// ```
/// use std::sync::Arc;
/// use glam::Vec2;
/// use uchain_core::chain::Command;
/// use uchain_sim::{map::{Vertex, corridor}, world::{MotionParams, PointMass, Start, Waypoint, World}};
///
/// let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
/// let tunnel = corridor(&[vertex(0.0), vertex(10.0)], 1.0, false).unwrap().0;
/// let at = |x, z_m| Waypoint { at: Vec2::new(x, 0.0), z_m, heading_rad: 0.0 };
/// let starts = [
///     Start::by_velocity(at(1.0, 0.5)),
///     Start::by_waypoint(Box::new(PointMass::new(at(2.0, 1.0), 0.5, 0.5))),
/// ];
/// let mut world = World::new(Arc::new(tunnel), MotionParams::default(), starts);
/// world.command(0, Command { forward_mps: 0.3, airborne: true, ..Command::default() }.into())?;
/// world.command(1, at(4.0, 1.0).into())?;
/// while !world.has_arrived() {
///     world.advance();
/// }
/// assert_eq!((world.tick(), world.bodies()[1].pose()), (80, at(4.0, 1.0)));
/// assert!((world.bodies()[0].at.x - 2.15).abs() < 0.02);
/// # Ok::<(), uchain_sim::world::WorldError>(())
/// ```
#[derive(Debug)]
pub struct World {
    map: Arc<Map>,
    params: MotionParams,
    bodies: Vec<Body>,
    /// What those who take velocities were told last.
    commands: Vec<Command>,
    /// Of those who fly to waypoints.
    vehicles: Vec<Option<Box<dyn Vehicle>>>,
    neighbours: NeighbourGrid,
    /// `None` where nobody takes velocities.
    contacts: Option<Contacts>,
    /// `None` where nobody flies to waypoints and all are on one level.
    overlaps: Option<Overlaps>,
    tick: u64,
}

impl World {
    /// Bodies at their starts. All have the radius of `params`, whose lags are those of bodies that take velocities.
    pub fn new(
        map: Arc<Map>,
        params: MotionParams,
        starts: impl IntoIterator<Item = impl Into<Start>>,
    ) -> Self {
        Self::with_broad_phase(map, params, starts, Solved::Near)
    }

    /// The same world with every body that takes velocities and is in the air going through rapier at every tick, near
    /// something or not: slow, and the measure of the other.
    #[cfg(any(test, feature = "oracles"))]
    pub fn ungated(
        map: Arc<Map>,
        params: MotionParams,
        starts: impl IntoIterator<Item = impl Into<Start>>,
    ) -> Self {
        Self::with_broad_phase(map, params, starts, Solved::Everybody)
    }

    fn with_broad_phase(
        map: Arc<Map>,
        params: MotionParams,
        starts: impl IntoIterator<Item = impl Into<Start>>,
        solved: Solved,
    ) -> Self {
        let starts = starts.into_iter().map(Into::into);
        let (bodies, vehicles): (Vec<Body>, Vec<_>) =
            starts.map(|start| (Body::new(start.at, start.vehicle.is_some()), start.vehicle)).unzip();
        let takes_velocities = bodies.iter().any(|body| !body.kinematic);
        let mut world = Self {
            contacts: takes_velocities.then(|| Contacts::new(&map, params.radius_m, &bodies, solved)),
            overlaps: None,
            commands: vec![Command::default(); bodies.len()],
            neighbours: NeighbourGrid::new(bodies.len(), BroadPhase::reach_m(&params)),
            map,
            params,
            bodies,
            vehicles,
            tick: 0,
        };
        world.begin();
        world
    }

    /// All bodies back to a start each, in order, and the clock to 0: bit for bit the world that [`World::new`] makes of
    /// these starts, but in the memory of this one, and without building the walls' shapes again. A body keeps what it is
    /// commanded by; of one that takes velocities, the start's height is its level.
    ///
    /// # Errors
    /// Other than one start per body; then nothing has changed.
    pub fn reset(
        &mut self,
        starts: impl IntoIterator<Item = Waypoint, IntoIter: ExactSizeIterator>,
    ) -> Result<(), WorldError> {
        let starts = starts.into_iter();
        let (got, count) = (starts.len(), self.bodies.len());
        if got != count {
            return Err(WorldError::Starts { got, count });
        }
        for ((body, vehicle), mut at) in self.bodies.iter_mut().zip(&mut self.vehicles).zip(starts) {
            if let Some(vehicle) = vehicle {
                vehicle.place(at);
                at = vehicle.now();
            }
            *body = Body::new(at, vehicle.is_some());
        }
        self.commands.fill(Command::default());
        self.tick = 0;
        if let Some(contacts) = &mut self.contacts {
            contacts.reset(&self.map, &self.bodies);
        }
        self.begin();
        Ok(())
    }

    /// Everybody is at a start.
    fn begin(&mut self) {
        self.neighbours.sort(&self.bodies);
        if body::on_levels(&self.bodies) {
            let overlaps = self.overlaps.get_or_insert_default();
            overlaps.reset(&self.bodies);
            overlaps.count(&self.map, self.params.radius_m, &self.neighbours, &mut self.bodies);
        } else {
            self.overlaps = None;
        }
    }

    /// The walls.
    pub fn map(&self) -> &Arc<Map> {
        &self.map
    }

    /// Ticks since the start.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// All bodies, those on the ground included.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Radius of every body (m).
    pub fn radius_m(&self) -> f32 {
        self.params.radius_m
    }

    /// Ticks so far in which somebody was near something, so that rapier stepped.
    pub fn solver_steps(&self) -> u64 {
        self.contacts.as_ref().map_or(0, Contacts::steps)
    }

    /// The places of all others in the air and on its level that are nearer than `reach_m` to this one (m).
    pub fn others_near(&self, body: usize, reach_m: f32) -> impl Iterator<Item = Vec2> {
        let here = self.bodies.get(body);
        let near = here.map(|here| self.neighbours.near(here.at, reach_m));
        let level_m = here.filter(|_| self.overlaps.is_some()).map(|here| here.level_m);
        let is_beside =
            move |other: usize| level_m.is_none_or(|level_m| self.bodies[other].level_m == level_m);
        near.into_iter()
            .flatten()
            .filter_map(move |(other, at)| (other != body && is_beside(other)).then_some(at))
    }

    /// Whether all in the air that fly to waypoints are where they were told to be.
    pub fn has_arrived(&self) -> bool {
        let airborne = self.vehicles.iter().zip(&self.bodies).filter(|(_, body)| body.airborne);
        airborne.filter_map(|(vehicle, _)| vehicle.as_ref()).all(|vehicle| vehicle.has_arrived())
    }

    /// Where bodies count as being once they have arrived, in order: from there they scan and decide.
    pub fn stand(&self) -> impl Iterator<Item = Waypoint> + '_ {
        let all = self.vehicles.iter().zip(&self.bodies);
        all.map(|(vehicle, body)| match vehicle {
            Some(vehicle) => vehicle.stands(),
            None => body.pose(),
        })
    }

    /// One body does this from now on.
    ///
    /// # Errors
    /// No such body, or one that takes no such command.
    pub fn command(&mut self, body: usize, motion: Motion) -> Result<(), WorldError> {
        let count = self.bodies.len();
        let (Some(state), Some(vehicle)) = (self.bodies.get_mut(body), self.vehicles.get_mut(body)) else {
            return Err(WorldError::NoBody { body, count });
        };
        let (was_airborne, was_on_m) = (state.airborne, state.level_m);
        match (motion, vehicle) {
            (Motion::Velocity(command), None) => {
                state.lift(command.airborne);
                self.commands[body] = command;
            }
            (Motion::Waypoint(to), Some(vehicle)) => {
                vehicle.fly_to(to);
                (state.airborne, state.level_m) = (true, to.z_m);
            }
            (Motion::Velocity(_), Some(_)) => return Err(WorldError::FliesToWaypoints { body }),
            (Motion::Waypoint(_), None) => return Err(WorldError::TakesVelocities { body }),
        }
        let lifted = was_airborne != state.airborne;
        let is_in_the_way = state.kinematic && (lifted || was_on_m != state.level_m);
        if let Some(contacts) = self.contacts.as_mut().filter(|_| is_in_the_way) {
            contacts.ask_next(body);
        }
        if lifted {
            self.sort();
        }
        Ok(())
    }

    /// All bodies that take velocities fly as told from now on: the first with the first command, and so on. Those that
    /// fly to waypoints pass theirs over.
    pub fn act(&mut self, asked: &[Command]) {
        let mut changed = false;
        for ((body, held), command) in self.bodies.iter_mut().zip(&mut self.commands).zip(asked) {
            if body.kinematic {
                continue;
            }
            changed |= body.airborne != command.airborne;
            body.lift(command.airborne);
            *held = *command;
        }
        if changed {
            self.sort();
        }
    }

    /// A body that fails is on the ground at once: it stands, and is in nobody's way or sight, until it is told to fly.
    pub fn ground(&mut self, body: usize) {
        if let Some(state) = self.bodies.get_mut(body).filter(|state| state.airborne) {
            state.lift(false);
            self.commands[body] = Command::default();
            self.sort();
        }
    }

    /// How much of its battery's charge a body has left (0 to 1), from now on. Of a body that there is not, nothing.
    pub fn set_battery(&mut self, body: usize, charge: Option<f32>) {
        if let Some(state) = self.bodies.get_mut(body) {
            state.battery = charge;
        }
    }

    /// Somebody has come from the ground, or gone there.
    fn sort(&mut self) {
        self.neighbours.sort(&self.bodies);
        if let Some(overlaps) = &mut self.overlaps {
            overlaps.list_again();
        }
    }

    /// One tick: vehicles fly on; bodies that take velocities glide, and those within reach of a contact go through rapier.
    pub fn advance(&mut self) {
        // Who flies to waypoints, or whoever is on another level, is looked for only where somebody may be.
        let on_levels = self.overlaps.is_some();
        if on_levels {
            for (vehicle, body) in flying(&mut self.vehicles, &mut self.bodies) {
                vehicle.advance();
                body.aim(vehicle.now());
            }
        }
        if let Some(contacts) = &mut self.contacts {
            for (body, command) in self.bodies.iter_mut().zip(&self.commands) {
                body.steer(command, TICK_S, &self.params);
            }
            contacts.advance(&self.map, &self.neighbours, &mut self.bodies);
            for body in &mut self.bodies {
                body.roll(TICK_S);
                body.turn(TICK_S);
            }
        }
        if on_levels {
            for (vehicle, body) in flying(&mut self.vehicles, &mut self.bodies) {
                body.put(vehicle.now());
            }
        }
        self.tick += 1;
        self.neighbours.sort(&self.bodies);
        if let Some(overlaps) = &mut self.overlaps {
            overlaps.count(&self.map, self.params.radius_m, &self.neighbours, &mut self.bodies);
        }
    }
}

/// Those in the air that fly to waypoints.
fn flying<'a>(
    vehicles: &'a mut [Option<Box<dyn Vehicle>>],
    bodies: &'a mut [Body],
) -> impl Iterator<Item = (&'a mut Box<dyn Vehicle>, &'a mut Body)> {
    let vehicles = vehicles.iter_mut().zip(bodies).filter(|(_, body)| body.airborne);
    vehicles.filter_map(|(vehicle, body)| Some((vehicle.as_mut()?, body)))
}

#[cfg(test)]
mod far_tests;
#[cfg(test)]
mod levels_tests;
#[cfg(test)]
mod reset_tests;
#[cfg(test)]
mod tests;
