//! Memory: a tick asks for none, unless rapier steps (which allocates by itself).

use allocation_counter::measure;
use uchain_core::chain::{
    BASE_ID, Brain as _, CenterLaw, CenterParams, EqualizeParams, Heard, Node, NodeParams, Observation,
    Packet, RadioSlot, Role, SpeedLaw, Stage, Tof,
};
use uchain_sim::mission::{Mission as _, chain::Chain};

use crate::course;

/// Ticks without a solver step, how often memory was asked for in them, and the same for ticks with one. In the tick after one
/// rapier may let go of bodies, and asks for memory then too.
fn count(name: &str, sets: &[&str], ticks: usize) -> [(u64, u64); 2] {
    let course = course(name, sets);
    let mut sim: Chain = Chain::start(course.clone(), 1);
    let mut counted = [(0, 0); 2];
    let mut was_solved = false;
    for _ in 0..ticks {
        let before = sim.world().solver_steps();
        let asked = measure(|| _ = sim.step(&mut ()).unwrap()).count_total;
        let is_solved = sim.world().solver_steps() > before;
        let (ticks, total) = &mut counted[usize::from(is_solved || was_solved)];
        was_solved = is_solved;
        *ticks += 1;
        *total += asked;
    }
    counted
}

#[test]
fn a_tick_in_which_nothing_can_touch_asks_for_no_memory() {
    for (name, sets) in [
        ("corner", vec![]),
        ("circuit", vec!["chain.uavs=5"]),
        ("staircase", vec![]),
        ("circuit", vec!["preset=cavemod", "faults.burst_rate=0.1"]),
    ] {
        let [(free, asked), _] = count(name, &sets, 2400);
        assert!(free > 2000, "{name}: {free} ticks without a solver step");
        assert_eq!(asked, 0, "{name}: memory was asked for in {free} ticks");
    }
}

#[test]
fn the_counter_sees_rapiers_own_allocations() {
    let [_, (ticks, asked)] = count("corner", &["center.c_t_per_s=0", "center.c_r_rad_per_s_m=0"], 2400);
    assert!(ticks > 10 && asked > ticks, "{asked} in {ticks} ticks with a solver step");
}

/// A head and a relay by these laws, for so many ticks of readings that never repeat.
fn fly_nodes(center: CenterLaw, speed: SpeedLaw, ticks: u32) {
    let params = NodeParams {
        center: CenterParams { law: center, ..CenterParams::default() },
        equalize: EqualizeParams { law: speed, ..EqualizeParams::default() },
        ..NodeParams::default()
    };
    let mut nodes = [Node::new(Role::Head, params.clone()), Node::new(Role::Relay, params)];
    let mut bits = 1_u32;
    let mut between = |low: f32, high: f32| {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        low + (bits >> 8) as f32 / (1 << 24) as f32 * (high - low)
    };
    for tick in 0..ticks {
        let radio = tick.is_multiple_of(4).then(|| {
            let packet =
                Packet { place: 0, flown_s: 60.0, ground_speed_mps: between(0.0, 0.3), ..Packet::default() };
            let ahead = Heard { from: 0, loss_db: between(50.0, 90.0), packet };
            [ahead, Heard { from: BASE_ID, loss_db: between(50.0, 90.0), packet: Packet::BASE }]
                .into_iter()
                .collect::<RadioSlot>()
        });
        let mut beam_m = || between(0.0, 2.5);
        let tof = Tof { nw_m: beam_m(), ne_m: beam_m(), sw_m: beam_m(), se_m: beam_m() };
        for (place, node) in nodes.iter_mut().enumerate() {
            let (place, radio) = (Some(place as u16), radio.clone());
            let seen = Observation { place, tof: Some(tof), radio, ..Observation::default() };
            std::hint::black_box((
                node.say(&seen),
                node.decide(&seen),
                node.explain(&seen),
                node.doing(&seen),
            ));
        }
    }
    assert!(nodes.iter().all(|node| node.explain(&Observation::default()).unwrap().stage == Stage::Flying));
}

#[test]
fn a_million_ticks_of_a_node_ask_for_no_memory() {
    for (center, speed) in [
        (CenterLaw::Wall, SpeedLaw::Lipschitz),
        (CenterLaw::Paper, SpeedLaw::InverseModel),
        (CenterLaw::Firmware, SpeedLaw::BangBang),
    ] {
        let asked = measure(|| fly_nodes(center, speed, 170_000)).count_total;
        assert_eq!(asked, 0, "{center:?} and {speed:?}");
    }
    // The counter counts.
    assert_eq!(measure(|| drop(std::hint::black_box(Box::new(1)))).count_total, 1);
}
