//! Many runs of one scenario: every variant of a design, flown as often as there are replicates, rows in order.
//!
//! Row `i` is variant `i / replicates`, replicate `i % replicates`. Its seed is a function of the root seed and the
//! replicate alone ([`Seed::replicate`](crate::seed::Seed::replicate)): all variants of a replicate see the same
//! random numbers, which makes them comparable pair by pair, and `uchain run --seed` flies any row again.
//!
//! [`Sweep::each`] keeps what is made of each run in memory, [`table`] the rows; [`folder`] keeps them on disk, whatever
//! happens to the process.

mod cache;
mod design;
mod fly;
pub mod folder;
pub mod report;
mod row;
pub mod table;

use std::{any::Any, hash::Hasher as _, sync::Arc};

use twox_hash::XxHash64;

use crate::{
    config::{ConfigError, Source},
    map::Map,
    registry::{About, AnyScene, Registry, ValueKind},
    seed::Seed,
};
use cache::SceneCache;
use design::{combined, refuse_overlaps};

pub use crate::registry::Flown;
pub use design::{Design, DesignError, DesignText, RUNS_MAX, TABLE_MAX_BYTES, Written};
pub use fly::{PoolError, caught, on_threads, parallel_map};

/// One run of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Its place in the sweep, from 0.
    pub index: u64,
    /// Its variant, from 0.
    pub variant: u64,
    /// Its replicate, from 0.
    pub replicate: u64,
    /// Its seed, the same for all variants of a replicate.
    pub seed: u64,
}

/// Many runs of one scenario.
#[derive(Debug)]
pub struct Sweep {
    source: Source,
    sets: Vec<String>,
    design: Design,
    replicates: u64,
    seed: u64,
    about: About,
    /// What the values of every varied key are.
    kinds: Vec<ValueKind>,
    scenes: SceneCache,
    registry: Registry,
    /// What scenes share, as their mission has it.
    shared: Box<dyn Any + Send + Sync>,
}

impl Sweep {
    /// Runs of a scenario with `sets` written over it and the values of the design over those. Nothing is laid out yet,
    /// and only the first variant is looked at: see [`Sweep::check`].
    ///
    /// ```
    /// use uchain_libm as _; // the same bits on every system
    /// use uchain_sim::{config::builtin, sweep::{Design, DesignText, Sweep}};
    /// let vary = vec!["radio.sigma_db=0,4".to_owned()];
    /// let design = Design::parse(&DesignText { vary, table: None }, "").unwrap();
    /// let sets = vec!["duration_s=5".to_owned()];
    /// let sweep = Sweep::new(builtin("straight").unwrap(), sets, design, 3, 1).unwrap();
    /// sweep.check().unwrap();
    /// let digests = sweep.each(|scene, run| scene.fly(run.seed, &mut ()).unwrap().digest().to_owned());
    /// assert_eq!(digests.len(), 6);
    /// assert!(digests.iter().all(Result::is_ok));
    /// ```
    ///
    /// # Errors
    /// No runs, or more than [`RUNS_MAX`]; a key that is written twice, or lies within another one, however they are
    /// spelled; a first variant that is no scenario.
    pub fn new(
        source: Source,
        sets: Vec<String>,
        design: Design,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, DesignError> {
        Self::of(Registry::default(), source, sets, design, replicates, seed)
    }

    /// Like [`Sweep::new`], of a scenario of one of these missions.
    ///
    /// # Errors
    /// Those of [`Sweep::new`].
    pub fn of(
        registry: Registry,
        source: Source,
        sets: Vec<String>,
        design: Design,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, DesignError> {
        let runs = design.variants().saturating_mul(u128::from(replicates));
        if runs == 0 {
            return Err(DesignError::None);
        }
        if runs > u128::from(RUNS_MAX) {
            let product = format!("{} variants × {replicates} replicates", design.product());
            return Err(DesignError::TooMany { runs, product });
        }
        refuse_overlaps(registry, &design, &source, &sets)?;
        let first = combined(&design, &sets, 0);
        let about = registry.describe(&source, &first).map_err(|error| design.place(0, error))?;
        let kinds = design.keys().map(|key| registry.kind_of(&source, &first, key)).collect();
        let shared = about.mission.shared();
        let scenes = SceneCache::default();
        Ok(Self { source, sets, design, replicates, seed, about, kinds, scenes, registry, shared })
    }

    /// Checks keys and values of every variant, and gives a hash of the walls of the first that can be laid out. What only shows in the map (a base in rock, UAVs that overlap) fails
    /// the runs of its variant and no others, unless it is so in all variants.
    ///
    /// # Errors
    /// The first variant that is wrong, with the place its value was written in; the first variant, if none can be laid
    /// out.
    pub fn check(&self) -> Result<String, DesignError> {
        self.check_until(&|| false).map(Option::unwrap_or_default)
    }

    /// Like [`Sweep::check`], until somebody says to stop; `None` if so.
    ///
    /// # Errors
    /// Those of [`Sweep::check`].
    pub fn check_until(&self, stop: &(dyn Fn() -> bool + Sync)) -> Result<Option<String>, DesignError> {
        let checked = fly::first_error(self.variants(), |variant| {
            if stop() {
                return Some(None);
            }
            let sets = combined(&self.design, &self.sets, variant);
            let wrong = self.registry.describe(&self.source, &sets).err();
            wrong.map(|error| Some(self.design.place(variant, error)))
        });
        match checked {
            Ok(()) => {}
            Err(None) => return Ok(None),
            Err(Some(error)) => return Err(error.into()),
        }
        let mut first = None;
        for variant in 0..self.variants() {
            match self.lay(variant) {
                Ok(scene) => return Ok(Some(hash_of(scene.map()))),
                Err(error) => first = first.or(Some(error)),
            }
            if stop() {
                return Ok(None);
            }
        }
        first.map_or(Err(DesignError::None), |error| Err(error.into()))
    }

    /// Lays a variant out.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    pub fn lay(&self, variant: u64) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let sets = combined(&self.design, &self.sets, variant);
        let scene = self.registry.read_sharing(&self.source, &sets, &*self.shared);
        scene.map_err(|error| self.design.place(variant, error))
    }

    /// Number of runs.
    pub fn runs(&self) -> u64 {
        self.variants() * self.replicates
    }

    /// Number of variants.
    pub fn variants(&self) -> u64 {
        self.design.variants() as u64
    }

    /// Runs of each variant.
    pub fn replicates(&self) -> u64 {
        self.replicates
    }

    /// The missions that its scenario may be of.
    pub fn registry(&self) -> Registry {
        self.registry
    }

    /// What the scenario says of itself.
    pub fn about(&self) -> &About {
        &self.about
    }

    /// What is varied.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The run at a place.
    pub fn run(&self, index: u64) -> Run {
        let (variant, replicate) = (index / self.replicates, index % self.replicates);
        Run { index, variant, replicate, seed: Seed(self.seed).replicate(replicate).0 }
    }

    /// The scenario's text with all that a run of this variant writes over it.
    pub fn scenario(&self, variant: u64) -> (&Source, Vec<String>) {
        (&self.source, combined(&self.design, &self.sets, variant))
    }
}

/// Hash of all walls of a map.
fn hash_of(map: &Map) -> String {
    let mut hash = XxHash64::with_seed(0);
    let ends = map.walls().iter().flat_map(|wall| [wall.a, wall.b]);
    ends.flat_map(|end| [end.x, end.y]).for_each(|number| hash.write(&number.to_bits().to_le_bytes()));
    format!("{:016x}", hash.finish())
}

#[cfg(test)]
mod tests;
