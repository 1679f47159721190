//! What a scenario says of levelling, for a law of one's own.

use std::sync::Arc;

use numpy::PyArray1;
use pyo3::{exceptions::PyValueError, prelude::*, sync::PyOnceLock, types::PyType};
use uchain_core::chain::EqualizeParams;

/// A number as numpy has it.
pub(super) fn float32(py: Python<'_>, value: f32) -> PyResult<Bound<'_, PyAny>> {
    float32_type(py)?.call1((value,))
}

pub(super) fn float32_type(py: Python<'_>) -> PyResult<&Bound<'_, PyType>> {
    static TYPE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    TYPE.import(py, "numpy", "float32")
}

/// Whose parameters.
enum Of {
    /// One scenario's.
    One(EqualizeParams),
    /// Those of many relays: the parameters of each world, and the world of each relay.
    Many(Arc<[EqualizeParams]>, Vec<u32>),
}

/// What a scenario says of levelling, under the keys of its table `equalize`.
///
/// Each is a numpy.float32; for a law that sees many relays at once, an array (relays,) of float32, for worlds may differ.
///
/// >>> env = uchain.ChainEnv("corner")
/// >>> float(env.params.k_db_per_m), float(env.params.decision_s)
/// (25.0, 0.20000000298023224)
#[pyclass(frozen, module = "uchain")]
pub(crate) struct LawParams(Of);

impl LawParams {
    pub(crate) fn one(params: &EqualizeParams) -> Self {
        Self(Of::One(params.clone()))
    }

    pub(super) fn many(params: Arc<[EqualizeParams]>, world: Vec<u32>) -> Self {
        Self(Of::Many(params, world))
    }

    fn get<'py>(&self, py: Python<'py>, of: impl Fn(&EqualizeParams) -> f32) -> PyResult<Bound<'py, PyAny>> {
        match &self.0 {
            Of::One(params) => float32(py, of(params)),
            Of::Many(params, world) => {
                let each = world.iter().map(|&world| params.get(world as usize).map_or(f32::NAN, &of));
                Ok(PyArray1::from_iter(py, each).into_any())
            }
        }
    }
}

#[pymethods]
impl LawParams {
    /// Lipschitz constant of quality over distance, `k` in Laclau 2021, Eq. 12 (dB/m).
    #[getter]
    fn k_db_per_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.k_db_per_m)
    }

    /// Imbalance that counts as level, `T` in Laclau 2021, Algorithm 1 (dB).
    #[getter]
    fn tolerance_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.tolerance_db)
    }

    /// Largest speed of a relay (m/s): whatever a law returns is bounded by it.
    #[getter]
    fn v_max_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.v_max_mps)
    }

    /// Time between two decisions, `T_s` in Laclau 2021, Eq. 12 (s).
    #[getter]
    fn decision_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.decision_s)
    }

    /// Distance that the law "inverse-model" reads from a loss of 0 dB (m).
    #[getter]
    fn model_d0_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.model_d0_m)
    }

    /// Loss over which the distance read by "inverse-model" grows e-fold (dB).
    #[getter]
    fn model_scale_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.model_scale_db)
    }

    /// Speed of the law "bang-bang" (m/s).
    #[getter]
    fn bang_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.bang_mps)
    }

    /// Imbalance within which "bang-bang" stays (dB).
    #[getter]
    fn bang_band_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, |params| params.bang_band_db)
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, Option<Vec<u32>>))> {
        let parts = match &slf.get().0 {
            Of::One(params) => (serde_json::to_string(&[params]), None),
            Of::Many(params, world) => (serde_json::to_string(&params[..]), Some(world.clone())),
        };
        let text = parts.0.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((slf.get_type().getattr("_unpickled")?, (text, parts.1)))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(_: &Bound<'_, PyType>, text: &str, world: Option<Vec<u32>>) -> PyResult<Self> {
        let params: Vec<EqualizeParams> =
            serde_json::from_str(text).map_err(|error| PyValueError::new_err(error.to_string()))?;
        match (params.as_slice(), world) {
            ([one], None) => Ok(Self::one(one)),
            (_, Some(world)) => Ok(Self::many(params.into(), world)),
            (_, None) => Err(PyValueError::new_err("expected the parameters of one scenario")),
        }
    }

    fn __repr__(&self) -> String {
        match &self.0 {
            Of::One(params) => format!(
                "<uchain.LawParams k_db_per_m={} tolerance_db={} v_max_mps={} decision_s={}>",
                params.k_db_per_m, params.tolerance_db, params.v_max_mps, params.decision_s
            ),
            Of::Many(_, world) => format!("<uchain.LawParams of {} relays>", world.len()),
        }
    }
}
