//! Strategies by their words: what a scenario names, and what makes it.

use alloc::boxed::Box;
use core::fmt;

use super::{
    Strategy, baseline::RandomFrontier, comparators::NearestFrontier, comparators::Utility, target::Cssg,
};
use crate::explore::ExploreParams;

/// A strategy as a scenario names it: its word, what it means, and what makes one for a robot. The built-in ones are
/// [`StrategyKind::BUILTIN`]; a program's own stands beside them.
///
/// ```
/// use uchain_core::explore::{Cssg, ExploreParams, Goal, Strategy, StrategyKind, View};
///
/// /// Never goes back for a frontier it has passed.
/// #[derive(Debug, Clone)]
/// struct Onward;
///
/// impl Strategy for Onward {
///     fn goal(&mut self, view: &mut View<'_>) -> Goal {
///         match Cssg.goal(view) {
///             Goal::Node(_) => Goal::Home,
///             goal => goal,
///         }
///     }
/// }
///
/// const ONWARD: StrategyKind =
///     StrategyKind::new("onward", "As `cssg`, without going back.", |_| Box::new(Onward));
/// let params = ExploreParams { strategy: ONWARD, ..ExploreParams::default() };
/// assert_eq!(params.strategy.word(), "onward");
/// assert!(!params.strategy.holds() && params.strategy != StrategyKind::CSSG);
/// ```
#[derive(Clone, Copy)]
pub struct StrategyKind {
    word: &'static str,
    meaning: &'static str,
    holds: bool,
    make: fn(&ExploreParams) -> Box<dyn Strategy>,
}

impl StrategyKind {
    /// Cooperative Sensor-based Selective Graph (Kim 2021, Algorithm 2).
    pub const CSSG: Self = Self::new(
        "cssg",
        "Cooperative Sensor-based Selective Graph: STN, backtracking by graph, levels (Kim 2021, Algorithm 2).",
        |_| Box::new(Cssg),
    );
    /// The same with a random frontier (Kim 2021, §7.2).
    pub const CSSG_RANDOM: Self =
        Self::new("cssg-random", "The same with a random frontier instead of STN (Kim 2021, §7.2).", |_| {
            Box::new(RandomFrontier)
        });
    /// Sensor-based Random Graph (Kim 2021, §7.2).
    pub const SRG: Self = Self::new(
        "srg",
        "Sensor-based Random Graph: a random frontier, backtracking by graph, and of two robots that would meet one\n\
         holds (Kim 2021, §7.2).",
        |_| Box::new(RandomFrontier),
    )
    .holding();
    /// The frontier with the shortest way (Yamauchi 1997).
    pub const NEAREST_FRONTIER: Self = Self::new(
        "nearest-frontier",
        "The frontier with the shortest way, whoever found it; conflicts as in `cssg` (Yamauchi 1997).",
        |_| Box::new(NearestFrontier),
    );
    /// The frontier of the largest utility (after Burgard 2005).
    pub const UTILITY: Self = Self::new(
        "utility",
        "The frontier of the largest utility: length of its arc, as far as others will not see it, minus \
         `utility_beta`\ntimes the way there; conflicts as in `cssg` (after Burgard 2005).",
        |_| Box::new(Utility),
    );

    /// All that are built in.
    pub const BUILTIN: [Self; 5] =
        [Self::CSSG, Self::CSSG_RANDOM, Self::SRG, Self::NEAREST_FRONTIER, Self::UTILITY];

    /// A strategy of this word in scenarios, with what it means in a sentence or two, and what makes one for a robot of a
    /// team that explores by these parameters. Robots in conflict fly on levels.
    pub const fn new(
        word: &'static str,
        meaning: &'static str,
        make: fn(&ExploreParams) -> Box<dyn Strategy>,
    ) -> Self {
        Self { word, meaning, holds: false, make }
    }

    /// The same with robots in conflict that hold for one another instead (Kim 2021, §6.2).
    #[must_use]
    pub const fn holding(self) -> Self {
        Self { holds: true, ..self }
    }

    /// Its word in a scenario file.
    pub const fn word(self) -> &'static str {
        self.word
    }

    /// What it means.
    pub const fn meaning(self) -> &'static str {
        self.meaning
    }

    /// Whether robots in conflict hold for one another instead of flying on levels (Kim 2021, §6.2).
    pub const fn holds(self) -> bool {
        self.holds
    }

    /// One for a robot that has decided nothing yet.
    pub fn make(self, params: &ExploreParams) -> Box<dyn Strategy> {
        (self.make)(params)
    }
}

impl Default for StrategyKind {
    fn default() -> Self {
        Self::CSSG
    }
}

impl PartialEq for StrategyKind {
    /// By their words.
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

impl Eq for StrategyKind {}

impl fmt::Debug for StrategyKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word)
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for StrategyKind {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word)
    }
}

/// Reads the words that are built in; those of a program's own are known to whoever reads its scenarios.
#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for StrategyKind {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Word;

        impl serde::de::Visitor<'_> for Word {
            type Value = StrategyKind;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the word of a strategy")
            }

            fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<StrategyKind, E> {
                const WORDS: &[&str] = &[
                    StrategyKind::CSSG.word,
                    StrategyKind::CSSG_RANDOM.word,
                    StrategyKind::SRG.word,
                    StrategyKind::NEAREST_FRONTIER.word,
                    StrategyKind::UTILITY.word,
                ];
                let found = StrategyKind::BUILTIN.into_iter().find(|kind| kind.word == word);
                found.ok_or_else(|| E::unknown_variant(word, WORDS))
            }
        }

        deserializer.deserialize_str(Word)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for StrategyKind {
    fn schema_name() -> alloc::borrow::Cow<'static, str> {
        "StrategyKind".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let words = Self::BUILTIN.map(|kind| {
            schemars::json_schema!({ "type": "string", "const": kind.word, "description": kind.meaning })
        });
        schemars::json_schema!({ "oneOf": words })
    }
}
