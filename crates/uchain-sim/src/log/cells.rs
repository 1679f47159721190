//! The cells of a row: each is a number of its column, or what was expected there is said.

use uchain_core::chain::{Follow, Packet, Tof};

use super::{
    columns::{Column, End, Of},
    rows::{Row, Word},
};

/// Cells of a row that make something together.
#[derive(Default)]
pub(super) struct Cells {
    pub(super) has_time: bool,
    tof_m: [Option<f32>; 4],
    loss_db: [Option<f32>; 2],
    speed_mps: [Option<f32>; 2],
    is_base: Option<bool>,
    flown_s: Option<f32>,
    follow: Follow,
    imbalance_db: f32,
}

impl Cells {
    /// Takes a cell in; `false` if it is no number and nobody minds. Or what was expected.
    pub(super) fn take(&mut self, row: &mut Row, column: &Column, cell: &str) -> Result<bool, String> {
        match column.of {
            Of::Time => {
                row.time_s = cell
                    .parse()
                    .ok()
                    .filter(|time_s: &f64| time_s.is_finite())
                    .ok_or("expected a number of seconds")?;
                self.has_time = true;
            }
            Of::Place => row.place = Some(place(cell)?),
            Of::PilotFollow => row.pilot_follow = Some(follow(cell)?),
            Of::FrontFollow => self.follow = follow(cell)?,
            Of::BackIsBase => self.is_base = Some(truth(cell)?),
            _ => {
                let value = number(column, cell)?;
                // No distance is a beam that sees nothing; no other number is no measurement, as an empty cell is.
                if value.is_finite() || matches!(column.of, Of::Tof(_)) {
                    self.take_number(row, column.of, value);
                }
                return Ok(value.is_finite());
            }
        }
        Ok(true)
    }

    fn take_number(&mut self, row: &mut Row, of: Of, value: f32) {
        let end = |end: End| usize::from(end == End::Front);
        match of {
            Of::Tof(beam) => self.tof_m[beam] = Some(value),
            Of::GroundSpeed => row.ground_speed_mps = Some(value),
            Of::Battery => row.battery = Some(value),
            Of::PilotSpeed => row.pilot_mps = Some(value),
            Of::Rssi(of) => self.loss_db[end(of)] = Some(-value),
            Of::Loss(of) => self.loss_db[end(of)] = Some(value),
            Of::Speed(of) => self.speed_mps[end(of)] = Some(value),
            Of::FrontFlown => self.flown_s = Some(value),
            Of::FrontImbalance => self.imbalance_db = value,
            Of::Asked(which) => row.asked[which] = Some(value),
            Of::Time | Of::Place | Of::PilotFollow | Of::FrontFollow | Of::BackIsBase => {}
        }
    }

    /// What the cells come to.
    pub(super) fn end(self, row: &mut Row) {
        if self.tof_m.iter().any(Option::is_some) {
            // A beam without a number sees nothing.
            let [nw_m, ne_m, sw_m, se_m] = self.tof_m.map(|beam_m| beam_m.unwrap_or(f32::NAN));
            row.tof = Some(Tof { nw_m, ne_m, sw_m, se_m });
        }
        let [back_db, front_db] = self.loss_db;
        let [back_mps, front_mps] = self.speed_mps;
        let is_base = self.is_base.unwrap_or(back_mps.is_none());
        let base = Packet { is_base, ground_speed_mps: back_mps.unwrap_or(0.0), ..Packet::BASE };
        row.back = back_db.map(|loss_db| Word { loss_db, packet: base, is_of_age: false });
        let ahead = Packet {
            ground_speed_mps: front_mps.unwrap_or(0.0),
            flown_s: self.flown_s.unwrap_or(0.0),
            follow: self.follow,
            imbalance_db: self.imbalance_db,
            ..Packet::default()
        };
        let is_of_age = self.flown_s.is_none();
        row.front = front_db.map(|loss_db| Word { loss_db, packet: ahead, is_of_age });
    }
}

fn number(column: &Column, cell: &str) -> Result<f32, String> {
    let value: f32 =
        cell.parse().map_err(|_| "expected a number, or an empty cell where there was nothing".to_owned())?;
    match column.sound {
        // What is no number has neither a unit nor a sign that could be wrong.
        Some((low, high, hint)) if value.is_finite() && !(low..=high).contains(&f64::from(value)) => {
            // Each hint is about one mistake, which no number on the other side comes of.
            let is_meant = match column.of {
                Of::Rssi(_) | Of::Tof(_) | Of::Battery => f64::from(value) > high,
                Of::Loss(_) => f64::from(value) < low,
                _ => true,
            };
            Err(if is_meant { hint.to_owned() } else { format!("expected {low} to {high}") })
        }
        _ => Ok(value),
    }
}

fn place(cell: &str) -> Result<u16, String> {
    // Tables with gaps write whole numbers as 1.0.
    let place =
        cell.parse().ok().filter(|place: &f64| place.fract() == 0.0 && (0.0..=65_533.0).contains(place));
    place.map(|place| place as u16).ok_or_else(|| "expected a whole number: 0, the head, to 65533".to_owned())
}

fn follow(cell: &str) -> Result<Follow, String> {
    Follow::of_word(cell).ok_or_else(|| "expected centre, left or right".to_owned())
}

fn truth(cell: &str) -> Result<bool, String> {
    match cell {
        "1" | "1.0" | "true" | "True" => Ok(true),
        "0" | "0.0" | "false" | "False" => Ok(false),
        _ => Err("expected 1 or 0".to_owned()),
    }
}
