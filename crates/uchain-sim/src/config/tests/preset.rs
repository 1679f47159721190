use uchain_core::chain::NodeParams;

use super::{
    super::{KnownKeys, PRESETS, Preset, document::Document},
    Course, PLAIN, Scenario, source,
};
use crate::mission::Scene as _;

#[test]
fn a_preset_fills_in_what_is_not_written_and_every_one_of_them_is_right() {
    for preset in PRESETS {
        let table: toml::Table = preset.text.parse().unwrap();
        assert!(table.values().all(toml::Value::is_table), "{}: tables only", preset.name);
        assert!(preset.description().len() > 20, "{}: {}", preset.name, preset.description());
        let text = format!("preset = \"{}\"\n{PLAIN}", preset.name);
        let scenario = Course::read(&source(&text), &[]).unwrap().scenario.clone();
        assert_eq!(scenario.preset.as_deref(), Some(preset.name));
        assert_eq!(scenario.equalize.k_db_per_m, 20.0, "the scenario's own value in a table of the preset");
        // Each value of the preset is where it belongs.
        let flown = toml::Table::try_from(&scenario).unwrap();
        let float = |value: &toml::Value| value.as_float().map(|f| f as f32);
        for (name, values) in table {
            for (key, value) in values.as_table().unwrap() {
                let got = &flown[&name][key];
                assert!(
                    got == value || float(got).is_some() && float(got) == float(value),
                    "{name}.{key} = {got}"
                );
            }
        }
    }
}

/// A drone reads no scenario: what it flies by is written down in the core as well.
#[test]
fn a_node_on_a_drone_flies_by_the_presets_that_scenarios_name() {
    let drone = [("cavemod", NodeParams::cavemod()), ("frontiers2021", NodeParams::frontiers2021())];
    assert_eq!(drone.each_ref().map(|(name, _)| *name), PRESETS.map(|preset| preset.name), "all of them");
    let plain = PLAIN.replace("k_db_per_m = 20.0", "");
    let read = |text: &str| Course::read(&source(text), &[]).unwrap().node_params();
    assert_eq!(read(&plain), NodeParams::default());
    for (name, params) in drone {
        assert_eq!(read(&format!("preset = \"{name}\"\n{plain}")), params, "{name}");
    }
}

#[test]
fn a_set_wins_over_a_preset_whichever_comes_first() {
    for sets in [["preset=cavemod", "link.lost_s=2"], ["link.lost_s=2", "preset=cavemod"]] {
        let scenario = Scenario::parse(&source(PLAIN), &sets.map(str::to_owned)).unwrap();
        assert_eq!((scenario.link.lost_s, scenario.link.head_stop_db), (2.0, 65.0));
    }
}

#[test]
fn a_wrong_value_of_a_preset_is_named_with_the_presets_line() {
    const ODD: Preset = Preset { name: "odd", text: "# Odd\n[tof]\nperiod_s = 0.07\n[link]\nlost = 1\n" };
    let (source, sets) = (source(PLAIN), ["link.lost_s=2".to_owned()]);
    let known = KnownKeys::of(&[Course::KEYS]);
    let odd = |preset| {
        let mut document = Document::parse(&source, &sets, &known).unwrap();
        document.fill_in(preset).unwrap();
        Scenario::from_document(&document).unwrap_err().to_string()
    };
    assert!(
        odd(ODD).starts_with("<preset odd>:5: unknown key 'link.lost'; did you mean 'lost_s'?"),
        "{}",
        odd(ODD)
    );
    let ranged = Preset { text: ODD.text.trim_end_matches("lost = 1\n"), ..ODD };
    assert!(
        odd(ranged).starts_with("<preset odd>:3: tof.period_s = 0.07: must be a multiple"),
        "{}",
        odd(ranged)
    );
}
