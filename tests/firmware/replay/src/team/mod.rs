//! Explorers flown again: a whole team on one store, or one robot with a store of its own that hears the others.

mod figures;

use alloc::vec::Vec;

use arrayvec::ArrayVec;
use uchain_core::explore::{ExploreParams, Explorer, Message, Observation, Pose, Ssg, Target, rule};

use crate::{
    Call, Cause, DRAWS_MAX, Meter, Output, Plant, SECTORS_MAX,
    meter::{Explored, Metered},
    rows::RowWriter,
};

pub use figures::{Figures, explored};

/// Most robots of a team.
pub const ROBOTS_MAX: u16 = 64;

/// The exploration that is flown, if there is one.
pub(crate) struct Flight {
    team: Option<Team>,
    plant: Plant,
}

/// What one robot is, and has said that the others have not heard yet.
struct Robot {
    id: u16,
    explorer: Explorer,
    said: Vec<Message>,
    target: Option<Target>,
    /// Instructions of this round's decision so far.
    instructions: u32,
}

struct Team {
    store: Ssg,
    robots: Vec<Robot>,
    is_alone: bool,
    rounds: u32,
    /// What the heap held before.
    before: u32,
}

impl Team {
    fn robot(&mut self, id: u16) -> Result<(&mut Robot, &mut Ssg), Cause> {
        let robot = self.robots.iter_mut().find(|robot| robot.id == id).ok_or(Cause::Order)?;
        Ok((robot, &mut self.store))
    }

    /// What robots have said is heard by all of a team. A robot alone says it to nobody here.
    fn deliver(&mut self) {
        for speaker in 0..self.robots.len() {
            let said = self.robots.get_mut(speaker).map(|robot| core::mem::take(&mut robot.said));
            let mut said = said.unwrap_or_default();
            for message in &said {
                self.robots.iter_mut().for_each(|robot| robot.explorer.hear(message));
            }
            // Its memory is kept.
            said.clear();
            if let Some(robot) = self.robots.get_mut(speaker) {
                robot.said = said;
            }
        }
    }
}

impl Flight {
    pub(crate) fn new(plant: Plant) -> Self {
        Self { team: None, plant }
    }

    /// An exploration begins.
    pub(crate) fn begin<M: Meter>(
        &mut self,
        robots: u16,
        alone: Option<u16>,
        params: ExploreParams,
        metered: &mut Metered<'_, M>,
    ) -> Result<(), Cause> {
        if !(1..=ROBOTS_MAX).contains(&robots) || alone.is_some_and(|robot| robot >= robots) {
            return Err(Cause::Crew { got: robots });
        }
        metered.forget_peak();
        let before = metered.heap().used;
        let store = Ssg::new(params, robots).map_err(|_| Cause::Params)?;
        let flown = alone.map_or(0..robots, |robot| robot..robot + 1);
        let robot = |id| Robot {
            id,
            explorer: Explorer::new(id, robots),
            said: Vec::new(),
            target: None,
            instructions: 0,
        };
        let robots = flown.map(robot).collect();
        self.team = Some(Team { store, robots, is_alone: alone.is_some(), rounds: 0, before });
        Ok(())
    }

    /// It is over: what it has taken is counted, and given back.
    pub(crate) fn leave<M: Meter>(&mut self, metered: &mut Metered<'_, M>) {
        let Some(team) = self.team.take() else { return };
        let heap = metered.heap();
        let explored = Explored {
            brains: team.robots.len() as u16,
            rounds: team.rounds,
            nodes: team.store.len() as u32,
            used: heap.used.saturating_sub(team.before),
            peak: heap.peak.saturating_sub(team.before),
        };
        // There is room for those that anybody measures; the rest is flown all the same.
        let _ = metered.tally.explored.try_push(explored);
    }

    fn team(&mut self) -> Result<&mut Team, Cause> {
        self.team.as_mut().ok_or(Cause::Order)
    }

    /// A robot looks around.
    pub(crate) fn perceive<M: Meter>(
        &mut self,
        id: u16,
        pose: Pose,
        mut scan: Option<ArrayVec<Option<f32>, SECTORS_MAX>>,
        metered: &mut Metered<'_, M>,
    ) -> Result<(), Cause> {
        if self.plant == Plant::Reading
            && let Some(return_m) = scan.iter_mut().flatten().flatten().next()
        {
            *return_m = return_m.next_up();
            self.plant = Plant::None;
        }
        let (robot, store) = self.team()?.robot(id)?;
        let seen = Observation { pose, arrived: true, scan: scan.as_deref() };
        let (_, instructions) = metered.timed(Call::Perceive, || {
            // What a store has no room for is no fault: its robot flies home.
            robot.explorer.perceive(store, &seen, &mut robot.said)
        });
        robot.instructions = instructions;
        Ok(())
    }

    /// A robot alone hears another one.
    pub(crate) fn hear<M: Meter>(
        &mut self,
        message: &Message,
        metered: &mut Metered<'_, M>,
    ) -> Result<(), Cause> {
        let team = self.team()?;
        let (Some(robot), true) = (team.robots.first_mut(), team.is_alone) else { return Err(Cause::Order) };
        metered.time(Call::Hear, || {
            robot.explorer.hear(message);
            // What it has no room for it does not know.
            let _ = team.store.apply(message);
        });
        Ok(())
    }

    /// A robot decides.
    pub(crate) fn announce<M: Meter>(
        &mut self,
        id: u16,
        draws: &ArrayVec<u32, DRAWS_MAX>,
        metered: &mut Metered<'_, M>,
    ) -> Result<(), Cause> {
        let team = self.team()?;
        team.deliver();
        let (robot, store) = team.robot(id)?;
        let mut left = draws.iter().copied();
        let mut is_short = false;
        let mut draw = || {
            left.next().unwrap_or_else(|| {
                is_short = true;
                0
            })
        };
        let (target, instructions) =
            metered.timed(Call::Announce, || robot.explorer.announce(store, &mut draw, &mut robot.said));
        robot.target = Some(target);
        robot.instructions = robot.instructions.saturating_add(instructions);
        if is_short { Err(Cause::Draws) } else { Ok(()) }
    }

    /// The round is over: all of them follow.
    pub(crate) fn rule<M: Meter>(
        &mut self,
        round: u32,
        metered: &mut Metered<'_, M>,
        rows: &mut RowWriter<'_, impl Output>,
    ) -> Result<(), Cause> {
        let team = self.team()?;
        team.deliver();
        let targets: Vec<Target> = team.robots.iter().filter_map(|robot| robot.target).collect();
        if targets.len() < team.robots.len() {
            return Err(Cause::Order);
        }
        let params = team.store.params();
        let rulings =
            if team.is_alone { Vec::new() } else { metered.time(Call::Rule, || rule(&targets, params)) };
        let figures = Figures::of(&team.store);
        for (i, (robot, target)) in team.robots.iter_mut().zip(&targets).enumerate() {
            let (asks, instructions) = metered.timed(Call::Follow, || match rulings.get(i) {
                Some(&ruling) => robot.explorer.follow_ruling(ruling, params),
                None => robot.explorer.resolve(params),
            });
            metered.decided(robot.instructions.saturating_add(instructions));
            rows.explored(&explored(round, robot.id, &asks, target, &figures));
            metered.tally.ticks = metered.tally.ticks.saturating_add(1);
            (robot.target, robot.instructions) = (None, 0);
        }
        team.rounds = team.rounds.saturating_add(1);
        Ok(())
    }
}
