//! What a program adds to the words of an exploration's scenarios.

use uchain_core::explore::StrategyKind;

use crate::radio::RadioKind;

/// Answers of a program's own that an exploration's scenario may name, beside those that are built in. Write what is not
/// given as `..Site::BUILTIN`: more kinds of answers may come.
///
/// ```
/// use uchain_core::explore::{NearestFrontier, StrategyKind};
/// use uchain_sim::{
///     config::builtin,
///     mission::{Scene as _, chain::Course, explore::{Site, SiteExtensions}},
///     registry::{AnyMission, Of, Registry},
/// };
///
/// // A strategy of one's own is a type that implements `Strategy`; one that is there stands in for it here.
/// const MINE: StrategyKind = StrategyKind::new("mine", "The nearest one.", |_| Box::new(NearestFrontier));
/// static MISSIONS: [&dyn AnyMission; 2] = [
///     &Of::<Course>::NEW,
///     &Of::<Site>::with(SiteExtensions { strategies: &[MINE], ..Site::BUILTIN }),
/// ];
/// let registry = Registry::new(&MISSIONS);
/// let sets = ["explore.strategy=mine".to_owned()];
/// assert!(registry.read(&builtin("apartment").unwrap(), &sets).is_ok());
/// assert!(Registry::default().read(&builtin("apartment").unwrap(), &sets).is_err());
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SiteExtensions {
    /// Strategies that `explore.strategy` may name. None has the word of a built-in one, or of another of them.
    pub strategies: &'static [StrategyKind],
    /// Models that `radio.model` may name. None has the word of a built-in one, or of another of them.
    pub radios: &'static [RadioKind],
}

impl SiteExtensions {
    /// The words that `explore.strategy` may be, those that are built in first.
    pub(super) fn strategy_words(self) -> impl Iterator<Item = &'static str> {
        StrategyKind::BUILTIN.into_iter().chain(self.strategies.iter().copied()).map(StrategyKind::word)
    }
}
