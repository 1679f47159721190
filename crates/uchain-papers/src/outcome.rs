//! Result of an item: published values beside ours, verdicts, notes, pictures and tables.

use uchain_sim::{
    analyse::{Estimate, Tendency},
    draw::{
        DrawError, Picture,
        figure::{Figure, figure},
    },
};

/// Whether what was published holds here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It does.
    Agrees,
    /// It does not.
    Differs,
    /// Nothing was published to hold it against, or ours is no evidence.
    Unjudged,
}

impl Verdict {
    /// Of a claim that holds or does not.
    pub fn of(holds: bool) -> Self {
        if holds { Self::Agrees } else { Self::Differs }
    }

    /// In one word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Agrees => "yes",
            Self::Differs => "**no**",
            Self::Unjudged => "–",
        }
    }
}

/// One published value or claim beside ours.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// What it is about.
    pub what: String,
    /// As published.
    pub published: String,
    /// As found here: mean and 95 % interval, or a test's p.
    pub ours: String,
    /// Whether the two agree.
    pub verdict: Verdict,
}

impl Row {
    /// A claim that was published.
    pub fn claim(what: &str, published: &str, ours: String, holds: bool) -> Self {
        Self::new(what, published, ours, Verdict::of(holds))
    }

    /// Published, but no evidence either way.
    pub fn unjudged(what: &str, published: &str, ours: String) -> Self {
        Self::new(what, published, ours, Verdict::Unjudged)
    }

    /// A number that was not published.
    pub fn fact(what: &str, ours: String) -> Self {
        Self::new(what, "–", ours, Verdict::Unjudged)
    }

    fn new(what: &str, published: &str, ours: String, verdict: Verdict) -> Self {
        Self { what: what.to_owned(), published: published.to_owned(), ours, verdict }
    }
}

/// Numbers: a table of the report, or one for programs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// What its file is called, without the ending; nothing for one of the report.
    pub name: String,
    /// Names of the columns.
    pub header: Vec<String>,
    /// As many cells a row as there are columns.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table for programs, saved as a CSV file of this name, without rows.
    pub fn new(name: &str, header: &[&str]) -> Self {
        let header = header.iter().map(|column| (*column).to_owned()).collect();
        Self { name: name.to_owned(), header, rows: Vec::new() }
    }

    /// A table of the report, without rows.
    pub fn for_report(header: &[&str]) -> Self {
        Self::new("", header)
    }

    /// Whether it is one of the report.
    pub fn is_for_report(&self) -> bool {
        self.name.is_empty()
    }

    /// In Markdown.
    pub(crate) fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
        let rule = format!("|{}\n", "---|".repeat(self.header.len()));
        line(&self.header) + &rule + &self.rows.iter().map(line).collect::<String>()
    }

    /// As CSV.
    pub fn csv(&self) -> String {
        let line = |cells: &Vec<String>| {
            let quoted = cells.iter().map(|cell| {
                if cell.contains([',', '"', '\n']) {
                    format!("\"{}\"", cell.replace('"', "\"\""))
                } else {
                    cell.clone()
                }
            });
            quoted.collect::<Vec<_>>().join(",") + "\n"
        };
        std::iter::once(&self.header).chain(&self.rows).map(line).collect()
    }
}

/// Result of an item.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outcome {
    /// What was flown, in a sentence or two.
    pub setup: String,
    /// Published values beside ours.
    pub rows: Vec<Row>,
    /// Where it differs and why; what was assumed.
    pub notes: Vec<String>,
    /// Pictures, each with its name without the ending.
    pub pictures: Vec<(String, Picture)>,
    /// Numbers.
    pub tables: Vec<Table>,
    /// Pages of their own, beside the report.
    pub pages: Vec<Page>,
}

/// A page in Markdown of an item's own. Its first paragraph says in two sentences what came out, for whoever reads nothing
/// else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// What its file is called, with the ending.
    pub name: String,
    /// All of it.
    pub text: String,
}

impl Page {
    /// Its first paragraph, what comes below the heading.
    ///
    /// ```
    /// # use uchain_papers::Page;
    /// let page = Page { name: "a.md".into(), text: "# A\n\nIt is so. It is not so.\n\n## B\n".into() };
    /// assert_eq!(page.gist(), "It is so. It is not so.");
    /// ```
    pub fn gist(&self) -> &str {
        self.text.split("\n\n").find(|paragraph| !paragraph.starts_with('#')).unwrap_or_default()
    }
}

impl Outcome {
    /// Draws a figure, and keeps its points.
    pub(crate) fn draw(&mut self, name: &str, drawn: &Figure) -> Result<(), DrawError> {
        self.pictures.push((name.to_owned(), figure(drawn)?));
        let mut table = Table::new(&format!("{name}-points"), &["panel", "series", "x", "y", "low", "high"]);
        table.rows = drawn.points().into_iter().map(Vec::from).collect();
        self.tables.push(table);
        Ok(())
    }
}

/// Mean and 95 % confidence interval as text, with so many digits after the point, of what is never below 0: counts, times,
/// lengths, shares.
pub(crate) fn mean_with_interval(sample: &[f64], digits: usize, unit: &str) -> String {
    in_words(sample, Estimate::of_never_negative(sample), digits, unit)
}

/// The same of differences, which may be below 0.
pub(crate) fn difference_with_interval(sample: &[f64], digits: usize, unit: &str) -> String {
    in_words(sample, Estimate::of(sample), digits, unit)
}

fn in_words(sample: &[f64], estimate: Option<Estimate>, digits: usize, unit: &str) -> String {
    let Some(estimate) = estimate else { return "none".to_owned() };
    let (low, high) = estimate.interval();
    let mean = estimate.mean;
    // Of a few values the interval says little, and may leave the possible.
    if sample.len() < 8 || low == high {
        return format!("{mean:.digits$}{unit}");
    }
    format!("{mean:.digits$}{unit} ({low:.digits$} … {high:.digits$})")
}

/// The p value of a test as text.
pub(crate) fn p_value(p: Option<f64>) -> String {
    match p {
        None => "p not known".to_owned(),
        Some(p) if p < 0.001 => "p < 0.001".to_owned(),
        Some(p) => format!("p = {p:.3}"),
    }
}

/// Result of a Mann–Whitney U test as text: p and the effect size A (probability of superiority).
pub(crate) fn mann_whitney(of: Option<Tendency>) -> String {
    match of {
        None => "too few for Mann–Whitney".to_owned(),
        Some(Tendency { p, share }) => format!("Mann–Whitney {}, A = {share:.2}", p_value(Some(p))),
    }
}

/// Whether a test is significant at the level of 5 %.
pub(crate) fn is_significant(p: Option<f64>) -> bool {
    p.is_some_and(|p| p < 0.05)
}

/// A table's cell: a number, or nothing.
pub(crate) fn cell(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(String::new, |value| format!("{value:.digits$}"))
}
