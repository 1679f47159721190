//! What a law of one's own sees of many relays at once.

use numpy::{Element, PyArray1, PyArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyType};
use uchain_sim::{clock::time_s, mission::chain::Asked};

use super::{
    LawParams,
    seen::{NUMBERS, numbers},
};

/// Arrays that are being filled, relay by relay.
pub(crate) struct Filling {
    floats: [Vec<f32>; NUMBERS],
    asks: Vec<bool>,
    world: Vec<i32>,
    uav: Vec<i32>,
    place: Vec<i32>,
    tick: Vec<i64>,
    time_s: Vec<f64>,
}

impl Filling {
    /// Room for so many relays, of which nobody asks.
    pub(crate) fn new(relays: usize) -> Self {
        Self {
            floats: std::array::from_fn(|_| vec![f32::NAN; relays]),
            asks: vec![false; relays],
            world: vec![0; relays],
            uav: vec![0; relays],
            place: vec![0; relays],
            tick: vec![0; relays],
            time_s: vec![0.0; relays],
        }
    }

    /// Whose the relay at a place is, and when; whether there is such a place.
    pub(crate) fn stand(&mut self, at: usize, world: usize, uav: usize, tick: u64) -> bool {
        if at >= self.asks.len() {
            return false;
        }
        let number = |number: usize| i32::try_from(number).unwrap_or(i32::MAX);
        (self.world[at], self.uav[at]) = (number(world), number(uav));
        (self.tick[at], self.time_s[at]) = (tick.cast_signed(), time_s(tick));
        true
    }

    /// The relay at a place asks.
    pub(crate) fn ask(&mut self, at: usize, world: usize, tick: u64, asked: &Asked) {
        if self.stand(at, world, asked.uav, tick) {
            self.asks[at] = true;
            self.place[at] = asked.levelling.place.into();
            for (all, value) in self.floats.iter_mut().zip(numbers(&asked.levelling)) {
                all[at] = value;
            }
        }
    }

    /// As arrays: of one dimension, or (worlds, relays).
    pub(crate) fn done(
        self,
        py: Python<'_>,
        width: Option<usize>,
        params: LawParams,
    ) -> PyResult<SeenArrays> {
        let mut arrays = Vec::with_capacity(ARRAYS);
        for values in self.floats {
            arrays.push(array(py, values, width)?);
        }
        arrays.push(array(py, self.asks, width)?);
        for values in [self.world, self.uav, self.place] {
            arrays.push(array(py, values, width)?);
        }
        arrays.push(array(py, self.tick, width)?);
        arrays.push(array(py, self.time_s, width)?);
        SeenArrays::of(arrays, Py::new(py, params)?)
    }
}

/// Arrays of [`SeenArrays`].
const ARRAYS: usize = NUMBERS + 6;

/// Values as an array, in the memory they are in; rows of so many if there is a width.
pub(crate) fn array<T: Element>(py: Python<'_>, values: Vec<T>, width: Option<usize>) -> PyResult<Py<PyAny>> {
    let len = values.len();
    let flat = PyArray1::from_vec(py, values);
    Ok(match width {
        None => flat.into_any().unbind(),
        Some(width) => flat.reshape([len.checked_div(width).unwrap_or(0), width])?.into_any().unbind(),
    })
}

/// What many relays know at one decision of each, as arrays of numpy.
///
/// A law of `uchain.batched` gets shape (relays,): all that ask at this instant, in all runs that fly side by side. A
/// `ChainEnv` gives shape (worlds, relays), with `asks` where a relay does. Losses, speeds and distances are float32, NaN where
/// nothing was heard or measured, or nobody asks. Nothing in it is the truth; no position is.
///
/// >>> seen = uchain.ChainEnv("corner", worlds=2).reset()
/// >>> seen.back_db.shape, str(seen.back_db.dtype), bool(seen.asks.any())
/// ((2, 3), 'float32', False)
#[pyclass(frozen, get_all, module = "uchain")]
pub(crate) struct SeenArrays {
    /// Loss of the link toward the base (dB), bigger is worse, by the scenario's `link.signal`.
    back_db: Py<PyAny>,
    /// Loss of the link toward the head (dB), by the scenario's `link.signal`.
    front_db: Py<PyAny>,
    /// Loss of the last packet from the neighbour toward the base, as measured (dB).
    back_raw_db: Py<PyAny>,
    /// Loss of the last packet from the neighbour toward the head, as measured (dB).
    front_raw_db: Py<PyAny>,
    /// For how long the neighbour toward the base has been silent (s).
    back_silent_s: Py<PyAny>,
    /// For how long the neighbour toward the head has been silent (s).
    front_silent_s: Py<PyAny>,
    /// The relay's own forward ground speed by optic flow (m/s).
    ground_speed_mps: Py<PyAny>,
    /// Distance along the beam to the front left, +45° (m).
    tof_nw_m: Py<PyAny>,
    /// Distance along the beam to the front right, -45° (m).
    tof_ne_m: Py<PyAny>,
    /// Distance along the beam to the rear left, +135° (m).
    tof_sw_m: Py<PyAny>,
    /// Distance along the beam to the rear right, -135° (m).
    tof_se_m: Py<PyAny>,
    /// Whether the relay asks for a speed: in the air, with both links heard once. Bool.
    asks: Py<PyAny>,
    /// The run it flies in, from 0: the world of an environment, the run within those that fly side by side. Int32.
    world: Py<PyAny>,
    /// Its id, for life: 1 is the first relay behind the head. Int32.
    uav: Py<PyAny>,
    /// Its place in the chain, 1 follows the head; 0 where it does not ask. Int32.
    place: Py<PyAny>,
    /// Ticks of 0.05 s since the start. Int64.
    tick: Py<PyAny>,
    /// Simulated time (s), float64.
    time_s: Py<PyAny>,
    /// What the scenarios say of levelling.
    params: Py<LawParams>,
}

impl SeenArrays {
    /// Of its arrays, in the order of its attributes.
    fn of(arrays: Vec<Py<PyAny>>, params: Py<LawParams>) -> PyResult<Self> {
        let [
            back_db,
            front_db,
            back_raw_db,
            front_raw_db,
            back_silent_s,
            front_silent_s,
            ground_speed_mps,
            tof_nw_m,
            tof_ne_m,
            tof_sw_m,
            tof_se_m,
            asks,
            world,
            uav,
            place,
            tick,
            time_s,
        ]: [Py<PyAny>; ARRAYS] = arrays.try_into().map_err(|arrays: Vec<_>| {
            PyValueError::new_err(format!("{} arrays: expected {ARRAYS}", arrays.len()))
        })?;
        Ok(Self {
            back_db,
            front_db,
            back_raw_db,
            front_raw_db,
            back_silent_s,
            front_silent_s,
            ground_speed_mps,
            tof_nw_m,
            tof_ne_m,
            tof_sw_m,
            tof_se_m,
            asks,
            world,
            uav,
            place,
            tick,
            time_s,
            params,
        })
    }

    fn arrays(&self) -> [&Py<PyAny>; ARRAYS] {
        [
            &self.back_db,
            &self.front_db,
            &self.back_raw_db,
            &self.front_raw_db,
            &self.back_silent_s,
            &self.front_silent_s,
            &self.ground_speed_mps,
            &self.tof_nw_m,
            &self.tof_ne_m,
            &self.tof_sw_m,
            &self.tof_se_m,
            &self.asks,
            &self.world,
            &self.uav,
            &self.place,
            &self.tick,
            &self.time_s,
        ]
    }
}

#[pymethods]
impl SeenArrays {
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Vec<Py<PyAny>>, Py<LawParams>))> {
        let (py, this) = (slf.py(), slf.get());
        let arrays = this.arrays().map(|array| array.clone_ref(py)).into();
        Ok((slf.get_type().getattr("_unpickled")?, (arrays, this.params.clone_ref(py))))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(_: &Bound<'_, PyType>, arrays: Vec<Py<PyAny>>, params: Py<LawParams>) -> PyResult<Self> {
        Self::of(arrays, params)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.back_db.bind(py).getattr("shape")?;
        Ok(format!("<uchain.SeenArrays of shape {shape}>"))
    }
}
