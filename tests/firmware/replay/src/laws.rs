//! The laws by themselves, on what a flight shows them: nothing of a flight depends on it.

use core::hint::black_box;

use uchain_core::chain::{
    CenterLaw, CenterParams, EqualizeParams, Explanation, NodeParams, Observation, ScalarKalman, SpeedLaw,
    center, equalize,
};

use crate::{Call, Meter, meter::Metered};

const CENTERINGS: [(Call, CenterLaw); 3] = [
    (Call::CenterWall, CenterLaw::Wall),
    (Call::CenterPaper, CenterLaw::Paper),
    (Call::CenterFirmware, CenterLaw::Firmware),
];

const LEVELLINGS: [(Call, SpeedLaw); 3] = [
    (Call::EqualizeLipschitz, SpeedLaw::Lipschitz),
    (Call::EqualizeInverseModel, SpeedLaw::InverseModel),
    (Call::EqualizeBangBang, SpeedLaw::BangBang),
];

/// Measures each law on an observation, and on what a node makes of it.
pub(crate) fn measure<M: Meter>(
    seen: &Observation,
    why: &Explanation,
    params: &NodeParams,
    metered: &mut Metered<'_, M>,
) {
    if let Some(tof) = &seen.tof {
        let is_backward = why.estimates.allowed_mps.is_some_and(|speed_mps| speed_mps < 0.0);
        for (call, law) in CENTERINGS {
            let own = black_box(CenterParams { law, ..params.center.clone() });
            metered.time(call, || center(tof, params.tof_range_m, is_backward, why.follow, &own));
        }
    }
    let (back, front) = (why.estimates.back, why.estimates.front);
    if seen.radio.is_some()
        && let (Some(back_db), Some(front_db)) = (back.filtered_db, front.filtered_db)
    {
        for (call, law) in LEVELLINGS {
            let own = black_box(EqualizeParams { law, ..params.equalize.clone() });
            metered.time(call, || equalize(back_db, front_db, &own));
        }
    }
    if seen.radio.is_some()
        && let (Some(loss_db), Some(variance_db2)) = (back.filtered_db, why.back_variance_db2)
        && let (Some(mut filter), Some(raw_db)) = (ScalarKalman::resume(loss_db, variance_db2), back.raw_db)
    {
        let speed_mps = seen.ground_speed_mps.unwrap_or(0.0);
        metered.time(Call::Kalman, || {
            filter.predict(speed_mps, params.equalize.decision_s, &params.kalman);
            filter.update(raw_db, &params.kalman);
            filter
        });
    }
}
