//! A node in memory of the caller.

use core::mem::MaybeUninit;

use uchain_core::chain::{self, Brain as _, HEARD_MAX, Heard, RadioSlot};

use crate::{Command, Observation, Params, Status, UCHAIN_BASE_ID, UCHAIN_NODE_WORDS, choice::Role, pointer};

/// The brain of one UAV: memory of the caller, filled by `uchain_node_init`. It holds no pointer: it may be copied. Two
/// threads may not use the same one at the same time.
#[repr(C)]
pub struct Node {
    opaque: [u32; UCHAIN_NODE_WORDS],
}

/// What lies in a [`Node`].
#[repr(C)]
pub(crate) struct Inner {
    /// Tells that it was initialised.
    mark: u32,
    /// Its id for life.
    pub(crate) id: u16,
    /// Its place in the chain, as it was told last.
    pub(crate) place: u16,
    /// What the next packet is numbered.
    pub(crate) sequence: u8,
    /// Whether it has asked to be in the air.
    is_airborne: bool,
    /// What was heard since the last decision, the newest packet of each sender.
    pub(crate) heard: [Option<Heard>; HEARD_MAX],
    pub(crate) node: chain::Node,
}

const _: () = assert!(size_of::<Inner>() <= size_of::<Node>() && align_of::<Inner>() <= align_of::<Node>());

/// What no memory holds by chance.
const MARK: u32 = 0x4e43_5501;

/// Makes a node on the ground. `role`: one of `UCHAIN_ROLE_…`; later on its place says whether it leads. `id`: what other
/// UAVs know it by, its own for life, not `UCHAIN_BASE_ID`. `params` are copied.
///
/// `UCHAIN_STATUS_BAD_CHOICE` or `UCHAIN_STATUS_OUT_OF_RANGE`: the node is not made; `uchain_params_check` says which key is wrong.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_node_init(
    node: *mut Node,
    role: u8,
    id: u16,
    params: *const Params,
) -> Status {
    // SAFETY: as C was asked. The memory may be uninitialised: it is written only.
    let made = unsafe { pointer::write(node.cast::<MaybeUninit<Inner>>()) };
    // SAFETY: as C was asked.
    let params = unsafe { pointer::read(params) };
    match made.and_then(|made| make(made, role, id, params?)) {
        Ok(()) => Status::Ok,
        Err(status) => status,
    }
}

/// Makes a node where it will be, and not on the stack, where it has no room.
fn make(made: &mut MaybeUninit<Inner>, role: u8, id: u16, params: &Params) -> Result<(), Status> {
    let role = Role::read(role).ok_or(Status::BadChoice)?;
    if id == UCHAIN_BASE_ID {
        return Err(Status::OutOfRange);
    }
    let params = params.read().map_err(|refused| refused.status)?;
    made.write(Inner {
        mark: MARK,
        id,
        place: if role == chain::Role::Head { 0 } else { chain::Packet::BASE_PLACE - 1 },
        sequence: 0,
        is_airborne: false,
        heard: [None; HEARD_MAX],
        node: chain::Node::new(role, params),
    });
    Ok(())
}

/// One step of the control loop: shows the node what is seen, and asks it what to do. Call it at the rate of the loop, 20 Hz
/// say, with `is_decision_due` every `equalize_decision_s`.
///
/// Whatever is wrong, the command is safe: it says to hover, or to stay on the ground if the node has not taken off.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_step(
    node: *mut Node,
    observation: *const Observation,
    command: *mut Command,
) -> Status {
    // SAFETY: as C was asked.
    let (node, observation, command) =
        unsafe { (inner_mut(node), pointer::read(observation).copied(), pointer::write(command)) };
    let command = match command {
        Ok(command) => command,
        Err(status) => return status,
    };
    *command = Command::default();
    let node = match node {
        Ok(node) => node,
        Err(status) => return status,
    };
    command.airborne = node.is_airborne.into();
    match observation.and_then(|observation| node.step(&observation)) {
        Ok(asked) => {
            *command = Command::of(asked);
            Status::Ok
        }
        Err(status) => status,
    }
}

impl Inner {
    fn step(&mut self, observation: &Observation) -> Result<chain::Command, Status> {
        let mut seen = chain::Observation::default();
        observation.show(&mut seen)?;
        if observation.is_decision_due != 0 {
            let slot = seen.radio.insert(RadioSlot::default());
            for heard in self.heard.iter_mut().filter_map(Option::take) {
                // There are as many places in both.
                slot.push(heard);
            }
        }
        self.place = seen.place.unwrap_or(self.place);
        let asked = self.node.decide(&seen);
        #[cfg(feature = "control")]
        let asked = spoilt(asked, self.place);
        self.is_airborne = asked.airborne;
        Ok(asked)
    }
}

/// What the check of what is linked has to find: a panic, and a double.
#[cfg(feature = "control")]
fn spoilt(asked: chain::Command, place: u16) -> chain::Command {
    let share = [1.0, 0.9, 0.8][usize::from(place)];
    chain::Command { forward_mps: (f64::from(asked.forward_mps) * share) as f32, ..asked }
}

/// The node that lies there.
///
/// # Safety
/// The pointer is NULL, or points to memory of a [`Node`], which nobody else uses meanwhile.
pub(crate) unsafe fn inner_mut<'a>(node: *mut Node) -> Result<&'a mut Inner, Status> {
    // SAFETY: the memory may be uninitialised by a node, but it is there, and its first word is a number.
    if *unsafe { pointer::read(node.cast_const().cast::<u32>()) }? != MARK {
        return Err(Status::NotInitialised);
    }
    // SAFETY: `uchain_node_init` wrote all of it.
    unsafe { pointer::write(node.cast::<Inner>()) }
}

/// The node that lies there, for reading.
///
/// # Safety
/// The pointer is NULL, or points to memory of a [`Node`], to which nobody writes meanwhile.
pub(crate) unsafe fn inner<'a>(node: *const Node) -> Result<&'a Inner, Status> {
    // SAFETY: as in `inner_mut`.
    if *unsafe { pointer::read(node.cast::<u32>()) }? != MARK {
        return Err(Status::NotInitialised);
    }
    // SAFETY: `uchain_node_init` wrote all of it.
    unsafe { pointer::read(node.cast::<Inner>()) }
}
