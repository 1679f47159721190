//! What one should know of a chain before it starts.

use crate::mission::chain::{Course, Spawn};
use crate::radio::{Antenna, Disc};

impl Course {
    /// What keeps relays on the ground, or the head from its way, although every value is one that may be asked for.
    pub fn notes(&self) -> Vec<String> {
        [
            self.map.import().note(),
            self.row(),
            self.reception(),
            self.scenario.radio.note(),
            self.range(),
            self.speed(),
            self.from_base.note(),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// UAVs that wait so far from the base that the first of them is over the threshold from the start. The next in
    /// line hears the chain from where it waits, not from the base.
    fn row(&self) -> Option<String> {
        let s_min_db = self.scenario.takeoff.s_min_db;
        let chain = &self.scenario.chain;
        let loss_db = |spawn: &Spawn| {
            let from = Antenna::flying(spawn.at, spawn.heading_rad).on_ground(true);
            self.loss_db(&from, &self.base_antenna())
        };
        let head = self.spawns.first().filter(|head| chain.uavs > 1 && loss_db(head) > s_min_db)?;
        let far_m = head.at.distance(self.base);
        let words = format!(
            "the head waits {far_m:.2} m from the base, and loses {:.1} dB on the way there: more than \
             takeoff.s_min_db = {s_min_db} dB before anybody flies; the next relay waits beside it, hears it well and \
             may never take off",
            loss_db(head)
        );
        if chain.spawns_m.is_some() {
            return Some(words + "; move chain.spawns_m nearer to the base");
        }
        let fit = self.spawns.iter().rev().take_while(|spawn| loss_db(spawn) <= s_min_db).count();
        if fit < 2 {
            return Some(words);
        }
        // Rounded down to a centimetre.
        let row_m = chain.spacing_m * (fit - 1) as f32;
        let spacing_m = (100.0 * row_m / (chain.uavs - 1) as f32).floor() / 100.0;
        let closer = if spacing_m > 2.0 * self.scenario.motion.radius_m {
            format!(" or --set chain.spacing_m={spacing_m}")
        } else {
            String::new()
        };
        Some(format!("{words}; try --set chain.uavs={fit}{closer}"))
    }

    /// A reception that ends below the threshold of a take-off.
    fn reception(&self) -> Option<String> {
        let (limit_db, s_min_db) = (self.scenario.packets.limit_db, self.scenario.takeoff.s_min_db);
        (self.scenario.chain.uavs > 1 && limit_db <= s_min_db).then(|| {
            format!(
                "packets.limit_db = {limit_db}: no packet arrives over a link that loses more, so that none ever exceeds \
                 takeoff.s_min_db = {s_min_db} and no relay takes off; try --set packets.limit_db={}",
                s_min_db + 40.0
            )
        })
    }

    /// A disc: no link is ever too long for the next relay to wait, and then none is left.
    fn range(&self) -> Option<String> {
        let radio = &self.scenario.radio;
        let s_min_db = self.scenario.takeoff.s_min_db;
        let never = radio.model == Disc::WORD && radio.reference_loss_db <= s_min_db;
        (self.scenario.chain.uavs > 1 && never).then(|| {
            format!(
                "radio.model = \"{}\": within its range a link loses {} dB wherever its ends are, which is no more than \
                 takeoff.s_min_db = {s_min_db}, so that no relay takes off before the link is lost",
                Disc::WORD, radio.reference_loss_db
            )
        })
    }

    /// A pilot that asks for more than the head may fly.
    fn speed(&self) -> Option<String> {
        let v_max_mps = self.scenario.equalize.v_max_mps;
        let steps = self.scenario.pilot.iter().enumerate();
        let (index, step) = steps.into_iter().find(|(_, step)| step.speed_mps.abs() > v_max_mps)?;
        Some(format!(
            "pilot.{index}.speed_mps = {}: the head flies no faster than equalize.v_max_mps = {v_max_mps}; try --set \
             equalize.v_max_mps={}",
            step.speed_mps,
            step.speed_mps.abs()
        ))
    }
}
