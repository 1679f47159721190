//! What a mission came to: one word that a machine can rely on, and words with numbers for people.

mod words;

use serde::{Serialize, Serializer, ser::SerializeStruct as _};

/// What a mission came to: a finding with its numbers. The graver ones stand first, and a cause
/// before what follows from it.
///
/// [`Outcome::Completed`] and [`Outcome::Explored`] are the two that are as they should be, and [`Outcome::Own`] if it
/// says so; every other one is a failure. [`Outcome::word`] is stable: the file `summary.json`, the table of a sweep and scripts know it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// The flight is known up to somewhere in the middle only.
    Interrupted {
        /// Until when it is known (s).
        at_s: f64,
        /// How long it was to last (s); `None` where nobody knows beforehand.
        of_s: Option<f64>,
    },
    /// Chain: the head never took off.
    NeverFlew,
    /// Chain: the head failed in the air.
    HeadFailed {
        /// When (s).
        at_s: f64,
    },
    /// Chain: at the end, links were beyond reception, or nothing was heard over them.
    ChainBroken {
        /// Links that were broken.
        broken: usize,
        /// Links of the chain.
        links: usize,
        /// The UAV at the front end of the first of them, 0 = head.
        uav: usize,
        /// What was wrong with that one.
        cause: Break,
    },
    /// Chain: the head was let fly and stayed where it was.
    HeadStuck {
        /// What the pilot asked of it, and what came.
        way: Way,
        /// When it last began (s).
        from_s: f64,
        /// For how long it stayed, all in all (s).
        stuck_s: f64,
        /// Where, in the frame of the map's file or scenario (m).
        at_m: [f64; 2],
    },
    /// Chain: links were over `takeoff.s_min_db` at the end, and relays still waited on the ground.
    NotLaunched {
        /// Relays that waited.
        waiting: usize,
        /// Relays in the air.
        used: usize,
        /// The links.
        over: Over,
    },
    /// Chain: links were over `takeoff.s_min_db` at the end, with all relays in the air.
    RelaysShort {
        /// How many more the best chain would need; `None` where no number would do or nobody knows.
        short: Option<usize>,
        /// Relays in the air.
        used: usize,
        /// The links.
        over: Over,
    },
    /// Chain: the head is not where its pilot asked it to be, for its link was too bad to go on.
    HeadHeld {
        /// What the pilot asked of it, and what came.
        way: Way,
        /// How much of it was withheld (m).
        held_m: f64,
        /// For how long (s).
        held_s: f64,
    },
    /// Chain: the head is not where its pilot asked it to be, and neither its link nor a wall held it for long.
    HeadShort {
        /// What the pilot asked of it, and what came.
        way: Way,
        /// How much it lost by flying slowly near walls (m).
        slowed_m: f64,
    },
    /// Chain: links were over `takeoff.s_min_db` at the end, though relays enough were in the air: it was not level.
    LinksOver(Over),
    /// Exploration: no frontier is left, and yet ground was not seen.
    Unseen {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
        /// Share of it that lies unseen in or behind passages that are narrower than stars surely look through (1).
        behind: f64,
        /// Narrower than this (m).
        narrow_m: f64,
        /// The middle of the largest piece that was not seen, in the frame of the map's file or scenario (m).
        piece_m: [f64; 2],
        /// Its area (m²).
        piece_m2: f64,
        /// What to change so that it is seen.
        remedy: Option<Remedy>,
    },
    /// Exploration: frontiers are left that nobody knows of or finds a way to.
    Unreachable {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
        /// Nodes with a frontier left.
        hubs: u32,
    },
    /// Exploration: there was no room for more nodes (`explore.nodes_max`).
    Full {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
        /// Nodes with a frontier left.
        hubs: u32,
    },
    /// Exploration: nobody moved any more, and not all were home.
    Stuck {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
        /// When (s).
        at_s: f64,
    },
    /// Exploration: the longest time was up (`duration_s`) before all were home.
    TimeUp {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
        /// The longest time (s).
        after_s: f64,
    },
    /// Chain: the head is where its pilot asked it to be, every link was heard, and every one was within
    /// The largest loss it may have, `takeoff.s_min_db` (dB).
    Completed {
        /// What the pilot asked of the head, and what came; `None` where a recording does not say.
        way: Option<Way>,
        /// Links of the chain.
        links: usize,
        /// The worst of them (dB); `None` without one.
        worst_db: Option<f32>,
        /// `takeoff.s_min_db`.
        s_min_db: f32,
    },
    /// Exploration: everything that could be reached was seen, and all are home.
    Explored {
        /// Share of the reachable ground that was seen (1).
        seen: f64,
    },
    /// Any other mission: a finding in its own words.
    Own {
        /// The word that stands for it in files and tables; it does not change.
        word: &'static str,
        /// Words with numbers, for people.
        words: String,
        /// Whether the mission did what was asked of it.
        is_success: bool,
    },
}

/// Why a link was broken.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Break {
    /// Its loss was at or beyond `packets.limit_db`.
    Loss {
        /// Its loss (dB).
        loss_db: f32,
        /// `packets.limit_db`.
        limit_db: f32,
    },
    /// One of its ends had heard nothing for longer than `link.lost_s`.
    Silent {
        /// Whether it was the end toward the head.
        is_front: bool,
        /// For how long (s); `None` if it never heard anything.
        silent_s: Option<f32>,
    },
}

/// What to change in a scenario so that a team sees more.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedy {
    /// Arguments of the command: `--set explore.sectors=36`.
    pub sets: String,
    /// How wide passages then have to be (m); `None` if they were no narrower.
    pub width_m: Option<f64>,
}

/// The way of the head: along the tunnel, backward ways taken off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// What its pilot asked for while it could fly (m).
    pub asked_m: f64,
    /// What came (m).
    pub flown_m: f64,
    /// Whether the tunnel ended before.
    pub is_end: bool,
}

/// Links that were worse at the end than `takeoff.s_min_db`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Over {
    /// How many.
    pub over: usize,
    /// Of how many.
    pub links: usize,
    /// The worst one (dB).
    pub worst_db: f32,
    /// `takeoff.s_min_db`.
    pub s_min_db: f32,
}

impl Outcome {
    /// The word that stands for it in files and tables; it does not change.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Interrupted { .. } => "interrupted",
            Self::NeverFlew => "never-flew",
            Self::HeadFailed { .. } => "head-failed",
            Self::ChainBroken { .. } => "chain-broken",
            Self::HeadStuck { .. } => "head-stuck",
            Self::NotLaunched { .. } => "not-launched",
            Self::RelaysShort { .. } => "relays-short",
            Self::HeadHeld { .. } => "head-held",
            Self::HeadShort { .. } => "head-short",
            Self::LinksOver(_) => "links-over",
            Self::Unseen { .. } => "unseen",
            Self::Unreachable { .. } => "unreachable",
            Self::Full { .. } => "full",
            Self::Stuck { .. } => "stuck",
            Self::TimeUp { .. } => "time-up",
            Self::Completed { .. } => "completed",
            Self::Explored { .. } => "explored",
            Self::Own { word, .. } => word,
        }
    }

    /// Whether the mission did what was asked of it.
    pub fn is_success(&self) -> bool {
        matches!(self, Self::Completed { .. } | Self::Explored { .. } | Self::Own { is_success: true, .. })
    }

    /// Its place among the findings, the gravest first.
    fn rank(&self) -> u8 {
        match self {
            Self::Interrupted { .. } => 0,
            Self::NeverFlew => 1,
            Self::HeadFailed { .. } => 2,
            Self::ChainBroken { .. } => 3,
            Self::HeadStuck { .. } => 4,
            Self::NotLaunched { .. } => 5,
            Self::RelaysShort { .. } => 6,
            Self::HeadHeld { .. } => 7,
            Self::HeadShort { .. } => 8,
            Self::LinksOver(_) => 9,
            Self::Stuck { .. } => 10,
            Self::Full { .. } => 11,
            Self::TimeUp { .. } => 12,
            Self::Unreachable { .. } => 13,
            Self::Unseen { .. } => 14,
            Self::Own { is_success: false, .. } => 15,
            Self::Completed { .. } | Self::Explored { .. } | Self::Own { .. } => 16,
        }
    }
}

/// All that was found out about how a mission went: the gravest finding is its [`Outcome`].
///
/// In files it is two fields: `outcome`, the word, and `verdict`, the words with their numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    gravest: Outcome,
    others: Vec<Outcome>,
    remarks: Vec<String>,
}

impl Verdict {
    /// The outcome's word, and the words with numbers.
    pub fn words(&self) -> String {
        format!("{}: {self}", self.outcome().word())
    }

    /// The gravest of the findings; without any, what the mission is if nothing went wrong. `remarks` are said
    /// besides: what went wrong and healed.
    ///
    /// ```
    /// use uchain_sim::analyse::{Outcome, Verdict};
    /// let seen = 0.625;
    /// let good = Verdict::new(Outcome::Explored { seen: 1.0 }, Vec::new(), Vec::new());
    /// assert!(good.outcome().is_success());
    /// let found = vec![Outcome::TimeUp { seen, after_s: 600.0 }];
    /// let verdict = Verdict::new(Outcome::Explored { seen }, found, Vec::new());
    /// assert_eq!(verdict.outcome().word(), "time-up");
    /// assert_eq!(verdict.to_string(), "62.5 % seen when the time was up, after 600 s (duration_s)");
    /// ```
    pub fn new(good: Outcome, mut findings: Vec<Outcome>, remarks: Vec<String>) -> Self {
        findings.sort_by_key(Outcome::rank);
        let mut findings = findings.into_iter();
        let gravest = findings.next().unwrap_or(good);
        Self { gravest, others: findings.collect(), remarks }
    }

    /// The gravest finding.
    pub fn outcome(&self) -> &Outcome {
        &self.gravest
    }

    /// Every finding, the gravest first.
    pub fn findings(&self) -> impl Iterator<Item = &Outcome> {
        std::iter::once(&self.gravest).chain(&self.others)
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, finding) in self.findings().enumerate() {
            let before = if index == 0 { "" } else { "; " };
            write!(f, "{before}{finding}")?;
        }
        self.remarks.iter().try_for_each(|remark| write!(f, "; {remark}"))
    }
}

impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Verdict", 2)?;
        fields.serialize_field("outcome", self.gravest.word())?;
        fields.serialize_field("verdict", &self.to_string())?;
        fields.end()
    }
}

#[cfg(test)]
mod tests;
