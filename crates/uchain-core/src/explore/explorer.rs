//! One robot's decisions (Kim 2021, Algorithm 2).

mod decide;
#[cfg(test)]
mod tests;

use alloc::{boxed::Box, vec, vec::Vec};

use decide::{End, Leg, spend};

use super::{
    Command, Dijkstra, ExploreParams, Mate, Message, NodeId, NodeReport, Observation, Pose, Purpose, Refusal,
    Ruling, Sector, Ssg, Strategy, Target, rule,
};

/// The brain of one robot.
///
/// ```
/// use uchain_core::explore::{ExploreParams, Explorer, Observation, Pose, Purpose, Ssg};
/// let mut ssg = Ssg::new(ExploreParams::default(), 1)?;
/// let mut robot = Explorer::new(0, 1);
/// let (mut said, mut draw) = (Vec::new(), || 0);
/// // Alone in a cell: a wall at half a metre all around.
/// let walls = [Some(0.5); 18];
/// let seen = Observation { pose: Pose::default(), arrived: true, scan: Some(&walls) };
/// robot.perceive(&mut ssg, &seen, &mut said)?;
/// let target = robot.announce(&mut ssg, &mut draw, &mut said);
/// assert_eq!(target.purpose, Purpose::Park); // nothing to explore, and it is home
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Explorer {
    robot: u16,
    pose: Pose,
    /// The node it is at, or left last; `None` before its first scan.
    here: Option<NodeId>,
    /// What it is flying; `None` at a node without a decision yet, and while it stays.
    leg: Option<Leg>,
    level: u16,
    /// The hub it was last on its way to.
    hub: Option<NodeId>,
    /// Nodes it has scanned.
    nodes: u32,
    mates: Vec<Mate>,
    routes: Dijkstra,
    /// Made by its first decision, by the parameters of the store.
    strategy: Option<Box<dyn Strategy>>,
}

impl Explorer {
    /// A robot of a team of so many, where its first scan will be.
    pub fn new(robot: u16, robots: u16) -> Self {
        Self {
            robot,
            pose: Pose::default(),
            here: None,
            leg: None,
            level: ExploreParams::USUAL_LEVEL,
            hub: None,
            nodes: 0,
            mates: vec![Mate::default(); usize::from(robots)],
            routes: Dijkstra::default(),
            strategy: None,
        }
    }

    /// The node it is at, or has left last; `None` before its first scan.
    pub fn node(&self) -> Option<NodeId> {
        self.here
    }

    /// The node it comes home to; `None` before its first scan.
    pub fn home(&self) -> Option<NodeId> {
        self.here.map(|_| NodeId { robot: self.robot, number: 0 })
    }

    /// The level it was last told to fly on.
    pub fn level(&self) -> u16 {
        self.level
    }

    /// Takes in where another robot is and what it will fly. Nodes and labels are the store's concern.
    pub fn hear(&mut self, message: &Message) {
        let of = |robot: u16| if robot == self.robot { usize::MAX } else { usize::from(robot) };
        match message {
            Message::Pose { robot, at } if at.is_sound() => {
                if let Some(mate) = self.mates.get_mut(of(*robot)) {
                    mate.at = Some(*at);
                }
            }
            Message::Target(target) if target.from.is_sound() && target.to.is_sound() => {
                if let Some(mate) = self.mates.get_mut(of(target.robot)) {
                    mate.target = Some(*target);
                }
            }
            _ => {}
        }
    }

    /// A round begins: where it is, and what it has scanned if it came to a new place (Kim 2021, Algorithm 2, lines
    /// 1, 22 and 23). What it says of it is added to `said`. With a pose that is none it knows nothing new, and goes on
    /// with what it was doing. If the store has no room for a new node it turns back.
    ///
    /// # Errors
    /// The store takes no such node: a scan of another number of sectors, or a robot of another team; or it is full
    /// before the robot's first.
    pub fn perceive(
        &mut self,
        ssg: &mut Ssg,
        seen: &Observation<'_>,
        said: &mut Vec<Message>,
    ) -> Result<(), Refusal> {
        let lost = !(seen.pose.at.is_sound() && seen.pose.heading_rad.is_finite());
        if !lost {
            self.pose = seen.pose;
        }
        for mate in &mut self.mates {
            mate.target = None;
        }
        said.push(Message::Pose { robot: self.robot, at: self.pose.at });
        let flown = self.leg.filter(|leg| leg.sent).map(|leg| leg.end);
        match (flown, self.here) {
            _ if lost || !seen.arrived => Ok(()),
            (Some(End::Known(node)), _) => {
                (self.here, self.leg) = (Some(node), None);
                Ok(())
            }
            (Some(End::New(flown)), Some(left)) => match self.scan(ssg, seen, Some((left, flown)), said) {
                Err(Refusal::Full { .. }) => {
                    let to = ssg.slot(left).and_then(|slot| ssg.at(slot)).unwrap_or(self.pose.at);
                    let (end, purpose) = (End::Known(left), Purpose::Backtrack);
                    self.leg = Some(Leg { to, end, purpose, open: false, sent: false });
                    Ok(())
                }
                result => result,
            },
            (_, None) => self.scan(ssg, seen, None, said),
            (None, Some(_)) => Ok(()),
        }
    }

    /// A new node here, if there is a scan of it.
    fn scan(
        &mut self,
        ssg: &mut Ssg,
        seen: &Observation<'_>,
        flown: Option<(NodeId, [u16; 2])>,
        said: &mut Vec<Message>,
    ) -> Result<(), Refusal> {
        let Some(returns_m) = seen.scan else { return Ok(()) };
        let id = NodeId { robot: self.robot, number: self.nodes };
        let r_s_m = ssg.params().r_s_m;
        let node = Message::Node(NodeReport {
            id,
            at: self.pose.at,
            flown_from: flown.map(|(left, _)| left),
            sectors: returns_m.iter().map(|&return_m| Sector::of(return_m, r_s_m)).collect(),
        });
        ssg.apply(&node)?;
        said.push(node);
        if let Some((node, sectors)) = flown {
            spend(ssg, node, sectors, said);
        }
        self.nodes = self.nodes.saturating_add(1);
        (self.here, self.leg) = (Some(id), None);
        Ok(())
    }

    /// Decides where to fly, in the instant of the last [`Self::perceive`], and says so (Kim 2021, Algorithm 2, lines
    /// 2–17). `draw` gives uniformly random bits from the robot's own stream. On the way it says again what it flies.
    pub fn announce(
        &mut self,
        ssg: &mut Ssg,
        draw: &mut dyn FnMut() -> u32,
        said: &mut Vec<Message>,
    ) -> Target {
        if self.leg.is_none() {
            self.leg = self.decide(ssg, draw, said);
        }
        let at_home = self.here.is_some() && self.here == self.home();
        let target = Target {
            robot: self.robot,
            purpose: self.leg.map_or(if at_home { Purpose::Park } else { Purpose::Wait }, |leg| leg.purpose),
            hub: self.hub,
            from: self.pose.at,
            to: self.leg.map_or(self.pose.at, |leg| leg.to),
            level: self.level,
        };
        if let Some(own) = self.mates.get_mut(usize::from(self.robot)) {
            own.target = Some(target);
        }
        said.push(Message::Target(target));
        target
    }

    /// Flies by its own target and those it has heard this round (Kim 2021, Algorithm 2, lines 18–21).
    pub fn resolve(&mut self, params: &ExploreParams) -> Command {
        let targets: Vec<Target> = self.mates.iter().filter_map(|mate| mate.target).collect();
        let own = targets.iter().position(|target| target.robot == self.robot);
        let ruling = own.and_then(|own| rule(&targets, params).get(own).copied());
        self.follow_ruling(ruling.unwrap_or(Ruling { level: self.level, hold: true, mfl: false }), params)
    }

    /// Flies by a ruling on the target it has announced.
    pub fn follow_ruling(&mut self, ruling: Ruling, params: &ExploreParams) -> Command {
        self.level = ruling.level;
        if ruling.hold {
            // At a node it thinks again next round; on the way it waits.
            self.leg = self.leg.filter(|leg| !leg.open);
        }
        if let Some(leg) = &mut self.leg {
            leg.sent = !ruling.hold;
            leg.open = false;
        }
        let leg = self.leg.filter(|_| !ruling.hold);
        let (from, to) = (self.pose.at, leg.map_or(self.pose.at, |leg| leg.to));
        let bearing_rad = libm::atan2f(to.y_m - from.y_m, to.x_m - from.x_m);
        Command {
            to,
            heading_rad: if from == to { self.pose.heading_rad } else { bearing_rad },
            level: ruling.level,
            z_m: params.height_m(ruling.level),
            scan: self.here.is_none() || leg.is_some_and(|leg| matches!(leg.end, End::New(_))),
            mfl: ruling.mfl,
            hold: ruling.hold,
        }
    }
}
