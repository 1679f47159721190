//! Memory: a tick asks for none, unless rapier steps (which allocates by itself).

use allocation_counter::measure;
use uchain_sim::mission::{Mission as _, chain::Chain};

use crate::course;

/// Ticks without a solver step, how often memory was asked for in them, and the same for ticks with one.
fn count(name: &str, sets: &[&str], ticks: usize) -> [(u64, u64); 2] {
    let course = course(name, sets);
    let mut sim: Chain = Chain::start(course.clone(), 1);
    let mut counted = [(0, 0); 2];
    for _ in 0..ticks {
        let before = sim.world().solver_steps();
        let asked = measure(|| _ = sim.step(&mut ()).unwrap()).count_total;
        let (ticks, total) = &mut counted[(sim.world().solver_steps() - before) as usize];
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
