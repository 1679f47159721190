//! Readings that may be, and yet look like another unit, or like a sensor that is stuck.

use uchain_core::chain::Tof;

use super::super::{Settings, rows::Row};

/// Faster than this no indoor drone of a chain flies (m/s).
const FAST_MPS: f32 = 1.5;
/// Readings after which one that never changed is told.
const STUCK: usize = 50;

/// What was seen of the readings so far.
#[derive(Debug)]
pub(in crate::log) struct Readings {
    range_m: f32,
    /// The place that was asked for, until the log tells one.
    place_asked: Option<u16>,
    place_note: Option<(u64, u16, u16)>,
    /// The drone's own speed, and what both neighbours say of theirs.
    fast: [Option<Fast>; 3],
    beams: Beams,
    tof: Same<[u32; 4]>,
    /// Of both links.
    loss_db: [Same<u32>; 2],
}

/// Speeds that are too large.
#[derive(Debug)]
struct Fast {
    first_line: u64,
    rows: usize,
    most_mps: f32,
}

/// Distances by whether they are within range.
#[derive(Debug, Default)]
struct Beams {
    first_line: Option<u64>,
    least_m: Option<f32>,
    is_any_seen: bool,
}

/// A reading, as long as it is the same.
#[derive(Debug)]
struct Same<T> {
    first: Option<(u64, T)>,
    times: usize,
    has_changed: bool,
}

impl<T> Default for Same<T> {
    fn default() -> Self {
        Self { first: None, times: 0, has_changed: false }
    }
}

impl<T: Copy + PartialEq> Same<T> {
    fn see(&mut self, line: u64, value: T) {
        self.times += 1;
        let (_, first) = self.first.get_or_insert((line, value));
        self.has_changed |= *first != value;
    }

    /// Line and value, if it looks stuck.
    fn stuck(&self) -> Option<&(u64, T)> {
        self.first.as_ref().filter(|_| self.times >= STUCK && !self.has_changed)
    }
}

impl Readings {
    pub(in crate::log) fn new(settings: &Settings) -> Self {
        Self {
            range_m: settings.params.tof_range_m,
            place_asked: settings.is_place_asked.then_some(settings.place),
            place_note: None,
            fast: [const { None }; 3],
            beams: Beams::default(),
            tof: Same::default(),
            loss_db: [const { Same { first: None, times: 0, has_changed: false } }; 2],
        }
    }

    pub(in crate::log) fn see(&mut self, row: &Row) {
        if let Some(told) = row.place
            && let Some(asked) = self.place_asked.take()
            && told != asked
        {
            self.place_note = Some((row.line, told, asked));
        }
        let said = [row.back, row.front].map(|word| word.map(|word| word.packet.ground_speed_mps));
        for (fast, speed_mps) in self.fast.iter_mut().zip([row.ground_speed_mps, said[0], said[1]]) {
            let Some(speed_mps) = speed_mps.filter(|speed_mps| speed_mps.abs() > FAST_MPS) else { continue };
            let fast = fast.get_or_insert(Fast { first_line: row.line, rows: 0, most_mps: 0.0 });
            fast.rows += 1;
            fast.most_mps = if speed_mps.abs() > fast.most_mps.abs() { speed_mps } else { fast.most_mps };
        }
        if let Some(tof) = row.tof {
            self.see_tof(row.line, tof);
        }
        for (same, word) in self.loss_db.iter_mut().zip([row.back, row.front]) {
            if let Some(word) = word.filter(|word| word.loss_db.is_finite()) {
                same.see(row.line, word.loss_db.to_bits());
            }
        }
    }

    fn see_tof(&mut self, line: u64, tof: Tof) {
        let beams_m = [tof.nw_m, tof.ne_m, tof.sw_m, tof.se_m];
        self.tof.see(line, beams_m.map(f32::to_bits));
        for beam_m in beams_m.into_iter().filter(|beam_m| beam_m.is_finite()) {
            self.beams.first_line.get_or_insert(line);
            self.beams.least_m = Some(self.beams.least_m.map_or(beam_m, |least_m| least_m.min(beam_m)));
            self.beams.is_any_seen |= beam_m > 0.0 && beam_m < self.range_m;
        }
    }

    /// For people, a line each.
    pub(in crate::log) fn notes(&self, label: &str) -> Vec<String> {
        let place = self.place_note.map(|(line, told, asked)| {
            format!("{label}:{line}: place = {told}: what the log tells counts, and not the place {asked} that was asked for (--role, --place)")
        });
        let columns = ["ground_speed_mps", "back_ground_speed_mps", "front_ground_speed_mps"];
        let fast = self.fast.iter().zip(columns).filter_map(|(fast, column)| {
            let Fast { first_line, rows, most_mps } = fast.as_ref()?;
            let rows = if *rows == 1 { "1 row".to_owned() } else { format!("{rows} rows") };
            Some(format!(
                "{label}:{first_line}: {column}: {rows} beyond {FAST_MPS} m/s, {most_mps} at most: in cm/s? expected m/s"
            ))
        });
        let unseen = self.beams.first_line.zip(self.beams.least_m).filter(|_| !self.beams.is_any_seen);
        let range_m = self.range_m;
        let unseen = unseen.map(|(line, least_m)| {
            format!(
                "{label}:{line}: no distance of any row is within tof.range_m = {range_m}, the least is {least_m}: in cm? \
                 expected metres. It steers by no wall"
            )
        });
        let stuck = |line: u64, what: &str, times: usize| {
            format!("{label}:{line}: {what}, the same in all {times} of them: stuck?")
        };
        // Four beams that see nothing may well stay like that.
        let tof = self.tof.stuck().filter(|_| self.beams.is_any_seen);
        let tof = tof.map(|(line, _)| stuck(*line, "sets of four distances", self.tof.times));
        let links = self.loss_db.iter().zip(["back", "front"]).filter_map(|(same, end)| {
            let (line, bits) = same.stuck()?;
            let loss_db = f32::from_bits(*bits) + 0.0;
            Some(stuck(*line, &format!("packets of the {end} link with a loss of {loss_db} dB"), same.times))
        });
        place.into_iter().chain(fast).chain(unseen).chain(tof).chain(links).collect()
    }
}
