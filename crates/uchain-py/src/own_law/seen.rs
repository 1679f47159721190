//! What a law of one's own sees of one relay.

use pyo3::{prelude::*, types::PyType};
use uchain_core::chain::Levelling;
use uchain_sim::{clock::time_s, mission::chain::Asked};

use super::params::{LawParams, float32};

/// Numbers of a relay.
pub(super) const NUMBERS: usize = 11;

/// All numbers of a relay, in the order of the attributes; NaN where nothing was heard or measured.
pub(super) fn numbers(levelling: &Levelling) -> [f32; NUMBERS] {
    let Levelling { back_db, front_db, back, front, ground_speed_mps, tof, .. } = levelling;
    let or_nan = |value: Option<f32>| value.unwrap_or(f32::NAN);
    let [nw_m, ne_m, sw_m, se_m] = tof.map_or([f32::NAN; 4], |tof| [tof.nw_m, tof.ne_m, tof.sw_m, tof.se_m]);
    [
        *back_db,
        *front_db,
        or_nan(back.raw_db),
        or_nan(front.raw_db),
        or_nan(back.silent_s),
        or_nan(front.silent_s),
        or_nan(*ground_speed_mps),
        nw_m,
        ne_m,
        sw_m,
        se_m,
    ]
}

/// What a relay knows at one decision: all that a law of one's own may see. Numbers are numpy.float32, None where nothing was
/// heard or measured. Nothing in it is the truth; no position is.
///
/// >>> def law(seen):
/// ...     s_d = seen.front_db - seen.back_db  # the front link is worse: forward
/// ...     return s_d / (3 * seen.params.k_db_per_m) / seen.params.decision_s
/// >>> uchain.run("straight", law=law, frames=None).outcome
/// 'completed'
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Seen {
    /// Ticks of 0.05 s since the start.
    #[pyo3(get)]
    tick: u64,
    /// Its id, for life: 1 is the first relay behind the head.
    #[pyo3(get)]
    uav: usize,
    /// Its place in the chain: 1 follows the head, larger ones are nearer to the base.
    #[pyo3(get)]
    place: u16,
    /// What the scenario says of levelling.
    #[pyo3(get)]
    params: Py<LawParams>,
    numbers: [f32; NUMBERS],
}

impl Seen {
    pub(super) fn of(tick: u64, asked: &Asked, params: Py<LawParams>) -> Self {
        let Asked { uav, levelling } = asked;
        Self { tick, uav: *uav, place: levelling.place, params, numbers: numbers(levelling) }
    }

    /// One of the numbers, by its place among them.
    fn get<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let known = self.numbers.get(number).filter(|value| !value.is_nan());
        known.map(|value| float32(py, *value)).transpose()
    }
}

#[pymethods]
impl Seen {
    /// Loss of the link toward the base (dB), bigger is worse, by the scenario's `link.signal`: filtered, or raw.
    #[getter]
    fn back_db<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 0)
    }

    /// Loss of the link toward the head (dB), by the scenario's `link.signal`.
    #[getter]
    fn front_db<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 1)
    }

    /// Loss of the last packet from the neighbour toward the base, as measured (dB).
    #[getter]
    fn back_raw_db<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 2)
    }

    /// Loss of the last packet from the neighbour toward the head, as measured (dB).
    #[getter]
    fn front_raw_db<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 3)
    }

    /// For how long the neighbour toward the base has been silent (s).
    #[getter]
    fn back_silent_s<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 4)
    }

    /// For how long the neighbour toward the head has been silent (s).
    #[getter]
    fn front_silent_s<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 5)
    }

    /// Its own forward ground speed by optic flow (m/s).
    #[getter]
    fn ground_speed_mps<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 6)
    }

    /// Distance along the beam to the front left, +45° (m).
    #[getter]
    fn tof_nw_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 7)
    }

    /// Distance along the beam to the front right, -45° (m).
    #[getter]
    fn tof_ne_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 8)
    }

    /// Distance along the beam to the rear left, +135° (m).
    #[getter]
    fn tof_sw_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 9)
    }

    /// Distance along the beam to the rear right, -135° (m).
    #[getter]
    fn tof_se_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.get(py, 10)
    }

    /// Simulated time (s), float.
    #[getter]
    fn time_s(&self) -> f64 {
        time_s(self.tick)
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (u64, usize, u16, Py<LawParams>, Vec<f32>))> {
        let Self { tick, uav, place, params, numbers } = slf.get();
        let parts = (*tick, *uav, *place, params.clone_ref(slf.py()), numbers.to_vec());
        Ok((slf.get_type().getattr("_unpickled")?, parts))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(
        _: &Bound<'_, PyType>,
        tick: u64,
        uav: usize,
        place: u16,
        params: Py<LawParams>,
        numbers: [f32; NUMBERS],
    ) -> Self {
        Self { tick, uav, place, params, numbers }
    }

    fn __repr__(&self) -> String {
        let [back_db, front_db, ..] = self.numbers;
        let time_s = time_s(self.tick);
        format!("<uchain.Seen UAV {} at {time_s} s: back_db={back_db} front_db={front_db}>", self.uav)
    }
}
