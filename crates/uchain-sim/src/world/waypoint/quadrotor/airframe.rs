//! A rigid body that four rotors lift and turn. Axes of the body: x to the front, y to the left, z up.

use glam::{Quat, Vec3};
use uchain_core::{
    bounded,
    flight::{Attitude, Demand, FlightState, GRAVITY_MPS2, QuadrotorParams},
};

/// Most that a body spins (rad/s). What is flown by a law that cannot hold it stays within numbers.
const SPIN_MAX_RADPS: f32 = 100.0;

/// What is built.
#[derive(Debug, Clone)]
pub(super) struct Airframe {
    pub(super) mass_kg: f32,
    arm_m: f32,
    drag_arm_m: f32,
    rotor_max_n: f32,
    /// Moments of inertia about the axes (kg m²).
    pub(super) inertia_kg_m2: Vec3,
}

/// How it moves.
#[derive(Debug, Clone)]
pub(super) struct State {
    /// Place (m).
    pub(super) at_m: Vec3,
    /// What `at_m` leaves of the place (m).
    pub(super) remainder_m: Vec3,
    pub(super) velocity_mps: Vec3,
    /// Turns the body's axes into the world's.
    pub(super) attitude: Quat,
    /// Rates about the body's axes (rad/s).
    pub(super) rates_radps: Vec3,
}

impl Airframe {
    pub(super) fn new(params: &QuadrotorParams) -> Self {
        let QuadrotorParams { mass_kg, arm_m, drag_arm_m, thrust_to_weight, .. } = *params;
        let flat = mass_kg * arm_m * arm_m / 4.0;
        Self {
            mass_kg,
            arm_m,
            drag_arm_m,
            rotor_max_n: thrust_to_weight * mass_kg * GRAVITY_MPS2 / 4.0,
            inertia_kg_m2: Vec3::new(flat, flat, 2.0 * flat),
        }
    }

    /// Thrusts of the front, left, rear and right rotor, each from none to its greatest (N). What they cannot do all
    /// together they do first for height, roll and pitch; yaw gets what is left.
    pub(super) fn rotors_n(&self, asked: &Demand) -> [f32; 4] {
        let limit = |n: f32| bounded(n, 0.0, self.rotor_max_n);
        let torque = self.inertia_kg_m2 * Vec3::from(asked.turn_radps2);
        let even = self.mass_kg * asked.lift_mps2 / 4.0;
        let (roll, pitch) = (torque.x / (2.0 * self.arm_m), torque.y / (2.0 * self.arm_m));
        let [front, left, rear, right] = [even - pitch, even + roll, even + pitch, even - roll].map(limit);
        let up_to = |a: f32, b: f32| (self.rotor_max_n - a).min(self.rotor_max_n - b);
        let (more, less) = (up_to(front, rear).min(left.min(right)), up_to(left, right).min(front.min(rear)));
        let yaw = bounded(torque.z / (4.0 * self.drag_arm_m), -less, more);
        [front + yaw, left - yaw, rear + yaw, right - yaw]
    }

    /// Force along the body's z axis (N), and torque about its axes (N m).
    fn wrench(&self, [front, left, rear, right]: &[f32; 4]) -> (f32, Vec3) {
        let torque_nm = Vec3::new(
            self.arm_m * (left - right),
            self.arm_m * (rear - front),
            self.drag_arm_m * (front + rear - left - right),
        );
        (front + left + rear + right, torque_nm)
    }
}

impl State {
    /// At rest at the origin.
    pub(super) fn hovering(heading_rad: f32) -> Self {
        let (sin, cos) = libm::sincosf(heading_rad / 2.0);
        Self {
            at_m: Vec3::ZERO,
            remainder_m: Vec3::ZERO,
            velocity_mps: Vec3::ZERO,
            attitude: Quat::from_xyzw(0.0, 0.0, sin, cos),
            rates_radps: Vec3::ZERO,
        }
    }

    /// Some time passes under constant thrusts. The place is exact for what falls freely; rates and attitude are of
    /// second order (midpoint).
    pub(super) fn step(&mut self, airframe: &Airframe, rotors_n: &[f32; 4], step_s: f32) {
        let (lift_n, torque_nm) = airframe.wrench(rotors_n);
        let inertia = airframe.inertia_kg_m2;
        let turn = |rates: Vec3| (torque_nm - rates.cross(inertia * rates)) / inertia;
        let half = self.rates_radps + turn(self.rates_radps) * (step_s / 2.0);
        let middle = half.clamp_length_max(SPIN_MAX_RADPS);
        let lift = self.up() * (lift_n / airframe.mass_kg);
        let before_mps = self.velocity_mps;
        self.velocity_mps += (lift - Vec3::Z * GRAVITY_MPS2) * step_s;
        self.move_by((before_mps + self.velocity_mps) * (step_s / 2.0));
        let after = self.rates_radps + turn(middle) * step_s;
        self.rates_radps = after.clamp_length_max(SPIN_MAX_RADPS);
        let spin = Quat::from_xyzw(middle.x, middle.y, middle.z, 0.0);
        self.attitude = (self.attitude + self.attitude * spin * (step_s / 2.0)).normalize();
    }

    /// The sum is compensated, as that of a chain's bodies: a step is less than the spacing of `f32` on a long way.
    pub(super) fn move_by(&mut self, way_m: Vec3) {
        let way_m = way_m + self.remainder_m;
        let at_m = self.at_m + way_m;
        self.remainder_m = way_m - (at_m - self.at_m);
        self.at_m = at_m;
    }

    /// The body's z axis in the world.
    pub(super) fn up(&self) -> Vec3 {
        self.attitude * Vec3::Z
    }

    /// Where the body's x axis points to, counter-clockwise from the world's (rad).
    pub(super) fn heading_rad(&self) -> f32 {
        self.attitude().heading_rad()
    }

    fn attitude(&self) -> Attitude {
        let Quat { x, y, z, w } = self.attitude;
        Attitude { xyz: [x, y, z], w }
    }

    /// What the law knows of it.
    pub(super) fn known(&self) -> FlightState {
        FlightState {
            at_m: self.at_m.to_array(),
            velocity_mps: self.velocity_mps.to_array(),
            attitude: self.attitude(),
            rates_radps: self.rates_radps.to_array(),
        }
    }
}
