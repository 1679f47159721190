//! The reproduction report in Markdown: `REPORT.md`, and `docs/reproduction.md`.

use std::fmt::Write as _;

use super::{ITEMS, Item, Outcome, SEED, Table, Verdict};

const INTRODUCTION: &str = "\
# The papers, regenerated

Published values beside ours. Every run is a function of scenario and seed: the same command gives the same report, and
a test fails when the code no longer gives this one. Where it says **no**, that is a result.

How it is judged: numbers in parentheses are the 95 % interval of the mean (Student's t, from eight values on; cut at 0
where nothing is below, as of counts and times) or of a saving (bootstrap over pairs). p is of one side unless it says
otherwise: Mann–Whitney for times and spreads, with A, how often a value of the group said to be smaller is below one of
the other (0.5: no difference); McNemar's exact test for launches under the same noise; a t test in pairs. *Agrees*
means, of an order: p < 0.05; of anything else: what the item says. A dash: nothing published, or ours is no evidence.

What was set after a first look at results, each for a reason of its own: with the authors' settings UAVs slow only nearer
to walls than the middle of their corridor (fig4d says how far the head comes with and without), UAVs that start in a corner
look across it (fig4abc has both), the pilot of fig6 stops where three links reach (all links are published as below the
limit), the windows of fig4f (drift and late launches hid the noise), the margin of *about as fast* (fig4e), and the rule
for ranges (fig10, fig11). Nothing else was tuned, and nothing to a verdict.

Sources: Laclau 2021 (U-Chain, Frontiers in Robotics and AI 8:614206) and Kim 2021 (CSSG, Journal of Intelligent &
Robotic Systems).

";

const ENDING: &str = "\
## Misprints and gaps in the papers

| place | printed | taken here |
|---|---|---|
| Laclau 2021, Eq. 22 | log of a distance, without reference | L0 = 35 dB at d0 = 0.25 m, base 10 (the authors' simulator); without it no relay would launch within the published 10 m |
| Laclau 2021, §6.1.2 | noise of variance 3 | standard deviation 3 dB (the authors' simulator) |
| Laclau 2021, Algorithm 1 | the sum of two velocities | their difference: the speed at which the ends of a link separate |
| Laclau 2021, §6.1.1 | packets arrive only if s > s_min | below 100 dB of loss; as printed, no sample above 60 dB would be heard and nobody would launch |
| Laclau 2021, §6.1.2 | 20 % of packets lost | none in the published runs (the authors' simulator); 20 % is this project's default |
| Laclau 2021, Fig. 4F | variance of positions | their standard deviation (the authors' simulator) |
| Laclau 2021, §4.1 | Eq. 12, speed at most 0.3 m/s | the published figures: a third of a distance read from a path-loss model, at most 0.375 m/s (preset `frontiers2021`) |
| Laclau 2021, §5 | no word of slower flight near walls | a UAV slows near walls; with the authors' settings only nearer than the middle of their corridor: else their head would not come 10 m far |
| Laclau 2021, §6.1.3 | no map of the corridors, no start headings | redrawn: 0.78 m wide, one sharp corner, one bend of 1 m, the circuit; a UAV that starts in a corner looks across it |
| Laclau 2021, §6.1.3 | 0.2 m/s for 50 s | 0.235 m/s for 40 s, as in the authors' runs, and as printed where a reading is called so |
| Laclau 2021, §4.3 | nothing of how long a take-off takes | no time, and no wait for the UAV ahead (the authors' simulator); the firmware waits for 3 s |
| Laclau 2021, Eq. 22 | nothing of the way through the tunnel | 40 dB per metre by which two odometers differ from the straight line (the authors' simulator) |
| Laclau 2021, §6.2 | RSSI of 60 dB launches | 50 dB in the air, and 10 dB more for an antenna on the ground (the authors' firmware) |
| Laclau 2021, §6.2 | nothing of how the pilot drove | 0.2 m/s until three links of this radio reach no farther, then hover (fig6) |
| Kim 2021, Eq. 8 | edges only where both labels are free | edges wherever two nodes see each other: as printed, robots' graphs stay disconnected |
| Kim 2021, Fig. 8 and 12 | no sizes | maps of our own: nine rooms of 10 m x 10 m, a net of corridors as large, and 2 m x 2 m for the experiment |
| Kim 2021, Eq. 7 | weights c_i without values | 1 |
| Kim 2021, §6.2 | robots that meet at a node are given different targets | by Eq. 7 alone they are not; `explore.taken = \"left\"` is our rule for it, for every strategy (cooperation) |
| Kim 2021, §4.1 | left and right points of an arc where there is a wide gap, which is defined nowhere | mid-points alone; `explore.arc_ends` with a gap of half of R_s beside it (cooperation) |
| Kim 2021, §7.2 | SRG: what holds, and for how long | of two moving robots in conflict the higher number holds one round; parked or holding ones are passed |

Assumed throughout: Laclau 2021: a plane, packets that take no time, ToF sensors and optic flow with the noise of this
project's defaults. Kim 2021: poses known, the graph shared by all at once, scans in all directions that take no time,
no downwash.

";

/// Every row of these items as a table for programs.
pub fn verdict_table(items: &[(Item, Outcome)]) -> Table {
    let mut table = Table::new("verdicts", &["item", "what", "published", "ours", "agrees"]);
    for (item, outcome) in items {
        table.rows.extend(outcome.rows.iter().map(|row| {
            let agrees = match row.verdict {
                Verdict::Agrees => "yes",
                Verdict::Differs => "no",
                Verdict::Unjudged => "",
            };
            [item.id, &row.what, &row.published, &row.ours, agrees].map(str::to_owned).to_vec()
        }));
    }
    table
}

/// The report of these items, in Markdown.
pub fn report(items: &[(Item, Outcome)]) -> String {
    let mut text = INTRODUCTION.to_owned();
    let ids: Vec<&str> = items.iter().map(|(item, _)| item.id).collect();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "uchain {}, root seed {SEED}: `uchain paper {} --out DIR`\n",
        env!("CARGO_PKG_VERSION"),
        if ids.len() == ITEMS.len() { "all".to_owned() } else { ids.join(" ") }
    );
    text += "| item | claims | agree | differ |\n|---|--:|--:|--:|\n";
    for (item, outcome) in items {
        let count = |verdict| outcome.rows.iter().filter(|row| row.verdict == verdict).count();
        let (agree, differ) = (count(Verdict::Agrees), count(Verdict::Differs));
        let _ = writeln!(text, "| {} | {} | {agree} | {differ} |", item.id, agree + differ);
    }
    for (item, outcome) in items {
        let _ = write!(text, "\n## {}: {}\n\n{}\n", item.id, item.title, outcome.setup);
        if !outcome.rows.is_empty() {
            text += "\n| what | published | ours | agrees? |\n|---|---|---|---|\n";
        }
        for row in &outcome.rows {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} |",
                row.what,
                row.published,
                row.ours,
                row.verdict.word()
            );
        }
        for table in outcome.tables.iter().filter(|table| table.is_for_report()) {
            let _ = write!(text, "\n{}", table.markdown());
        }
        if !outcome.notes.is_empty() {
            text += "\n";
        }
        for note in &outcome.notes {
            let _ = writeln!(text, "- {note}");
        }
        let files: Vec<String> = outcome.pictures.iter().map(|(name, _)| format!("`{name}.png`")).collect();
        if !files.is_empty() {
            let _ = writeln!(text, "\nPictures (also as SVG): {}.", files.join(", "));
        }
        for page in &outcome.pages {
            let _ = writeln!(text, "\nA page of its own: [{0}]({0}).", page.name);
        }
    }
    text + "\n" + ENDING.trim_end() + "\n"
}
