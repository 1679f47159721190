//! What a program adds to the words of a chain's scenarios.

use uchain_core::chain::{Brain, NodeParams};

use super::OwnLaw;
use crate::{
    config::{ConfigError, Document},
    radio::RadioKind,
};

/// A brain of one's own for a UAV, by its id and by what the scenario says of the built-in laws.
pub type MakeBrain = fn(uav: usize, params: &NodeParams) -> Box<dyn Brain>;

/// Answers of a program's own that a chain's scenario may name, beside those that are built in. Write what is not given
/// as `..Course::BUILTIN`: more kinds of answers may come.
///
/// ```
/// use uchain_core::chain::{Brain, Command, Observation};
/// use uchain_sim::{
///     config::builtin,
///     mission::{Scene, chain::{ChainExtensions, Course}},
///     registry::{Of, Registry},
/// };
/// #[derive(Debug)]
/// struct Hover;
/// impl Brain for Hover {
///     fn decide(&mut self, _: &Observation) -> Command {
///         Command { airborne: true, ..Command::default() }
///     }
/// }
/// const CHAIN: Of<Course> =
///     Of::with(ChainExtensions { brains: &[("hover", |_, _| Box::new(Hover))], ..Course::BUILTIN });
/// let registry = Registry::new(&[&CHAIN]);
/// assert!(registry.read(&builtin("corner").unwrap(), &["chain.brain=hover".into()]).is_ok());
/// let error = registry.read(&builtin("corner").unwrap(), &["chain.brain=hovr".into()]).unwrap_err();
/// assert!(error.to_string().contains("did you mean 'hover'?"));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ChainExtensions {
    /// Laws of one's own, by the word that `chain.brain` has for them. None has the word of the built-in one, "node", or of
    /// another of them.
    pub brains: &'static [(&'static str, MakeBrain)],
    /// Models that `radio.model` may name. None has the word of a built-in one, or of another of them.
    pub radios: &'static [RadioKind],
}

impl ChainExtensions {
    /// The word for the built-in law.
    const NODE: &'static str = "node";

    /// What `chain.brain` may be.
    pub(super) fn words(&self) -> Vec<&'static str> {
        std::iter::once(Self::NODE).chain(self.brains.iter().map(|(word, _)| *word)).collect()
    }

    /// The law of this name; `None` for the built-in one.
    pub(super) fn law(
        &self,
        name: Option<&str>,
        document: &Document<'_>,
    ) -> Result<Option<OwnLaw>, ConfigError> {
        let Some(name) = name else { return Ok(None) };
        if self.words().iter().filter(|word| **word == name).count() > 1 {
            let expected = "this program gives the word to more than one law";
            return Err(document.invalid("chain.brain", &format!("\"{name}\""), expected));
        }
        if name == Self::NODE {
            return Ok(None);
        }
        match self.brains.iter().find(|(word, _)| *word == name) {
            Some((_, make)) => Ok(Some(OwnLaw::new(*make))),
            None => Err(document.unknown_choice("chain.brain", name, &self.words())),
        }
    }
}
