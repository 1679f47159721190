use std::{collections::BTreeSet, fmt::Write as _, fs, path::Path};

use uchain_papers::{ITEMS, Item, Outcome, RunCache, Verdict, report};

/// Rows of an item that agree or differ, one a line.
fn verdicts((item, outcome): &(Item, Outcome)) -> String {
    let judged = outcome.rows.iter().filter(|row| row.verdict != Verdict::Unjudged);
    judged.fold(String::new(), |mut text, row| {
        let agrees = if row.verdict == Verdict::Agrees { "agrees " } else { "differs" };
        let _ = writeln!(text, "{:<9} {agrees} {}: {} | {}", item.id, row.what, row.published, row.ours);
        text
    })
}

/// What programs read: every table with the number of its rows and a hash of its bytes (FNV-1a).
fn tables(outcome: &Outcome) -> String {
    let hash = |bytes: &[u8]| {
        let fold = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, fold)
    };
    let named = outcome.tables.iter().filter(|table| !table.is_for_report());
    named.fold(String::new(), |mut text, table| {
        let (rows, hash) = (table.rows.len(), hash(table.csv().as_bytes()));
        let _ = writeln!(text, "          {}.csv: {rows} rows, {hash:016x}", table.name);
        text
    })
}

#[test]
fn the_report_in_the_docs_is_what_the_code_gives() {
    let cache = RunCache::default();
    let regenerate =
        |item: &Item| (*item, item.regenerate(&cache).unwrap_or_else(|e| panic!("{}: {e}", item.id)));
    let all: Vec<(Item, Outcome)> = ITEMS.iter().map(regenerate).collect();

    let names = all.iter().flat_map(|(_, outcome)| outcome.pictures.iter().map(|(name, _)| name));
    let distinct: BTreeSet<&String> = names.clone().collect();
    assert_eq!(names.count(), distinct.len());
    for (item, outcome) in &all {
        for (name, picture) in &outcome.pictures {
            assert!(
                name.starts_with(item.id)
                    && picture.png.starts_with(b"\x89PNG")
                    && picture.svg.contains("<svg")
            );
        }
        for table in &outcome.tables {
            assert!(!table.rows.is_empty(), "{}", table.name);
            assert!(table.is_for_report() || table.name.starts_with(item.id), "{}", table.name);
            assert!(table.rows.iter().all(|row| row.len() == table.header.len()), "{}", table.name);
        }
    }
    insta::assert_snapshot!(all.iter().map(|item| verdicts(item) + &tables(&item.1)).collect::<String>());

    let report = report(&all);
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reproduction.md");
    if std::env::var("INSTA_UPDATE").as_deref() == Ok("always") {
        fs::write(&docs, &report).expect("the report can be written");
    }
    let written = fs::read_to_string(&docs).unwrap_or_default();
    let first = report.lines().zip(written.lines()).position(|(now, then)| now != then);
    assert!(
        written == report,
        "docs/reproduction.md is no longer what the code gives, from line {:?} on; look at the difference, then: \
         INSTA_UPDATE=always cargo test paper",
        first.map(|line| line + 1)
    );
}
