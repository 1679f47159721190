use std::sync::Arc;

use proptest::prelude::*;
use uchain_sim::{
    mission::chain::{Course, Frame, UavFrame},
    record::{RecordError, Recorder},
    run::run,
    seed::{Seed, Source, Stream},
};

use crate::course;

/// Every source of randomness there is.
const SOURCES: [Source; 10] = [
    Source::Tof,
    Source::Flow,
    Source::RadioBack,
    Source::RadioFront,
    Source::Start,
    Source::BurstBack,
    Source::BurstFront,
    Source::Choice,
    Source::Position,
    Source::Replicate,
];

fn draws(stream: &mut Stream, count: usize) -> Vec<u32> {
    (0..count).map(|_| stream.bits()).collect()
}

proptest! {
    #[test]
    fn adding_a_robot_or_a_sensor_moves_nobody_elses_draws(
        seed: u64,
        robots in 1_u32..40,
        more in 1_u32..10,
        sources in proptest::sample::subsequence(&SOURCES[..], 1..10),
        count in 1_usize..20,
    ) {
        // Each stream is drawn from in turn, as in a tick; then once more with more robots and all sources.
        let all = |robots: u32, sources: &[Source]| {
            let mut streams: Vec<(u32, Source, Stream)> = (0..robots)
                .flat_map(|robot| sources.iter().map(move |source| (robot, *source)))
                .map(|(robot, source)| (robot, source, Seed(seed).stream(robot, source)))
                .collect();
            let mut drawn = vec![Vec::new(); streams.len()];
            for _ in 0..count {
                for ((.., stream), drawn) in streams.iter_mut().zip(&mut drawn) {
                    drawn.extend(draws(stream, 2));
                }
            }
            streams.into_iter().map(|(robot, source, _)| (robot, source)).zip(drawn).collect::<Vec<_>>()
        };
        let few = all(robots, &sources);
        let many = all(robots + more, &SOURCES);
        for (who, drawn) in &few {
            let (_, again) = many.iter().find(|(other, _)| other == who).unwrap();
            prop_assert_eq!(drawn, again, "{:?}", who);
        }
        // No two of them draw the same.
        let mut drawn: Vec<&Vec<u32>> = many.iter().map(|(_, drawn)| drawn).collect();
        drawn.sort();
        prop_assert!(drawn.windows(2).all(|pair| pair[0] != pair[1]));
    }
}

/// Keeps every frame of the first few UAVs, up to the launch of the one behind them.
struct First {
    uavs: usize,
    frames: Vec<Vec<UavFrame>>,
    is_over: bool,
}

impl Recorder<Frame> for First {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.is_over |= frame.uavs.get(self.uavs).is_some_and(|next| next.airborne);
        if !self.is_over {
            self.frames.push(frame.uavs[..self.uavs].to_vec());
        }
        Ok(())
    }
}

fn first(course: &Arc<Course>, seed: u64, uavs: usize) -> Vec<Vec<UavFrame>> {
    let mut first = First { uavs, frames: Vec::new(), is_over: false };
    run(course, seed, &mut first).unwrap();
    first.frames
}

#[test]
fn a_uav_that_waits_behind_the_others_changes_no_bit_of_their_flight() {
    // Waiting places of their own: a row would be laid out anew for each number of UAVs.
    let places = ["[1.1, 0]", "[0.9, 0]", "[0.7, 0]"];
    let lay = |uavs: usize, more: &str| {
        let spawns = format!("chain.spawns_m=[{}]", places[..uavs].join(", "));
        course("corner", &[&format!("chain.uavs={uavs}"), &spawns, "duration_s=100", more])
    };
    for seed in 1..=5 {
        let with_two = first(&lay(2, "duration_s=100"), seed, 2);
        let with_three = first(&lay(3, "duration_s=100"), seed, 2);
        assert!(with_three.len() > 500, "the third takes off too early to tell: {}", with_three.len());
        // A chain that has nobody left to launch differs at the launch itself, not before.
        let common = with_three.len() - 1;
        assert_eq!(with_two[..common], with_three[..common], "seed {seed}");
        // Were the comparison blind, it would not see this either.
        let other = first(&lay(3, "flow.noise_mps=0.05"), seed, 2);
        assert_ne!(other[..common.min(other.len())], with_three[..common.min(other.len())]);
    }
}
