//! Robots hear each other over the same radio as relays.

use std::sync::Arc;

use uchain_sim::{
    config::builtin,
    mission::{
        Scene as _, Stopped,
        chain::Course,
        explore::{Site, SiteExtensions},
    },
    radio::{Disc, PathLoss, RadioKind, RadioModel},
    registry::{AnyMission, Of, Registry},
};

use super::{site, summary};

const MAPS: [&str; 2] = ["apartment", "corridors"];

/// Every packet arrives that has a link.
const SURE: [&str; 2] = ["packets.drop_rate=0", "radio.sigma_db=0"];

#[test]
fn a_disc_by_its_own_word_is_the_range_of_messages() {
    for map in MAPS {
        for seed in 1..=3 {
            let by_range = |range_m: &str| {
                let set = format!("explore.range_m={range_m}");
                summary(&site(map, &[&set]), seed).digest
            };
            let by_radio = |range_m: &str| {
                let set = format!("radio.range_m={range_m}");
                summary(&site(map, &["radio.model=disc", &set, SURE[0]]), seed).digest
            };
            let near = by_range("2.25");
            assert_eq!(by_radio("2.25"), near, "{map} {seed}");
            assert_ne!(by_radio("6"), near, "{map} {seed}");
        }
    }
}

#[test]
fn over_a_radio_that_loses_little_all_hear_all() {
    for map in MAPS {
        let all = summary(&site(map, &[]), 1).digest;
        // 35 dB wherever they are.
        let little = ["radio.alpha_free=0", "radio.alpha_wall=0", SURE[0]];
        assert_eq!(summary(&site(map, &little), 1).digest, all, "{map}");
        let lost = [little[0], little[1], "packets.drop_rate=0.7"];
        assert_ne!(summary(&site(map, &lost), 1).digest, all, "{map}");
        let noisy = [little[0], little[1], SURE[0], "packets.limit_db=36"];
        assert_ne!(summary(&site(map, &noisy), 1).digest, all, "{map}");
    }
}

#[test]
fn a_team_whose_packets_get_lost_still_sees_everything_and_comes_home() {
    for map in MAPS {
        for seed in 1..=3 {
            let site = site(map, &["radio.alpha_wall=6"]);
            let flown = summary(&site, seed);
            assert_eq!(
                (flown.stopped, flown.hubs_left, flown.wall_contacts),
                (Some(Stopped::Explored), 0, 0)
            );
            assert!(flown.coverage > 0.97, "{map} {seed}: {}", flown.coverage);
            assert_eq!(flown, summary(&site, seed));
        }
    }
}

#[test]
fn a_model_of_ones_own_joins_robots() {
    let far = site("corridors", &["packets.drop_rate=0"]);
    let near = far.with_radio("mine", Arc::new(Disc { range_m: 2.25, loss_db: 50.0 }));
    assert!(near.scenario.to_toml().unwrap().contains("model = \"mine\""));
    assert_eq!(summary(&near, 1).digest, summary(&site("corridors", &["explore.range_m=2.25"]), 1).digest);
    // Eq. 22 by the scenario's word, and as somebody's own.
    let by_word: Arc<Site> = site("corridors", &["radio.alpha_wall=4"]);
    let eq_22 = PathLoss::new(by_word.scenario.radio.clone().unwrap(), &by_word.map).unwrap();
    let own: Arc<dyn RadioModel> = Arc::new(eq_22);
    assert_eq!(summary(&by_word.with_radio("mine", own), 1), summary(&by_word, 1));
}

#[test]
fn losses_that_leave_robots_to_themselves_are_noted_before_the_start() {
    let notes = |sets: &[&str]| site("apartment", sets).notes().join("\n");
    let plain = notes(&[]);
    assert!(notes(&["radio.sigma_db=1"]).contains("packets.drop_rate = 0.2: in 36 of 100 rounds two robots"));
    assert_eq!(notes(&SURE), plain);
    assert!(notes(&["radio.range_m=4"]).contains("the model \"path-loss\" has no range"));
}

/// A disc of two ranges.
const WIDE: RadioKind = RadioKind::new("wide", "Twice as far as range_m.", |table, _| {
    Ok(Arc::new(Disc { range_m: 2.0 * table.range_m.unwrap_or(1.5), loss_db: 50.0 }))
});

static MISSIONS: [&dyn AnyMission; 2] =
    [&Of::<Course>::NEW, &Of::<Site>::with(SiteExtensions { radios: &[WIDE], ..Site::BUILTIN })];

#[test]
fn a_model_of_ones_own_has_a_word_in_explorations_alone() {
    let registry = Registry::new(&MISSIONS);
    let sets = ["radio.model=wide", "packets.drop_rate=0"].map(ToOwned::to_owned);
    let wide = registry.read(&builtin("corridors").unwrap(), &sets).unwrap();
    let wide = summary(wide.get::<Site>().unwrap(), 1).digest;
    assert_eq!(wide, summary(&site("corridors", &["explore.range_m=3"]), 1).digest);
    assert_ne!(wide, summary(&site("corridors", &["explore.range_m=2.25"]), 1).digest);
    let chain = registry.read(&builtin("corner").unwrap(), &sets).unwrap_err().to_string();
    assert!(chain.contains("radio.model = \"wide\": unknown choice"), "{chain}");
    let words = |registry: Registry| {
        let explained = registry.explain("radio.model").unwrap();
        explained[0].choices.iter().map(|(word, _)| word.clone()).collect::<Vec<_>>()
    };
    assert_eq!(words(registry).last().map(String::as_str), Some("wide"));
    let built_in =
        ["path-loss", "disc", "log-distance", "multi-wall", "p1238", "table", "two-slope", "visibility"];
    assert_eq!(words(Registry::default()), built_in);
}
