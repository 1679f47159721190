//! Static shadowing: what stays in place of fading, as the place of both ends has it.

use std::sync::Arc;

use super::field::{Field, MOST};
use crate::{
    map::Map,
    radio::{Antenna, NO_LINK_DB, RadioModel, RadioParams, finite_db},
    seed::Seed,
};

/// A model with a loss X(p, q) of its own for every pair of places, which does not change with time: mean 0, standard
/// deviation `radio.sigma_static_db`, correlation exp(−(|Δp| + |Δq|)/`radio.correlation_m`), at most four standard deviations.
///
/// Whoever lays a scenario out does not know X: the loss is then that of the model inside, its mean. A run has the X of its
/// seed ([`RadioModel::seeded`]), and so has the optimum it is measured by; with `radio.shadowing_seed` there is one X for
/// all, and a plan knows it.
#[derive(Debug)]
pub struct Shadowed {
    inner: Arc<dyn RadioModel>,
    sigma_db: f32,
    correlation_m: f32,
    /// The seed that the scenario gives, if it does: no run has another.
    given: Option<u64>,
    /// X of a seed; `None` where it is not known.
    field: Option<(Seed, Field)>,
}

impl Shadowed {
    /// As a scenario asks for it, around a model.
    pub fn new(inner: Arc<dyn RadioModel>, params: &RadioParams) -> Self {
        let (sigma_db, correlation_m) = (params.sigma_static_db, params.correlation_m);
        let given = params.shadowing_seed;
        let field = given.map(|seed| (Seed(seed), Field::new(Seed(seed), correlation_m)));
        Self { inner, sigma_db, correlation_m, given, field }
    }
}

impl RadioModel for Shadowed {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let loss_db = finite_db(self.inner.loss_db(map, from, to));
        match &self.field {
            // No shadow makes a link of none.
            Some((_, field)) if loss_db < NO_LINK_DB => loss_db + self.sigma_db * field.at(from.at, to.at),
            _ => loss_db,
        }
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        let least_db = self.inner.least_loss_db(apart_m);
        if self.field.is_some() && least_db < NO_LINK_DB { least_db - self.sigma_db * MOST } else { least_db }
    }

    fn key(&self) -> Option<String> {
        let inner = self.inner.key()?;
        let Some((Seed(seed), _)) = &self.field else { return Some(inner) };
        let Self { sigma_db, correlation_m, .. } = self;
        Some(format!("{inner}, in place {sigma_db:?} over {correlation_m:?} of seed {seed}"))
    }

    fn is_costly(&self) -> bool {
        self.inner.is_costly()
    }

    fn seeded(&self, seed: Seed) -> Option<Arc<dyn RadioModel>> {
        let inner = self.inner.seeded(seed);
        if self.given.is_some() && inner.is_none() {
            return None;
        }
        let of = Seed(self.given.unwrap_or(seed.0));
        Some(Arc::new(Self {
            inner: inner.unwrap_or_else(|| self.inner.clone()),
            field: Some((of, Field::new(of, self.correlation_m))),
            ..*self
        }))
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::{map::drawn, radio::Disc};

    fn shadowed(params: &RadioParams) -> Shadowed {
        Shadowed::new(Arc::new(Disc { range_m: 4.0, loss_db: 50.0 }), params)
    }

    fn loss_db(model: &dyn RadioModel, from: [f32; 2], to: [f32; 2]) -> f32 {
        let map = drawn(&[vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]]).unwrap();
        model.loss_db(&map, &Vec2::from(from).into(), &Vec2::from(to).into())
    }

    #[test]
    fn nobody_knows_the_shadow_but_a_run_and_whoever_was_told_its_seed() {
        let params = RadioParams { sigma_static_db: 6.0, ..RadioParams::default() };
        let (from, to) = ([1.0, 2.0], [4.0, 2.5]);
        let plain = shadowed(&params);
        assert_eq!((loss_db(&plain, from, to), plain.key()), (50.0, plain.inner.key()));
        let [one, again, two] = [1, 1, 2].map(|seed| plain.seeded(Seed(seed)).unwrap());
        let of_one = loss_db(&*one, from, to);
        assert!(of_one != 50.0 && of_one == loss_db(&*again, from, to) && of_one == loss_db(&*one, to, from));
        assert_ne!(of_one, loss_db(&*two, from, to));
        assert!(one.key() == again.key() && one.key() != two.key());
        // Seeded once more it is that of the other seed, and nothing else.
        assert_eq!(loss_db(&*one.seeded(Seed(2)).unwrap(), from, to), loss_db(&*two, from, to));
        let told = shadowed(&RadioParams { shadowing_seed: Some(1), ..params });
        assert_eq!(loss_db(&told, from, to), of_one);
        assert!(told.seeded(Seed(2)).is_none(), "one place for all runs");
    }

    #[test]
    fn a_shadow_is_never_better_than_the_least_loss_and_makes_no_link_of_none() {
        let params = RadioParams { sigma_static_db: 9.0, ..RadioParams::default() };
        let model = shadowed(&params).seeded(Seed(3)).unwrap();
        for i in 0..2_000 {
            let to = [1.0 + 0.003 * i as f32, 1.0 + 0.001 * i as f32];
            let apart_m = Vec2::from(to).distance(Vec2::new(1.0, 1.0));
            let loss_db = loss_db(&*model, [1.0, 1.0], to);
            assert!(loss_db >= model.least_loss_db(apart_m), "{apart_m}");
            assert_eq!(loss_db >= NO_LINK_DB, apart_m > 4.0, "{apart_m}");
        }
    }
}
