use bytes::Bytes;
use parquet::file::reader::{FileReader as _, SerializedFileReader};

use super::*;
use crate::analyse::{Cell, Column, Kind};

const KINDS: [(&str, Kind); 6] = [
    ("count", Kind::Count),
    ("number", Kind::Number),
    ("single", Kind::Single),
    ("digest", Kind::Text),
    ("numbers", Kind::Numbers),
    ("singles", Kind::Singles),
];

fn columns() -> Vec<Column> {
    let column =
        |(name, kind): &(&str, Kind)| Column { name: (*name).to_owned(), kind: *kind, is_result: true };
    KINDS.iter().map(column).collect()
}

/// Rows of every kind of cell, some of them absent.
fn rows(count: u64) -> Vec<Vec<Cell>> {
    let row = |run: u64| {
        let number = (run as f64 + 0.1) / 7.0;
        let list = |width: u64| {
            Cell::Numbers(
                (0..run % width)
                    .map(|at| (at != 1).then_some(f64::from(number as f32) * (at + 1) as f64))
                    .collect(),
            )
        };
        let digest = if run.is_multiple_of(5) {
            Cell::Absent
        } else {
            Cell::Text(format!("{:016x}", run * 0x9e37_79b9))
        };
        vec![run.into(), number.into(), (number as f32).into(), digest, list(4), list(3)]
    };
    (0..count).map(row).collect()
}

fn written(rows: Vec<Vec<Cell>>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = Writer::start(&mut bytes, columns(), vec![("uchain.name", "test".to_owned())]).unwrap();
    rows.into_iter().try_for_each(|row| writer.row(row)).unwrap();
    writer.finish().unwrap();
    bytes
}

/// All cells of a table, column by column; the reason if one cannot be read.
fn read(bytes: &[u8]) -> std::result::Result<Vec<Vec<Cell>>, String> {
    let table = Table::of(Bytes::copy_from_slice(bytes)).map_err(|error| error.to_string())?;
    let cells = |column: Column| {
        let cells = |group| table.cells(&column, group).map_err(|error| error.to_string());
        let groups: std::result::Result<Vec<_>, _> = (0..table.groups()).map(cells).collect();
        groups.map(|groups| groups.concat())
    };
    columns().into_iter().map(cells).collect()
}

#[test]
fn a_table_reads_as_it_was_written_in_one_group_and_in_many() {
    for count in [1, 100, 2 * GROUP_ROWS as u64 + 7] {
        let rows = rows(count);
        let columns = read(&written(rows.clone())).unwrap();
        for (place, cells) in columns.iter().enumerate() {
            let wanted: Vec<Cell> = rows.iter().map(|row| row[place].clone()).collect();
            assert!(*cells == wanted, "{} of {count} rows", KINDS[place].0);
        }
    }
}

/// Where the contents of pages lie in a table: behind their headers. The last page of a column ends where the column
/// does; the content of the one before, a dictionary, is long enough not to stand in its header by chance.
fn contents(whole: &[u8]) -> Vec<std::ops::Range<usize>> {
    let file = SerializedFileReader::new(Bytes::copy_from_slice(whole)).unwrap();
    let mut ranges = Vec::new();
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group).unwrap();
        for leaf in 0..group.num_columns() {
            let (start, length) = group.metadata().column(leaf).byte_range();
            let (mut from, end) = (start as usize, (start + length) as usize);
            let pages: Vec<_> = group.get_column_page_reader(leaf).unwrap().map(Result::unwrap).collect();
            for (place, page) in pages.iter().enumerate() {
                let content = page.buffer();
                let at = if place + 1 == pages.len() {
                    end - content.len()
                } else {
                    from + whole[from..end]
                        .windows(content.len())
                        .position(|bytes| bytes == &content[..])
                        .unwrap()
                };
                assert_eq!(whole[at..at + content.len()], content[..]);
                ranges.push(at..at + content.len());
                from = at + content.len();
            }
        }
    }
    ranges
}

#[test]
fn a_bit_that_flips_in_a_page_is_noticed_without_the_folder() {
    let whole = written(rows(40));
    let wanted = read(&whole).unwrap();
    let contents = contents(&whole);
    assert!(contents.len() >= 6, "a page a column at least: {contents:?}");
    let mut unnoticed = 0;
    for range in &contents {
        for bit in 8 * range.start..8 * range.end {
            let mut flipped = whole.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            let now = read(&flipped);
            assert!(now.is_err(), "bit {} of byte {}: {now:?}", bit % 8, bit / 8);
            // Were the checksum changed with it, nobody would notice.
            let (old, new) = (crc_of(&whole[range.clone()]), crc_of(&flipped[range.clone()]));
            let place = whole[..range.start].windows(old.len()).rposition(|bytes| bytes == old).unwrap();
            if bit % 8 == 0 && old.len() == new.len() {
                flipped[place..place + new.len()].copy_from_slice(&new);
                unnoticed += usize::from(read(&flipped).is_ok_and(|now| now != wanted));
            }
        }
    }
    assert!(unnoticed > 100, "the bits are looked at: {unnoticed}");
}

fn crc_of(content: &[u8]) -> Vec<u8> {
    pages::folded(crc32fast::hash(content).cast_signed())
}

#[test]
fn a_bit_that_flips_anywhere_else_is_no_panic() {
    let whole = written(rows(3));
    for bit in 0..whole.len() * 8 {
        let mut flipped = whole.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        // Whether it is noticed is up to the folder: sweep.json holds the hash of all bytes.
        let _ = read(&flipped);
    }
}
