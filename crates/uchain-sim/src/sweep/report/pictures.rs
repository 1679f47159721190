//! Charts of a sweep, what is drawn over what: the first key with numbers stands on the axis, every combination of the
//! others is a line.

use uchain_core::bounded;

use super::{Metric, ReportError, Rows, values, words};
use crate::{
    analyse::Estimate,
    draw::{
        Picture,
        sweep::{Chart, LINES_MAX, Line, chart as drawn},
    },
    sweep::Sweep,
};

/// The picture of one number: its mean over what is varied, or how it is distributed if nothing is. `None` if there is
/// nothing in it to see.
///
/// # Errors
/// Rows cannot be read, or the picture cannot be drawn.
pub fn picture(rows: &dyn Rows, sweep: &Sweep, metric: &Metric) -> Result<Option<Picture>, ReportError> {
    if metric.constant.is_some() {
        return Ok(None);
    }
    let chart = if sweep.variants() == 1 {
        Some(distribution(sweep, &metric.name, values(rows, sweep, &metric.name)?))
    } else {
        chart(sweep, metric)
    };
    Ok(chart.map(|chart| drawn(&chart)).transpose()?)
}

/// A picture of one number; `None` if there is nothing in it to see.
fn chart(sweep: &Sweep, metric: &Metric) -> Option<Chart> {
    let keys: Vec<&str> = sweep.design().keys().collect();
    let place = axis(sweep, metric.cells.len());
    let mut lines: Vec<Line> = Vec::new();
    let mut is_cut = false;
    for (variant, estimate) in metric.cells.iter().enumerate() {
        let Some(estimate) = estimate else { continue };
        let values = sweep.design().values(variant as u64);
        let number = |place: usize| values.get(place)?.as_ref()?.parse::<f64>().ok();
        let x = match place {
            Some(place) => number(place)?,
            None => variant as f64,
        };
        let name = match place {
            Some(place) => {
                let others = values.iter().enumerate().filter(|(key, _)| *key != place);
                let others: Vec<String> = others
                    .filter_map(|(_, value)| Some(value.as_deref()?.trim_matches('"').to_owned()))
                    .collect();
                // One value alone does not say what it is of.
                match (&others[..], keys.iter().enumerate().find(|(key, _)| *key != place)) {
                    ([value], Some((_, key))) => {
                        format!("{} {value}", key.rsplit('.').next().unwrap_or_default())
                    }
                    _ => others.join(", "),
                }
            }
            None => String::new(),
        };
        if let Some(line) = lines.iter_mut().find(|line| line.name == name) {
            line.points.push((x, *estimate));
        } else if lines.len() < LINES_MAX {
            lines.push(Line { name, points: vec![(x, *estimate)] });
        } else {
            is_cut = true;
        }
    }
    for line in &mut lines {
        line.points.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    }
    let about = &sweep.about().name;
    let cut = if is_cut { format!(", the first {LINES_MAX} combinations") } else { String::new() };
    let others: Vec<&str> =
        keys.iter().enumerate().filter(|(key, _)| Some(*key) != place).map(|(_, key)| *key).collect();
    let colours = if lines.len() > 1 { format!("; lines: {}", others.join(", ")) } else { String::new() };
    let title = format!("{about}: {}{cut}{colours}", metric.name);
    let key = place.and_then(|place| keys.get(place));
    let key = key.map_or_else(|| "variant".to_owned(), |key| words::key_in_words(sweep.registry(), key));
    (!lines.is_empty()).then(|| Chart { title, metric: words::of_metric(&metric.name), key, lines })
}

/// How the runs of a single variant are distributed.
fn distribution(sweep: &Sweep, name: &str, mut values: Vec<f64>) -> Chart {
    const STEPS: usize = 100;
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    let steps = bounded(last, 1, STEPS);
    let point = |step: usize| {
        let place = step * last / steps;
        let share = (place + 1) as f64 / values.len() as f64;
        let estimate =
            Estimate { count: 1, mean: share, half_width: None, is_never_negative: true, median: share };
        values.get(place).map(|value| (*value, estimate))
    };
    let points: Vec<(f64, Estimate)> = (0..=steps).filter_map(point).collect();
    let title = format!("{}: {name} of {} runs", sweep.about().name, values.len());
    Chart {
        title,
        metric: "share of runs up to there (0 to 1)".to_owned(),
        key: words::of_metric(name),
        lines: vec![Line { name: String::new(), points }],
    }
}

/// The first key that has a number in every variant, and more than one.
fn axis(sweep: &Sweep, variants: usize) -> Option<usize> {
    (0..sweep.design().keys().count()).find(|place| {
        let numbers: Option<Vec<f64>> = (0..variants)
            .map(|variant| sweep.design().values(variant as u64).get(*place)?.as_ref()?.parse().ok())
            .collect();
        numbers.is_some_and(|numbers| numbers.windows(2).any(|pair| pair[0] != pair[1]))
    })
}
