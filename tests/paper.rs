use std::{collections::BTreeSet, fmt::Write as _, fs, path::Path};

use uchain_papers::{ITEMS, Item, Outcome, Page, RunCache, Verdict, report};

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
        for page in &outcome.pages {
            let is_page = Path::new(&page.name).extension().is_some_and(|ending| ending == "md");
            assert!(page.name.starts_with(item.id) && is_page, "{}", page.name);
        }
        for table in &outcome.tables {
            assert!(!table.rows.is_empty(), "{}", table.name);
            assert!(table.is_for_report() || table.name.starts_with(item.id), "{}", table.name);
            assert!(table.rows.iter().all(|row| row.len() == table.header.len()), "{}", table.name);
        }
    }
    insta::assert_snapshot!(all.iter().map(|item| verdicts(item) + &tables(&item.1)).collect::<String>());

    kept("reproduction.md", &report(&all));
    for page in all.iter().flat_map(|(_, outcome)| &outcome.pages) {
        kept(&page.name, &page.text);
        assert!(says(&read("README.md"), page), "README.md has to say, word for word:\n\n{}", page.gist());
    }
}

fn read(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap_or_default()
}

/// A page of the docs is what the code gives; it is written anew if snapshots are.
fn kept(name: &str, text: &str) {
    let docs = format!("docs/{name}");
    if std::env::var("INSTA_UPDATE").as_deref() == Ok("always") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&docs);
        fs::write(path, text).expect("a page can be written");
    }
    let written = read(&docs);
    let first = text.lines().zip(written.lines()).position(|(now, then)| now != then);
    assert!(
        written == text,
        "{docs} is no longer what the code gives, from line {:?} on; look at the difference, then: \
         INSTA_UPDATE=always cargo test paper",
        first.map(|line| line + 1)
    );
}

/// Whether a text holds a page's first paragraph, wherever its lines end.
fn says(text: &str, page: &Page) -> bool {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    !page.gist().is_empty() && words(text).contains(&words(page.gist()))
}

#[test]
fn a_text_says_what_a_page_begins_with_only_if_every_word_and_number_is_there() {
    let page =
        Page { name: "a.md".into(), text: "# A\n\nIt saves 5.5 % of\nits rounds. No more.\n\nWhy.\n".into() };
    assert!(says("# B\n\nSo: It saves 5.5 %\nof its rounds. No\nmore. See there.", &page));
    assert!(!says("It saves 5.4 % of its rounds. No more.", &page));
    assert!(!says("It saves 5.5 % of its rounds.", &page));
    assert!(!says("", &Page { name: "b.md".into(), text: "# B\n".into() }));
}
