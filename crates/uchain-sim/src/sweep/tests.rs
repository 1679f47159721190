use super::*;
use crate::{
    analyse::{Cell, Kind},
    config::builtin,
    mission::{chain::Summary, explore::ExploreSummary},
};

fn sweep(vary: &[&str], replicates: u64) -> Sweep {
    let vary = vary.iter().map(ToString::to_string).collect();
    let design = Design::parse(&DesignText { vary, table: None }, "").unwrap();
    Sweep::new(builtin("straight").unwrap(), vec!["duration_s=1".to_owned()], design, replicates, 1).unwrap()
}

#[test]
fn what_is_varied_last_changes_fastest_and_replicates_faster_still() {
    let sweep = sweep(&["radio.sigma_db=1,2", "chain.uavs=2..4/3"], 5);
    assert_eq!((sweep.runs(), sweep.variants()), (30, 6));
    let run = sweep.run(27);
    assert_eq!((run.variant, run.replicate), (5, 2));
    assert_eq!(run.seed, sweep.run(2).seed, "common random numbers");
    assert_ne!(run.seed, sweep.run(26).seed);
    assert_eq!(sweep.design().assignments(4), ["radio.sigma_db=2", "chain.uavs=3"]);
}

#[test]
fn a_row_does_not_change_with_what_is_varied_besides_or_how_often() {
    let digests = |sweep: Sweep| -> Vec<String> {
        let digest =
            |scene: &dyn AnyScene, run: Run| scene.fly(run.seed, &mut ()).unwrap().digest().to_owned();
        sweep.each(digest).into_iter().map(Result::unwrap).collect()
    };
    let few = digests(sweep(&["radio.sigma_db=4"], 2));
    let more = digests(sweep(&["radio.sigma_db=0,4"], 3));
    assert_eq!(more[3..5], few);
    assert_ne!(more[..2], few, "another variant is another flight");
}

#[test]
fn results_come_in_order_on_any_number_of_threads() {
    let sweep = sweep(&["radio.sigma_db=0..9/10"], 20);
    for threads in [1, 3, 16] {
        let order = on_threads(Some(threads), || sweep.each(|_, run| run.index)).unwrap();
        assert_eq!(order, (0..200).map(Ok).collect::<Vec<_>>());
    }
}

#[test]
fn a_run_that_panics_is_a_row_and_takes_no_other_with_it() {
    let sweep = sweep(&[], 4);
    let done = sweep.each(|_, run| {
        assert!(run.index != 2, "run {} went wrong", run.index);
        run.index
    });
    assert_eq!(done, [Ok(0), Ok(1), Err("panicked: run 2 went wrong".to_owned()), Ok(3)]);
    let flown = done[2].clone().map(|_| unreachable!());
    let row = sweep.row(sweep.run(2), &flown);
    let columns = sweep.columns();
    assert_eq!(row.len(), columns.len());
    let cell = |name: &str| &row[columns.iter().position(|column| column.name == name).unwrap()];
    assert_eq!(cell("failed").text(), Some("panicked: run 2 went wrong"));
    assert_eq!((cell("run"), cell("digest")), (&Cell::Count(2), &Cell::Absent));
}

#[test]
fn columns_have_different_names_and_those_of_the_summary() {
    for name in ["straight", "apartment"] {
        let sweep = Sweep::new(builtin(name).unwrap(), Vec::new(), Design::default(), 1, 1).unwrap();
        let mut names: Vec<String> = sweep.columns().into_iter().map(|column| column.name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
        let sets = vec!["duration_s=5".to_owned()];
        let scene = Registry::default().read(&builtin(name).unwrap(), &sets).unwrap();
        let flown = scene.fly(1, &mut ()).unwrap();
        let summary = match (flown.summary::<Summary>(), flown.summary::<ExploreSummary>()) {
            (Some(summary), _) => serde_json::to_value(summary),
            (_, summary) => serde_json::to_value(summary),
        };
        // What is not a column: the scenario's name is the table's, the others are lists of structures.
        let elsewhere = ["scenario", "links", "unseen", "gaps"];
        for key in summary.unwrap().as_object().unwrap().keys() {
            assert!(names.contains(key) || elsewhere.contains(&key.as_str()), "{key} has no column");
        }
    }
}

#[test]
fn the_guide_names_every_column_with_its_type() {
    let names = |scenario: &str, kind: Kind| {
        let sweep = Sweep::new(builtin(scenario).unwrap(), Vec::new(), Design::default(), 1, 1).unwrap();
        let results = sweep.columns().into_iter().filter(|column| column.is_result && column.kind == kind);
        results.map(|column| format!("`{}`", column.name)).collect::<Vec<_>>().join(", ")
    };
    let rows = [
        (Kind::Count, "int64", "`run`, `variant`, `replicate`, `seed`; varied keys that are whole numbers"),
        (Kind::Number, "double", "other varied numbers"),
        (Kind::Single, "float", ""),
        (Kind::Text, "string", "all else that is varied; `failed`"),
        (Kind::Numbers, "list of double", ""),
        (Kind::Singles, "list of float", ""),
    ];
    let guide = include_str!("../../../../docs/guide/sweeps.md");
    for (kind, name, every) in rows {
        let line =
            format!("| {name} | {every} | {} | {} |\n", names("straight", kind), names("apartment", kind));
        assert!(guide.contains(&line), "docs/guide/sweeps.md lacks the line\n{line}");
    }
}
