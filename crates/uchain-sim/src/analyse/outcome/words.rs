//! Outcomes in words.

use std::fmt::{Display, Formatter, Result};

use super::{Break, Outcome, Over, Remedy, Way};

/// Shares of unseen ground that are worth a word (1).
const TOLD: f64 = 0.001;

impl Display for Outcome {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Unseen { .. }
            | Self::Unreachable { .. }
            | Self::Full { .. }
            | Self::Stuck { .. }
            | Self::TimeUp { .. }
            | Self::Explored { .. } => self.exploration(f),
            Self::Interrupted { at_s, of_s: Some(of_s) } => {
                write!(f, "ended early, after {at_s:.2} s of {of_s} s")
            }
            Self::Interrupted { at_s, of_s: None } => write!(f, "ended early, after {at_s:.2} s"),
            Self::Own { words, .. } => f.write_str(words),
            Self::NeverFlew => f.write_str("the head never took off"),
            Self::HeadFailed { at_s } => write!(f, "the head failed at {at_s:.2} s"),
            Self::ChainBroken { broken, links, uav, cause } => {
                let of = counted(*links, "link");
                write!(f, "the chain was broken at the end, in {broken} of {of}: {}", cause.words(*uav))
            }
            Self::HeadStuck { way, from_s, stuck_s, at_m: [x_m, y_m] } => write!(
                f,
                "the head was stuck for {stuck_s:.1} s, last from {from_s:.1} s on at ({x_m:.2}, {y_m:.2}) m: it was let \
                 fly and stayed where it was; {way}"
            ),
            Self::NotLaunched { waiting, used, over } => match used {
                0 => write!(f, "none of {} took off, and {over}", counted(*waiting, "relay")),
                _ => write!(f, "{} waited on the ground, and {over}", counted(*waiting, "relay")),
            },
            Self::RelaysShort { short: Some(short), used, over } => {
                let more = counted(*short, "relay");
                write!(f, "{more} short: {used} in the air, {} needed, and {over}", used + short)
            }
            Self::RelaysShort { short: None, used, over } => {
                let all = match used {
                    0 => "there was no relay".to_owned(),
                    1 => "the only relay was in the air".to_owned(),
                    _ => format!("all {used} relays were in the air"),
                };
                write!(f, "relays short: {all}, and {over}")
            }
            Self::HeadHeld { way, held_m, held_s } => write!(
                f,
                "the head was held back by its link: {way}; {held_m:.1} m were withheld in {held_s:.1} s"
            ),
            Self::HeadShort { way, slowed_m } => {
                write!(
                    f,
                    "the head did not get as far as asked: {way}; slowing down near walls cost {slowed_m:.1} m"
                )
            }
            Self::LinksOver(over) => write!(f, "the chain was not level: {over}"),
            Self::Completed { way, links, worst_db, s_min_db } => {
                if let Some(way) = way {
                    write!(f, "{way}; ")?;
                }
                match worst_db {
                    Some(worst_db) => write!(
                        f,
                        "{} within {s_min_db} dB, the worst {worst_db:.1} dB",
                        counted(*links, "link")
                    ),
                    None => f.write_str("no link yet"),
                }
            }
        }
    }
}

impl Break {
    /// What is wrong with the link of a UAV toward the base.
    fn words(self, uav: usize) -> String {
        let name = if uav == 0 { "the head".to_owned() } else { format!("UAV {uav}") };
        match self {
            Self::Loss { loss_db, limit_db } => format!(
                "the link of {name} toward the base loses {loss_db:.1} dB, and reception ends at {limit_db} dB"
            ),
            Self::Silent { is_front: true, silent_s: None } => format!("{name} never heard anybody"),
            Self::Silent { is_front: true, silent_s: Some(silent_s) } => {
                format!("{name} had not heard its neighbour toward the base for {silent_s:.1} s")
            }
            Self::Silent { is_front: false, silent_s: None } => format!("nobody ever heard {name}"),
            Self::Silent { is_front: false, silent_s: Some(silent_s) } => {
                format!("nobody had heard {name} for {silent_s:.1} s")
            }
        }
    }
}

impl Outcome {
    fn exploration(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Unseen { .. } => unseen(f, self),
            Self::Unreachable { seen, hubs } => write!(
                f,
                "{} seen, all home, and {} with a frontier left that nobody finds a way to",
                percent(*seen),
                counted(*hubs as usize, "node")
            ),
            Self::Full { seen, hubs } => write!(
                f,
                "{} seen, all home, {} with a frontier left and no room for more nodes (explore.nodes_max)",
                percent(*seen),
                counted(*hubs as usize, "node")
            ),
            Self::Stuck { seen, at_s } => {
                write!(
                    f,
                    "{} seen when nobody moved any more, at {at_s:.1} s, and not all were home",
                    percent(*seen)
                )
            }
            Self::TimeUp { seen, after_s } => {
                write!(f, "{} seen when the time was up, after {after_s} s (duration_s)", percent(*seen))
            }
            Self::Explored { seen } => write!(f, "{} seen, no frontier left, all home", percent(*seen)),
            _ => Ok(()),
        }
    }
}

/// Shares, where, and what to set.
fn unseen(f: &mut Formatter<'_>, outcome: &Outcome) -> Result {
    let Outcome::Unseen { seen, behind, narrow_m, piece_m: [x_m, y_m], piece_m2, remedy } = outcome else {
        return Ok(());
    };

    write!(f, "{} seen", percent(*seen))?;
    let elsewhere = (1.0 - seen - behind).max(0.0);
    if *behind >= TOLD {
        write!(f, ", {} behind passages narrower than {narrow_m:.2} m", percent(*behind))?;
    }
    if elsewhere >= TOLD {
        write!(f, ", {} unseen elsewhere", percent(elsewhere))?;
    }
    write!(f, ", the largest piece {piece_m2:.1} m2 around ({x_m:.2}, {y_m:.2}) m")?;
    remedy.iter().try_for_each(|remedy| write!(f, ": {remedy}"))
}

impl Display for Remedy {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.width_m {
            Some(width_m) => write!(f, "{} looks through {width_m:.2} m", self.sets),
            None => write!(f, "{} sees more", self.sets),
        }
    }
}

impl Display for Way {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Self { asked_m, flown_m, is_end } = self;
        write!(f, "{flown_m:.1} of {asked_m:.1} m flown")?;
        f.write_str(if *is_end { ", up to the tunnel's end" } else { "" })
    }
}

impl Display for Over {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Self { over, links, worst_db, s_min_db } = self;
        write!(f, "{over} of {} over {s_min_db} dB, the worst {worst_db:.1} dB", counted(*links, "link"))
    }
}

/// `1 link`, `3 links`.
fn counted(count: usize, one: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
}

/// A share in per cent, rounded down: what is not all does not read 100 %.
fn percent(share: f64) -> String {
    let tenths = (1000.0 * share + 1e-6).floor();
    if tenths >= 1000.0 { "100 %".to_owned() } else { format!("{:.1} %", tenths / 10.0) }
}
