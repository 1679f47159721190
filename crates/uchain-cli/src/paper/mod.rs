//! `uchain paper`: regenerates the papers' figures and tables (reproduction).

use std::{io::Write as _, time::Instant};

use clap::{
    Args,
    builder::{PossibleValue, PossibleValuesParser},
};
use uchain_papers::{ITEMS, Item, Outcome, RunCache, Verdict, report, verdict_table};

use crate::{
    exit::Failure,
    flags::{Out, Quiet},
    output::{
        Folder,
        papers::{REPORT, VERDICTS, leaves},
    },
};

/// Stands for every item.
const ALL: &str = "all";
const EXAMPLES: &str = "\
Examples:
  uchain paper all --out again              every figure and table of Laclau 2021 and Kim 2021
  uchain paper fig4e fig4f                  two of them; results in ./paper
  uchain paper formal ablations --out more  what the papers prove or leave open, in numbers

Writes REPORT.md (published | ours | agrees?) of the items asked for, verdicts.csv with its rows, a PNG and an SVG of
every picture, CSV of every run and every curve, and the pages that some items have of their own. Nothing is tuned to
agree; where it does not, the report says so and why. The report of all is docs/reproduction.md.
";

/// Items of the papers.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: paper, overwritten]")))]
#[command(mut_arg("quiet", |quiet| quiet.help("Print errors only: no progress, no verdicts")))]
pub(crate) struct Paper {
    /// What to draw again
    #[arg(value_name = "ITEM", required = true, value_parser = items())]
    items: Vec<String>,
    #[command(flatten)]
    out: Out,
    #[command(flatten)]
    quiet: Quiet,
}

fn items() -> PossibleValuesParser {
    let all = PossibleValue::new(ALL).help("everything");
    let items = ITEMS.iter().map(|item| PossibleValue::new(item.id).help(item.title));
    PossibleValuesParser::new(std::iter::once(all).chain(items))
}

impl Paper {
    /// In the order of the papers, each once.
    fn asked(&self) -> impl Iterator<Item = &'static Item> {
        let is_asked = |id: &str| self.items.iter().any(|asked| asked == ALL || asked == id);
        ITEMS.iter().filter(move |item| is_asked(item.id))
    }
}

#[expect(clippy::disallowed_methods, reason = "progress tells how long this computer took")]
pub(crate) fn regenerate(asked: &Paper) -> Result<(), Failure> {
    let folder = asked.out.folder(|| Folder::ours("", "paper", ""))?;
    let (cache, mut done, begin) = (RunCache::default(), Vec::new(), Instant::now());
    for item in asked.asked() {
        let start = Instant::now();
        let outcome = item.regenerate(&cache)?;
        if done.is_empty() {
            // The report is about what is drawn now; pictures it does not name would be somebody else's.
            folder.clear_all(&[REPORT, VERDICTS], leaves)?;
        }
        write(&folder, &outcome)?;
        asked.quiet.progress(&format!("{}: {:.1} s", item.id, start.elapsed().as_secs_f64()));
        done.push((*item, outcome));
        // After each, so that the report is never about older numbers.
        folder.write_each(&[
            (REPORT.to_owned(), report(&done).as_bytes()),
            (VERDICTS.to_owned(), verdict_table(&done).csv().as_bytes()),
        ])?;
    }
    asked.quiet.progress(&format!("all: {:.1} s", begin.elapsed().as_secs_f64()));
    asked.quiet.report(|| done.iter().map(verdicts).collect::<String>() + &says(&folder))
}

/// Pictures and numbers of one item.
fn write(folder: &Folder, outcome: &Outcome) -> Result<(), Failure> {
    let mut files: Vec<(String, &[u8])> = Vec::new();
    for (name, picture) in &outcome.pictures {
        files.push((format!("{name}.png"), &picture.png));
        files.push((format!("{name}.svg"), picture.svg.as_bytes()));
    }
    let tables = outcome.tables.iter().filter(|table| !table.is_for_report());
    let tables: Vec<(String, String)> =
        tables.map(|table| (format!("{}.csv", table.name), table.csv())).collect();
    files.extend(tables.iter().map(|(name, csv)| (name.clone(), csv.as_bytes())));
    files.extend(outcome.pages.iter().map(|page| (page.name.clone(), page.text.as_bytes())));
    folder.write_each(&files)
}

fn says(folder: &Folder) -> String {
    format!("files  {}\n", folder.path().join(REPORT).display())
}

/// An item in one line, and a line for everything that differs.
fn verdicts((item, outcome): &(Item, Outcome)) -> String {
    let differ = outcome.rows.iter().filter(|row| row.verdict == Verdict::Differs);
    let count = |verdict| outcome.rows.iter().filter(|row| row.verdict == verdict).count();
    let (agree, against) = (count(Verdict::Agrees), count(Verdict::Differs));
    let first = format!("{}: {agree} of {} claims agree\n", item.id, agree + against);
    differ.fold(first, |text, row| {
        let (what, published, ours) = (&row.what, &row.published, &row.ours);
        text + &format!("  differs: {what}: published {published}, ours {ours}\n")
    })
}

impl Quiet {
    /// Says on stderr how far it is.
    fn progress(&self, words: &str) {
        if !self.is_quiet() {
            // Nobody is left to tell when stderr is gone.
            let _ = writeln!(std::io::stderr(), "{words}");
        }
    }
}
