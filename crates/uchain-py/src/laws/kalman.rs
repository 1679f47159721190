//! The filter of a link's loss, over a log.

use numpy::{PyArray1, PyReadonlyArray1, ToPyArray};
use pyo3::{
    exceptions::PyValueError,
    prelude::*,
    types::{PyDict, PyTuple, PyType},
};
use uchain_core::chain::{self, KalmanParams};

use super::params::{from_keywords, to_dict};

/// Scalar Kalman filter of one link's loss, driven by optic flow (Laclau 2021, Eq. 16 to 19): the very code that flies.
///
/// It begins at its first sample. Losses are in dB, bigger is worse: the negated RSSI (dBm). All numbers are float32
/// inside. Parameters are keywords: `measurement_variance_db2` (R, dB^2, 5), `process_variance_db2_per_s` (Q / T_s,
/// dB^2/s, 0.5), `flow_gain_db_per_m` (A / T_s, dB/m, 10.7).
///
/// Raises `ValueError` of a first sample that is not finite or a parameter out of its range, `TypeError` of an unknown
/// parameter.
///
/// >>> from uchain.laws import ScalarKalman
/// >>> link = ScalarKalman(50.0)
/// >>> link.predict(separating_mps=0.2, period_s=0.2)
/// >>> link.update(52.0)
/// >>> 50.4 < link.loss_db < 52.0
/// True
#[pyclass(module = "uchain.laws")]
pub(super) struct ScalarKalman {
    filter: chain::ScalarKalman,
    params: KalmanParams,
}

/// What a filter makes of a log: a dict of arrays, one entry a sample.
type Log<'py> = Bound<'py, PyDict>;

#[pymethods]
impl ScalarKalman {
    #[new]
    #[pyo3(signature = (loss_db, **params))]
    fn new(loss_db: f32, params: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let params: KalmanParams = from_keywords(params)?;
        let filter = chain::ScalarKalman::start(loss_db, &params);
        let filter = filter.ok_or_else(|| {
            PyValueError::new_err(format!("loss_db = {loss_db}: a filter begins at a finite sample"))
        })?;
        Ok(Self { filter, params })
    }

    /// Moves the estimate with the ends of the link (Eq. 18): `separating_mps` is the speed of the front end minus that of
    /// the rear end (m/s), `period_s` the time since the last step (s, at least 0). A speed that is not finite counts as 0.
    ///
    /// Raises `ValueError` of a period that is negative or not finite.
    fn predict(&mut self, separating_mps: f32, period_s: f32) -> PyResult<()> {
        if !(0.0..=1.0e6).contains(&period_s) {
            return Err(PyValueError::new_err(format!("period_s = {period_s}: must lie in 0..=1000000")));
        }
        self.filter.predict(separating_mps, period_s, &self.params);
        Ok(())
    }

    /// Corrects the estimate with a sample (dB) (Eq. 19). A sample that is not finite counts as none.
    fn update(&mut self, loss_db: f32) {
        self.filter.update(loss_db, &self.params);
    }

    /// The estimate (dB).
    #[getter]
    fn loss_db(&self) -> f32 {
        self.filter.loss_db()
    }

    /// Its variance (dB^2).
    #[getter]
    fn variance_db2(&self) -> f32 {
        self.filter.variance_db2()
    }

    /// Its parameters, by name.
    #[getter]
    fn params<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        to_dict(py, &self.params)
    }

    /// A whole log through a new filter, in one call: predict, then update, sample by sample.
    ///
    /// `time_s` (n,) float64, not decreasing; `loss_db` (n,) float32, NaN where nothing was heard; `separating_mps` (n,)
    /// float32, the speed since the sample before, or None for a filter without motion input. Parameters are keywords, as
    /// of the class. The filter begins at the first finite sample; before it all is NaN.
    ///
    /// Returns a dict of arrays (n,) float32: `loss_db` the estimate and `variance_db2` its variance after the sample,
    /// `predicted_db` the estimate before it, `innovation_db` the sample minus that, `innovation_variance_db2` what the
    /// filter expects of its square (P + R).
    ///
    /// Raises `ValueError` of arrays of different lengths, and of a time that is not finite or goes back.
    ///
    /// >>> import numpy as np
    /// >>> from uchain.laws import ScalarKalman
    /// >>> log = ScalarKalman.filter(np.arange(5.0), np.array([50, 51, np.nan, 50, 49], np.float32))
    /// >>> [round(float(loss), 2) for loss in log["loss_db"]]
    /// [50.0, 50.52, 50.52, 50.3, 49.86]
    #[classmethod]
    #[pyo3(signature = (time_s, loss_db, separating_mps=None, **params))]
    #[expect(clippy::needless_pass_by_value, reason = "arguments from Python")]
    fn filter<'py>(
        cls: &Bound<'py, PyType>,
        time_s: PyReadonlyArray1<'py, f64>,
        loss_db: PyReadonlyArray1<'py, f32>,
        separating_mps: Option<PyReadonlyArray1<'py, f32>>,
        params: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Log<'py>> {
        let params: KalmanParams = from_keywords(params)?;
        let py = cls.py();
        let (times, losses) = (time_s.as_array(), loss_db.as_array());
        let speeds = separating_mps.as_ref().map(|speeds| speeds.as_array());
        let count = times.len();
        if losses.len() != count || speeds.as_ref().is_some_and(|speeds| speeds.len() != count) {
            let speeds = speeds.map_or(String::new(), |speeds| format!(", separating_mps {}", speeds.len()));
            let lengths = format!("time_s {count}, loss_db {}{speeds}", losses.len());
            return Err(PyValueError::new_err(format!("arrays of one length are expected: {lengths}")));
        }
        let mut columns: [Vec<f32>; 5] = std::array::from_fn(|_| Vec::with_capacity(count));
        let mut filter: Option<chain::ScalarKalman> = None;
        let mut before_s = f64::NEG_INFINITY;
        for (i, (&time_s, &loss_db)) in times.iter().zip(losses).enumerate() {
            if !time_s.is_finite() || time_s < before_s {
                return Err(PyValueError::new_err(format!("time_s[{i}] = {time_s}: after {before_s}")));
            }
            let mut row = [f32::NAN; 5];
            if let Some(filter) = &mut filter {
                let speed_mps = speeds.as_ref().map_or(0.0, |speeds| speeds[i]);
                filter.predict(speed_mps, (time_s - before_s) as f32, &params);
                row[2] = filter.loss_db();
                if loss_db.is_finite() {
                    row[3] = loss_db - filter.loss_db();
                    row[4] = filter.variance_db2() + params.measurement_variance_db2;
                }
                filter.update(loss_db, &params);
            } else {
                filter = chain::ScalarKalman::start(loss_db, &params);
            }
            if let Some(filter) = &filter {
                (row[0], row[1]) = (filter.loss_db(), filter.variance_db2());
            }
            columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            before_s = time_s;
        }
        let log = PyDict::new(py);
        let names = ["loss_db", "variance_db2", "predicted_db", "innovation_db", "innovation_variance_db2"];
        for (name, column) in names.iter().zip(&columns) {
            let column: Bound<'py, PyArray1<f32>> = column.to_pyarray(py);
            log.set_item(name, column)?;
        }
        Ok(log)
    }

    /// Pickled with its estimate, variance and parameters.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let this = slf.borrow();
        let state = (this.filter.loss_db(), this.filter.variance_db2(), to_dict(py, &this.params)?);
        Ok((slf.get_type().getattr("_unpickled")?, state.into_pyobject(py)?))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(
        _: &Bound<'_, PyType>,
        loss_db: f32,
        variance_db2: f32,
        params: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let params: KalmanParams = from_keywords(Some(params))?;
        let filter = chain::ScalarKalman::resume(loss_db, variance_db2);
        let filter = filter.ok_or_else(|| PyValueError::new_err("no state of a filter"))?;
        Ok(Self { filter, params })
    }

    fn __repr__(&self) -> String {
        let (loss_db, variance_db2) = (self.filter.loss_db(), self.filter.variance_db2());
        format!("<uchain.laws.ScalarKalman {loss_db} dB, variance {variance_db2} dB^2>")
    }
}
