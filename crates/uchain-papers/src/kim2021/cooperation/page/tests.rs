use super::*;

#[test]
fn two_sentences_hold_every_number_and_count_what_shows() {
    let targets = [[[5.5, 3.7, 7.3], [4.0, 2.5, 5.5]], [[9.4, 7.7, 11.1], [10.2, 9.0, 11.4]]];
    let levels = [[[0.4, -0.2, 1.0], [-1.5, -2.5, -0.5]], [[-2.0, -3.0, -1.0], [2.0, 1.0, 3.0]]];
    let text = sentences(targets, levels, [0.14, 4.0]);
    for number in ["5.5 % (3.7 … 7.3)", "4.0 % (2.5 … 5.5)", "9.4 % (7.7 … 11.1)", "10.2 % (9.0 … 11.4)"]
    {
        assert!(text.contains(number), "{text}");
    }
    assert!(text.contains("saves 0.4 % (-0.2 … 1.0) and -1.5 % (-2.5 … -0.5) of the rounds"), "{text}");
    assert!(text.contains("of these four intervals one lies above 0 and two below"), "{text}");
    assert!(text.ends_with("in 0.1 to 4.0 % of their rounds only."), "{text}");
    // Eq. 7 is no end of a sentence.
    assert_eq!(text.matches(". ").count() - text.matches("Eq. 7").count(), 1, "{text}");
}

#[test]
fn a_range_is_met_by_the_mean_and_only_near_if_the_interval_alone_reaches_it() {
    let range = [5.41, 11.71];
    assert_eq!(met([5.41, 3.0, 8.0], range), "met");
    assert_eq!(met([5.4, 3.0, 5.5], range), "near");
    assert_eq!(met([12.0, 11.7, 13.0], range), "near");
    assert_eq!(met([5.0, 4.0, 5.4], range), "no");
    assert_eq!(met([f64::NAN; 3], range), "no");
}

#[test]
fn a_study_of_two_runs_makes_a_page_with_every_table_and_all_readings() {
    let study = Study::fly(2).unwrap();
    let text = text(&study, 2);
    for reading in super::super::READINGS {
        assert!(text.matches(&format!("| {} |", reading.name)).count() >= 7, "{}", reading.name);
    }
    // 12 means, 6 ranges, 4 slopes, 2 times 30 by team, 16 ways, 8 holds, 5 readings; and a head and a rule each.
    let rows = text.lines().filter(|line| line.starts_with('|')).count();
    assert_eq!(rows, 12 + 6 + 4 + 2 * 30 + 16 + 8 + 5 + 2 * 8);
    assert!(text.lines().nth(2).is_some_and(|line| line == gist(&study)));
    let [savings, runs] = study.tables();
    assert_eq!((savings.rows.len(), runs.rows.len()), (5 * 2 * 3 * 2 * 4, 5 * 2 * 3 * 4 * 2));
    for table in [savings, runs] {
        assert!(table.rows.iter().all(|row| row.len() == table.header.len()), "{}", table.name);
    }
}
