use uchain_sim::{
    mission::chain::{Frame, Summary},
    record::{RecordError, Recorder},
    run::run,
};

use crate::course;

fn fly(name: &str, sets: &[&str]) -> Summary {
    run(&course(name, sets), 1, &mut ()).unwrap()
}

/// Whatever the radio does, UAVs stay within the tunnel and every number is a number.
struct Sane;

impl Recorder<Frame> for Sane {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        for uav in &frame.uavs {
            assert!(uav.x_m.is_finite() && uav.y_m.is_finite() && uav.heading_rad.is_finite(), "{uav:?}");
        }
        for link in &frame.links {
            assert!(link.true_db.is_finite() && link.filtered_db.is_none_or(f32::is_finite), "{link:?}");
        }
        Ok(())
    }
}

#[test]
fn from_no_loss_to_total_loss_every_run_ends_in_words() {
    for percent in [0, 20, 40, 60, 80, 100] {
        let set = format!("packets.drop_rate={}", f64::from(percent) / 100.0);
        let s = run(&course("circuit", &[&set]), 1, &mut Sane).unwrap();
        let words = s.verdict.to_string();
        assert_eq!(words.contains("the head never heard anybody"), percent == 100, "{percent} %: {words}");
        assert!(s.verdict.outcome().is_success() || percent > 40, "{percent} %: {words}");
        if percent <= 40 {
            assert!(s.uavs >= 3 && s.below_limit_fraction == Some(1.0), "{percent} %: {s:?}");
        }
    }
    // Nobody hears anybody: the head takes off, stays, and nobody follows.
    let s = fly("circuit", &["packets.drop_rate=1"]);
    assert!(s.uavs == 1 && s.head_reach_m < 0.8, "{s:?}");
    assert_eq!(s.links[0].filtered_db, None);
}

#[test]
fn bursts_of_two_seconds_delay_the_chain_but_do_not_break_it() {
    let sets = ["faults.burst_rate=0.02", "faults.burst_packets=10"];
    let s = run(&course("circuit", &sets), 1, &mut Sane).unwrap();
    // Every burst holds the head back, and its pilot does not wait.
    let word = s.verdict.outcome().word();
    assert!(["completed", "head-held"].contains(&word), "{word}: {}", s.verdict);
    assert_eq!(s.below_limit_fraction, Some(1.0));
    assert_ne!(s.digest, fly("circuit", &[]).digest, "the bursts must be felt");
}

#[test]
fn a_head_that_hears_nothing_is_pulled_back_while_its_neighbours_still_hear_it() {
    let deaf = "faults.deaf=[{ uav = 0, side = \"back\", start_s = 30.0, stop_s = 40.0 }]";
    let s = run(&course("circuit", &[deaf]), 1, &mut Sane).unwrap();
    assert!(s.head_reach_m < fly("circuit", &[]).head_reach_m - 1.0, "{s:?}");
    // The link healed, but the pilot did not wait for the head.
    assert_eq!(s.verdict.outcome().word(), "head-held", "{}", s.verdict);
}

#[test]
fn a_dead_relay_is_named_and_the_chain_closes_over_it() {
    let s = run(&course("circuit", &["faults.dead=[{ uav = 1, start_s = 80.0 }]"]), 1, &mut Sane).unwrap();
    let words = s.verdict.to_string();
    assert!(s.verdict.outcome().is_success() && words.contains("; UAV 1 failed at 80.00 s"), "{words}");
    assert_eq!(s.links.iter().map(|link| link.uav).collect::<Vec<_>>(), [0, 2, 3]);
    assert_eq!(s.launches_s.len(), 4, "the spare takes off: {s:?}");
    assert!(s.connected_fraction > Some(0.95), "{s:?}");
}

#[test]
fn a_uav_may_die_at_any_time() {
    for uav in 0..4 {
        for start_s in [0.0, 0.05, 1.0, 19.0, 60.0, 119.8] {
            let set = format!("faults.dead=[{{ uav = {uav}, start_s = {start_s:?} }}]");
            let s = run(&course("circuit", &[&set]), 1, &mut Sane).unwrap();
            let words = s.verdict.to_string();
            let flew = words.contains(" failed at ");
            let expected = match uav {
                0 => start_s > 0.0,
                1 => start_s > 18.0,
                2 => start_s > 50.0,
                _ => false,
            };
            assert_eq!(flew, expected, "{set}: {words}");
            assert!(s.uavs <= 3, "{set}: {s:?}");
            if uav == 0 {
                assert_eq!((s.relays_needed, s.bottleneck_gap_db), (None, None), "{set}");
                assert!(
                    s.connected_fraction.is_none_or(|share| share <= start_s / 120.0 + 0.01),
                    "{set}: {s:?}"
                );
            }
        }
    }
}

#[test]
fn packets_a_decision_late_do_not_upset_the_chain() {
    let s = run(&course("circuit", &["packets.delay_ticks=4"]), 1, &mut Sane).unwrap();
    assert!(s.spread_db.unwrap() < 4.0 && s.connected_fraction >= Some(0.99), "{s:?}");
}

/// Every switch of the laws and the radio is felt, and none upsets the chain.
#[test]
fn every_switch_changes_the_run_and_the_chain_still_reaches_as_deep() {
    let plain = fly("circuit", &[]);
    for sets in [
        "takeoff.launch=converged takeoff.converged_db=0.5",
        "takeoff.launch_signal=raw",
        "link.signal=raw",
        "link.gap=predict",
        "link.base_flow=false",
        "equalize.law=inverse-model",
        "equalize.law=bang-bang",
        "equalize.spacing=true",
        "center.law=firmware",
        "radio.shadowing=wall-count",
        "radio.antenna_db=3",
        "radio.detour_db_per_m=20",
        "packets.delay_ticks=2",
        "faults.deaf=[{uav=1,side=\"front\",start_s=60.0,stop_s=63.0}]",
    ] {
        let s = run(&course("circuit", &sets.split(' ').collect::<Vec<_>>()), 1, &mut Sane).unwrap();
        assert_ne!(s.digest, plain.digest, "{sets}");
        assert!(s.head_reach_m > 6.0 && s.connected_fraction >= Some(0.97), "{sets}: {s:?}");
        assert_eq!((s.wall_contacts, s.uav_contacts), (0, 0), "{sets}");
    }
}
