//! A chain flown again: every UAV sees what it saw.

use core::hint::black_box;

use uchain_core::chain::{
    Brain as _, Command, Heard, Node, NodeParams, Observation, RadioSlot, Role, equalize,
};

use crate::{
    Call, Cause, Meter, Output, Plant, laws,
    meter::Metered,
    rows::{RowWriter, flown},
};

/// Most UAVs of a chain that is flown again: they have their places before anything is known of a trace.
pub const UAVS_MAX: usize = 8;

/// The UAVs of a chain.
pub(crate) struct Chain {
    uavs: [Option<Uav>; UAVS_MAX],
    /// How many of them there are.
    count: usize,
    plant: Plant,
}

struct Uav {
    node: Node,
    /// What its node flies by, for laws that are measured by themselves.
    params: NodeParams,
}

impl Chain {
    pub(crate) fn new(plant: Plant) -> Self {
        Self { uavs: [const { None }; UAVS_MAX], count: 0, plant }
    }

    /// A chain of so many, none of which is known yet.
    pub(crate) fn begin(&mut self, uavs: u8) -> Result<(), Cause> {
        self.uavs = [const { None }; UAVS_MAX];
        self.count = usize::from(uavs);
        if (1..=UAVS_MAX).contains(&self.count) { Ok(()) } else { Err(Cause::Crew { got: u16::from(uavs) }) }
    }

    /// One of them, on the ground.
    pub(crate) fn join(&mut self, uav: u8, role: Role, params: NodeParams) -> Result<(), Cause> {
        let uavs = self.uavs.get_mut(..self.count).unwrap_or_default();
        let place = uavs.get_mut(usize::from(uav)).ok_or(Cause::Order)?;
        *place = Some(Uav { node: Node::new(role, params.clone()), params });
        Ok(())
    }

    /// One of them decides on what it sees.
    pub(crate) fn see<M: Meter>(
        &mut self,
        tick: u32,
        id: u8,
        mut seen: Observation,
        metered: &mut Metered<'_, M>,
        rows: &mut RowWriter<'_, impl Output>,
    ) -> Result<(), Cause> {
        let uav = self.uavs.get_mut(usize::from(id)).and_then(Option::as_mut).ok_or(Cause::Order)?;
        if self.plant == Plant::Reading && has_nudged(&mut seen) {
            self.plant = Plant::None;
        }
        let (node, seen) = (&mut uav.node, black_box(&seen));
        metered.time(Call::Say, || node.say(seen));
        let asks = metered.time(kind(node, seen), || match self.plant {
            Plant::Equalize => decide_planted(node, seen, &uav.params),
            Plant::None | Plant::Reading => node.decide(seen),
        });
        let says = node.say(seen);
        let why = node.explain(seen).ok_or(Cause::Order)?;
        laws::measure(seen, &why, &uav.params, metered);
        rows.flown(&flown(tick, id, &asks, &why, &says));
        metered.tally.ticks = metered.tally.ticks.saturating_add(1);
        Ok(())
    }
}

/// What kind of decision is due. A node learns its place, and so its role, by what it sees.
fn kind(node: &Node, seen: &Observation) -> Call {
    let is_head = seen.place.map_or_else(|| node.role() == Role::Head, |place| place == 0);
    match (seen.radio.is_some(), seen.tof.is_some()) {
        _ if is_head => Call::Head,
        (true, true) => Call::RelayRadioTof,
        (true, false) => Call::RelayRadio,
        (false, true) => Call::RelayTof,
        (false, false) => Call::RelayNothing,
    }
}

/// A decision by a law that gives the next larger number.
fn decide_planted(node: &mut Node, seen: &Observation, params: &NodeParams) -> Command {
    let level_mps = match node.prepare(seen) {
        Some(asked) => equalize(asked.back_db, asked.front_db, &params.equalize).next_up(),
        None => 0.0,
    };
    node.conclude(seen, level_mps)
}

/// Makes the first loss the next larger number; whether there is one.
fn has_nudged(seen: &mut Observation) -> bool {
    let Some(radio) = seen.radio.as_mut().filter(|radio| !radio.heard().is_empty()) else { return false };
    let nudge = |(i, heard): (usize, &Heard)| {
        let loss_db = if i == 0 { heard.loss_db.next_up() } else { heard.loss_db };
        Heard { loss_db, ..*heard }
    };
    let nudged: RadioSlot = radio.heard().iter().enumerate().map(nudge).collect();
    *radio = nudged;
    true
}
