//! Budgets against figures worked out by hand.

use super::*;

fn applied(text: &str) -> Budgeted {
    let budget = LinkBudget::read(text).unwrap();
    budget.applied(
        &RadioParams::default(),
        &TakeoffParams::default(),
        &LinkParams::default(),
        &PacketParams::default(),
    )
}

fn threshold(of: &Budgeted, key: &str) -> (f64, f64, f64) {
    let found = of.thresholds.iter().find(|threshold| threshold.key == key).unwrap();
    (found.loss_db, found.received_dbm, found.above_sensitivity_db)
}

#[test]
fn friis_gives_28_db_at_a_quarter_of_a_metre_of_2450_mhz_and_6_db_more_at_twice_the_distance() {
    // 4 π · 0.25 m · 2.45e9 / 299792458 = 25.674; 20 log10 of it is 28.190.
    let budget = LinkBudget::CRAZYFLIE;
    assert!((budget.free_space_db(0.25) - 28.190).abs() < 1e-3, "{}", budget.free_space_db(0.25));
    assert!((budget.free_space_db(0.5) - budget.free_space_db(0.25) - 6.0206).abs() < 1e-3);
}

#[test]
fn the_limit_is_power_and_gains_less_sensitivity_and_margin_and_the_thresholds_keep_their_distance_to_it() {
    // 0 + 2 + 2 + 95 - 10 = 89 dB, 5 dBm above... which is 99 dB at the sensitivity.
    let of =
        applied("tx_dbm=0,tx_gain_dbi=2,rx_gain_dbi=2,sensitivity_dbm=-95,margin_db=10,frequency_mhz=2450");
    assert_eq!(threshold(&of, "takeoff.s_min_db"), (89.0, -85.0, 10.0));
    assert_eq!(threshold(&of, "link.head_stop_db"), (99.0, -95.0, 0.0));
    assert_eq!(threshold(&of, "link.head_back_db"), (104.0, -100.0, -5.0));
    assert_eq!(threshold(&of, "link.relay_back_db"), (109.0, -105.0, -10.0));
    assert_eq!(of.reference_loss_db, 28.2);
    assert_eq!(threshold(&of, "packets.limit_db"), (99.0, -95.0, 0.0), "a receiver hears no better for it");
    let deaf: Vec<&str> = of.deaf().map(|threshold| threshold.key).collect();
    assert_eq!(deaf, ["link.head_back_db", "link.relay_back_db"]);
}

#[test]
fn with_margin_enough_nobody_turns_round_later_than_the_receiver_hears() {
    let of = applied("crazyflie");
    assert_eq!(threshold(&of, "takeoff.s_min_db"), (65.0, -65.0, 20.0));
    assert_eq!(threshold(&of, "link.relay_back_db"), (85.0, -85.0, 0.0));
    assert_eq!(of.deaf().count(), 0);
    assert_eq!(threshold(&of, "packets.limit_db"), (85.0, -85.0, 0.0));
    let sets = of.sets();
    assert!(sets.contains(&"takeoff.s_min_db=65.0".to_owned()), "{sets:?}");
    assert!(sets.contains(&"radio.reference_loss_db=28.2".to_owned()), "{sets:?}");
}

#[test]
fn what_is_no_budget_is_answered_with_what_one_is() {
    for (text, wanted) in [
        ("tx_dbm=0,sensitivity=-95", "unknown field `sensitivity`"),
        ("tx_dbm=0,sensitivity_dbm=-950", "sensitivity_dbm = -950"),
        ("tx_dbm=nan,sensitivity_dbm=-95", "tx_dbm = NaN"),
        ("sensitivity_dbm=-95", "missing field `tx_dbm`"),
        ("tx_dbm=much,sensitivity_dbm=-95", "expected tx_dbm"),
        ("absent.toml", "absent.toml: No such file"),
        ("crazyfly", "expected crazyflie, a file that ends in .toml"),
    ] {
        let said = LinkBudget::read(text).unwrap_err().to_string();
        assert!(said.contains(wanted), "{text}: {said}");
    }
}
