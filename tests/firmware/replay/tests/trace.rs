//! Traces: what stands in them, what is wrong with them, and that they are flown again.

use replay::{
    Call, Cause, Fault, Meter, Plant, Record, TraceWriter, Unmetered, VERSION, replay,
    rows::{FLOWN, Row, RowReader},
};
use uchain_core::{
    chain::{BASE_ID, Heard, NodeParams, Observation, Packet, PilotInput, Role, Tof},
    explore::{ExploreParams, Message, NodeId, NodeReport, Point, Pose, Sector},
};

/// Ticks of the chain below.
const TICKS: u32 = 200;

/// What a head, or a relay behind it, sees: losses that grow apart, distances now and then.
fn seen(tick: u32, uav: u8) -> Observation {
    let said = |place, flown_s| Packet { place, flown_s, ..Packet::default() };
    let off_db = 0.005 * tick as f32;
    let heard = match uav {
        // The first reading of all is the relay's, which takes it in on the ground.
        0 if tick == 0 => vec![],
        0 => vec![Heard { from: 1, loss_db: 50.0 + off_db, packet: said(1, 9.0) }],
        _ => vec![
            Heard { from: 0, loss_db: 62.0 + off_db, packet: said(0, 60.0) },
            Heard { from: BASE_ID, loss_db: 61.0 - off_db, packet: Packet::BASE },
        ],
    };
    Observation {
        place: Some(u16::from(uav)),
        tof: tick.is_multiple_of(2).then_some(Tof { nw_m: 0.5, ne_m: 0.7, sw_m: 0.5, se_m: 0.6 }),
        radio: tick.is_multiple_of(4).then(|| heard.into_iter().collect()),
        ground_speed_mps: tick.is_multiple_of(4).then_some(0.0),
        pilot: (uav == 0).then_some(PilotInput { speed_mps: 0.2, ..PilotInput::default() }),
        ..Observation::default()
    }
}

/// A trace of a chain, and of one robot that hears another one.
fn trace() -> Vec<u8> {
    trace_of(TICKS)
}

/// The same, with a flight of so many ticks.
fn trace_of(ticks: u32) -> Vec<u8> {
    let mut trace = TraceWriter::begin(Vec::new());
    let mut write = |record: Record<'_>| trace.write(&record).unwrap();
    write(Record::Chain { name: "pair", uavs: 2 });
    for (uav, role) in [(0, Role::Head), (1, Role::Relay)] {
        write(Record::Uav { uav, role, params: NodeParams::default() });
    }
    for tick in 0..ticks {
        for uav in 0..2 {
            write(Record::Seen { tick, uav, seen: seen(tick, uav) });
        }
    }
    write(Record::Team { name: "cell", robots: 2, alone: Some(1), params: ExploreParams::default() });
    let sectors = vec![Sector::of(Some(0.5), 1.0); 18];
    for round in 0..3 {
        let at = Point { x_m: 0.1 * round as f32, y_m: 0.0 };
        let scan = (round == 0).then(|| [Some(0.9); 18].into_iter().collect());
        write(Record::Scanned { robot: 1, pose: Pose { at, heading_rad: 0.0 }, scan });
        let id = NodeId { robot: 0, number: round };
        let node = NodeReport { id, at, flown_from: None, sectors: sectors.clone() };
        write(Record::Heard { message: Message::Node(node) });
        write(Record::Announces { robot: 1, draws: [7].into_iter().collect() });
        write(Record::Rules { round });
    }
    trace.end().unwrap()
}

fn flown(mut trace: &[u8], plant: Plant) -> Result<Vec<u8>, Fault> {
    let mut result = Vec::new();
    replay(&mut trace, &mut result, &mut Unmetered, plant).map(|_| result)
}

/// All rows of a chain.
fn rows(mut result: &[u8]) -> Vec<[u32; FLOWN.len()]> {
    let mut reader = RowReader::open(&mut result).unwrap();
    let mut rows = Vec::new();
    while let Some(row) = reader.read().unwrap() {
        if let Row::Flown(words) = row {
            rows.push(words.iter().collect::<Vec<_>>().try_into().unwrap());
        }
    }
    rows
}

fn at(name: &str) -> usize {
    FLOWN.iter().position(|field| field.name == name).unwrap()
}

#[test]
fn a_record_has_these_bytes_and_who_changes_them_changes_the_version() {
    assert_eq!(VERSION, 1);
    let observation = Observation { ground_speed_mps: Some(0.5), ..Observation::default() };
    let mut trace = TraceWriter::begin(Vec::new());
    trace.write(&Record::Seen { tick: 300, uav: 2, seen: observation }).unwrap();
    let bytes = trace.end().unwrap();
    assert_eq!(bytes[..8], *b"UCTRACE\x01");
    // Length; kind; 300 in seven bits a byte; UAV; four times absent or there, the speed as an `f32`.
    let seen = [14, 0, 2, 0xac, 0x02, 2, 0, 0, 0, 1, 0x00, 0x00, 0x00, 0x3f, 0, 0];
    assert_eq!(bytes[8..24], seen);
    // Length; kind; records before it.
    assert_eq!(bytes[24..], [2, 0, 3, 1]);
}

#[test]
fn every_uav_flies_again_tick_by_tick_with_its_links_filtered_and_its_wishes_named() {
    let rows = rows(&flown(&trace(), Plant::None).unwrap());
    assert_eq!(rows.len(), 2 * TICKS as usize);
    let relay = rows.last().unwrap();
    assert_eq!(relay[..2], [TICKS - 1, 1]);
    let value = |name| f32::from_bits(relay[at(name)]);
    assert!(value("forward_mps") > 0.0 && relay[at("airborne")] == 1, "{relay:?}");
    assert!((value("front.filtered_db") - 62.9).abs() < 1.0 && value("front.raw_db") == 62.0 + 0.005 * 196.0);
    assert_eq!(rows[1][at("back.filtered_db")], u32::MAX, "a relay on the ground has not heard the base");
}

#[test]
fn a_planted_ulp_is_found() {
    let (plain, trace) = (flown(&trace(), Plant::None).unwrap(), trace());
    let differ = |plant, fields: &[&str]| {
        let planted = rows(&flown(&trace, plant).unwrap());
        let differs = |(a, b): &(&[u32; FLOWN.len()], &[u32; FLOWN.len()])| {
            fields.iter().any(|name| a[at(name)] != b[at(name)])
        };
        rows(&plain).iter().zip(&planted).filter(differs).count()
    };
    assert!(differ(Plant::Equalize, &["forward_mps"]) > 50);
    assert!(differ(Plant::Equalize, &["wish_mps"]) > 50);
    assert_eq!(differ(Plant::Reading, &["forward_mps", "lateral_mps", "yaw_rate_radps", "airborne"]), 0);
    assert!(differ(Plant::Reading, &["front.filtered_db"]) > 0, "in the state only");
    assert_eq!(differ(Plant::None, &["wish_mps", "front.filtered_db"]), 0);
}

#[test]
fn a_trace_that_is_cut_anywhere_is_a_fault() {
    let trace = trace_of(9);
    assert!(flown(&trace, Plant::None).is_ok());
    for length in 0..trace.len() {
        let fault = flown(&trace[..length], Plant::None).unwrap_err();
        assert_eq!(fault.cause, Cause::Short, "{length}");
    }
}

#[test]
fn a_trace_that_goes_on_or_misses_a_record_or_is_none_is_a_fault() {
    let trace = trace();
    let cause = |bytes: &[u8]| flown(bytes, Plant::None).unwrap_err().cause;
    assert_eq!(cause(&[&trace[..], &[0]].concat()), Cause::Trailing);
    assert_eq!(cause(b"UCTRACK\x01"), Cause::Magic);
    assert_eq!(cause(b"UCTRACE\x02"), Cause::Version { got: 2 });
    assert_eq!(cause(b"UCTRACE\x01\x00\x00"), Cause::Length { bytes: 0 });
    assert_eq!(cause(b"UCTRACE\x01\x01\x08"), Cause::Length { bytes: 2049 });
    assert_eq!(cause(b"UCTRACE\x01\x02\x00\x03\x09"), Cause::Count { written: 9 });
    assert_eq!(cause(b"UCTRACE\x01\x01\x00\x63"), Cause::Malformed);
    // An end that something stands behind.
    assert_eq!(cause(b"UCTRACE\x01\x03\x00\x03\x00\x00"), Cause::Malformed);
}

#[test]
fn a_record_that_nothing_announces_is_a_fault_that_says_where() {
    let only = |record: &Record<'_>| {
        let mut trace = TraceWriter::begin(Vec::new());
        trace.write(&Record::Chain { name: "", uavs: 1 }).unwrap();
        trace.write(record).unwrap();
        flown(&trace.end().unwrap(), Plant::None).unwrap_err()
    };
    let order = Fault { place: 1, cause: Cause::Order };
    assert_eq!(only(&Record::Seen { tick: 0, uav: 0, seen: Observation::default() }), order);
    let stranger = Record::Uav { uav: 1, role: Role::Relay, params: NodeParams::default() };
    assert_eq!(only(&stranger), order);
    assert_eq!(only(&Record::Rules { round: 0 }), order);
    assert_eq!(only(&Record::Chain { name: "", uavs: 9 }).cause, Cause::Crew { got: 9 });
    let params = ExploreParams { alpha: f32::NAN, ..ExploreParams::default() };
    let team = |robots, params| Record::Team { name: "", robots, alone: None, params };
    assert_eq!(only(&team(3, params)).cause, Cause::Params);
    assert_eq!(only(&team(9999, ExploreParams::default())).cause, Cause::Crew { got: 9999 });
    let text = order.to_string();
    assert!(text.starts_with("after 1 records: ") && text.contains("--example observed"), "{text}");
}

#[test]
fn damage_anywhere_neither_panics_nor_takes_much_memory() {
    let trace = trace_of(9);
    for place in 0..trace.len() {
        for damage in [0x01, 0x80, 0xff] {
            let mut damaged = trace.clone();
            damaged[place] ^= damage;
            let memory = allocation_counter::measure(|| {
                let _ = flown(&damaged, Plant::None);
            });
            assert!(memory.bytes_max < 1_000_000, "{place}: {} bytes", memory.bytes_max);
        }
    }
}

#[test]
fn calls_are_counted_by_kind_and_the_mean_and_the_most_are_told() {
    /// Every call takes one more than the last.
    struct Growing(u32);
    impl Meter for Growing {
        fn now(&mut self) -> u32 {
            0
        }

        fn call<T>(&mut self, _: Call, make: impl FnOnce() -> T) -> (T, u32) {
            self.0 += 1;
            (make(), self.0)
        }
    }
    let tally = replay(&mut trace().as_slice(), &mut Vec::new(), &mut Growing(0), Plant::None).unwrap();
    assert_eq!(tally.ticks, 2 * TICKS + 3);
    assert_eq!(tally.count(Call::Head).calls, TICKS);
    assert_eq!(tally.count(Call::RelayRadioTof).calls, TICKS / 4);
    assert_eq!(tally.count(Call::RelayTof).calls, TICKS / 4);
    assert_eq!(tally.count(Call::RelayNothing).calls, TICKS / 2);
    assert_eq!(tally.count(Call::Announce).calls, 3);
    let head = tally.count(Call::Head);
    assert!(u64::from(head.most) > head.mean() && head.mean() > 0);
    let line = format!("call head {TICKS} {} {}\n", head.mean(), head.most);
    assert!(tally.to_string().contains(&line), "{tally}");
    assert!(tally.to_string().contains("explored 1 3 4 0 0\n"), "{tally}");
}
