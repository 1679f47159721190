//! What is heard over links, against counts and by hand.

use super::*;
use crate::radio::{Deaf, DeafSide};

const BACK: Link = Link { from: 1, to: 0, side: Some(Side::Back) };
const FRONT: Link = Link { side: Some(Side::Front), ..BACK };
const PAIR: Link = Link { from: 5, to: 9, side: None };

/// Hears everything and keeps the time it was sent as the loss.
#[derive(Debug)]
struct Perfect;

impl Channel<()> for Perfect {
    fn transfer(&mut self, link: Link, tick: u64, _: f32, payload: ()) -> Option<Received<()>> {
        Some(Received { from: link.from, loss_db: tick as f32, payload })
    }
}

fn hear(channel: &mut impl Channel<()>, tick: u64, link: Link, loss_db: f32) -> Option<f32> {
    channel.transfer(link, tick, loss_db, ()).map(|received| received.loss_db)
}

fn bare(params: &PacketParams) -> Noise {
    Noise::new(Seed(1), 0, 3.0, params)
}

#[test]
fn a_fifth_is_lost_at_random_half_at_the_limit_and_all_far_beyond_it_on_every_kind_of_link() {
    let share = |params: &PacketParams, link, loss_db| {
        let mut noise = bare(params);
        let heard = (0..20_000).filter(|&tick| hear(&mut noise, tick, link, loss_db).is_some()).count();
        heard as f64 / 20_000.0
    };
    let params = PacketParams::default();
    for link in [BACK, FRONT, PAIR] {
        for (loss_db, expected) in [(60.0, 0.8), (100.0, 0.4), (120.0, 0.0)] {
            let share = share(&params, link, loss_db);
            assert!((share - expected).abs() < 0.015, "{share} heard at {loss_db} dB over {link:?}");
        }
        assert_eq!(share(&PacketParams { drop_rate: 1.0, ..params.clone() }, link, 60.0), 0.0);
        assert_eq!(share(&PacketParams { drop_rate: 0.0, ..params.clone() }, link, 60.0), 1.0);
    }
}

#[test]
fn neighbours_draw_from_the_streams_of_the_receiver_and_its_side() {
    // As a receiver alone would draw: a normal number, then whether the packet arrives.
    let params = PacketParams::default();
    for (link, source) in [(BACK, crate::seed::Source::RadioBack), (FRONT, crate::seed::Source::RadioFront)] {
        let link = Link { to: 7, ..link };
        let (mut noise, mut stream) = (bare(&params), Seed(1).stream(7, source));
        for tick in 0..1_000 {
            let loss_db = 90.0 + 3.0 * stream.normal();
            let arrives = stream.uniform() >= 0.2;
            // Whoever sends: it is the link to the back, or to the front.
            let link = Link { from: (tick % 3) as u16, ..link };
            assert_eq!(
                hear(&mut noise, tick, link, 90.0),
                (arrives && loss_db < 100.0).then_some(loss_db),
                "{tick}"
            );
        }
    }
}

#[test]
fn what_is_heard_on_one_link_moves_nobody_elses_draws() {
    let faults = FaultConfig { burst_rate: 0.1, ..FaultConfig::default() };
    let packets = PacketParams { delay_ticks: 3, ..PacketParams::default() };
    let links = [BACK, FRONT, PAIR, Link { from: 9, to: 5, ..PAIR }, Link { to: 4, ..FRONT }];
    let new = |receivers| channel::<()>(Seed(1), receivers, 3.0, &packets, &faults);
    let mut all = new(0);
    let mut alone: Vec<_> = links.iter().map(|_| new(2)).collect();
    let mut heard = [0; 5];
    for tick in 0..400 {
        for (i, &link) in links.iter().enumerate() {
            let got = hear(&mut all, tick, link, 55.0);
            assert_eq!(got, hear(&mut alone[i], tick, link, 55.0), "{link:?} at {tick}");
            heard[i] += u32::from(got.is_some());
        }
    }
    // And they differ among each other.
    assert!(heard.iter().all(|&heard| (50..350).contains(&heard)), "{heard:?}");
    let shares: std::collections::BTreeSet<_> = heard.into_iter().collect();
    assert!(shares.len() > 3, "{heard:?}");
}

#[test]
fn a_pair_hears_the_same_at_a_tick_whatever_was_asked_before() {
    let mut whole = bare(&PacketParams::default());
    let all: Vec<_> = (0..100).map(|tick| hear(&mut whole, tick, PAIR, 90.0)).collect();
    let mut late = bare(&PacketParams::default());
    assert_eq!(hear(&mut late, 77, PAIR, 90.0), all[77]);
    assert!(all.iter().flatten().count() > 50 && all.iter().any(Option::is_none));
}

#[test]
fn bursts_have_the_mean_length_and_the_share_asked_for_on_every_kind_of_link() {
    let faults = FaultConfig { burst_rate: 0.02, burst_packets: 10.0, ..FaultConfig::default() };
    for link in [BACK, PAIR] {
        let mut bursts = Bursts::new(Box::new(Perfect), Seed(1), 0, &faults);
        let heard: Vec<bool> =
            (0..200_000).map(|tick| hear(&mut bursts, tick, link, 0.0).is_some()).collect();
        let lost = heard.iter().filter(|heard| !**heard).count() as f64;
        let begun = heard.windows(2).filter(|pair| pair[0] && !pair[1]).count() as f64;
        assert!((lost / begun - 10.0).abs() < 0.5, "{} packets a burst", lost / begun);
        assert!((lost / 200_000.0 - 1.0 / 6.0).abs() < 0.01, "{} of all", lost / 200_000.0);
    }
}

#[test]
fn a_one_way_link_is_deaf_on_its_side_and_in_its_time_only() {
    let deaf = Deaf { uav: 0, side: DeafSide::Back, start_s: 1.0, stop_s: Some(2.0) };
    let mut one_way = OneWay::new(Box::new(Perfect), &[deaf]);
    let back = [19, 20, 39, 40].map(|tick| hear(&mut one_way, tick, BACK, 0.0).is_some());
    assert_eq!(back, [true, false, false, true]);
    assert!(hear(&mut one_way, 30, FRONT, 0.0).is_some());
    assert!(hear(&mut one_way, 30, Link { from: 0, to: 1, ..BACK }, 0.0).is_some(), "another UAV");
    assert!(hear(&mut one_way, 30, Link { side: None, ..BACK }, 0.0).is_some(), "no neighbour");
}

#[test]
fn a_late_packet_is_heard_at_the_first_decision_after_its_delay() {
    let mut late = Delayed::new(Box::new(Perfect), 0, 6);
    let heard = [0, 4, 8, 12, 16].map(|tick| hear(&mut late, tick, BACK, 0.0));
    assert_eq!(heard, [None, None, Some(0.0), Some(4.0), Some(8.0)]);
    assert_eq!(hear(&mut late, 16, FRONT, 0.0), None);
}

#[test]
fn a_packet_under_way_is_its_senders_when_another_uav_has_taken_its_place() {
    let mut late = Delayed::new(Box::new(Perfect), 0, 4);
    assert_eq!(late.transfer(BACK, 0, 0.0, ()), None);
    let heard = late.transfer(Link { from: 2, ..BACK }, 4, 0.0, ()).unwrap();
    assert_eq!((heard.from, heard.loss_db), (1, 0.0));
}

#[test]
fn a_deaf_uav_hears_no_late_packet_while_it_is_deaf_and_afterwards_what_was_sent_meanwhile() {
    let packets = PacketParams { delay_ticks: 8, drop_rate: 0.0, ..PacketParams::default() };
    let deaf = vec![Deaf { uav: 2, side: DeafSide::Back, start_s: 1.0, stop_s: Some(2.0) }];
    let mut whole = channel(Seed(1), 3, 0.0, &packets, &FaultConfig { deaf, ..FaultConfig::default() });
    // A sample tells when it was sent.
    let heard: Vec<Option<f32>> = (0..=44)
        .step_by(4)
        .map(|tick: u64| hear(&mut whole, tick, Link { to: 2, ..BACK }, tick as f32))
        .collect();
    let (before, deaf, after) = (&heard[..5], &heard[5..10], &heard[10..]);
    assert_eq!(before, [None, None, Some(0.0), Some(4.0), Some(8.0)]);
    assert_eq!(deaf, [None; 5], "sent before it was deaf, two of them");
    assert_eq!(after, [Some(32.0), Some(36.0)], "sent while it was deaf");
}

#[test]
fn without_faults_a_channel_is_bare_noise() {
    let packets = PacketParams::default();
    let mut whole = channel(Seed(1), 1, 3.0, &packets, &FaultConfig::default());
    let mut noise = bare(&packets);
    for tick in 0..100 {
        assert_eq!(hear(&mut noise, tick, BACK, 0.0), hear(&mut whole, tick, BACK, 0.0));
    }
}

#[test]
fn numbers_of_robots_reach_to_the_end_of_their_range() {
    let faults = FaultConfig { burst_rate: 0.5, ..FaultConfig::default() };
    let packets = PacketParams { delay_ticks: 1, drop_rate: 0.0, ..PacketParams::default() };
    let mut whole = channel(Seed(1), 0, 3.0, &packets, &faults);
    for side in [None, Some(Side::Back)] {
        let link = Link { from: u16::MAX, to: u16::MAX, side };
        assert!((0..100).any(|tick| hear(&mut whole, tick, link, 0.0).is_some()), "{side:?}");
    }
}
