extern crate std;

use std::{format, string::ToString, vec, vec::Vec};

use proptest::prelude::*;

use super::*;
use crate::chain::{BASE_ID, Brain, Node, NodeParams, Observation, Role, Takeoff, TakeoffParams};

fn sent(message: &Message) -> Vec<u8> {
    let mut bytes = [0xaa; SIZE_MAX];
    let length = encode(message, &mut bytes);
    bytes[..length].to_vec()
}

fn received(packet: Packet) -> Packet {
    decode(&sent(&Message { packet, ..Message::default() })).unwrap().packet
}

/// A message of any bits: NaN, infinities and subnormal numbers as well.
fn any_message() -> impl Strategy<Value = Message> {
    let numbers = (any::<u16>(), any::<u8>(), any::<u16>());
    let follow = prop::sample::select(&[Follow::Centre, Follow::Left, Follow::Right][..]);
    let float = || prop_oneof![prop::num::f32::ANY, -2000.0..2000.0_f32];
    let rest = (follow, any::<bool>(), prop::option::of(float()), any::<[u8; 8]>());
    (numbers, [float(), float(), float()], rest).prop_map(|(numbers, floats, rest)| {
        let (from, sequence, place) = numbers;
        let [ground_speed_mps, flown_s, imbalance_db] = floats;
        let (follow, is_base, battery, own) = rest;
        let packet = Packet { place, ground_speed_mps, flown_s, follow, imbalance_db, is_base, battery, own };
        Message { from, sequence, packet }
    })
}

/// Bytes as they may come: anything, most of it with the version that is read on; and fields with sections behind them.
fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    let version = prop_oneof![1 => any::<u8>(), 3 => Just(VERSION)];
    let anything = (prop::collection::vec(any::<u8>(), 0..64), version).prop_map(|(mut bytes, version)| {
        if let Some(first) = bytes.first_mut() {
            *first = version;
        }
        bytes
    });
    let section = (0..8_u8, prop::collection::vec(any::<u8>(), 0..10))
        .prop_map(|(kind, body)| [&[kind << LENGTH_BITS | body.len() as u8], &body[..]].concat());
    let sections = prop::collection::vec(section, 0..3);
    let shaped = (any::<[u8; SIZE_MIN - 1]>(), sections)
        .prop_map(|(fields, sections)| [&[VERSION][..], &fields, &sections.concat()].concat());
    prop_oneof![anything, shaped]
}

/// What arrives is at most half a step off; an `f32` rounds the product and the quotient a little as well.
fn assert_half_a_step(got: f32, value: f32, steps_per_unit: f64) -> Result<(), TestCaseError> {
    let steps_off = (f64::from(got) - f64::from(value)).abs() * steps_per_unit;
    let rounding = f64::from(value).abs() * steps_per_unit * f64::from(f32::EPSILON);
    prop_assert!(steps_off <= 0.5 + rounding, "{value} arrives as {got}, {steps_off} steps off");
    Ok(())
}

proptest! {
    #[test]
    fn every_number_in_range_arrives_at_most_half_a_step_off(
        ground_speed_mps in -32.0..31.999_f32, flown_s in 0.0..3276.75_f32,
        imbalance_db in 0.0..1023.98_f32, battery in 0.0..=1.0_f32,
    ) {
        let packet =
            Packet { ground_speed_mps, flown_s, imbalance_db, battery: Some(battery), ..Packet::default() };
        let got = received(packet);
        assert_half_a_step(got.ground_speed_mps, ground_speed_mps, 1024.0)?;
        assert_half_a_step(got.flown_s, flown_s, 20.0)?;
        assert_half_a_step(got.imbalance_db, imbalance_db, 64.0)?;
        assert_half_a_step(got.battery.unwrap(), battery, 254.0)?;
    }

    #[test]
    fn whatever_is_said_goes_out_in_at_most_30_bytes_and_arrives_as_numbers_of_the_table(message in any_message()) {
        let bytes = sent(&message);
        prop_assert!((SIZE_MIN..=SIZE_MAX).contains(&bytes.len()));
        let got = decode(&bytes).unwrap();
        let (said, heard) = (message.packet, got.packet);
        prop_assert_eq!((got.from, got.sequence), (message.from, message.sequence));
        prop_assert_eq!(
            (heard.place, heard.follow, heard.is_base, heard.own),
            (said.place, said.follow, said.is_base, said.own)
        );
        prop_assert!((-32.0..=32_767.0 / 1024.0).contains(&heard.ground_speed_mps));
        prop_assert!((0.0..=3276.75).contains(&heard.flown_s));
        prop_assert!((0.0..=65_535.0 / 64.0).contains(&heard.imbalance_db));
        prop_assert!(heard.battery.is_none_or(|share| (0.0..=1.0).contains(&share)));
        prop_assert_eq!(heard.battery.is_some(), said.battery.is_some_and(f32::is_finite));
        // What has arrived once is said on without another loss.
        prop_assert_eq!(sent(&got), bytes);
    }

    #[test]
    fn the_whole_room_may_be_sent_as_well(message in any_message()) {
        let mut bytes = [0xaa; SIZE_MAX];
        let length = encode(&message, &mut bytes);
        prop_assert_eq!(decode(&bytes), decode(&bytes[..length]));
    }

    #[test]
    fn whatever_bytes_come_in_are_a_packet_or_an_error_and_what_they_mean_is_said_on_as_it_is(bytes in any_bytes()) {
        if let Ok(message) = decode(&bytes) {
            prop_assert_eq!(decode(&sent(&message)), Ok(message));
        }
    }
}

#[test]
fn of_the_bytes_that_the_tests_make_up_many_are_packets_and_many_are_none() {
    use proptest::{strategy::ValueTree, test_runner::TestRunner};

    let mut runner = TestRunner::deterministic();
    let mut packets = 0;
    for _ in 0..2000 {
        packets += usize::from(decode(&any_bytes().new_tree(&mut runner).unwrap().current()).is_ok());
    }
    assert!((200..1800).contains(&packets), "{packets}");
}

#[test]
fn the_layout_is_what_the_table_says() {
    let packet = Packet {
        place: 0x0102,
        ground_speed_mps: 0.25,
        flown_s: 12.8,
        follow: Follow::Right,
        imbalance_db: 1.5,
        is_base: true,
        battery: Some(0.5),
        own: [9, 8, 7, 6, 5, 4, 3, 2],
    };
    let message = Message { from: 0x0304, sequence: 200, packet };
    let fields = [1, 0b110, 4, 3, 200, 2, 1, 0, 1, 0, 1, 96, 0, 127];
    let own = [0b001_01000, 9, 8, 7, 6, 5, 4, 3, 2];
    assert_eq!(sent(&message), [&fields[..], &own].concat());
    assert_eq!(decode(&sent(&message)), Ok(message));
}

#[test]
fn the_base_and_a_relay_that_was_told_no_place_arrive_as_they_are() {
    let base = Message { from: BASE_ID, sequence: 0, packet: Packet::BASE };
    assert_eq!(decode(&sent(&base)), Ok(base));
    let node = Node::new(Role::Relay, NodeParams::default());
    let last = node.say(&Observation::default());
    assert_eq!(last.place, Packet::BASE_PLACE - 1);
    assert_eq!(received(last), last);
}

#[test]
fn what_is_no_number_becomes_the_value_on_which_nobody_flies_or_launches() {
    for none in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let got = received(Packet {
            ground_speed_mps: none,
            flown_s: none,
            imbalance_db: none,
            battery: Some(none),
            ..Packet::default()
        });
        assert_eq!((got.ground_speed_mps, got.flown_s, got.battery), (0.0, 0.0, None));
        assert_eq!(got.imbalance_db, 65_535.0 / 64.0);
    }
    let got = received(Packet {
        ground_speed_mps: -33.0,
        flown_s: -1.0,
        imbalance_db: -1.0,
        battery: Some(1.5),
        ..Packet::default()
    });
    assert_eq!((got.ground_speed_mps, got.flown_s, got.imbalance_db), (-32.0, 0.0, 0.0));
    assert_eq!(got.battery, Some(1.0));
}

#[test]
fn a_long_flight_stays_long_and_launches_whoever_waits_for_it() {
    let most_s = |name| {
        let key = TakeoffParams::KEYS.iter().find(|key| key.name == name).unwrap();
        key.range.unwrap().1 as f32
    };
    let params = TakeoffParams {
        after_previous_s: most_s("after_previous_s"),
        launch_hold_s: 0.0,
        ..TakeoffParams::default()
    };
    let due = |flown_s| {
        let front = received(Packet { flown_s, ..Packet::default() });
        Takeoff::default().due(70.0, &front, 0.2, &params)
    };
    assert!(!due(599.95) && due(600.0));
    for flown_s in [3276.75, 3276.8, 3277.0, 65_536.0, 86_400.0, f32::MAX] {
        assert!(due(flown_s), "{flown_s}");
    }
    assert!(
        f64::from(received(Packet { imbalance_db: f32::MAX, ..Packet::default() }).imbalance_db) > 1000.0
    );
}

#[test]
fn every_multiple_of_the_tick_arrives_as_the_number_that_a_scenario_would_write() {
    for ticks in 0..=u16::MAX {
        let written_s: f32 = format!("{}.{:02}", ticks / 20, ticks % 20 * 5).parse().unwrap();
        for flown_s in [written_s, f32::from(ticks) * 0.05] {
            assert_eq!(received(Packet { flown_s, ..Packet::default() }).flown_s, written_s);
        }
    }
}

#[test]
fn another_version_is_named_however_long_its_packets_are() {
    for length in [1, 14, 30, 31, 60] {
        let bytes = vec![VERSION + 1; length];
        assert_eq!(decode(&bytes), Err(WireError::Version { got: VERSION + 1 }));
    }
    let error = decode(&[7; 20]).unwrap_err().to_string();
    assert!(error.contains("the version, is 7: expected 1"), "{error}");
}

#[test]
fn a_packet_that_is_cut_off_says_so() {
    let whole = sent(&Message { packet: Packet { own: [1; 8], ..Packet::default() }, ..Message::default() });
    assert_eq!(whole.len(), 23);
    for got in 0..SIZE_MIN {
        assert_eq!(decode(&whole[..got]), Err(WireError::Short { got }));
    }
    // Without its section it is a packet: nobody can see that there was one.
    assert_eq!(decode(&whole[..SIZE_MIN]).unwrap().packet.own, [0; 8]);
    for got in SIZE_MIN + 1..whole.len() {
        assert_eq!(decode(&whole[..got]), Err(WireError::Section { kind: OWN, length: 8 }));
    }
}

#[test]
fn sections_that_nobody_knows_yet_are_passed_over_and_a_route_beside_own_words_does_not_fit() {
    let message = Message::default();
    let own = Message { packet: Packet { own: [1; 8], ..Packet::default() }, ..message };
    let route = [&[2 << LENGTH_BITS | 15][..], &[0xff; 15]].concat();
    let with_route = [sent(&message), route.clone()].concat();
    assert_eq!(with_route.len(), SIZE_MAX);
    assert_eq!(decode(&with_route), Ok(message));
    let later = [sent(&own), vec![7 << LENGTH_BITS | 2, 0xff, 0xff]].concat();
    assert_eq!(decode(&later), Ok(own));
    let both = [sent(&own), route].concat();
    assert_eq!(decode(&both), Err(WireError::Long { got: 39 }));
    let error = decode(&both).unwrap_err().to_string();
    assert!(error.contains("own words and a route do not go into one packet"), "{error}");
}

#[test]
fn own_words_of_another_length_are_refused_and_so_is_a_wall_that_is_none() {
    let fields = sent(&Message::default());
    let with = |section: &[u8]| decode(&[&fields, section].concat()).map(|message| message.packet.own);
    let own = [OWN_HEAD, 1, 1, 1, 1, 1, 1, 1, 1];
    assert_eq!(with(&own), Ok([1; 8]));
    assert_eq!(with(&own[..8]), Err(WireError::Section { kind: OWN, length: 8 }));
    assert_eq!(with(&[OWN << LENGTH_BITS | 1, 1]), Err(WireError::Section { kind: OWN, length: 1 }));
    let mut bytes = fields.clone();
    bytes[1] = FOLLOW_BITS;
    let error = decode(&bytes).unwrap_err();
    assert_eq!(error, WireError::Follow { got: 3 });
    assert!(error.to_string().ends_with("expected 0 (centre), 1 (left) or 2 (right)"), "{error}");
}
