//! UAVs that join, leave, land and come back.

use uchain_core::chain::{Brain, Command, Node, Observation, Override, Packet, Role};
use uchain_sim::{
    mission::{
        Mission,
        chain::{Chain, Course, Frame, McapRecorder, Member, MemberError},
    },
    replay::Recording,
};

use crate::course;

/// Flies on for so long (s), with these UAVs told to stay on the ground.
fn fly(chain: &mut Chain, seconds: f64, grounded: &[usize]) {
    let mut commands = Vec::new();
    for _ in 0..(20.0 * seconds) as u32 {
        chain.sense();
        chain.decide(&mut commands);
        for &uav in grounded {
            commands[uav] = Command::default();
        }
        chain.act(&commands);
    }
}

/// UAVs at the front ends of the links, head first.
fn links(chain: &Chain) -> Vec<usize> {
    chain.frame().links.iter().map(|link| link.uav).collect()
}

#[test]
fn a_relay_that_lands_leaves_no_gap_and_comes_back_when_it_is_its_turn_again() {
    let mut chain = Chain::start(course("straight", &["duration_s=1000"]), 1);
    fly(&mut chain, 90.0, &[]);
    let before = links(&chain);
    assert!(before.len() >= 3 && before[..2] == [0, 1], "{before:?}");
    fly(&mut chain, 1.0, &[1]);
    assert!(!links(&chain).contains(&1), "its neighbours hear each other now");
    assert_eq!(chain.members().member(1), Some(Member::Landed));
    // It goes to the end of the list, and takes off as any relay does that waits.
    chain.leave(1).unwrap();
    let last = chain.members().order().len();
    chain.join(1, last).unwrap();
    assert_eq!(chain.members().member(1), Some(Member::Waiting));
    assert_eq!(chain.members().place_of(1), Some(last as u16));
    // Its brain still asks to fly: it is a link at once, the last one before the base.
    fly(&mut chain, 1.0, &[]);
    assert_eq!(links(&chain).last(), Some(&1), "{:?}", links(&chain));
}

#[test]
fn who_leads_the_list_is_the_head_and_has_the_pilot() {
    let mut chain = Chain::start(course("straight", &["duration_s=1000"]), 1);
    fly(&mut chain, 38.0, &[]);
    assert_eq!((chain.frame().leader, chain.members().leader()), (0, Some(0)));
    chain.leave(0).unwrap();
    chain.sense();
    fly(&mut chain, 1.0, &[0]);
    let frame = chain.frame();
    assert_eq!(frame.leader, 1);
    assert_eq!(frame.links[0].uav, 1);
    assert!(frame.is_connected(1.0).unwrap(), "{:?}", frame.links);
    let piloted: Vec<bool> = chain.sense().iter().map(|seen| seen.pilot.is_some()).collect();
    assert_eq!(piloted.iter().position(|&has| has), Some(1));
    assert_eq!(piloted.iter().filter(|&&has| has).count(), 1);
    let reach_m = chain.frame().head_reach_m;
    fly(&mut chain, 5.0, &[0]);
    let why = chain.explain(1).unwrap();
    assert!(chain.frame().head_reach_m > reach_m + 0.3, "the pilot flies it on: {reach_m} m, {why:?}");
}

#[test]
fn who_leaves_in_the_air_is_heard_by_nobody_and_flies_home_by_its_own_law() {
    let mut chain = Chain::start(course("straight", &["duration_s=1000"]), 1);
    fly(&mut chain, 90.0, &[]);
    let last = *links(&chain).last().unwrap();
    chain.leave(last).unwrap();
    fly(&mut chain, 3.0, &[]);
    assert!(!links(&chain).contains(&last));
    assert_eq!(chain.explain(last).unwrap().overridden, Some(Override::BackLost));
    assert!(chain.frame().uavs[last].forward_mps < -0.1);
}

#[test]
fn a_second_place_for_one_uav_is_refused_in_words() {
    let mut chain = Chain::start(course("straight", &[]), 1);
    let error = chain.join(2, 0).unwrap_err();
    assert_eq!(error, MemberError::Joined { uav: 2, place: 2 });
    assert_eq!(error.to_string(), "UAV 2 is in the chain already, in place 2; it has to leave first");
}

#[test]
fn the_charge_of_a_battery_is_sensed_and_told_to_the_neighbours() {
    let mut chain = Chain::start(course("straight", &["packets.drop_rate=0"]), 1);
    fly(&mut chain, 60.0, &[]);
    let told = |chain: &mut Chain| {
        for _ in 0..5 {
            fly(chain, 0.05, &[]);
            let seen = chain.sense();
            if let Some(radio) = &seen[0].radio {
                return (seen[1].battery, radio.back(0).and_then(|heard| heard.packet.battery));
            }
        }
        panic!("a decision every four ticks");
    };
    assert_eq!(told(&mut chain), (None, None));
    chain.set_battery(1, Some(0.42));
    assert_eq!(told(&mut chain), (Some(0.42), Some(0.42)));
}

/// The built-in law, that is shown packets from so many places on either side.
#[derive(Debug)]
struct FarSighted(Node, u16);

impl Brain for FarSighted {
    fn decide(&mut self, seen: &Observation) -> Command {
        self.0.decide(seen)
    }

    fn say(&self, seen: &Observation) -> Packet {
        self.0.say(seen)
    }

    fn reach(&self) -> u16 {
        self.1
    }
}

#[test]
fn whoever_wants_to_hears_farther_than_his_neighbours_and_they_hear_what_they_heard() {
    let near = course("straight", &["packets.drop_rate=0"]);
    let far = |reach| {
        near.with_law("far", move |uav, params| {
            let role = if uav == 0 { Role::Head } else { Role::Relay };
            FarSighted(Node::new(role, params.clone()), reach)
        })
    };
    let heard_at_the_end = |course| {
        let mut chain = Chain::start(course, 1);
        let mut heard = Vec::new();
        for _ in 0..2000 {
            let seen = chain.sense();
            if let Some(radio) = &seen[0].radio {
                heard = radio.heard().to_vec();
            }
            fly(&mut chain, 0.05, &[]);
        }
        let mut ids: Vec<u16> = heard.iter().map(|heard| heard.from).collect();
        ids.sort_unstable();
        let neighbours: Vec<_> = heard.into_iter().filter(|heard| heard.from == 1).collect();
        (ids, neighbours, chain.frame().uavs.clone())
    };
    let (ids, neighbours, uavs) = heard_at_the_end(near.clone());
    assert_eq!(ids, [1]);
    let (far_ids, far_neighbours, far_uavs) = heard_at_the_end(far(3));
    assert_eq!(far_ids, [1, 2, uchain_core::chain::BASE_ID], "three are in the air");
    // Noise of other pairs moves nobody's draws, and the built-in law heeds the nearest on each side only.
    assert_eq!(far_neighbours, neighbours);
    assert_eq!(far_uavs, uavs);
}

#[test]
fn a_recording_tells_who_led_the_chain() {
    let scene = course("straight", &["duration_s=1000"]);
    let mut chain = Chain::start(scene.clone(), 1);
    let mut recorder = McapRecorder::start(Vec::new(), &*scene, 1).unwrap();
    let mut flown = Vec::new();
    for tick in 0..800 {
        if tick == 700 {
            chain.leave(0).unwrap();
        }
        chain.step(&mut recorder).unwrap();
        flown.push(chain.frame().clone());
    }
    assert_eq!((flown[699].leader, flown[700].leader), (0, 1));
    let file = recorder.finish().unwrap();
    let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let mut frame = Frame::default();
    for flown in &flown {
        assert!(recording.frames.read(&mut frame).unwrap());
        assert_eq!(&frame, flown);
    }
}
