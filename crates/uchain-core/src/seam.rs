//! The seam between a brain and its body: all a robot may know, all it may ask.

/// A decision maker that sees readings and returns wishes; the simulator and the drone drive it alike.
pub trait Brain {
    /// All the robot may know at one instant. It holds no true position.
    type Observation;
    /// All the robot may ask for.
    type Command;

    /// One decision. The same observations in the same order give the same commands, bit for bit.
    fn decide(&mut self, seen: &Self::Observation) -> Self::Command;
}
