//! Params as C has them are Params as the core has them: each key, its words, its range, its default.

#[allow(dead_code, unreachable_pub)]
#[path = "../../src/choice.rs"]
mod choice;
#[allow(dead_code, unreachable_pub, unused_imports)]
#[path = "../../src/params/mod.rs"]
mod params;
#[allow(dead_code, unreachable_pub)]
#[path = "../../src/pointer.rs"]
mod pointer;
#[allow(dead_code, unreachable_pub)]
#[path = "../../src/status.rs"]
mod status;

use status::Status;
use uchain_core::{
    chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, NodeParams, TakeoffParams},
    params::Key,
};

/// Every table of a node, in the order of C.
const TABLES: [(&str, &[Key]); 5] = [
    ("kalman", KalmanParams::KEYS),
    ("equalize", EqualizeParams::KEYS),
    ("center", CenterParams::KEYS),
    ("takeoff", TakeoffParams::KEYS),
    ("link", LinkParams::KEYS),
];

/// Field of C, with its comment in one line.
fn fields() -> Vec<(String, String)> {
    let source = include_str!("../../src/params/mod.rs");
    let (_, body) = source.split_once("pub struct Params {").expect("the struct");
    let mut comment = String::new();
    let mut fields = Vec::new();
    for line in body.lines().map(str::trim) {
        if let Some(words) = line.strip_prefix("///") {
            comment += words;
        } else if let Some((name, _)) = line.strip_prefix("pub ").and_then(|rest| rest.split_once(':')) {
            fields.push((name.to_owned(), std::mem::take(&mut comment).trim().to_owned()));
        }
    }
    fields
}

/// What `{:?}` says of Params of C: every field by its name.
fn values() -> Vec<(String, String)> {
    let printed = format!("{:?}", params::Params::of(&NodeParams::default()));
    let body = printed.trim_start_matches("Params { ").trim_end_matches(" }").to_owned();
    let pair = |one: &str| one.split_once(": ").map(|(name, value)| (name.to_owned(), value.to_owned()));
    body.split(", ").filter_map(pair).collect()
}

#[test]
fn every_key_of_a_node_is_a_field_with_the_same_words_range_and_default() {
    let keys: Vec<(String, &Key)> = TABLES
        .iter()
        .flat_map(|(table, keys)| keys.iter().map(move |key| (format!("{table}_{}", key.name), key)))
        .collect();
    let (fields, values) = (fields(), values());
    let names: Vec<&String> = fields.iter().map(|(name, _)| name).collect();
    let mut expected: Vec<String> = keys.iter().map(|(name, _)| name.clone()).collect();
    expected.push("tof_range_m".into());
    assert_eq!(names, expected.iter().collect::<Vec<_>>());
    assert_eq!(values.iter().map(|(name, _)| name).collect::<Vec<_>>(), names);

    for (((name, key), (_, comment)), (_, value)) in keys.iter().zip(&fields).zip(&values) {
        let prose: Vec<&str> =
            key.doc.lines().map(str::trim).take_while(|line| !line.starts_with("- ")).collect();
        let prose = prose.join(" ");
        match key.range {
            Some((low, high)) => {
                let value: f64 = value.parse::<f32>().expect("a number").into();
                let default = value as f32;
                assert_eq!(comment, &format!("{prose} Range: {low} to {high}; default {default}."), "{name}");
            }
            None if comment.contains("0 or 1") => {
                assert_eq!(comment, &format!("{prose} 0 or 1; default {value}."), "{name}");
            }
            None => {
                // Every default is the first of its choices.
                assert!(
                    comment.starts_with(&format!("{prose} One of `UCHAIN_")) && value == "0",
                    "{name}: {comment}"
                );
            }
        }
    }
}

#[test]
fn params_come_back_as_they_went() {
    for params in [NodeParams::default(), NodeParams::frontiers2021(), NodeParams::cavemod()] {
        assert_eq!(params::Params::of(&params).read().ok(), Some(params));
    }
}

#[test]
fn a_number_outside_its_range_is_refused_with_its_own_name() {
    let plain = params::Params::of(&NodeParams::default());
    let mut refused = 0;
    let mut look = |table: &str, key: &Key, spoilt: NodeParams| {
        let told = params::Params::of(&spoilt).read().expect_err("out of range");
        assert_eq!(told.status, Status::OutOfRange);
        assert_eq!(told.key.to_str(), Ok(&*format!("{table}.{}", key.name)));
        refused += 1;
    };
    // One field after the other is NaN: the core names it, and C has to name the same.
    macro_rules! spoil {
        ($($table:ident { $($field:ident)* })*) => { $( $(
            let mut spoilt = plain.read().expect("the default");
            spoilt.$table.$field = f32::NAN;
            let named = spoilt.$table.first_wrong().expect("the core notices");
            let (_, keys) = TABLES.iter().find(|(name, _)| *name == stringify!($table)).expect("a table");
            let key = keys.iter().find(|key| key.name == named).expect("a key");
            assert_eq!(named, stringify!($field));
            look(stringify!($table), key, spoilt);
        )* )* };
    }
    spoil! {
        kalman { measurement_variance_db2 process_variance_db2_per_s flow_gain_db_per_m }
        equalize {
            k_db_per_m tolerance_db v_max_mps decision_s model_d0_m model_scale_db bang_mps bang_band_db spacing_db
            spacing_mps
        }
        center {
            c_t_per_s c_r_rad_per_s_m lateral_max_mps yaw_rate_max_radps wall_distance_m invalid_ratio slow_from_m
            slow_over_m slow_floor push_below_m push_mps closed_share follow_distance_m follow_lateral_per_s
            follow_lateral_max_mps firmware_lateral_per_s firmware_yaw_radps firmware_wide_m firmware_goal_m
        }
        takeoff { s_min_db converged_db launch_hold_s after_previous_s rise_s hover_s }
        link { predict_s lost_s head_stop_db head_back_db relay_back_db hysteresis_db retreat_mps }
    }
    let ranged = TABLES.iter().flat_map(|(_, keys)| *keys).filter(|key| key.range.is_some()).count();
    assert_eq!(refused, ranged, "all of them");
    let blind = params::Params { tof_range_m: f32::NAN, ..plain };
    assert_eq!(blind.read().expect_err("out of range").key, c"tof.range_m");
}
