use std::{fmt::Write as _, fs, path::Path, sync::Arc};

use crate::{
    config::{ConfigError, Source, builtin},
    mission::chain::{Course, plan},
    radio::Antenna,
    run::run,
};

/// Steps of the tables (m).
const STEP_M: f64 = 0.25;

/// Eq. 22 with the defaults of its other parameters as a table over all of the scenario `straight`, each pair one way.
fn eq_22(exponent: f64) -> String {
    let mut text = "x1_m,y1_m,x2_m,y2_m,loss_db\n".to_owned();
    let at = |place: u32| [f64::from(place % 57) * STEP_M, f64::from(place / 57) * STEP_M - 0.5];
    for from in 0..57 * 5 {
        for to in from..57 * 5 {
            let ([x1, y1], [x2, y2]) = (at(from), at(to));
            let apart_m = libm::hypot(x1 - x2, y1 - y2);
            let loss_db = 35.0 + 10.0 * exponent * libm::log10(apart_m.max(0.25) / 0.25);
            writeln!(text, "{x1},{y1},{x2},{y2},{loss_db}").unwrap();
        }
    }
    text
}

/// `straight` in a folder, with a table beside it.
fn straight(folder: &Path, table: &str) -> Result<Arc<Course>, ConfigError> {
    fs::write(folder.join("losses.csv"), table).unwrap();
    let text = builtin("straight").unwrap().text;
    let file = folder.join("straight.toml");
    fs::write(&file, text + "\n[radio]\nmodel = \"table\"\ntable_file = \"losses.csv\"\n").unwrap();
    Course::read(&Source::read(&file).unwrap(), &[])
}

#[test]
fn a_fine_table_of_eq_22_flies_as_eq_22_does() {
    let folder = tempfile::tempdir().unwrap();
    let formula = Course::read(&builtin("straight").unwrap(), &[]).unwrap();
    let table = straight(folder.path(), &eq_22(2.0)).unwrap();
    assert!(table.notes().is_empty(), "{:?}", table.notes());
    let mut most_db = 0.0_f32;
    for i in 0..4_000_u32 {
        let at = |x: u32, y: u32| [f64::from(x % 131) * 0.1 + 0.5, f64::from(y % 13) * 0.06 - 0.36];
        let [a, b]: [Antenna; 2] =
            [at(i, i / 7), at(7 * i + 13, i / 3)].map(|at| formula.map.to_local(at).into());
        let apart_m = a.at.distance(b.at);
        if apart_m < 2.0 {
            continue;
        }
        // Each of the four coordinates adds no more than h²/8 max |∂²|, and ∂² of 20 log10 r is no more than 8.686 / r²,
        // within two diagonals of a cell.
        let (step_m, nearest_m) = (STEP_M as f32, apart_m - 2.0 * 0.354);
        let bound_db = 0.5 * step_m * step_m * 8.686 / (nearest_m * nearest_m);
        let off_db = (table.loss_db(&a, &b) - formula.loss_db(&a, &b)).abs();
        assert!(off_db <= bound_db + 1e-4, "{off_db} dB off over {apart_m} m, at most {bound_db}");
        most_db = most_db.max(off_db);
    }
    assert!(most_db > 1e-3, "interpolated");

    let needed = |course: &Course| plan(course, None, 1.0, None).unwrap().uavs_needed;
    assert_eq!(needed(&table), needed(&formula));
    let [with_table, by_formula] = [&table, &formula].map(|course| run(course, 1, &mut ()).unwrap());
    assert_eq!(with_table.relays_used, by_formula.relays_used);
    let worst_db = |summary: &crate::mission::chain::Summary| summary.worst_link_db.unwrap();
    let off_db = (worst_db(&with_table) - worst_db(&by_formula)).abs();
    assert!(off_db < 1.0, "{off_db} dB");
    // The control: another exponent.
    let other = straight(folder.path(), &eq_22(2.5)).unwrap();
    assert_ne!(needed(&other), needed(&formula));
    assert!((worst_db(&run(&other, 1, &mut ()).unwrap()) - worst_db(&by_formula)).abs() > 2.0);
}

#[test]
fn a_bad_table_is_named_with_the_line_of_the_scenario_and_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let error =
        straight(folder.path(), "x1_m,y1_m,x2_m,y2_m,loss_db\n0,0,1,0,much\n").unwrap_err().to_string();
    let of_scenario = format!("{}:", folder.path().join("straight.toml").display());
    assert!(error.starts_with(&of_scenario), "{error}");
    assert!(
        error.contains("radio.table_file = \"losses.csv\": line 2, loss_db = \"much\": expected"),
        "{error}"
    );
}

#[cfg(feature = "record")]
#[test]
fn a_recording_names_the_table_that_it_does_not_hold() {
    use crate::{
        mission::chain::{McapRecorder, Scenario},
        replay::{Recording, verify},
    };
    let folder = tempfile::tempdir().unwrap();
    let table = straight(folder.path(), &eq_22(2.0)).unwrap();
    let toml = table.scenario.to_toml().unwrap();
    assert!(toml.contains("model = \"table\"") && toml.contains("table_file = \"losses.csv\""), "{toml}");
    let again = Source { label: "again".to_owned(), text: toml, folder: folder.path().to_owned() };
    assert_eq!(Scenario::parse(&again, &[]).unwrap(), table.scenario);

    let record = |course: &Arc<Course>| {
        let mut recorder = McapRecorder::start(Vec::new(), course, 1).unwrap();
        run(course, 1, &mut recorder).unwrap();
        recorder.finish().unwrap()
    };
    let open = |file: &[u8]| {
        let mut recording =
            Recording::<_, Course>::read(std::io::Cursor::new(file.to_vec()), "memory").unwrap();
        verify(&mut recording).map(|verdict| verdict.agrees())
    };
    let error = open(&record(&table)).unwrap_err().to_string();
    assert!(
        error.contains("radio.table_file = \"losses.csv\": cannot be read") && error.contains("recording"),
        "{error}"
    );
    // With a path from the root it is found again, as long as it is there.
    let whole = format!("radio.table_file={}", folder.path().join("losses.csv").display());
    let sets = ["radio.model=table".to_owned(), "duration_s=20".to_owned(), whole];
    let whole = Course::read(&builtin("straight").unwrap(), &sets).unwrap();
    assert!(open(&record(&whole)).unwrap());
}
