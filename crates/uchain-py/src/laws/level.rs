//! Leveling and centering: functions without memory.

use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use uchain_core::chain::{self, CenterParams, EqualizeParams, Tof};

use super::{params::from_keywords, words};

/// Forward speed (m/s) that levels the two links of a relay (Laclau 2021, Eq. 12 and Algorithm 1): toward the worse one.
///
/// `back_loss_db` is the loss toward the base, `front_loss_db` that toward the head (dB, bigger is worse); one that is not
/// finite gives 0. Parameters are keywords: `k_db_per_m`, `tolerance_db`, `v_max_mps`, `decision_s`, `law` and so on, as the
/// table `equalize` of a scenario has them. Computed in float32, as it flies.
///
/// Raises `TypeError` of an unknown parameter, `ValueError` of one out of its range.
///
/// >>> from uchain.laws import equalize
/// >>> round(equalize(50.0, 53.0), 6)
/// 0.2
/// >>> round(equalize(90.0, 40.0), 6)
/// -0.3
#[pyfunction]
#[pyo3(signature = (back_loss_db, front_loss_db, **params))]
pub(super) fn equalize(
    back_loss_db: f32,
    front_loss_db: f32,
    params: Option<&Bound<'_, PyDict>>,
) -> PyResult<f32> {
    let params: EqualizeParams = from_keywords(params)?;
    Ok(chain::equalize(back_loss_db, front_loss_db, &params))
}

/// What centering asks for.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Centering {
    /// Leftward speed (m/s).
    lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    yaw_rate_radps: f32,
    /// Share of the wished forward speed that is safe (0 to 1).
    speed_share: f32,
}

#[pymethods]
impl Centering {
    fn __repr__(&self) -> String {
        let Self { lateral_mps, yaw_rate_radps, speed_share } = self;
        format!(
            "Centering(lateral_mps={lateral_mps}, yaw_rate_radps={yaw_rate_radps}, speed_share={speed_share})"
        )
    }
}

/// Lateral speed and yaw rate that keep a UAV in mid-tunnel (Laclau 2021, Eq. 20), or along one wall (Eq. 21).
///
/// Distances of the four diagonal beams (m): front left, front right, rear left, rear right; one that is not finite,
/// negative or beyond `tof_range_m` (m, above 0) sees nothing. `backward`: it flies backward. `follow`: "centre", "left",
/// "right". Other parameters are keywords, as the table `center` of a scenario has them.
///
/// Raises `TypeError` of an unknown parameter, `ValueError` of one out of its range.
///
/// >>> from uchain.laws import center
/// >>> center(0.9, 0.5, 0.9, 0.5).lateral_mps > 0  # nearer the right wall: to the left
/// True
#[pyfunction]
#[pyo3(signature = (nw_m, ne_m, sw_m, se_m, *, tof_range_m=2.0, backward=false, follow="centre", **params))]
#[expect(clippy::too_many_arguments, reason = "four beams, and keywords")]
pub(super) fn center(
    nw_m: f32,
    ne_m: f32,
    sw_m: f32,
    se_m: f32,
    tof_range_m: f32,
    backward: bool,
    follow: &str,
    params: Option<&Bound<'_, PyDict>>,
) -> PyResult<Centering> {
    let params: CenterParams = from_keywords(params)?;
    let follow = words::choice("follow", follow, &words::FOLLOW)?;
    let tof_range_m = range(tof_range_m)?;
    let tof = Tof { nw_m, ne_m, sw_m, se_m };
    let chain::Centering { lateral_mps, yaw_rate_radps, speed_share } =
        chain::center(&tof, tof_range_m, backward, follow, &params);
    Ok(Centering { lateral_mps, yaw_rate_radps, speed_share })
}

/// A range that a sensor may have.
pub(super) fn range(tof_range_m: f32) -> PyResult<f32> {
    if tof_range_m > 0.0 && tof_range_m <= 1000.0 {
        return Ok(tof_range_m);
    }
    Err(PyValueError::new_err(format!("tof_range_m = {tof_range_m}: must lie above 0, at most 1000")))
}
