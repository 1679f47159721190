//! What the guide for firmware authors (docs/guide/firmware.md) says of rates, signs and sensors that are missing or
//! stuck, tried on the node that flies.

use uchain_core::chain::{
    BASE_ID, Brain as _, CenterParams, Centering, Command, Follow, Heard, Node, NodeParams, Observation,
    Packet, PilotInput, RadioSlot, Role, TOF_RANGE_M, Tof, center,
};

/// A straight tunnel with 5 dB a metre.
fn loss_db(length_m: f32) -> f32 {
    35.0 + 5.0 * length_m
}

/// A relay between a base at 0 m and a head.
struct Flight {
    relay: Node,
    at_m: f32,
    head_m: f32,
    head_mps: f32,
    command: Command,
}

impl Flight {
    /// On the ground at the base, the head 9 m deep.
    fn new() -> Self {
        let relay = Node::new(Role::Relay, NodeParams::default());
        Self { relay, at_m: 0.0, head_m: 9.0, head_mps: 0.0, command: Command::default() }
    }

    /// In the middle of both.
    fn levelled() -> Self {
        let mut flight = Self::new();
        flight.fly(120, |_| {});
        assert!((flight.at_m - 4.5).abs() < 0.01, "{} m", flight.at_m);
        flight
    }

    /// Decides once, on what a fault leaves of what there is to see; a fifth of a second passes.
    fn decide(&mut self, fault: &impl Fn(&mut Observation)) {
        let head = Packet { flown_s: 60.0, ground_speed_mps: self.head_mps, ..Packet::default() };
        let heard = [
            Heard { from: 0, loss_db: loss_db(self.head_m - self.at_m), packet: head },
            Heard { from: BASE_ID, loss_db: loss_db(self.at_m), packet: Packet::BASE },
        ];
        let mut seen = Observation {
            place: Some(1),
            radio: Some(heard.into_iter().collect()),
            ground_speed_mps: Some(self.command.forward_mps),
            ..Observation::default()
        };
        fault(&mut seen);
        self.command = self.relay.decide(&seen);
        self.at_m += self.command.forward_mps / 5.0;
        self.head_m += self.head_mps / 5.0;
    }

    fn fly(&mut self, time_s: usize, fault: impl Fn(&mut Observation)) {
        (0..5 * time_s).for_each(|_| self.decide(&fault));
    }

    /// How many decisions pass with a fault until the speed is this one.
    fn decisions_until(&mut self, forward_mps: f32, fault: impl Fn(&mut Observation)) -> usize {
        (1..100)
            .find(|_| {
                self.decide(&fault);
                self.command.forward_mps == forward_mps
            })
            .expect("within 20 s")
    }
}

/// Gives the packets of one sender another loss.
fn misread(seen: &mut Observation, from: u16, read: impl Fn(f32) -> f32) {
    let all = seen.radio.take().unwrap_or_default();
    let misread = |one: &Heard| {
        let loss_db = if one.from == from { read(one.loss_db) } else { one.loss_db };
        Heard { loss_db, ..*one }
    };
    seen.radio = Some(all.heard().iter().map(misread).collect());
}

#[test]
fn with_the_received_power_in_place_of_a_loss_no_relay_ever_takes_off() {
    let mut flight = Flight::new();
    flight.fly(120, |seen| {
        misread(seen, 0, |loss_db| -loss_db);
        misread(seen, BASE_ID, |loss_db| -loss_db);
    });
    assert!(!flight.command.airborne);
    let mut flight = Flight::new();
    flight.fly(120, |_| {});
    assert!(flight.command.airborne);
}

#[test]
fn silence_is_counted_in_decisions_whatever_the_clock_says() {
    // Six decisions are 1.2 s at 5 Hz; at every tick of 20 Hz they would be 0.3 s.
    let silent = |seen: &mut Observation| seen.radio = Some(RadioSlot::default());
    assert_eq!(Flight::levelled().decisions_until(-0.2, silent), 6);
    // Without a slot it asks for half a minute for what it asked for before.
    let mut flight = Flight::levelled();
    let before = flight.command;
    flight.fly(30, |seen| seen.radio = None);
    assert_eq!(flight.command, before);
}

#[test]
fn a_loss_that_is_no_number_is_silence_back_it_retreats_and_front_it_hovers() {
    let no_number = |from| move |seen: &mut Observation| misread(seen, from, |_| f32::NAN);
    let mut flight = Flight::levelled();
    assert_eq!(flight.decisions_until(-0.2, no_number(BASE_ID)), 6);
    flight.decide(&|_| {});
    assert!(flight.command.forward_mps > -0.2, "one packet ends that");
    // A head that flies on makes the relay follow: until it is not heard any more.
    let mut flight = Flight::levelled();
    flight.head_mps = 0.1;
    flight.fly(20, |_| {});
    assert!(flight.command.forward_mps > 0.02, "{:?}", flight.command);
    assert_eq!(flight.decisions_until(0.0, no_number(0)), 6);
    // A relay that has never heard its base hovers where it took off.
    let mut flight = Flight::new();
    flight.fly(60, no_number(BASE_ID));
    assert_eq!((flight.command.airborne, flight.at_m), (true, 0.0));
}

#[test]
fn a_frozen_front_rssi_leaves_the_head_alone_after_a_third_of_a_metre() {
    let mut flight = Flight::levelled();
    flight.head_mps = 0.1;
    let frozen_db = loss_db(flight.head_m - flight.at_m);
    flight.fly(60, |seen| misread(seen, 0, |_| frozen_db));
    assert!((flight.at_m - 4.5 - 0.28).abs() < 0.01, "{} m", flight.at_m);
    assert!((flight.head_m - 15.0).abs() < 0.01 && flight.command.forward_mps < 0.001);
    assert_eq!(flight.relay.estimates().front.silent_s, Some(0.0), "nothing tells it");
}

#[test]
fn a_frozen_back_rssi_takes_it_along_with_the_head_beyond_its_own_threshold() {
    let mut flight = Flight::levelled();
    flight.head_mps = 0.1;
    let frozen_db = loss_db(flight.at_m);
    flight.fly(60, |seen| misread(seen, BASE_ID, |_| frozen_db));
    assert!((flight.command.forward_mps - 0.1).abs() < 0.001, "{:?}", flight.command);
    let true_db = loss_db(flight.at_m);
    assert!(true_db > NodeParams::default().link.relay_back_db, "{true_db} dB, and nobody calls it back");
}

#[test]
fn a_ground_speed_that_is_stuck_moves_it_by_half_a_metre_and_one_that_is_missing_by_nothing() {
    let stands_m = |speed_mps: Option<f32>| {
        let mut flight = Flight::levelled();
        flight.fly(120, |seen| seen.ground_speed_mps = speed_mps);
        flight.at_m
    };
    assert!((stands_m(Some(0.2)) - 4.5 + 0.56).abs() < 0.01, "{}", stands_m(Some(0.2)));
    for missing in [None, Some(f32::NAN), Some(f32::INFINITY)] {
        assert!((stands_m(missing) - 4.5).abs() < 0.01);
    }
}

/// What the default law asks for at distances in the order front left, front right, rear left, rear right.
fn asked([nw_m, ne_m, sw_m, se_m]: [f32; 4], follow: Follow) -> Centering {
    let tof = Tof { nw_m, ne_m, sw_m, se_m };
    center(&tof, TOF_RANGE_M, false, follow, &CenterParams::default())
}

#[test]
fn a_beam_that_sees_nothing_is_one_and_the_same_however_it_says_so_and_blind_it_flies_straight() {
    for nothing in [TOF_RANGE_M, 600.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(asked([nothing; 4], Follow::Centre), Centering::default(), "{nothing}");
        let one = asked([nothing, 0.6, 0.6, 0.6], Follow::Centre);
        assert_eq!(one, asked([TOF_RANGE_M, 0.6, 0.6, 0.6], Follow::Centre), "{nothing}");
    }
}

#[test]
fn a_dead_beam_leaves_the_other_wall_and_a_dead_side_draws_it_into_the_wall_until_a_pilot_chooses_the_other()
{
    let asks = |beams| asked(beams, Follow::Centre);
    // Nearer than 0.45 m to the right wall it is pushed off, farther away it comes near.
    let dead_beam = |right_m| asks([TOF_RANGE_M, right_m, 0.8, right_m]).lateral_mps;
    assert!(dead_beam(0.3) > 0.0 && dead_beam(0.6) < 0.0);
    assert_eq!(asks([TOF_RANGE_M, 0.6, TOF_RANGE_M, 0.6]).lateral_mps, 0.4, "to the dead side, at its most");
    let right = |right_m| asked([TOF_RANGE_M, right_m, TOF_RANGE_M, right_m], Follow::Right).lateral_mps;
    assert!(right(0.3) > 0.0 && right(0.6) < 0.0 && right(0.45) == 0.0);
}

#[test]
fn a_beam_stuck_at_0_pushes_to_the_other_side_turns_and_slows_down() {
    let stuck = asked([0.0, 0.6, 0.6, 0.6], Follow::Centre);
    assert_eq!((stuck.lateral_mps, stuck.speed_share), (-0.2, 0.2));
    assert!((stuck.yaw_rate_radps.to_degrees() + 60.0).abs() < 1e-3);
}

#[test]
fn what_stuck_or_missing_distances_asked_for_last_goes_on_until_there_are_others() {
    let mut flight = Flight::levelled();
    // Off the middle, nearer to the left wall.
    let off = Tof { nw_m: 0.6, ne_m: 0.8, sw_m: 0.6, se_m: 0.8 };
    flight.decide(&|seen| seen.tof = Some(off));
    assert!((flight.command.lateral_mps + 0.1).abs() < 1e-6, "{:?}", flight.command);
    for _ in 0..50 {
        flight.decide(&|_| {});
    }
    assert!((flight.command.lateral_mps + 0.1).abs() < 1e-6, "no new set: the last one counts");
    let blind = Tof { nw_m: f32::NAN, ne_m: f32::NAN, sw_m: f32::NAN, se_m: f32::NAN };
    flight.decide(&|seen| seen.tof = Some(blind));
    assert_eq!(flight.command.lateral_mps, 0.0);
}

#[test]
fn a_relay_waits_for_somebody_ahead_who_says_how_long_he_has_flown() {
    let took_off = |flown_s: f32| {
        let mut relay = Node::new(Role::Relay, NodeParams::default());
        let packet = Packet { flown_s, ..Packet::default() };
        let heard = [Heard { from: 0, loss_db: 70.0, packet }];
        let radio = Some(heard.into_iter().collect());
        let seen = Observation { place: Some(1), radio, ..Observation::default() };
        (1..=50).find(|_| relay.decide(&seen).airborne)
    };
    // The hold of a second, from the first decision on.
    assert_eq!((took_off(60.0), took_off(0.0)), (Some(6), None));
}

#[test]
fn a_head_without_a_pilot_or_a_base_stays() {
    let mut head = Node::new(Role::Head, NodeParams::default());
    let base = [Heard { from: BASE_ID, loss_db: 50.0, packet: Packet::BASE }];
    let pilot = Some(PilotInput { speed_mps: 0.2, ..PilotInput::default() });
    let mut flies_mps = |radio: RadioSlot, pilot| {
        let seen = Observation { radio: Some(radio), pilot, ..Observation::default() };
        (0..20).map(|_| head.decide(&seen).forward_mps).last().unwrap()
    };
    assert_eq!(flies_mps(RadioSlot::default(), pilot), 0.0, "it has never heard the base");
    assert_eq!(flies_mps(base.into_iter().collect(), pilot), 0.2);
    assert_eq!(flies_mps(base.into_iter().collect(), None), 0.0);
}

/// A deck whose beams look ahead, left, back and right, on a drone that calls the half-way direction between front and
/// right forward.
#[test]
fn a_deck_with_straight_beams_centres_as_one_with_diagonals_when_the_frame_is_turned() {
    // The drone's own frame is 45° left of the tunnel's: its front beam looks at the left wall, ahead.
    let (front_m, left_m, back_m, right_m) = (0.6, 0.6, 0.8, 0.8);
    let tof = [front_m, right_m, left_m, back_m];
    let Centering { lateral_mps, yaw_rate_radps, .. } = asked(tof, Follow::Centre);
    assert!(lateral_mps < 0.0 && yaw_rate_radps == 0.0, "off the left wall");
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let forward_mps = 0.2;
    let (vx, vy) = ((forward_mps + lateral_mps) * half, (lateral_mps - forward_mps) * half);
    // In the drone's frame the tunnel runs at -45°: along it and across it again.
    let along_mps = (vx - vy) * half;
    let across_mps = (vx + vy) * half;
    assert!((along_mps - 0.2).abs() < 1e-6 && (across_mps - lateral_mps).abs() < 1e-6);
}
