//! Random passes through sharp corners, bends and straights, by the node that flies.

use core::f32::consts::PI;
use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::{
    BASE_ID, Brain, CenterLaw, Heard, Node, NodeParams, Observation, Packet, PilotInput, RadioSlot, Role,
};
use uchain_sim::{
    map::{CentreLine, Map, Vertex, corridor},
    seed::{Seed, Source, Stream},
    sense::{GridRays, TofBeams, TofNoise, TofParams, read_tof},
    world::{MotionParams, World},
};

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    SharpCorner,
    Bend,
    Straight,
}

/// One pass: everything that was drawn.
#[derive(Debug, Clone, Copy)]
struct Pass {
    shape: Shape,
    seed: u64,
    width_m: f32,
    /// +1 the tunnel turns left, −1 right.
    side: f32,
    backward: bool,
    speed_mps: f32,
    offset_m: f32,
    askew_rad: f32,
}

#[derive(Debug, PartialEq)]
enum End {
    Clean { nearest_m: f32 },
    Contact { after_m: f32, speed_mps: f32 },
    Stuck { after_m: f32 },
}

fn draw(shape: Shape, seed: u64) -> Pass {
    let mut random: Stream = Seed(seed).stream(0, Source::Start);
    let mut between = |low: f32, high: f32| low + (high - low) * random.uniform();
    let width_m = between(0.6, 3.0);
    Pass {
        shape,
        seed,
        width_m,
        side: if between(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 },
        backward: between(0.0, 1.0) < 0.5,
        speed_mps: between(0.1, 0.3),
        // Anywhere in the middle 40 % of the tunnel, up to 20° askew.
        offset_m: between(-0.2, 0.2) * width_m,
        askew_rad: between(-0.35, 0.35),
    }
}

fn tunnel(pass: &Pass) -> (Map, CentreLine) {
    let (width, side) = (f64::from(pass.width_m), f64::from(pass.side));
    let leg = 2.0 + width;
    let bend_radius_m = if pass.shape == Shape::Bend { 0.5 * width + 0.5 } else { 0.0 };
    let (turn, end) = ((leg + bend_radius_m, 0.0), (leg + bend_radius_m, side * (leg + bend_radius_m)));
    let vertex = |(x, y): (f64, f64), bend_radius_m| Vertex { x, y, bend_radius_m };
    let line = match pass.shape {
        Shape::Straight => vec![vertex((0.0, 0.0), 0.0), vertex((2.0 * leg, 0.0), 0.0)],
        _ => vec![vertex((0.0, 0.0), 0.0), vertex(turn, bend_radius_m), vertex(end, 0.0)],
    };
    corridor(&line, width, false).unwrap()
}

fn fly(pass: &Pass, law: CenterLaw) -> End {
    let (map, line) = tunnel(pass);
    let map = Arc::new(map);
    let margin_m = 0.5 * pass.width_m + 0.3;
    let (start, tangent_rad) = line.at(margin_m);
    let along = Vec2::new(libm::cosf(tangent_rad), libm::sinf(tangent_rad));
    // Backward, the tail leads.
    let heading_rad = tangent_rad + pass.askew_rad + if pass.backward { PI } else { 0.0 };
    let spawn = (start + along.perp() * pass.offset_m, heading_rad);
    let mut world = World::new(map.clone(), MotionParams::default(), [spawn]);
    let tof = TofParams::default();
    let (rays, beams) = (GridRays::new(&map, tof.range_m), TofBeams::new(&tof));
    let mut noise = TofNoise::new(Seed(pass.seed).stream(0, Source::Tof), tof);
    let mut params = NodeParams::default();
    params.center.law = law;
    params.equalize.v_max_mps = params.equalize.v_max_mps.max(pass.speed_mps);
    let mut node = Node::new(Role::Head, params);
    let speed_mps = if pass.backward { -pass.speed_mps } else { pass.speed_mps };
    let pilot = PilotInput { speed_mps, ..PilotInput::default() };
    let good = Heard { from: BASE_ID, loss_db: 40.0, packet: Packet::BASE };

    let goal_m = line.length_m() - margin_m;
    let (mut after_m, mut nearest_m) = (0.0, f32::INFINITY);
    // Slowed to a fifth for a third of the way at the most, plus take-off and the corner.
    let patience_ticks = (20.0 * (3.0 * goal_m / pass.speed_mps + 10.0)) as usize;
    for tick in 0..patience_ticks {
        let mut seen = Observation { pilot: Some(pilot), ..Observation::default() };
        if tick % 2 == 0 {
            seen.tof = Some(noise.apply(read_tof(&rays, &world, 0, &beams)));
        }
        if tick % 4 == 0 {
            seen.radio = Some(RadioSlot::from_iter([good]));
        }
        let asked = node.decide(&seen);
        world.act(&[asked]);
        world.advance();
        let at = world.bodies()[0].at;
        after_m = line.project(at);
        nearest_m = nearest_m.min(map.clearance_m(at) - world.radius_m());
        if world.bodies()[0].wall_contacts > 0 {
            return End::Contact { after_m, speed_mps: world.bodies()[0].velocity_mps.length() };
        }
        if after_m >= goal_m {
            return End::Clean { nearest_m };
        }
    }
    End::Stuck { after_m }
}

fn failures(passes: impl Iterator<Item = Pass>, law: CenterLaw) -> Vec<(Pass, End)> {
    passes.map(|pass| (pass, fly(&pass, law))).filter(|(_, end)| !matches!(end, End::Clean { .. })).collect()
}

/// So fast the authors' simulator flies (preset `frontiers2021`), and here the first beams of a corner come late.
fn fast(seed: u64, backward: bool) -> Pass {
    Pass { speed_mps: 0.375, backward, ..draw(Shape::SharpCorner, seed) }
}

#[test]
fn three_thousand_sharp_corners_are_all_clean() {
    let passes = (0..3200).map(|seed| draw(Shape::SharpCorner, seed));
    let failures = failures(passes, CenterLaw::default());
    assert!(failures.is_empty(), "{} of 3200 failed: {failures:?}", failures.len());
}

#[test]
fn all_bends_and_straights_are_clean() {
    for shape in [Shape::Bend, Shape::Straight] {
        let failures = failures((0..400).map(|seed| draw(shape, seed)), CenterLaw::default());
        assert!(failures.is_empty(), "{} of 400 failed: {shape:?}: {failures:?}", failures.len());
    }
}

#[test]
fn fast_passes_round_sharp_corners_are_clean_in_both_directions() {
    for backward in [false, true] {
        let failures = failures((0..1000).map(|seed| fast(seed, backward)), CenterLaw::default());
        assert!(failures.is_empty(), "{} of 1000 failed: {failures:?}", failures.len());
    }
}

/// The negative control of the tests above: Eq. 20 and 21 as printed, which is right in 99 of 100 corners.
#[test]
fn by_the_law_as_printed_one_of_a_hundred_fast_passes_ends_in_the_wall() {
    for backward in [false, true] {
        let failures = failures((0..1000).map(|seed| fast(seed, backward)), CenterLaw::Paper);
        assert!((5..=20).contains(&failures.len()), "{} of 1000: {failures:?}", failures.len());
    }
}

#[test]
fn the_narrowest_corners_keep_twelve_centimetres() {
    for seed in 0..3200 {
        let pass = draw(Shape::SharpCorner, seed);
        if pass.width_m < 0.7 {
            match fly(&pass, CenterLaw::default()) {
                End::Clean { nearest_m } => assert!(nearest_m > 0.12, "seed {seed}: {nearest_m} m"),
                end => panic!("seed {seed}: {end:?}"),
            }
        }
    }
}

/// Two passes that Eq. 20 and 21 do not bring through: askew by 8° and off the middle, the UAV ends up in the outer
/// pocket of the corner facing the end wall. Both front beams see that wall alike, the two sides' ratios agree, and
/// Eq. 20 centers it on the dead end. It touches at the crawl the slow-down leaves it.
#[test]
fn a_uav_in_the_outer_pocket_is_centered_on_the_end_wall_as_printed_and_turns_away_by_default() {
    for seed in [1830, 3104] {
        let pass = draw(Shape::SharpCorner, seed);
        match fly(&pass, CenterLaw::Paper) {
            End::Contact { speed_mps, .. } => assert!(speed_mps < 0.06, "seed {seed}: {speed_mps} m/s"),
            end => panic!("seed {seed}: {end:?}"),
        }
        assert!(matches!(fly(&pass, CenterLaw::Wall), End::Clean { .. }), "seed {seed}");
    }
}
