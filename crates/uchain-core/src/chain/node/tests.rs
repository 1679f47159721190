extern crate std;

use proptest::prelude::*;
use std::{vec, vec::Vec};

use super::{
    super::{
        BASE_ID, Brain, CenterLaw, Doing, Explanation, Heard, Launch, LaunchHold, Override, PendingLaunch,
        PilotInput, SpeedLaw, Tof, WallSide, Walls, equalize,
    },
    *,
};

/// Whatever a node may see, numbers that are none included, in whatever order.
fn observations() -> impl Strategy<Value = Vec<Observation>> {
    let loss_db = prop_oneof![8 => 30.0_f32..100.0, 1 => prop::num::f32::ANY];
    let heard = (0_u16..4, any::<bool>(), loss_db, prop::num::f32::ANY).prop_map(
        |(place, is_base, loss_db, speed_mps)| {
            let flown_s = 60.0;
            let packet = Packet { place, ground_speed_mps: speed_mps, flown_s, ..Packet::default() };
            let (from, packet) = if is_base { (BASE_ID, Packet::BASE) } else { (place, packet) };
            Heard { from, loss_db, packet }
        },
    );
    let radio = prop::collection::vec(heard, 0..5).prop_map(|heard| heard.into_iter().collect());
    let beam_m = || prop_oneof![4 => 0.0_f32..2.0, 1 => prop::num::f32::ANY];
    let tof = (beam_m(), beam_m(), beam_m(), beam_m()).prop_map(|(nw_m, ne_m, sw_m, se_m)| Tof {
        nw_m,
        ne_m,
        sw_m,
        se_m,
    });
    let speed_mps = || prop_oneof![4 => -0.5_f32..0.5, 1 => prop::num::f32::ANY];
    let seen = (
        prop::option::weighted(0.2, 0_u16..4),
        prop::option::of(tof),
        prop::option::weighted(0.8, radio),
        prop::option::of(speed_mps()),
        prop::option::of(speed_mps()),
    );
    let seen = seen.prop_map(|(place, tof, radio, ground_speed_mps, pilot_mps)| Observation {
        place,
        tof,
        radio,
        ground_speed_mps,
        pilot: pilot_mps.map(|speed_mps| PilotInput { speed_mps, ..PilotInput::default() }),
        battery: None,
    });
    prop::collection::vec(seen, 0..120)
}

/// Its bits: a zero has a sign, and what is no number equals itself.
fn bits(command: Command) -> (u32, u32, u32, bool) {
    let Command { forward_mps, lateral_mps, yaw_rate_radps, airborne } = command;
    (forward_mps.to_bits(), lateral_mps.to_bits(), yaw_rate_radps.to_bits(), airborne)
}

/// A decision in halves, by a law.
fn in_halves(node: &mut Node, seen: &Observation, law: impl Fn(&Levelling) -> f32) -> Command {
    let level_mps = node.prepare(seen).map_or(f32::NAN, |asked| law(&asked));
    node.conclude(seen, level_mps)
}

proptest! {
    #[test]
    fn a_decision_in_halves_by_eq_12_has_the_bits_of_the_whole(
        all in observations(), is_head in any::<bool>(), raw in any::<bool>(),
    ) {
        let signal = if raw { Signal::Raw } else { Signal::Filtered };
        let params = NodeParams { link: LinkParams { signal, ..LinkParams::default() }, ..NodeParams::default() };
        let mut whole = Node::new(if is_head { Role::Head } else { Role::Relay }, params.clone());
        let mut halves = whole.clone();
        for seen in &all {
            let eq_12 = |asked: &Levelling| equalize(asked.back_db, asked.front_db, &params.equalize);
            prop_assert_eq!(bits(in_halves(&mut halves, seen, eq_12)), bits(whole.decide(seen)));
            prop_assert_eq!(halves.say(seen).imbalance_db.to_bits(), whole.say(seen).imbalance_db.to_bits());
        }
    }

    #[test]
    fn whatever_is_seen_or_wished_a_command_is_a_number_within_its_limits(
        all in observations(), wish_mps in prop::num::f32::ANY, is_head in any::<bool>(),
        law in prop::sample::select(vec![CenterLaw::Wall, CenterLaw::Paper, CenterLaw::Firmware]),
        speed in prop::sample::select(vec![SpeedLaw::Lipschitz, SpeedLaw::InverseModel, SpeedLaw::BangBang]),
    ) {
        let params = NodeParams {
            center: CenterParams { law, ..CenterParams::default() },
            equalize: EqualizeParams { law: speed, spacing: true, ..EqualizeParams::default() },
            ..NodeParams::default()
        };
        let mut node = Node::new(if is_head { Role::Head } else { Role::Relay }, params.clone());
        let mut led = node.clone();
        for seen in &all {
            for command in [node.decide(seen), in_halves(&mut led, seen, |_| wish_mps)] {
                prop_assert!(command.forward_mps.abs() <= 0.3, "{command:?}");
                prop_assert!(command.lateral_mps.abs() <= params.center.lateral_max_mps, "{command:?}");
                prop_assert!(command.yaw_rate_radps.abs() <= params.center.yaw_rate_max_radps, "{command:?}");
            }
            let (back, front) = (node.estimates().back, node.estimates().front);
            let believed = [back.filtered_db, back.raw_db, front.filtered_db, front.raw_db];
            prop_assert!(believed.into_iter().flatten().all(f32::is_finite), "{believed:?}");
        }
    }
}

/// A relay between the head and the base, one decision after the other: what it sees at a loss of its front link.
fn between(front_db: f32) -> Observation {
    let head = Packet { flown_s: 60.0, ..Packet::default() };
    let heard = [
        Heard { from: 0, loss_db: front_db, packet: head },
        Heard { from: BASE_ID, loss_db: 60.0, packet: Packet::BASE },
    ];
    Observation { place: Some(1), radio: Some(heard.into_iter().collect()), ..Observation::default() }
}

/// A relay that has flown for a while by a law, and how it asks for what it asks.
fn flown(law: impl Fn(&Levelling) -> f32) -> (Node, Explanation) {
    let mut node = Node::new(Role::Relay, NodeParams::default());
    for _ in 0..200 {
        in_halves(&mut node, &between(63.0), &law);
    }
    let why = node.explain(&between(63.0)).unwrap();
    (node, why)
}

#[test]
fn another_law_flies_otherwise_and_its_own_wish_is_explained() {
    let params = NodeParams::default().equalize;
    let (_, eq_12) = flown(|asked| equalize(asked.back_db, asked.front_db, &params));
    let (node, back) = flown(|_| -0.125);
    assert!((eq_12.wish_mps - 0.2).abs() < 1e-3 && eq_12.estimates.allowed_mps == Some(eq_12.wish_mps));
    assert_eq!((back.wish_mps, back.estimates.allowed_mps), (-0.125, Some(-0.125)));
    assert_eq!(back.imbalance_db, eq_12.imbalance_db);
    // Too weak a link to the base is stronger than every law.
    let (mut node, mut seen) = (node, between(63.0));
    let mut weak = Heard { from: BASE_ID, loss_db: 95.0, packet: Packet::BASE };
    weak.packet.place = Packet::BASE_PLACE;
    seen.radio = Some([between(63.0).radio.unwrap().heard()[0], weak].into_iter().collect());
    for _ in 0..50 {
        in_halves(&mut node, &seen, |_| 0.3);
    }
    assert_eq!(node.explain(&seen).unwrap().wish_mps, 0.3);
    assert_eq!(node.estimates().allowed_mps, Some(-0.2));
}

#[test]
fn nothing_is_asked_on_the_ground_of_the_head_between_decisions_or_before_both_links_are_heard() {
    let mut relay = Node::new(Role::Relay, NodeParams::default());
    assert_eq!(relay.prepare(&between(40.0)), None, "on the ground");
    let (mut relay, _) = flown(|_| 0.0);
    let asked = relay.prepare(&between(63.0)).unwrap();
    assert_eq!((asked.place, asked.back.raw_db, asked.front.raw_db), (1, Some(60.0), Some(63.0)));
    assert_eq!(relay.prepare(&Observation::default()), None, "between decisions");
    // A speed that nobody asked for is passed over.
    let before = relay.clone();
    relay.conclude(&Observation::default(), 0.3);
    assert_eq!(relay, before);
    assert_eq!(relay.prepare(&Observation { place: Some(0), ..between(63.0) }), None, "the head");
    let mut young = Node::new(Role::Relay, NodeParams::default());
    let ahead = between(63.0).radio.unwrap().heard()[0];
    let one = Observation { radio: Some([ahead].into_iter().collect()), ..between(63.0) };
    for _ in 0..200 {
        assert_eq!(young.prepare(&one), None, "one link of two");
        young.conclude(&one, 0.3);
    }
    assert!(young.decide(&one).airborne && young.estimates().allowed_mps == Some(0.0));
}

/// What a relay that has flown for a while is about, by what it sees.
fn doing(params: &NodeParams, seen: &Observation) -> Doing {
    let mut node = Node::new(Role::Relay, params.clone());
    for _ in 0..200 {
        node.decide(&between(63.0));
    }
    for _ in 0..50 {
        node.decide(seen);
    }
    node.doing(seen).unwrap()
}

#[test]
fn a_relay_says_what_overrides_it_and_which_walls_it_steers_by() {
    let params = NodeParams::default();
    assert_eq!(doing(&params, &between(63.0)), Doing::default());
    let silent = Observation { radio: Some(RadioSlot::default()), ..between(63.0) };
    assert_eq!(doing(&params, &silent).overridden, Some(Override::BackLost));
    let near = NodeParams {
        equalize: EqualizeParams { spacing: true, spacing_db: 70.0, ..params.equalize.clone() },
        ..params.clone()
    };
    assert_eq!(doing(&near, &between(63.0)).overridden, Some(Override::Spacing));
    let narrow = Tof { nw_m: 0.5, ne_m: 2.0, sw_m: 0.5, se_m: 0.6 };
    let by_left = doing(&params, &Observation { tof: Some(narrow), ..between(63.0) });
    assert_eq!((by_left.walls, by_left.invalid_wall()), (Some(Walls::Left), Some(WallSide::Right)));
    let too_near = Tof { nw_m: 0.1, sw_m: 0.1, ne_m: 0.5, se_m: 0.5 };
    let pushed = doing(&params, &Observation { tof: Some(too_near), ..between(63.0) });
    assert_eq!((pushed.pushed_by, by_left.pushed_by), (Some(WallSide::Left), None));
}

#[test]
fn a_uav_on_the_ground_says_that_its_launch_is_armed_or_what_holds_it() {
    let seen = |loss_db, flown_s, imbalance_db| {
        let ahead = Packet { flown_s, imbalance_db, ..Packet::default() };
        let heard = [Heard { from: 0, loss_db, packet: ahead }];
        Observation { place: Some(1), radio: Some(heard.into_iter().collect()), ..Observation::default() }
    };
    let converged = TakeoffParams { launch: Launch::Converged, ..TakeoffParams::default() };
    let launch = |takeoff: &TakeoffParams, seen: &[Observation]| {
        let params = NodeParams { takeoff: takeoff.clone(), ..NodeParams::default() };
        let mut node = Node::new(Role::Relay, params);
        for seen in seen {
            _ = node.decide(seen);
        }
        node.doing(seen.last().unwrap()).unwrap().launch
    };
    let held =
        |takeoff: &TakeoffParams, seen: &[Observation]| launch(takeoff, seen).map(|launch| launch.held);
    let threshold = TakeoffParams::default();
    assert_eq!(held(&threshold, &[seen(59.0, 60.0, 0.0)]), None, "the link is good");
    assert_eq!(
        launch(&threshold, &[seen(65.0, 60.0, 0.0)]),
        Some(PendingLaunch { loss_db: 65.0, held: None })
    );
    assert_eq!(held(&threshold, &[seen(65.0, 1.0, 0.0)]), Some(Some(LaunchHold::Ahead)));
    assert_eq!(held(&converged, &[seen(65.0, 60.0, 9.0)]), Some(Some(LaunchHold::Unlevelled)));
    assert_eq!(held(&threshold, &[seen(65.0, 60.0, 9.0)]), Some(None), "it waits for no level");
    let silence = Observation { radio: Some(RadioSlot::default()), ..seen(65.0, 1.0, 0.0) };
    let mut quiet = vec![seen(65.0, 1.0, 0.0)];
    quiet.extend(std::iter::repeat_n(silence, 10));
    assert_eq!(held(&threshold, &quiet), Some(Some(LaunchHold::Silent)));
    let many = vec![seen(65.0, 60.0, 0.0); 20];
    assert_eq!(held(&threshold, &many), None, "in the air");
}
