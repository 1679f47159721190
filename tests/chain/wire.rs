//! Over packets in bytes a chain flies as over packets as they are said, to a tenth of a decibel.

use std::{collections::BTreeMap, ops::RangeInclusive, sync::Arc};

use uchain_core::chain::{BASE_ID, Brain, Command, Estimates, Node, Observation, Packet, RadioSlot, Role};
use uchain_sim::{
    mission::{
        Mission, UnderWay,
        chain::{Chain, ChainOf, Course, Frame},
    },
    record::{RecordError, Recorder},
    run::run,
};

use crate::course;

const SEEDS: RangeInclusive<u64> = 1..=20;
const WIRE: &str = "packets.wire=true";

/// By relay, at every decision of the last 30 s: the loss of its link to the front minus that of its link to the back (dB).
#[derive(Default)]
struct Settled {
    from_s: f64,
    imbalances_db: BTreeMap<usize, Vec<f64>>,
}

impl Recorder<Frame> for Settled {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.decision && frame.time_s() > self.from_s {
            for pair in frame.links.windows(2) {
                let of_relay = self.imbalances_db.entry(pair[1].uav).or_default();
                of_relay.push(f64::from(pair[0].true_db - pair[1].true_db));
            }
        }
        Ok(())
    }
}

fn settled(course: &Arc<Course>, seed: u64) -> Settled {
    let mut settled = Settled { from_s: course.scenario.duration_s - 30.0, ..Settled::default() };
    run(course, seed, &mut settled).unwrap();
    settled
}

/// How far apart the relays of two flights settle (dB).
#[derive(Debug, Default)]
struct Apart {
    /// Over how many flights of one relay.
    relays: u32,
    /// And how many more flew in one of the two alone, or took off at another time within the last 30 s.
    otherwise: u32,
    /// Their imbalances of the last 30 s in mean, over all relays and seeds: in mean and at most.
    mean_db: f64,
    most_db: f64,
    /// Their imbalances at one and the same decision, at most.
    most_at_once_db: f64,
}

impl Apart {
    fn of(flights: [&Arc<Course>; 2]) -> Self {
        let mut apart = Self::default();
        for seed in SEEDS {
            let [one, other] = flights.map(|course| settled(course, seed).imbalances_db);
            assert!(one.len() >= 2, "two relays level at least");
            for relay in one.keys().chain(other.keys().filter(|relay| !one.contains_key(relay))) {
                let [one, other] =
                    [&one, &other].map(|flight| flight.get(relay).map_or(&[][..], Vec::as_slice));
                if one.len() != other.len() {
                    apart.otherwise += 1;
                    continue;
                }
                let mean_db =
                    |imbalances_db: &[f64]| imbalances_db.iter().sum::<f64>() / imbalances_db.len() as f64;
                let apart_db = (mean_db(one) - mean_db(other)).abs();
                apart.relays += 1;
                apart.mean_db += apart_db;
                apart.most_db = apart.most_db.max(apart_db);
                for (one, other) in one.iter().zip(other) {
                    apart.most_at_once_db = apart.most_at_once_db.max((one - other).abs());
                }
            }
        }
        apart.mean_db /= f64::from(apart.relays);
        apart
    }

    fn is_as_good(&self) -> bool {
        self.otherwise == 0 && self.mean_db <= 0.005 && self.most_db <= 0.1
    }
}

/// A node that says its speed in coarser steps than the wire's.
#[derive(Debug)]
struct Coarse {
    node: Node,
    step_mps: f32,
}

impl Brain for Coarse {
    fn decide(&mut self, seen: &Observation) -> Command {
        self.node.decide(seen)
    }

    fn say(&self, seen: &Observation) -> Packet {
        let said = self.node.say(seen);
        let ground_speed_mps = (said.ground_speed_mps / self.step_mps).round() * self.step_mps;
        Packet { ground_speed_mps, ..said }
    }

    fn estimates(&self) -> Estimates {
        self.node.estimates()
    }
}

#[test]
fn a_relay_settles_over_bytes_where_it_settles_without_them_and_fifty_times_as_coarse_it_does_not() {
    for name in ["straight", "circuit"] {
        let (plain, wire) = (course(name, &[]), course(name, &[WIRE]));
        let apart = Apart::of([&plain, &wire]);
        assert!(apart.is_as_good(), "{name}: {apart:?}");
        assert!(name == "circuit" || apart.most_at_once_db <= 0.01, "{name}: {apart:?}");
        let in_steps = |steps: f32| {
            wire.with_law("coarse", move |uav, params| Coarse {
                node: Node::new(if uav == 0 { Role::Head } else { Role::Relay }, params.clone()),
                step_mps: steps / 1024.0,
            })
        };
        let digest = |course: &Arc<Course>| run(course, 1, &mut ()).unwrap().digest;
        assert_eq!(digest(&in_steps(1.0)), digest(&wire), "{name}: the wire's own step");
        let apart = Apart::of([&plain, &in_steps(50.0)]);
        assert!(!apart.is_as_good(), "{name}, the control: {apart:?}");
    }
}

#[test]
fn over_bytes_a_run_is_the_same_on_every_thread_and_in_memory_that_was_flown_in_before() {
    let sets = ["packets.delay_ticks=6", "faults.burst_rate=0.05"];
    let (plain, wire) = (course("corner", &sets), course("corner", &[sets[0], sets[1], WIRE]));
    let alone = run(&wire, 5, &mut ()).unwrap();
    assert_ne!(alone.digest, run(&plain, 5, &mut ()).unwrap().digest, "the steps are felt");
    std::thread::scope(|scope| {
        let runs = [(); 3].map(|()| scope.spawn(|| run(&wire, 5, &mut ()).unwrap()));
        for other in runs {
            assert_eq!(other.join().unwrap(), alone);
        }
    });
    let mut again = UnderWay::<ChainOf<Node>>::start(&wire, 7);
    for seed in [7, 5] {
        again.reset(seed);
        while again.tick(&mut ()).unwrap().is_none() {}
    }
    assert_eq!(again.summary(), alone);
}

/// Says its number in words of its own.
#[derive(Debug)]
struct Talker(u8);

impl Brain for Talker {
    fn decide(&mut self, _: &Observation) -> Command {
        Command { airborne: true, ..Command::default() }
    }

    fn say(&self, seen: &Observation) -> Packet {
        let own = [self.0 + 1, 0, 0, 255, self.0 + 1, 0, 0, 128];
        Packet { place: seen.place.unwrap_or(0), own, ground_speed_mps: 40.0, ..Packet::default() }
    }
}

#[test]
fn words_of_ones_own_and_ids_arrive_as_they_are_and_a_speed_beyond_the_wire_at_its_end() {
    let sets = [WIRE, "packets.drop_rate=0", "chain.uavs=6"];
    let course = course("straight", &sets).with_law("talker", |uav, _| Talker(uav as u8));
    let (mut chain, mut commands, mut heard) = (Chain::start(course, 1), Vec::new(), 0);
    for _ in 0..40 {
        for packet in chain.sense().iter().filter_map(|seen| seen.radio.as_ref()).flat_map(RadioSlot::heard) {
            if packet.from == BASE_ID {
                assert_eq!(packet.packet, Packet::BASE);
                continue;
            }
            heard += 1;
            let wanted = Talker(packet.from as u8)
                .say(&Observation { place: Some(packet.packet.place), ..Observation::default() });
            assert_eq!(packet.packet, Packet { ground_speed_mps: f32::from(i16::MAX) / 1024.0, ..wanted });
        }
        chain.decide(&mut commands);
        chain.act(&commands);
    }
    assert!(heard > 50, "{heard}");
}
