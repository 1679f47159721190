//! What is heard over links, against counts and by hand.

use super::*;
use crate::radio::{Deaf, DeafSide, Fading};

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
    Noise::new(Seed(1), 0, &RadioParams::default(), params)
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
    let new = |receivers| channel::<()>(Seed(1), receivers, &RadioParams::default(), &packets, &faults);
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
    let still = RadioParams { sigma_db: 0.0, ..RadioParams::default() };
    let deaf = vec![Deaf { uav: 2, side: DeafSide::Back, start_s: 1.0, stop_s: Some(2.0) }];
    let mut whole = channel(Seed(1), 3, &still, &packets, &FaultConfig { deaf, ..FaultConfig::default() });
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
    let mut whole = channel(Seed(1), 1, &RadioParams::default(), &packets, &FaultConfig::default());
    let mut noise = bare(&packets);
    for tick in 0..100 {
        assert_eq!(hear(&mut noise, tick, BACK, 0.0), hear(&mut whole, tick, BACK, 0.0));
    }
}

#[test]
fn numbers_of_robots_reach_to_the_end_of_their_range() {
    let faults = FaultConfig { burst_rate: 0.5, ..FaultConfig::default() };
    let packets = PacketParams { delay_ticks: 1, drop_rate: 0.0, ..PacketParams::default() };
    let mut whole = channel(Seed(1), 0, &RadioParams::default(), &packets, &faults);
    for side in [None, Some(Side::Back)] {
        let link = Link { from: u16::MAX, to: u16::MAX, side };
        assert!((0..100).any(|tick| hear(&mut whole, tick, link, 0.0).is_some()), "{side:?}");
    }
}

/// What noise adds to a loss of 50 dB, over ticks and by both kinds of draws (dB).
fn added(radio: &RadioParams) -> Vec<f64> {
    let packets = PacketParams { drop_rate: 0.0, limit_db: 1000.0, ..PacketParams::default() };
    let mut channel = channel(Seed(1), 0, radio, &packets, &FaultConfig::default());
    let draws = (0..100_000).flat_map(|tick| [BACK, PAIR].map(|link| (tick, link)));
    draws
        .filter_map(|(tick, link)| hear(&mut channel, tick, link, 50.0))
        .map(|db| f64::from(db) - 50.0)
        .collect()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

#[test]
fn rician_fading_keeps_the_mean_power_and_has_the_spread_of_its_k() {
    for rician_k_db in [-100.0, 0.0, 6.0, 20.0] {
        let radio = RadioParams { fading: Fading::Rician, rician_k_db, ..RadioParams::default() };
        let powers: Vec<f64> = added(&radio).into_iter().map(|db| libm::pow(10.0, -0.1 * db)).collect();
        let k = libm::pow(10.0, 0.1 * f64::from(rician_k_db));
        // Var |h|² = (1 + 2 K)/(1 + K)².
        let expected = (1.0 + 2.0 * k) / ((1.0 + k) * (1.0 + k));
        let power = mean(powers.iter().copied());
        let variance = mean(powers.iter().map(|p| (p - power) * (p - power)));
        assert!((power - 1.0).abs() < 0.01, "{rician_k_db}: {power}");
        assert!((variance - expected).abs() < 0.04 * expected, "{rician_k_db}: {variance} for {expected}");
    }
}

#[test]
fn without_a_steady_part_fading_is_rayleighs_and_with_one_it_is_not() {
    let of =
        |rician_k_db| added(&RadioParams { fading: Fading::Rician, rician_k_db, ..RadioParams::default() });
    let farthest = |draws: &[f64]| {
        // P(loss > x) = P(|h|² < 10^(−x/10)) = 1 − exp(−10^(−x/10)).
        let apart = [-5.0, -2.0, 0.0, 3.0, 10.0, 20.0].map(|x: f64| {
            let share = draws.iter().filter(|&&db| db > x).count() as f64 / draws.len() as f64;
            (share - (1.0 - libm::exp(-libm::pow(10.0, -0.1 * x)))).abs()
        });
        apart.into_iter().fold(0.0, f64::max)
    };
    let rayleigh = of(-100.0);
    assert!(farthest(&rayleigh) < 0.006, "{}", farthest(&rayleigh));
    assert!(farthest(&of(6.0)) > 0.1);
    // In dB its deviation is 10/ln 10 · π/√6 = 5.57, about a mean of 10/ln 10 · 0.5772 = 2.51.
    let mean_db = mean(rayleigh.iter().copied());
    let deviation_db = mean(rayleigh.iter().map(|db| (db - mean_db) * (db - mean_db))).sqrt();
    assert!((mean_db - 2.507).abs() < 0.05 && (deviation_db - 5.57).abs() < 0.05, "{mean_db} {deviation_db}");
}

#[test]
fn a_reading_comes_in_steps_no_better_than_the_least_and_off_by_the_receivers_own_constant() {
    let packets = PacketParams { drop_rate: 0.0, ..PacketParams::default() };
    let read = |radio: &RadioParams, link: Link, loss_db: f32| {
        let radio = RadioParams { sigma_db: 0.0, ..radio.clone() };
        let mut channel = channel(Seed(1), 1, &radio, &packets, &FaultConfig::default());
        hear(&mut channel, 0, link, loss_db).unwrap()
    };
    let p = RadioParams::default();
    assert_eq!(read(&p, BACK, 47.3), 47.3);
    let stepped = RadioParams { quantum_db: 1.0, least_reading_db: Some(40.0), ..p.clone() };
    assert_eq!([39.2, 47.3, 47.6].map(|loss_db| read(&stepped, BACK, loss_db)), [40.0, 47.0, 48.0]);
    let off = RadioParams { reading_offset_db: 2.0, ..p };
    let offsets: Vec<f64> =
        (0..4_000).map(|to| f64::from(read(&off, Link { to, ..PAIR }, 50.0)) - 50.0).collect();
    assert_eq!(f64::from(read(&off, Link { to: 7, ..FRONT }, 60.0)) - 60.0, offsets[7]);
    let (centre, deviation) = (mean(offsets.iter().copied()), mean(offsets.iter().map(|db| db * db)).sqrt());
    assert!(centre.abs() < 0.15 && (deviation - 2.0).abs() < 0.1, "{centre} {deviation}");
}

#[test]
fn a_soft_limit_loses_half_at_the_limit_and_as_the_logistic_curve_has_it_around() {
    let share = |soft_db: f32, drop_rate: f32, link, loss_db: f32| {
        let packets = PacketParams { soft_db, drop_rate, ..PacketParams::default() };
        let still = RadioParams { sigma_db: 0.0, ..RadioParams::default() };
        let mut channel = channel(Seed(1), 0, &still, &packets, &FaultConfig::default());
        (0..20_000).filter(|&tick| hear(&mut channel, tick, link, loss_db).is_some()).count() as f64
            / 20_000.0
    };
    for link in [BACK, PAIR] {
        // 1/(1 + e^-2) = 0.881, 1/2, 1/(1 + e) = 0.269, and beyond 11 widths none.
        for (loss_db, expected) in [(96.0, 0.881), (100.0, 0.5), (102.0, 0.269), (122.5, 0.0)] {
            let share = [share(2.0, 0.0, link, loss_db), share(2.0, 0.2, link, loss_db)];
            assert!((share[0] - expected).abs() < 0.012, "{share:?} at {loss_db}");
            assert!((share[1] - 0.8 * expected).abs() < 0.012, "{share:?} at {loss_db}");
        }
        assert_eq!([99.9, 100.0].map(|loss_db| share(0.0, 0.0, link, loss_db)), [1.0, 0.0]);
    }
}
