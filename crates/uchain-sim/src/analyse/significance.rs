//! Whether two samples differ, and by how much. Tests are statrs's.

use statrs::{
    distribution::{Binomial, DiscreteCDF as _},
    stats_tests::{
        Alternative, NaNPolicy,
        mannwhitneyu::{MannWhitneyUMethod, mannwhitneyu},
        ttest_onesample::ttest_onesample,
    },
};

use crate::seed::{Seed, Source};

/// Resamples of a bootstrap.
const RESAMPLES: usize = 2000;
/// Values from which ranks may be taken as normally distributed.
const ENOUGH: usize = 8;

/// How two samples compare by their ranks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tendency {
    /// How likely such samples are if the first one is not the one with the smaller values (p of one side).
    pub p: f64,
    /// How often a value of the first sample is below one of the second one, ties counted half (0 to 1): the size of
    /// the effect, 0.5 for none.
    pub share: f64,
}

/// Mann–Whitney, with ties and the correction for continuity. `None` with fewer than eight values on a side.
///
/// ```
/// use uchain_sim::analyse::tends_to_be_less;
/// let (low, high) = ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], [9.0; 8]);
/// let less = tends_to_be_less(&low, &high).unwrap();
/// assert!(less.p < 0.001 && less.share == 1.0);
/// assert!(tends_to_be_less(&high, &low).unwrap().p > 0.999);
/// ```
pub fn tends_to_be_less(first: &[f64], second: &[f64]) -> Option<Tendency> {
    if first.len().min(second.len()) < ENOUGH {
        return None;
    }
    let method = MannWhitneyUMethod::AsymptoticInclContinuityCorrection;
    let (_, p) = mannwhitneyu(first, second, method, Alternative::Less).ok()?;
    let half_wins = |a: &f64| {
        let wins = |b: &f64| u32::from(a < b) * 2 + u32::from(a.total_cmp(b).is_eq());
        second.iter().map(wins).sum::<u32>()
    };
    let pairs = (first.len() * second.len()) as f64;
    let share = 0.5 * f64::from(first.iter().map(half_wins).sum::<u32>()) / pairs;
    // Two samples of one and the same value have no ranks.
    Some(Tendency { p: if p.is_nan() { 1.0 } else { p }, share })
}

/// Paired t test: how likely such pairs are if `small` is not less in the mean (p of one side). `None` of fewer than
/// two pairs.
pub fn is_less_in_pairs(small: &[f64], large: &[f64]) -> Option<f64> {
    let differences: Vec<f64> = small.iter().zip(large).map(|(a, b)| a - b).collect();
    if differences.iter().all(|difference| *difference == 0.0) {
        return (differences.len() > 1).then_some(1.0);
    }
    let (_, p) = ttest_onesample(differences, 0.0, Alternative::Less, NaNPolicy::Error).ok()?;
    (!p.is_nan()).then_some(p)
}

/// `McNemar`'s exact test: how likely such pairs of yes and no are if yes is not rarer in the first sample (p of one
/// side). `None` if the samples are not of one length, or empty.
pub fn is_rarer_in_pairs(first: &[bool], second: &[bool]) -> Option<f64> {
    if first.len() != second.len() || first.is_empty() {
        return None;
    }
    let count = |yes: bool| first.iter().zip(second).filter(|(a, b)| **a == yes && **b != yes).count() as u64;
    let (only_first, only_second) = (count(true), count(false));
    let pairs = Binomial::new(0.5, only_first + only_second).ok()?;
    Some(pairs.cdf(only_first))
}

/// What the first of two samples saves against the second one, pair by pair under common random numbers: one minus the
/// ratio of the means (%), and the ends of its 95 % interval, by bootstrap over the pairs.
///
/// ```
/// use uchain_sim::analyse::saved_percent;
/// let [saved, low, high] = saved_percent(&[9.0, 8.0, 9.0, 10.0], &[10.0, 10.0, 10.0, 10.0]);
/// assert!((saved - 10.0).abs() < 1e-9 && low < 10.0 && high > 10.0);
/// ```
pub fn saved_percent(first: &[f64], second: &[f64]) -> [f64; 3] {
    let pairs: Vec<(f64, f64)> = first.iter().copied().zip(second.iter().copied()).collect();
    bootstrap(pairs.len(), |drawn| {
        let drawn = drawn.iter().filter_map(|&i| pairs.get(i));
        let (a, b) = drawn.fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
        100.0 * (1.0 - a / b)
    })
}

/// What a statistic is of so many replicates, and the ends of its 95 % interval by bootstrap over them: it is told which
/// are drawn, of all of them with replacement. What belongs to one replicate stays together, so this is for statistics of
/// several samples under common random numbers.
///
/// ```
/// use uchain_sim::analyse::bootstrap;
/// let sample = [9.0, 8.0, 9.0, 10.0];
/// let mean = |drawn: &[usize]| drawn.iter().map(|&i| sample[i]).sum::<f64>() / drawn.len() as f64;
/// let [of_all, low, high] = bootstrap(sample.len(), mean);
/// assert!(of_all == 9.0 && low < 9.0 && high > 9.0);
/// ```
pub fn bootstrap(replicates: usize, mut statistic: impl FnMut(&[usize]) -> f64) -> [f64; 3] {
    let mut drawn: Vec<usize> = (0..replicates).collect();
    let of_all = statistic(&drawn);
    let mut stream = Seed(0).stream(0, Source::Choice);
    let mut resample = |_| {
        drawn.fill_with(|| stream.bits() as usize % replicates);
        statistic(&drawn)
    };
    let mut resamples: Vec<f64> = (0..RESAMPLES).map(&mut resample).collect();
    resamples.sort_by(f64::total_cmp);
    let at = |share: f64| {
        resamples.get((share * (RESAMPLES - 1) as f64).round() as usize).copied().unwrap_or(f64::NAN)
    };
    [of_all, at(0.025), at(0.975)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Student's sleep data: hours gained with two drugs by the same ten people; t = -4.0621, p = 0.001416.
    const SLEEP: [[f64; 10]; 2] = [
        [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0],
        [1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4],
    ];

    #[test]
    fn a_paired_t_test_gives_the_textbook_p_and_one_less_it_the_other_way_round() {
        let [a, b] = SLEEP;
        assert!((is_less_in_pairs(&a, &b).unwrap() - 0.001_416).abs() < 1e-6);
        assert!((is_less_in_pairs(&b, &a).unwrap() - 0.998_584).abs() < 1e-6);
        assert_eq!(is_less_in_pairs(&a, &a), Some(1.0));
        assert_eq!(is_less_in_pairs(&a[..1], &b[..1]), None);
        assert_eq!(is_less_in_pairs(&[1.0, f64::NAN, 2.0], &[2.0, 3.0, 4.0]), None);
    }

    /// By hand: ranks 1, 2.5, 4, … of 16 values with three ties.
    #[test]
    fn ranks_give_the_p_and_the_share_worked_out_by_hand() {
        let [a, b] = [[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], [2.0, 4.0, 6.0, 9.0, 10.0, 11.0, 12.0, 13.0]];
        let less = tends_to_be_less(&a, &b).unwrap();
        assert!((less.share - 0.789_062_5).abs() < 1e-12, "{}", less.share);
        assert!((less.p - 0.029_075_232_291).abs() < 1e-9, "{}", less.p);
        let more = tends_to_be_less(&b, &a).unwrap();
        assert!((more.share - (1.0 - 0.789_062_5)).abs() < 1e-12 && more.p > 0.95);
        assert_eq!(tends_to_be_less(&a[..7], &b), None);
        assert_eq!(tends_to_be_less(&[5.0; 9], &[5.0; 9]).map(|t| t.share), Some(0.5));
    }

    #[test]
    fn pairs_of_yes_and_no_give_the_tail_of_the_binomial() {
        // Nine pairs differ, in one of them it is the first that says yes: 10 of 512.
        let first = [true, false, false, false, false, false, false, false, false, true, false];
        let second = [false, true, true, true, true, true, true, true, true, true, false];
        assert!((is_rarer_in_pairs(&first, &second).unwrap() - 10.0 / 512.0).abs() < 1e-12);
        assert!((is_rarer_in_pairs(&second, &first).unwrap() - 511.0 / 512.0).abs() < 1e-12);
        assert_eq!(is_rarer_in_pairs(&first, &first), Some(1.0));
        assert_eq!(is_rarer_in_pairs(&first, &second[..4]), None);
    }

    #[test]
    fn nineteen_of_twenty_intervals_of_a_saving_hold_the_true_one() {
        let trials = 400;
        let holds = |trial: u64| {
            let mut stream = Seed(trial).stream(0, Source::Start);
            let mut sample =
                |mean: f64| -> Vec<f64> { (0..20).map(|_| mean + f64::from(stream.normal())).collect() };
            let (first, second) = (sample(9.0), sample(10.0));
            let [_, low, high] = saved_percent(&first, &second);
            (low..=high).contains(&10.0)
        };
        let share = (0..trials).filter(|trial| holds(*trial)).count() as f64 / trials as f64;
        assert!((0.90..=0.98).contains(&share), "{share}");
    }
}
