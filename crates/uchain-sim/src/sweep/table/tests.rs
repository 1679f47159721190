use super::*;
use crate::{
    config::builtin,
    sweep::{
        Design, DesignText,
        folder::{Folder, Job, Record, Shard, Watch},
    },
};

/// Nobody looks on.
struct Nobody;

impl Watch for Nobody {
    fn stop(&self) -> bool {
        false
    }
    fn done(&self, _: u64, _: u64, _: bool) {}
    fn again(&self, _: &FolderError) {}
}

/// Stops at once.
struct Hasty;

impl Watch for Hasty {
    fn stop(&self) -> bool {
        true
    }
    fn done(&self, _: u64, _: u64, _: bool) {}
    fn again(&self, _: &FolderError) {}
}

const WHOLE: Shard = Shard { number: 1, of: 1 };

/// Some of its variants cannot be flown, and one loses its head.
fn sweep(seed: u64) -> Sweep {
    let vary = vec!["chain.spacing_m=0.05,0.25".to_owned(), "faults.dead.0.start_s=1,100".to_owned()];
    let design = Design::parse(&DesignText { vary, table: None }, "").unwrap();
    let sets = vec!["duration_s=2".to_owned(), "faults.dead=[{ uav = 0, start_s = 1 }]".to_owned()];
    Sweep::new(builtin("corner").unwrap(), sets, design, 70, seed).unwrap()
}

fn fly(seed: u64, shard: Shard) -> Table {
    Table::fly(&sweep(seed), std::path::Path::new(""), shard, &Nobody).unwrap()
}

#[test]
fn a_table_in_memory_writes_the_bytes_of_a_folder_and_reads_them_back() {
    let here = tempfile::tempdir().unwrap();
    let asked = sweep(1);
    let manifest = Manifest::of(&asked, asked.check().unwrap());
    let folder = Folder::begin(&here.path().join("a"), manifest, std::path::Path::new(""), false).unwrap();
    let flown = folder.sweep().unwrap();
    let job = |shard| Job { shard, record: Record::None, watch: &Nobody };
    folder.fly(&flown, job(Shard { number: 2, of: 3 })).unwrap();
    let part = Table::read(&folder).unwrap();
    assert!(part == fly(1, Shard { number: 2, of: 3 }), "chunks that wait for the others");
    folder.fly(&flown, job(WHOLE)).unwrap();
    let totals = folder.finish(&flown).unwrap().unwrap();

    let table = fly(1, WHOLE);
    assert_eq!(table.totals(), totals);
    assert!(totals.failed == 3 * 70, "{totals:?}");
    let file = here.path().join("b.parquet");
    table.write(&file).unwrap();
    let bytes = |file: &std::path::Path| std::fs::read(file).unwrap();
    let wanted = bytes(&here.path().join("a/runs.parquet"));
    assert!(bytes(&file) == wanted);
    assert!(Table::read(&folder).unwrap() == table);
    fly(2, WHOLE).write(&file).unwrap();
    assert!(bytes(&file) != wanted, "another seed, other bytes");
}

#[test]
fn shards_in_any_order_are_the_whole_and_nothing_else_is() {
    let whole = fly(1, WHOLE);
    let shards: Vec<Table> = (1..=3).map(|number| fly(1, Shard { number, of: 3 })).collect();
    for (number, shard) in (1..).zip(&shards) {
        assert_eq!(Shard { number, of: 3 }.runs(&sweep(1)), shard.rows());
    }
    assert!(Table::concat(&[&shards[2], &shards[0], &shards[1]]).unwrap() == whole);
    let part = Table::concat(&[&shards[2], &shards[0]]).unwrap();
    let said = part.whole().unwrap_err().to_string();
    assert!(said.starts_with("94 of 280 runs are missing, the first is run 2:"), "{said}");
    let said = |tables: &[&Table]| Table::concat(tables).unwrap_err().to_string();
    assert!(said(&[&whole, &shards[1]]).starts_with("run 2 is in two of the tables"));
    assert_eq!(said(&[]), "no tables: expected at least one");
    let other = said(&[&shards[0], &fly(2, Shard { number: 2, of: 3 })]);
    assert_eq!(other, "table 1 is of another sweep than table 0: seed = 1 there, 2 asked for");
}

#[test]
fn a_table_goes_to_another_process_as_bytes_and_bytes_that_are_none_are_no_panic() {
    let table = fly(1, Shard { number: 2, of: 3 });
    let (about, rows) = table.to_bytes().unwrap();
    let back = |about: &str, rows: &[u8]| Table::from_bytes(Registry::default(), about, rows.to_vec());
    assert!(back(&about, &rows).unwrap() == table);
    assert!(rows.len() < 300 * 94 + 20_000, "{} bytes", rows.len());
    for about in ["", "{}", &about.replace("\"runs\":280", "\"runs\":281")] {
        assert!(back(about, &rows).is_err(), "{about}");
    }
    for end in [0, 10, rows.len() / 2, rows.len() - 1] {
        assert!(back(&about, &rows[..end]).is_err(), "{end}");
    }
    for place in (0..rows.len()).step_by(97) {
        let mut damaged = rows.clone();
        damaged[place] ^= 0x55;
        // Most are noticed; none is a panic.
        let _ = back(&about, &damaged);
    }
}

#[test]
fn who_is_told_to_stop_stops_before_the_first_run() {
    let stopped = Table::fly(&sweep(1), std::path::Path::new(""), WHOLE, &Hasty);
    assert!(matches!(stopped, Err(FolderError::Interrupted)));
}

#[test]
fn how_rows_are_cut_into_blocks_follows_from_which_runs_there_are() {
    let columns = sweep(1).columns();
    let block = |runs: std::ops::Range<u64>| {
        let mut block = Block::of(&columns, runs.start);
        for run in runs {
            let words = if run.is_multiple_of(3) { Cell::Absent } else { format!("{run}").as_str().into() };
            let row: Vec<Cell> = columns.iter().map(|_| words.clone()).collect();
            block.push(row.iter());
        }
        block
    };
    let most = BLOCK_ROWS as u64;
    let whole = joined(&columns, vec![block(0..2 * most + 5)]).unwrap();
    assert_eq!(
        whole.iter().map(Block::runs).collect::<Vec<_>>(),
        [0..most, most..2 * most, 2 * most..2 * most + 5]
    );
    let pieces = vec![block(most - 7..2 * most + 5), block(3..most - 7), block(0..1), block(1..3)];
    assert!(joined(&columns, pieces).unwrap() == whole);
    let gap = joined(&columns, vec![block(0..4), block(5..6)]).unwrap();
    assert_eq!(gap.len(), 2);
    assert!(gap != whole);
    assert_eq!(joined(&columns, vec![block(0..4), block(3..6)]), Err(3));
}
