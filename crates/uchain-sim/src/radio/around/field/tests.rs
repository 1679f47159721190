//! 10 000 draws of fields, against what they are said to be.

use super::*;

const DRAWS: u64 = 10_000;
const C_M: f32 = 2.0;

/// Mean, standard deviation and correlation of a field at two links, over seeds.
fn moments(correlation_m: f32, one: [Vec2; 2], other: [Vec2; 2]) -> [f64; 3] {
    let mut sums = [0.0; 5];
    for seed in 0..DRAWS {
        let field = Field::new(Seed(seed), correlation_m);
        let [x, y] = [one, other].map(|[p, q]| f64::from(field.at(p, q)));
        for (sum, term) in sums.iter_mut().zip([x, y, x * x, y * y, x * y]) {
            *sum += term / DRAWS as f64;
        }
    }
    let [x, y, xx, yy, xy] = sums;
    let (var_x, var_y) = (xx - x * x, yy - y * y);
    [x, var_x.sqrt(), (xy - x * y) / (var_x * var_y).sqrt()]
}

fn link(p: [f32; 2], q: [f32; 2]) -> [Vec2; 2] {
    [p, q].map(Vec2::from)
}

/// Links 20 m long whose ends are moved by so much.
fn moved(by_p_m: f32, by_q_m: f32) -> [[Vec2; 2]; 2] {
    [link([1.0, 2.0], [21.0, 2.0]), link([1.0, 2.0 + by_p_m], [21.0 + 0.6 * by_q_m, 2.0 - 0.8 * by_q_m])]
}

#[test]
fn over_ten_thousand_draws_mean_deviation_and_correlation_at_both_ends_are_those_of_gudmundson() {
    for (by_p_m, by_q_m) in [(0.2, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (2.0, 0.5), (4.0, 3.0)] {
        let [one, other] = moved(by_p_m, by_q_m);
        let [mean, deviation, correlation] = moments(C_M, one, other);
        let expected = libm::exp(-f64::from(by_p_m + by_q_m) / f64::from(C_M));
        // Of 10^4 draws a mean and a correlation are known to 0.01.
        assert!(mean.abs() < 0.04, "mean {mean}");
        assert!((deviation - 1.0).abs() < 0.03, "deviation {deviation}");
        assert!((correlation - expected).abs() < 0.035, "{by_p_m} {by_q_m}: {correlation} for {expected}");
    }
}

#[test]
fn a_field_of_another_correlation_length_is_told_apart_by_the_same_count() {
    let [one, other] = moved(1.0, 1.0);
    let [_, _, correlation] = moments(2.0 * C_M, one, other);
    let expected = libm::exp(-2.0 / f64::from(C_M));
    assert!((correlation - expected).abs() > 0.15, "{correlation}");
}

#[test]
fn short_links_have_the_same_deviation_as_long_ones() {
    for apart_m in [0.0, 0.1, 0.5, 2.0] {
        let link = link([1.0, 2.0], [1.0 + apart_m, 2.0]);
        let [_, deviation, _] = moments(C_M, link, link);
        assert!((deviation - 1.0).abs() < 0.03, "{apart_m}: {deviation}");
    }
}

#[test]
fn a_field_is_the_same_from_both_ends_to_the_last_bit_and_again() {
    let field = Field::new(Seed(7), C_M);
    for i in 0..1_000 {
        let i = i as f32;
        let (p, q) = (Vec2::new(0.37 * i, -0.11 * i), Vec2::new(3.0 - 0.29 * i, 0.05 * i));
        assert_eq!(field.at(p, q).to_bits(), field.at(q, p).to_bits());
        assert_eq!(field.at(p, q), Field::new(Seed(7), C_M).at(p, q));
        assert_ne!(field.at(p, q), Field::new(Seed(8), C_M).at(p, q));
    }
}

#[test]
fn a_field_is_continuous_a_kilometre_from_the_origin_as_well() {
    for offset_m in [0.0, 1_000.0] {
        let steps = (0..DRAWS).map(|seed| {
            let field = Field::new(Seed(seed), C_M);
            let at = |y_m| field.at(Vec2::new(offset_m + 1.0, y_m), Vec2::new(offset_m + 9.0, 0.0));
            let (step, all) = (at(2.001) - at(2.0), at(2.25) - at(2.0));
            [step * step, all * all].map(f64::from)
        });
        let mut means = [0.0; 2];
        for step in steps {
            means[0] += step[0] / DRAWS as f64;
            means[1] += step[1] / DRAWS as f64;
        }
        // E (X − X')² = 2 (1 − exp(−δ/c)) for a step of δ: about 1.0e-3 for a millimetre, and 0.235 for 25 cm.
        assert!(means[0] < 1.3e-3 && (means[1] - 0.235).abs() < 0.02, "{offset_m}: {means:?}");
    }
}

#[test]
fn a_field_is_normal_as_far_as_a_sum_of_64_waves_is_and_ends_at_its_most() {
    let link = link([1.0, 2.0], [9.0, 2.0]);
    let draws: Vec<f32> = (0..DRAWS).map(|seed| Field::new(Seed(seed), C_M).at(link[0], link[1])).collect();
    let beyond = |sigmas: f32| draws.iter().filter(|x| x.abs() > sigmas).count() as f64 / DRAWS as f64;
    for (sigmas, expected) in [(1.0, 0.3173), (2.0, 0.0455), (3.0, 0.0027)] {
        let share = beyond(sigmas);
        assert!((share - expected).abs() < 0.012, "{share} beyond {sigmas}");
    }
    assert_eq!(beyond(MOST), 0.0);
}

#[test]
fn a_cosine_of_turns_is_that_of_the_library() {
    for i in -4_000..4_000 {
        let turns = 0.000_831 * f64::from(i);
        let expected = libm::cos(TAU * turns) as f32;
        assert!((cos_of_turns(turns) - expected).abs() < 1e-6, "{turns}");
        assert_eq!(cos_of_turns(turns).to_bits(), cos_of_turns(-turns).to_bits());
    }
}

#[test]
fn a_link_takes_microseconds() {
    let field = Field::new(Seed(1), C_M);
    let before = std::time::Instant::now();
    let sum: f32 =
        (0..10_000).map(|i| field.at(Vec2::new(i as f32, 1.0), Vec2::new(3.0, 0.1 * i as f32))).sum();
    println!("{:?} a link ({sum})", before.elapsed() / 10_000);
    let before = std::time::Instant::now();
    for i in 0..1_000 {
        std::hint::black_box(Field::new(Seed(i), C_M));
    }
    println!("{:?} a field", before.elapsed() / 1_000);
}
