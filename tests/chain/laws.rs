//! Claims of the laws for whatever they may meet: the papers' proofs as properties.

use adskalman::{
    CovarianceUpdateMethod, ObservationModel, StateAndCovariance, TransitionModelLinearNoControl,
};
use nalgebra::{Matrix1, Vector1};
use proptest::prelude::*;
use uchain_core::chain::{
    Brain, CenterLaw, CenterParams, Command, EqualizeParams, Follow, Gap, HEARD_MAX, Heard, KalmanParams,
    Node, NodeParams, Observation, Packet, PilotInput, RadioSlot, Role, ScalarKalman, SpeedLaw, TOF_RANGE_M,
    Tof, center, equalize,
};
use uchain_sim::analyse::optimum::equal_links;

/// Largest slope of a random loss over distance, k in Eq. 12 (dB/m).
const K_DB_PER_M: f64 = 25.0;

/// A random loss of which Eq. 12's proof holds: growing with either end, with slopes between a fifth of k and
/// k, and the same between any two ends that coincide. Rock of varying strength along the tunnel, summed up
/// between the ends and bent by a concave curve.
#[derive(Debug, Clone)]
struct Profile {
    /// Strength of each metre (dB/m).
    rock: Vec<f64>,
    /// Where the curve bends (dB), and how much flatter it goes on.
    bend_db: f64,
    flatter: f64,
}

impl Profile {
    fn summed_db(&self, x_m: f64) -> f64 {
        let whole = (x_m.max(0.0).floor() as usize).min(self.rock.len() - 1);
        self.rock[..whole].iter().sum::<f64>() + self.rock[whole] * (x_m - whole as f64)
    }

    fn loss_db(&self, a_m: f64, b_m: f64) -> f64 {
        let rock_db = (self.summed_db(a_m) - self.summed_db(b_m)).abs();
        if rock_db <= self.bend_db { rock_db } else { self.bend_db + self.flatter * (rock_db - self.bend_db) }
    }
}

fn profiles() -> impl Strategy<Value = Profile> {
    let rock = prop::collection::vec(0.4 * K_DB_PER_M..K_DB_PER_M, 20);
    (rock, 5.0..60.0, 0.5..1.0).prop_map(|(rock, bend_db, flatter)| Profile { rock, bend_db, flatter })
}

/// A profile and a chain in it: depths from the base (0 m) to the head, 2 to 32 links.
fn chains() -> impl Strategy<Value = (Profile, Vec<f64>)> {
    let depths = prop::collection::vec(0.0..20.0_f64, 2..=32).prop_map(|mut depths| {
        depths[0] = 0.0;
        depths.push(20.0);
        depths.sort_by(f64::total_cmp);
        depths
    });
    (profiles(), depths)
}

fn losses_db(profile: &Profile, depths_m: &[f64]) -> Vec<f64> {
    depths_m.windows(2).map(|pair| profile.loss_db(pair[0], pair[1])).collect()
}

fn worst_db(losses_db: &[f64]) -> f64 {
    losses_db.iter().copied().fold(0.0, f64::max)
}

/// All relays move at once, each by one decision of the law. Base first.
fn decide(profile: &Profile, depths_m: &[f64], params: &EqualizeParams) -> Vec<f64> {
    let losses_db = losses_db(profile, depths_m);
    let mut moved_m = depths_m.to_vec();
    for i in 1..depths_m.len() - 1 {
        let speed_mps = equalize(losses_db[i - 1] as f32, losses_db[i] as f32, params);
        moved_m[i] += f64::from(speed_mps * params.decision_s);
    }
    moved_m
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Laclau 2021, §4.1, second claim: the proof as a test.
    #[test]
    fn eq_12_never_lowers_the_worst_link_and_keeps_the_order((profile, start_m) in chains()) {
        let params = EqualizeParams { k_db_per_m: K_DB_PER_M as f32, ..EqualizeParams::default() };
        let mut depths_m = start_m;
        for _ in 0..200 {
            let moved_m = decide(&profile, &depths_m, &params);
            let (before_db, after_db) =
                (worst_db(&losses_db(&profile, &depths_m)), worst_db(&losses_db(&profile, &moved_m)));
            prop_assert!(after_db <= before_db + 1e-4, "{before_db} dB became {after_db} dB");
            prop_assert!(moved_m.is_sorted_by(|a, b| *a <= b + 1e-5), "{moved_m:?}");
            depths_m = moved_m;
        }
    }
}

/// Three times the step of Eq. 12 is a step too many: the claim above is not empty.
#[test]
fn thrice_the_step_of_eq_12_can_lower_the_worst_link() {
    let profile = Profile { rock: vec![K_DB_PER_M; 20], bend_db: 1e3, flatter: 1.0 };
    let k_db_per_m = K_DB_PER_M as f32 / 3.2;
    let params = EqualizeParams { k_db_per_m, v_max_mps: 1.0, ..EqualizeParams::default() };
    // A short link between two longer ones is stretched from both ends at once.
    let depths_m = [0.0, 0.15, 0.15, 0.3, 0.3];
    let before_db = worst_db(&losses_db(&profile, &depths_m));
    let after_db = worst_db(&losses_db(&profile, &decide(&profile, &depths_m, &params)));
    assert!(after_db > before_db);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn eq_12_converges_to_the_exact_optimum((profile, start_m) in chains()) {
        let params = EqualizeParams { k_db_per_m: K_DB_PER_M as f32, ..EqualizeParams::default() };
        let links = start_m.len() - 1;
        let mut depths_m = start_m;
        for _ in 0..60 * links * links {
            depths_m = decide(&profile, &depths_m, &params);
        }
        let reached_db = losses_db(&profile, &depths_m);
        let best = equal_links(&|a_m, b_m| profile.loss_db(a_m, b_m), 20.0, links).unwrap();
        let gap_db = worst_db(&reached_db) - best.bottleneck_db;
        prop_assert!(gap_db.abs() < 0.05, "{gap_db} dB off: {reached_db:?}, {best:?}");
    }

    #[test]
    fn the_filter_is_the_textbooks_and_its_variance_stays_positive_and_settles(
        steps in prop::collection::vec((-1.0_f32..1.0, 30.0_f32..100.0), 1..300),
        r in 0.1_f32..100.0, q in 0.01_f32..100.0, a in -20.0_f32..20.0,
    ) {
        let params = KalmanParams {
            measurement_variance_db2: r, process_variance_db2_per_s: q, flow_gain_db_per_m: a,
        };
        let period_s = 0.2_f32;
        let mut ours = ScalarKalman::start(60.0, &params).unwrap();
        let mut model = Textbook::new(f64::from(q * period_s), f64::from(r));
        let mut textbook = StateAndCovariance::new(Vector1::new(60.0), Matrix1::new(f64::from(r)));
        for (u, z) in steps {
            ours.predict(u, period_s, &params);
            ours.update(z, &params);
            model.lead_db = f64::from(a) * f64::from(period_s) * f64::from(u);
            let prior = TransitionModelLinearNoControl::predict(&model, &textbook);
            let method = CovarianceUpdateMethod::JosephForm;
            textbook = model.update(&prior, &Vector1::new(f64::from(z)), method).unwrap();
            prop_assert!((f64::from(ours.loss_db()) - textbook.state()[0]).abs() < 1e-2);
            let variance = textbook.covariance()[0];
            prop_assert!((f64::from(ours.variance_db2()) - variance).abs() < 1e-3 * variance);
            prop_assert!(ours.variance_db2() > 0.0 && ours.variance_db2() <= r);
        }
        for _ in 0..5_000 {
            ours.predict(0.0, period_s, &params);
            ours.update(60.0, &params);
        }
        // The fixed point of P = (P + Q) R / (P + Q + R).
        let (q, r) = (f64::from(q * period_s), f64::from(r));
        let settled = 0.5 * ((q * q + 4.0 * q * r).sqrt() - q);
        prop_assert!((f64::from(ours.variance_db2()) - settled).abs() < 2e-3 * settled);
    }
}

/// The same filter by another crate, in f64.
struct Textbook {
    one: Matrix1<f64>,
    process: Matrix1<f64>,
    measurement: Matrix1<f64>,
    lead_db: f64,
}

impl Textbook {
    fn new(process: f64, measurement: f64) -> Self {
        let (process, measurement) = (Matrix1::new(process), Matrix1::new(measurement));
        Self { one: Matrix1::new(1.0), process, measurement, lead_db: 0.0 }
    }
}

#[allow(non_snake_case, reason = "the oracle's names")]
impl TransitionModelLinearNoControl<f64, nalgebra::U1> for Textbook {
    fn F(&self) -> &Matrix1<f64> {
        &self.one
    }
    fn FT(&self) -> &Matrix1<f64> {
        &self.one
    }
    fn Q(&self) -> &Matrix1<f64> {
        &self.process
    }
    fn predict(
        &self,
        previous: &StateAndCovariance<f64, nalgebra::U1>,
    ) -> StateAndCovariance<f64, nalgebra::U1> {
        let state = Vector1::new(previous.state()[0] + self.lead_db);
        StateAndCovariance::new(state, previous.covariance() + self.process)
    }
}

#[allow(non_snake_case, reason = "the oracle's names")]
impl ObservationModel<f64, nalgebra::U1, nalgebra::U1> for Textbook {
    fn H(&self) -> &Matrix1<f64> {
        &self.one
    }
    fn HT(&self) -> &Matrix1<f64> {
        &self.one
    }
    fn R(&self) -> &Matrix1<f64> {
        &self.measurement
    }
}

/// Any f32 at all: NaN, infinities, subnormals and the ordinary.
fn any_f32() -> impl Strategy<Value = f32> {
    prop_oneof![prop::num::f32::ANY, -10.0_f32..200.0, Just(f32::NAN), Just(f32::INFINITY)]
}

fn any_tof() -> impl Strategy<Value = Tof> {
    [any_f32(), any_f32(), any_f32(), any_f32()].prop_map(|[nw_m, ne_m, sw_m, se_m]| Tof {
        nw_m,
        ne_m,
        sw_m,
        se_m,
    })
}

fn any_heard() -> impl Strategy<Value = Heard> {
    let words = (any_f32(), any_f32(), any_f32(), any::<bool>());
    (any::<u16>(), any::<u16>(), any_f32(), words).prop_map(
        |(from, place, loss_db, (ground_speed_mps, flown_s, imbalance_db, is_base))| {
            let packet =
                Packet { place, ground_speed_mps, flown_s, imbalance_db, is_base, ..Packet::default() };
            Heard { from, loss_db, packet }
        },
    )
}

fn any_observation() -> impl Strategy<Value = Observation> {
    let radio = prop::option::of(prop::collection::vec(any_heard(), 0..HEARD_MAX + 2));
    let radio = radio.prop_map(|heard| heard.map(RadioSlot::from_iter));
    let place = prop::option::of(any::<u16>());
    (place, prop::option::of(any_tof()), radio, prop::option::of(any_f32()), any_f32()).prop_map(
        |(place, tof, radio, ground_speed_mps, speed_mps)| {
            let pilot = Some(PilotInput { speed_mps, follow: Follow::Left });
            Observation { place, tof, radio, ground_speed_mps, battery: None, pilot }
        },
    )
}

fn within_limits(c: &Command, p: &NodeParams) -> bool {
    c.forward_mps.abs() <= p.equalize.v_max_mps
        && c.lateral_mps.abs() <= p.center.lateral_max_mps
        && c.yaw_rate_radps.abs() <= p.center.yaw_rate_max_radps
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn every_speed_law_is_finite_and_within_its_limit(back in any_f32(), front in any_f32()) {
        for law in [SpeedLaw::Lipschitz, SpeedLaw::InverseModel, SpeedLaw::BangBang] {
            for spacing in [false, true] {
                let params = EqualizeParams { law, spacing, ..EqualizeParams::default() };
                prop_assert!(equalize(back, front, &params).abs() <= params.v_max_mps);
            }
        }
    }

    #[test]
    fn centering_is_finite_and_within_its_limits(tof in any_tof(), backward in any::<bool>()) {
        for law in [CenterLaw::Wall, CenterLaw::Paper, CenterLaw::Firmware] {
            let params = CenterParams { law, ..CenterParams::default() };
            for follow in [Follow::Centre, Follow::Left, Follow::Right] {
                let c = center(&tof, TOF_RANGE_M, backward, follow, &params);
                prop_assert!(c.lateral_mps.abs() <= params.lateral_max_mps, "{c:?}");
                prop_assert!(c.yaw_rate_radps.abs() <= params.yaw_rate_max_radps, "{c:?}");
                prop_assert!((params.slow_floor..=1.0).contains(&c.speed_share), "{c:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_node_asks_for_what_it_may_whatever_it_sees(
        role in prop_oneof![Just(Role::Head), Just(Role::Relay)],
        predict in any::<bool>(),
        seen in prop::collection::vec(any_observation(), 1..120),
    ) {
        let mut params = NodeParams::default();
        params.link.gap = if predict { Gap::Predict } else { Gap::Hold };
        params.takeoff.launch_hold_s = 0.0;
        let mut node = Node::new(role, params.clone());
        for observation in &seen {
            let command = node.decide(observation);
            prop_assert!(within_limits(&command, &params), "{command:?}");
            for loss_db in [node.estimates().back.filtered_db, node.estimates().front.filtered_db].into_iter().flatten() {
                prop_assert!(loss_db.is_finite());
            }
        }
    }
}
