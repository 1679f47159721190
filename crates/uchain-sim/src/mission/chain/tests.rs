//! Who fails is out of the chain from that instant on.

use uchain_core::chain::RadioSlot;

use super::*;
use crate::{config::builtin, mission::chain::Scenario};

/// `straight` without losses at random, with these planned faults.
fn course(dead: &str) -> Arc<Course> {
    let source = builtin("straight").unwrap();
    let sets = ["packets.drop_rate=0".to_owned(), format!("faults.dead=[{dead}]")];
    Course::lay_out(Scenario::parse(&source, &sets).unwrap(), &source).unwrap()
}

/// What every UAV saw at this instant, and the frame of the tick that began then.
fn at(course: &Arc<Course>, time_s: f64) -> (Vec<Observation>, Frame) {
    let mut chain = Chain::start(course.clone(), 1);
    while crate::clock::time_s(chain.tick) <= time_s {
        chain.step(&mut ()).unwrap();
    }
    (chain.seen, chain.frame)
}

/// Whom the head hears behind itself at this instant: for how long it has flown (s).
fn heard_behind_head(seen: &[Observation]) -> f32 {
    seen[0].radio.as_ref().unwrap().back(0).unwrap().packet.flown_s
}

#[test]
fn a_uav_that_fails_is_heard_by_nobody_from_that_instant_on() {
    let of_the_first = heard_behind_head(&at(&course(""), 60.0).0);
    for fails_s in [60.0, 59.95, 59.85] {
        let (seen, frame) = at(&course(&format!("{{ uav = 1, start_s = {fails_s:?} }}")), 60.0);
        assert!(heard_behind_head(&seen) < of_the_first - 5.0, "{fails_s}: the second relay is heard");
        assert_eq!(seen[1].radio, Some(RadioSlot::default()), "{fails_s}: the dead one hears nothing");
        assert_eq!(frame.links.iter().map(|link| link.uav).next(), Some(0));
        assert!(frame.links.iter().all(|link| link.uav != 1), "{fails_s}: {:?}", frame.links);
        assert!(!frame.uavs[1].airborne && frame.uavs[1].tof.is_none(), "{fails_s}");
    }
    // The control: who fails a decision later is still heard.
    let (seen, _) = at(&course("{ uav = 1, start_s = 60.2 }"), 60.0);
    assert_eq!(heard_behind_head(&seen), of_the_first);
}

#[test]
fn a_uav_that_fails_is_in_no_sensors_sight_from_that_instant_on() {
    // Head and relay hover, the relay behind the head on its left.
    let hovering = |dead: &str| {
        let source = builtin("straight").unwrap();
        let sets = [
            "takeoff.s_min_db=-50".to_owned(),
            "takeoff.launch_hold_s=0".to_owned(),
            "takeoff.after_previous_s=0".to_owned(),
            "tof.dropout=0".to_owned(),
            "chain.uavs=2".to_owned(),
            "chain.spawns_m=[[1.0, 0.0], [0.8, 0.2]]".to_owned(),
            format!("faults.dead=[{dead}]"),
        ];
        Course::lay_out(Scenario::parse(&source, &sets).unwrap(), &source).unwrap()
    };
    let rear_m = |dead: &str| at(&hovering(dead), 1.0).0[0].tof.unwrap().sw_m;
    let alone = rear_m("{ uav = 1, start_s = 0 }");
    assert_eq!(rear_m("{ uav = 1, start_s = 1.0 }"), alone);
    assert!(rear_m("{ uav = 1, start_s = 1.05 }") < alone - 0.2, "the control: it is seen while it flies");
}

#[test]
fn the_next_in_line_listens_from_the_instant_on_at_which_the_one_before_it_fails() {
    let listens = |dead: &str, uav: usize| {
        let (seen, _) = at(&course(dead), 10.0);
        seen[uav].radio.as_ref().is_some_and(|slot| slot.front(seen[uav].place.unwrap()).is_some())
    };
    assert!(!listens("{ uav = 1, start_s = 10 }", 1) && listens("{ uav = 1, start_s = 10 }", 2));
    assert!(listens("{ uav = 1, start_s = 10.2 }", 1) && !listens("{ uav = 1, start_s = 10.2 }", 2));
}
