//! What the laws may cost on the drone, and what they cost: one table.

use std::fmt::Write as _;

use anyhow::{Result, ensure};

use super::figures::Figures;

/// Instructions that a relay may take for one tick.
const TICK: Option<u64> = Some(1000);
/// Memory of the chip that programs may take (bytes): its core-coupled 64 KiB apart.
const RAM: Option<u64> = Some(128 * 1024);

/// A line of the table.
struct Row {
    what: &'static str,
    unit: &'static str,
    /// What it may be; what has no limit is told and no more.
    limit: Option<u64>,
    of: fn(&Figures) -> Result<u64>,
}

const fn row(
    what: &'static str,
    unit: &'static str,
    limit: Option<u64>,
    of: fn(&Figures) -> Result<u64>,
) -> Row {
    Row { what, unit, limit, of }
}

/// Columns of a line `call WORD CALLS MEAN MOST`.
const MEAN: usize = 1;
const MOST: usize = 2;

#[rustfmt::skip]
const ROWS: &[Row] = &[
    row("A relay decides on packets and distances, in the mean", "instructions", TICK, |f| f.at("call relay-radio-tof", MEAN)),
    row("– at most", "instructions", TICK, |f| f.at("call relay-radio-tof", MOST)),
    row("A relay steers by distances alone, at most", "instructions", TICK, |f| f.at("call relay-tof", MOST)),
    row("A relay sees nothing new, at most", "instructions", TICK, |f| f.at("call relay-nothing", MOST)),
    row("The head decides, at most", "instructions", TICK, |f| f.at("call head", MOST)),
    row("A decision at its hardest: every law and variant, eight packets, readings good and bad", "instructions", None, |f| f.at("hardest instructions", 0)),
    row("What a UAV says is put together, at most", "instructions", None, |f| f.at("call say", MOST)),
    row("`center`, law \"wall\", at most", "instructions", None, |f| f.at("call center-wall", MOST)),
    row("`center`, law \"paper\", at most", "instructions", None, |f| f.at("call center-paper", MOST)),
    row("`center`, law \"firmware\", at most", "instructions", None, |f| f.at("call center-firmware", MOST)),
    row("`equalize`, law \"lipschitz\", at most", "instructions", None, |f| f.at("call equalize-lipschitz", MOST)),
    row("`equalize`, law \"inverse-model\", at most", "instructions", None, |f| f.at("call equalize-inverse-model", MOST)),
    row("`equalize`, law \"bang-bang\", at most", "instructions", None, |f| f.at("call equalize-bang-bang", MOST)),
    row("`ScalarKalman`, predict and update, at most", "instructions", None, |f| f.at("call kalman", MOST)),
    row("`Node`", "bytes of RAM", Some(384), |f| f.at("size_of Node", 0)),
    row("– of it its `NodeParams`", "bytes of RAM", None, |f| f.at("size_of NodeParams", 0)),
    row("`Observation`, the packets of a decision included", "bytes of RAM", None, |f| f.at("size_of Observation", 0)),
    row("– of it its `RadioSlot`, room for eight packets", "bytes of RAM", None, |f| f.at("size_of RadioSlot", 0)),
    row("Stack of a decision", "bytes of RAM", Some(512), decision_stack),
    row("Code of a node with all its laws: what a firmware grows by", "bytes of flash", Some(6 * 1024), |f| f.at("flash", 0)),
    row("Functions of software doubles in the chain's image", "functions", Some(0), |f| f.at("doubles", 0)),
    row("A robot's decision when it explores, in the mean", "instructions", None, |f| f.at("call decision", MEAN)),
    row("– at most", "instructions", None, |f| f.at("call decision", MOST)),
    row("Stack of an explorer's calls", "bytes of RAM", None, |f| f.most("explorer stack ")),
    row("Heap of the `apartment`'s whole team on one map, at most", "bytes of RAM", RAM, |f| f.in_line("explored", 0, PEAK)),
    row("– its map: nodes", "nodes", None, |f| f.in_line("explored", 0, NODES)),
    row("– heap in the end, per node", "bytes of RAM", None, |f| Ok(f.in_line("explored", 0, USED)? / f.in_line("explored", 0, NODES)?.max(1))),
    row("Heap of one robot of it alone, with a map of its own, at most", "bytes of RAM", RAM, |f| f.in_line("explored", 1, PEAK)),
    row("Heap of the fullest exploration of all that are flown, at most", "bytes of RAM", RAM, |f| f.most_in("explored", PEAK)),
];

/// Columns of a line `explored BRAINS ROUNDS NODES USED PEAK`.
const NODES: usize = 2;
const USED: usize = 3;
const PEAK: usize = 4;

/// Of every decision that was looked at, in flight and at its hardest.
fn decision_stack(figures: &Figures) -> Result<u64> {
    Ok(figures
        .at("hardest decide_stack", 0)?
        .max(figures.at("stack head", 0)?)
        .max(figures.most("stack relay-")?))
}

/// The table, in Markdown.
pub(crate) fn table(figures: &Figures) -> Result<String> {
    let mut table = String::from("| | measured | at most |\n|---|---:|---:|\n");
    for row in ROWS {
        let limit = row.limit.map(grouped).unwrap_or_default();
        let _ = writeln!(table, "| {} | {} {} | {limit} |", row.what, grouped((row.of)(figures)?), row.unit);
    }
    Ok(table)
}

/// Nothing costs more than it may.
pub(crate) fn hold(figures: &Figures) -> Result<()> {
    let mut passed = Vec::new();
    for row in ROWS {
        let (measured, limit) = ((row.of)(figures)?, row.limit.unwrap_or(u64::MAX));
        if measured > limit {
            passed.push(format!(
                "{}: {} {}, at most {}",
                row.what,
                grouped(measured),
                row.unit,
                grouped(limit)
            ));
        }
    }
    ensure!(passed.is_empty(), "over budget:\n{}", passed.join("\n"));
    Ok(())
}

/// 1,234,567.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Where the table stands in the docs.
const BEGINS: &str = "<!-- budget table -->\n";
const ENDS: &str = "<!-- end of budget table -->";

/// The docs tell of the same things and the same limits; figures move with the compiler.
pub(crate) fn are_in(page: &str, table: &str) -> Result<()> {
    let inside =
        page.split_once(BEGINS).and_then(|(_, rest)| rest.split_once(ENDS)).map(|(inside, _)| inside);
    let told = inside.unwrap_or_default();
    ensure!(
        skeleton(told) == skeleton(table),
        "docs/guide/firmware.md has another table of what firmware costs; between `{}` and `{ENDS}` has to stand\n\n{table}",
        BEGINS.trim()
    );
    Ok(())
}

/// A table without what was measured.
fn skeleton(table: &str) -> Vec<(String, String)> {
    let cells = |line: &str| {
        let mut cells = line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned());
        Some((cells.next()?, cells.nth(1)?))
    };
    table.lines().filter_map(cells).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = "size_of Node 384\nsize_of NodeParams 200\nsize_of Observation 376\nsize_of RadioSlot 324\n\
        hardest instructions 1177\nhardest decide_stack 184\nhardest say_stack 24\n\
        call head 9 400 600\ncall relay-radio-tof 9 719 1000\ncall relay-radio 9 300 300\n\
        call relay-tof 9 300 343\ncall relay-nothing 9 45 45\ncall say 9 20 30\n\
        call center-wall 9 200 283\ncall center-paper 9 200 283\ncall center-firmware 9 200 283\n\
        call equalize-lipschitz 9 50 58\ncall equalize-inverse-model 9 200 207\ncall equalize-bang-bang 9 40 50\n\
        call kalman 9 60 70\nstack head 180\nstack relay-radio-tof 512\nstack say 40\n\
        call decision 9 20000 90000\nexplorer stack perceive 900\n\
        explored 3 40 100 50000 131072\nexplored 1 40 100 45000 60000\nflash 6144\ndoubles 0\n";

    fn figures(printed: &str) -> Figures {
        let mut figures = Figures::default();
        figures.read(printed);
        figures
    }

    #[test]
    fn at_its_limits_everything_holds_and_the_table_tells_it() {
        let figures = figures(PRINTED);
        hold(&figures).unwrap();
        let table = table(&figures).unwrap();
        assert!(table.contains("| `Node` | 384 bytes of RAM | 384 |\n"), "{table}");
        assert!(table.contains("| – heap in the end, per node | 500 bytes of RAM |  |\n"), "{table}");
        assert!(table.contains("| Stack of a decision | 512 bytes of RAM | 512 |\n"), "{table}");
    }

    #[test]
    fn every_budget_that_is_passed_by_one_fails_and_says_so() {
        for (within, above, named) in [
            ("relay-radio-tof 9 719 1000", "relay-radio-tof 9 719 1001", "1,001 instructions, at most 1,000"),
            ("relay-tof 9 300 343", "relay-tof 9 300 1001", "A relay steers by distances alone"),
            ("relay-nothing 9 45 45", "relay-nothing 9 45 1001", "A relay sees nothing new"),
            ("head 9 400 600", "head 9 400 1001", "The head decides"),
            ("Node 384", "Node 385", "`Node`: 385 bytes of RAM, at most 384"),
            ("stack relay-radio-tof 512", "stack relay-radio-tof 513", "Stack of a decision: 513"),
            ("hardest decide_stack 184", "hardest decide_stack 513", "Stack of a decision: 513"),
            ("flash 6144", "flash 6145", "6,145 bytes of flash, at most 6,144"),
            ("doubles 0", "doubles 1", "Functions of software doubles"),
            ("50000 131072", "50000 131073", "131,073 bytes of RAM, at most 131,072"),
            ("45000 60000", "45000 131073", "Heap of one robot"),
            ("doubles 0", "doubles 0\nexplored 3 9 9 9 131073", "Heap of the fullest"),
        ] {
            let printed = PRINTED.replace(within, above);
            assert_ne!(printed, PRINTED, "{within}");
            let error = hold(&figures(&printed)).unwrap_err().to_string();
            assert!(error.contains(named), "{above}: {error}");
        }
    }

    #[test]
    fn what_the_chip_did_not_say_is_no_zero() {
        let untold = ["call relay-radio 9", "hardest say_stack", "stack say"];
        for line in PRINTED.lines().filter(|line| untold.iter().all(|begins| !line.starts_with(begins))) {
            let without = PRINTED.replace(&format!("{line}\n"), "");
            assert!(table(&figures(&without)).is_err(), "{line}");
            // A figure without a limit may be missed by the table alone.
            assert!(hold(&figures(&without)).is_err(), "{line}");
        }
    }

    #[test]
    fn the_docs_follow_rows_and_limits_and_not_every_figure() {
        let table = table(&figures(PRINTED)).unwrap();
        let page = |table: &str| format!("# What it costs\n\n{BEGINS}{table}{ENDS}\n");
        are_in(&page(&table), &table).unwrap();
        are_in(&page(&table.replace("1,177", "1,180")), &table).unwrap();
        let other_limit = table.replace("| 512 |", "| 600 |");
        assert!(are_in(&page(&other_limit), &table).unwrap_err().to_string().contains("firmware.md"));
        assert!(are_in("nothing", &table).is_err());
    }
}
