//! A team in such a world: rounds in which all perceive, announce, resolve and fly.

use uchain_core::explore::{
    Command, ExploreParams, Explorer, Label, Message, Observation, Point, Pose, Purpose, Ssg, Target,
    closest_m, rule,
};

use super::world::{World, exact};

/// Robots with one store that serves them all, or with a copy each.
pub(crate) struct Team<'a> {
    world: &'a World,
    params: ExploreParams,
    pub(crate) stores: Vec<Ssg>,
    robots: Vec<Explorer>,
    bodies: Vec<Body>,
    /// Drives headings and places at the start, and noise.
    chance: u64,
    /// Half width of the noise of every estimate (m).
    noise_m: f32,
    draws: Vec<u64>,
    pub(crate) tally: Tally,
}

/// Where a robot is, where it believes it is, and what it has been asked.
#[derive(Clone, Copy)]
struct Body {
    at: Point,
    believed: Pose,
    scan: bool,
}

/// What a run came to.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Tally {
    pub(crate) rounds: usize,
    pub(crate) moves: Vec<usize>,
    pub(crate) flown_m: f32,
    pub(crate) holds: usize,
    /// Robots and rounds on another level, as the strategy counts them.
    pub(crate) mfl: usize,
    /// Smallest true distance of any flight from a wall (m).
    pub(crate) clear_m: f64,
    /// All targets of all rounds.
    pub(crate) targets: Vec<Target>,
}

/// Splitmix64.
fn bits(state: &mut u64) -> u32 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 32) as u32
}

/// Up to so much to either side.
fn about(state: &mut u64, half: f32) -> f32 {
    half * (bits(state) as f32 / (u32::MAX / 2) as f32 - 1.0)
}

fn beside(p: Point, half_m: f32, state: &mut u64) -> Point {
    Point { x_m: p.x_m + about(state, half_m), y_m: p.y_m + about(state, half_m) }
}

impl<'a> Team<'a> {
    /// So many robots near the first starts of a world, with one store. All chance comes from the seed.
    pub(crate) fn new(world: &'a World, params: &ExploreParams, robots: u16, seed: u64) -> Self {
        let n = usize::from(robots);
        let mut chance = seed;
        let mut body = |&[x, y]: &[f64; 2]| {
            let at = beside(Point { x_m: x as f32, y_m: y as f32 }, 0.1, &mut chance);
            let heading_rad = about(&mut chance, std::f32::consts::PI);
            Body { at, believed: Pose { at, heading_rad }, scan: true }
        };
        let bodies: Vec<Body> = world.starts.iter().take(n).map(&mut body).collect();
        assert_eq!(bodies.len(), n, "a start for every robot");
        Self {
            world,
            params: params.clone(),
            stores: vec![Ssg::new(params.clone(), robots).unwrap()],
            robots: (0..robots).map(|i| Explorer::new(i, robots)).collect(),
            bodies,
            chance,
            noise_m: 0.0,
            draws: (0..n as u64).map(|i| seed.wrapping_mul(1_000_003).wrapping_add(i)).collect(),
            tally: Tally { moves: vec![0; n], clear_m: f64::INFINITY, ..Tally::default() },
        }
    }

    /// The same with a store for every robot.
    pub(crate) fn with_copies(mut self) -> Self {
        self.stores = vec![self.stores[0].clone(); self.robots.len()];
        self
    }

    /// The same at the exact starts.
    pub(crate) fn at_starts(mut self) -> Self {
        for (body, &[x, y]) in self.bodies.iter_mut().zip(&self.world.starts) {
            body.at = Point { x_m: x as f32, y_m: y as f32 };
            body.believed.at = body.at;
        }
        self
    }

    /// The same with robots that know where they are by a standard deviation (m).
    pub(crate) fn with_noise(mut self, sigma_m: f32) -> Self {
        self.noise_m = sigma_m * 3.0_f32.sqrt();
        self
    }

    /// The store that a robot keeps or shares.
    fn store(&self, robot: usize) -> usize {
        robot.min(self.stores.len() - 1)
    }

    /// All robots hear everything at once. Labels only fall, and a hub is a node with a frontier.
    fn deliver(&mut self, said: &[Message]) {
        let before = self.labels();
        for message in said {
            for robot in &mut self.robots {
                robot.hear(message);
            }
            for store in &mut self.stores {
                store.apply(message).unwrap();
            }
        }
        let after = self.labels();
        for (was, is) in before.iter().flatten().zip(after.iter().flatten()) {
            assert!(was == is || (*was, *is) == (Label::Frontier, Label::Free), "{was:?} became {is:?}");
        }
        let store = &self.stores[0];
        let hubs = after.iter().filter(|labels| labels.contains(&Label::Frontier)).count();
        assert_eq!((store.hubs().count(), store.has_hubs()), (hubs, hubs > 0));
    }

    fn labels(&self) -> Vec<Vec<Label>> {
        let store = &self.stores[0];
        (0..store.len()).map(|slot| store.sectors(slot).iter().map(|s| s.label).collect()).collect()
    }

    /// One round; false if nobody had anything left to do.
    pub(crate) fn round(&mut self) -> bool {
        let mut said = Vec::new();
        for i in 0..self.robots.len() {
            let body = &mut self.bodies[i];
            body.believed.at = beside(body.at, self.noise_m, &mut self.chance);
            let Body { at, believed, scan } = *body;
            let returns = scan.then(|| self.world.scan(at, &self.params));
            let seen = Observation { pose: believed, arrived: true, scan: returns.as_deref() };
            let store = self.store(i);
            self.robots[i].perceive(&mut self.stores[store], &seen, &mut said).unwrap();
        }
        self.deliver(&said);
        let mut targets = Vec::new();
        for i in 0..self.robots.len() {
            said.clear();
            let store = self.store(i);
            let state = &mut self.draws[i];
            targets.push(self.robots[i].announce(&mut self.stores[store], &mut || bits(state), &mut said));
            self.deliver(&said);
        }
        if targets.iter().all(|target| target.purpose == Purpose::Park) {
            return false;
        }
        let rulings = rule(&targets, &self.params);
        let mut commands = Vec::new();
        for (robot, ruling) in self.robots.iter_mut().zip(rulings) {
            let own = robot.clone().resolve(&self.params);
            commands.push(robot.follow_ruling(ruling, &self.params));
            assert_eq!(commands.last(), Some(&own), "a robot rules for itself as one does for all");
        }
        self.fly(&targets, &commands);
        self.tally.targets.extend(targets);
        true
    }

    /// All fly to the end of their moves. Nobody meets anybody, and without noise nobody touches a wall.
    fn fly(&mut self, targets: &[Target], commands: &[Command]) {
        self.tally.rounds += 1;
        let flown: Vec<Target> =
            targets.iter().zip(commands).map(|(t, c)| Target { to: c.to, ..*t }).collect();
        for (j, b) in flown.iter().enumerate() {
            for (i, a) in flown.iter().enumerate().take(j) {
                let apart = closest_m(a, b) >= self.params.conflict_m();
                assert!(apart || commands[i].level != commands[j].level, "robots {i} and {j} meet");
            }
        }
        for (i, command) in commands.iter().enumerate() {
            let Body { at, believed, .. } = self.bodies[i];
            let to = Point {
                x_m: at.x_m + (command.to.x_m - believed.at.x_m),
                y_m: at.y_m + (command.to.y_m - believed.at.y_m),
            };
            let clear_m = self.world.clear_m(exact(at), exact(to));
            let body_m = f64::from(self.params.r_body_m);
            assert!(self.noise_m > 0.0 || clear_m > body_m - 1e-5, "robot {i} touches a wall: {clear_m} m");
            let tally = &mut self.tally;
            tally.clear_m = tally.clear_m.min(clear_m);
            tally.moves[i] += usize::from(command.to != believed.at);
            tally.flown_m += at.distance_m(to);
            tally.holds += usize::from(command.hold);
            tally.mfl += usize::from(command.mfl);
            let believed = Pose { at: command.to, heading_rad: command.heading_rad };
            self.bodies[i] = Body { at: to, believed, scan: command.scan };
        }
    }

    /// Rounds until nothing is left to do; then all are home.
    pub(crate) fn run(mut self) -> Self {
        while self.round() {
            assert!(self.tally.rounds < 2000, "no end after 2000 rounds");
        }
        let home = |robot: &Explorer| robot.node().is_some() && robot.node() == robot.home();
        assert!(self.robots.iter().all(home), "all are home");
        self
    }

    /// The places of all nodes.
    pub(crate) fn nodes(&self) -> Vec<Point> {
        (0..self.stores[0].len()).filter_map(|slot| self.stores[0].at(slot)).collect()
    }

    /// Smallest distance of any edge of the graph from a wall (m).
    pub(crate) fn edges_clear_m(&self) -> f64 {
        let (store, nodes) = (&self.stores[0], self.nodes());
        let edges = (0..store.len())
            .flat_map(|a| store.graph().neighbours(a).map(move |(b, _)| (a, b)))
            .map(|(a, b)| self.world.clear_m(exact(nodes[a]), exact(nodes[b])));
        edges.fold(f64::INFINITY, f64::min)
    }
}
