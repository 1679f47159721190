//! Workloads that callgrind counts, one a process: `count NAME`; `count` alone says where this program is.

use std::{hint::black_box, iter, process::ExitCode};

use uchain_sim::{
    run::run,
    sense::{GridRays, TofBeams, TofParams},
};

use crate::{
    maps::{corridor, poses},
    run::circuit,
    w1::{Seen, ours::Ours, ring},
};

/// What is counted: callgrind collects inside this function only.
#[inline(never)]
fn measured(mut work: impl FnMut()) {
    work();
}

pub(crate) fn count(name: Option<&str>) -> ExitCode {
    match name {
        None => {
            return std::env::current_exe().map_or(ExitCode::FAILURE, |path| {
                println!("{}", path.display());
                ExitCode::SUCCESS
            });
        }
        Some("rays") => {
            let map = corridor(400);
            let poses = poses(&map, 1 << 12);
            let tof = TofParams::default();
            let (rays, beams) = (GridRays::new(&map, tof.range_m), TofBeams::new(&tof));
            measured(|| {
                for &(from, forward) in &poses {
                    black_box(beams.read(&rays, from, forward, iter::empty(), 0.0));
                }
            });
        }
        Some("w1") => {
            let map = ring();
            let mut world = Ours::new(&map, 64, Seen::Robots);
            measured(|| (0..1000).for_each(|_| world.tick()));
        }
        Some("mission") => {
            let course = circuit();
            // The first run draws the chart that all share.
            let _ = run(&course, 1, &mut ());
            measured(|| (0..10).for_each(|seed| drop(black_box(run(&course, seed, &mut ())))));
        }
        Some(other) => {
            eprintln!("no workload `{other}`");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}
