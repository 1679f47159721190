//! Records what the UAVs of a mission can know, instant by instant: what a board in their place would have seen. And what
//! they ask for and believe, for whoever flies the same on other hardware and compares.
//!
//! `cargo run --release --example observed -- FOLDER` writes `chains.trace` and `team.trace` into a folder, which the
//! programs in `tests/firmware` fly again, and `chains.result` and `team.result` beside them. Without a folder nothing is
//! written. Scenarios of chains may follow, in place of these three.
//!
//! ```text
//! circuit: 4 UAVs, 5000 ticks
//! circuit-frontiers2021: 4 UAVs, 5000 ticks
//! circuit-cavemod: 4 UAVs, 5000 ticks
//! apartment: 3 robots, 75 rounds, 108 nodes
//! apartment by srg: 3 robots, 95 rounds, 109 nodes
//! apartment until full: 3 robots, 137 rounds, 188 nodes
//! chains: 60015 records, 2092 kB
//! chains: 60000 decisions again, the same bits
//! team: 4830 records, 108 kB
//! team: 1228 decisions again, the same bits
//! ```

use std::{env, error::Error, ffi::OsString, fs, path::PathBuf};

use replay::{
    Plant, Record, TraceWriter, Unmetered, replay,
    rows::{Explored, RowWriter, flown},
    team::{Figures, explored},
};
use uchain_core::{
    chain::Role,
    explore::{Explorer, Message, Ssg, rule},
};
use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    config::{Source, builtin},
    mission::{
        Mission as _, Scene as _,
        chain::{Chain, Course},
        explore::{Exploration, Site},
    },
    seed::{self, Seed},
};

/// Scenarios of chains: the default laws, and the authors' own two.
const CHAINS: [&str; 3] = ["circuit", "circuit-frontiers2021", "circuit-cavemod"];

/// What every chain is flown for, whatever its scenario says (s).
const CHAIN_S: u32 = 250;

/// How the apartment is explored, each with a name: as it comes along; with random frontiers, by robots that hold; and with
/// shorter scans, which need more nodes than there may be: what bounds the memory of a board.
const EXPLORED: [(&str, &[&str]); 3] = [
    ("apartment", &[]),
    ("apartment by srg", &["explore.strategy=srg"]),
    ("apartment until full", &["explore.r_s_m=0.6", "explore.nodes_max=190"]),
];

/// The seed of every mission.
const SEED: u64 = 1;

/// The robot of the team whose brain is recorded by itself as well, with all that it hears: it has mates before and after
/// it.
const ALONE: u16 = 1;

type Done<T = ()> = Result<T, Box<dyn Error>>;
type Trace = TraceWriter<Vec<u8>>;
type Rows<'a> = RowWriter<'a, Vec<u8>>;

fn main() -> Done {
    let mut args = env::args_os().skip(1);
    let folder = args.next().map(PathBuf::from);
    let named: Result<Vec<String>, _> = args.map(OsString::into_string).collect();
    let mut names = named.map_err(|name| format!("{} is no name of a scenario", name.display()))?;
    if names.is_empty() {
        names.extend(CHAINS.map(str::to_owned));
    }

    let chains = record(|trace, rows| names.iter().try_for_each(|name| fly_chain(name, trace, rows)))?;
    let team =
        record(|trace, rows| EXPLORED.iter().try_for_each(|(name, sets)| explore(name, sets, trace, rows)))?;
    for (name, (trace, result)) in [("chains", chains), ("team", team)] {
        let records = trace.records();
        let trace = trace.end()?;
        println!("{name}: {records} records, {} kB", trace.len() / 1000);

        // The laws fly the trace again, as firmware does, and come to the same bits.
        let mut again = Vec::new();
        let tally = replay(&mut trace.as_slice(), &mut again, &mut Unmetered, Plant::None)?;
        if again != result {
            return Err(format!("{name}: the replay differs from the simulator").into());
        }
        println!("{name}: {} decisions again, the same bits", tally.ticks);
        if let Some(folder) = &folder {
            fs::create_dir_all(folder)?;
            fs::write(folder.join(name).with_extension("trace"), &trace)?;
            fs::write(folder.join(name).with_extension("result"), &result)?;
        }
    }
    Ok(())
}

/// Flies missions: a trace in the making, and what the simulator makes of the same observations.
fn record(fly: impl FnOnce(&mut Trace, &mut Rows<'_>) -> Done) -> Done<(Trace, Vec<u8>)> {
    let (mut trace, mut result) = (TraceWriter::begin(Vec::new()), Vec::new());
    let mut rows = RowWriter::begin(&mut result);
    fly(&mut trace, &mut rows)?;
    rows.end();
    Ok((trace, result))
}

/// Flies a chain. A tick is sense, decide, act: what is sensed is all that a board may know, and what is decided is what
/// the same laws must decide on it.
fn fly_chain(name: &str, trace: &mut Trace, rows: &mut Rows<'_>) -> Done {
    let course = Course::read(&Source::find(name)?, &[format!("duration_s={CHAIN_S}")])?;
    let uavs = u8::try_from(course.crew())?;
    trace.write(&Record::Chain { name: course.name(), uavs })?;
    rows.mission(course.name());
    for uav in 0..uavs {
        let role = if uav == 0 { Role::Head } else { Role::Relay };
        trace.write(&Record::Uav { uav, role, params: course.node_params() })?;
    }

    let mut chain = Chain::start(course.clone(), SEED);
    let mut commands = Vec::new();
    loop {
        let tick = u32::try_from(chain.tick())?;
        for (uav, seen) in (0..).zip(chain.sense()) {
            trace.write(&Record::Seen { tick, uav, seen: seen.clone() })?;
        }
        chain.decide(&mut commands);
        for (uav, asks) in (0..).zip(&commands) {
            let id = usize::from(uav);
            let (why, says) = chain.explain(id).zip(chain.says(id)).ok_or("a law that explains itself")?;
            rows.flown(&flown(tick, uav, asks, &why, &says));
        }
        if chain.act(&commands).is_some() {
            break;
        }
    }
    println!("{}: {uavs} UAVs, {} ticks", course.name(), chain.tick());
    Ok(())
}

/// Explores the apartment. Brains of our own decide along, for what they say to each other is heard nowhere else.
fn explore(name: &str, sets: &[&str], trace: &mut Trace, rows: &mut Rows<'_>) -> Done {
    let apartment = builtin("apartment").ok_or("apartment comes along")?;
    let site = Site::read(&apartment, &sets.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    let (robots, params) = (site.scenario.team.robots, site.scenario.params.clone());
    let begins = |name, alone| Record::Team { name, robots, alone, params: params.clone() };
    trace.write(&begins(name, None))?;
    rows.mission(name);

    let mut exploration = Exploration::start(site.clone(), SEED);
    let mut mates = Mates::new(&site, robots)?;
    // What robot 1 by itself sees and hears, and what the simulator has it do.
    let (mut alone, mut alone_rows): (Vec<Record<'_>>, Vec<Explored>) = (Vec::new(), Vec::new());
    let mut commands = Vec::new();
    let mut round = 0;
    loop {
        let seen = exploration.sense();
        if seen.iter().all(|seen| seen.arrived) {
            for event in mates.round(round, seen)? {
                if event.is_of_team {
                    trace.write(&event.record)?;
                }
                if event.is_of_alone {
                    alone.push(event.record);
                }
            }
            exploration.decide(&mut commands);
            let team = exploration.team();
            let figures = Figures::of(team.whole());
            for ((robot, asks), target) in (0..).zip(&commands).zip(team.targets()) {
                let row = explored(round, robot, asks, target, &figures);
                rows.explored(&row);
                if robot == ALONE {
                    alone_rows.push(row);
                }
            }
            round += 1;
        } else {
            exploration.decide(&mut commands);
        }
        if exploration.act(&commands).is_some() {
            break;
        }
    }
    println!("{name}: {robots} robots, {round} rounds, {} nodes", exploration.team().whole().len());

    let name = format!("{name}, robot {ALONE} alone");
    trace.write(&begins(&name, Some(ALONE)))?;
    alone.iter().try_for_each(|record| trace.write(record))?;
    rows.mission(&name);
    for row in &alone_rows {
        rows.explored(row);
    }
    Ok(())
}

/// Brains that decide along with those of an exploration: all hear all, so that one store serves them.
struct Mates {
    store: Ssg,
    explorers: Vec<Explorer>,
    draws: Vec<seed::Stream>,
}

/// Something that happens in a round, and to whom it is news.
struct Event {
    record: Record<'static>,
    is_of_team: bool,
    is_of_alone: bool,
}

impl Event {
    fn of(robot: u16, record: Record<'static>) -> Self {
        Self { record, is_of_team: true, is_of_alone: robot == ALONE }
    }

    fn heard(speaker: u16, message: Message) -> Self {
        Self { record: Record::Heard { message }, is_of_team: false, is_of_alone: speaker != ALONE }
    }
}

impl Mates {
    fn new(site: &Site, robots: u16) -> Done<Self> {
        let draws = |robot| Seed(SEED).stream(robot, seed::Source::Choice);
        Ok(Self {
            store: Ssg::new(site.scenario.params.clone(), robots)?,
            explorers: (0..robots).map(|robot| Explorer::new(robot, robots)).collect(),
            draws: (0..u32::from(robots)).map(draws).collect(),
        })
    }

    /// One round, and all that happens in it, in order.
    fn round(&mut self, round: u32, seen: &[uchain_sim::mission::explore::Observation]) -> Done<Vec<Event>> {
        let Self { store, explorers, draws } = self;
        let mut events = Vec::new();
        // All look around before anybody hears of it.
        let mut said = Vec::new();
        for ((robot, explorer), seen) in (0..).zip(&mut *explorers).zip(seen) {
            let scan = seen.scan.as_deref().map(TryInto::try_into).transpose()?;
            events.push(Event::of(robot, Record::Scanned { robot, pose: seen.pose, scan }));
            let seen = uchain_core::explore::Observation {
                pose: seen.pose,
                arrived: true,
                scan: seen.scan.as_deref(),
            };
            let mut says = Vec::new();
            // What the store has no room for is no error: its robot flies home.
            let _ = explorer.perceive(store, &seen, &mut says);
            said.extend(says.into_iter().map(|message| (robot, message)));
        }
        deliver(said, explorers, &mut events);

        let mut targets = Vec::new();
        for robot in 0..explorers.len() {
            let id = u16::try_from(robot)?;
            let (mut says, mut bits) = (Vec::new(), Vec::new());
            let mut draw = || {
                let drawn = draws[robot].bits();
                bits.push(drawn);
                drawn
            };
            targets.push(explorers[robot].announce(store, &mut draw, &mut says));
            let draws = bits.as_slice().try_into()?;
            events.push(Event::of(id, Record::Announces { robot: id, draws }));
            deliver(says.into_iter().map(|message| (id, message)).collect(), explorers, &mut events);
        }

        let params = store.params();
        for (explorer, ruling) in explorers.iter_mut().zip(rule(&targets, params)) {
            explorer.follow_ruling(ruling, params);
        }
        events.push(Event::of(ALONE, Record::Rules { round }));
        Ok(events)
    }
}

/// What robots have said is heard by all.
fn deliver(said: Vec<(u16, Message)>, explorers: &mut [Explorer], events: &mut Vec<Event>) {
    for (speaker, message) in said {
        for explorer in &mut *explorers {
            explorer.hear(&message);
        }
        events.push(Event::heard(speaker, message));
    }
}
