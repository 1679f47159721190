//! What nobody in the air knows.

use pyo3::{exceptions::PyValueError, prelude::*, types::PyType};
use uchain_sim::mission::chain::Flight;

use crate::own_law::array;

/// Where all UAVs of an environment truly are, and what their links truly lose: shape (worlds, UAVs), column `i` is UAV `i`,
/// the head is UAV 0. For rewards and pictures; no UAV knows any of it.
///
/// >>> truth = uchain.ChainEnv("corner", worlds=2).truth()
/// >>> truth.x_m.shape, str(truth.x_m.dtype)
/// ((2, 4), 'float32')
#[pyclass(frozen, get_all, module = "uchain")]
pub(crate) struct Truth {
    /// Position in the map's frame (m), float32.
    x_m: Py<PyAny>,
    /// Position in the map's frame (m), float32.
    y_m: Py<PyAny>,
    /// Direction of the body's x axis, counter-clockwise from the map's x axis (rad), float32.
    heading_rad: Py<PyAny>,
    /// Forward speed over ground (m/s), float32.
    forward_mps: Py<PyAny>,
    /// Leftward speed over ground (m/s), float32.
    lateral_mps: Py<PyAny>,
    /// Yaw rate, counter-clockwise (rad/s), float32.
    yaw_rate_radps: Py<PyAny>,
    /// Loss without noise of the link whose front end it is (dB), as of the last decision, float32; NaN where it has none.
    true_db: Py<PyAny>,
    /// Whether it is in the air, bool.
    airborne: Py<PyAny>,
    /// Wall contacts begun so far, uint32.
    wall_contacts: Py<PyAny>,
    /// Contacts with other UAVs begun so far, uint32.
    uav_contacts: Py<PyAny>,
    /// Tunnel distance from the base to the head (m), as of the last decision, shape (worlds,), float32.
    head_reach_m: Py<PyAny>,
}

/// Numbers of each UAV, in the order of the names.
const FLOATS: usize = 7;

/// The numbers of all worlds, one after the other.
pub(super) struct Filling {
    floats: [Vec<f32>; FLOATS],
    airborne: Vec<bool>,
    contacts: [Vec<u32>; 2],
    head_reach_m: Vec<f32>,
}

impl Filling {
    pub(super) fn of(flights: &[Flight]) -> Self {
        let mut all = Self {
            floats: std::array::from_fn(|_| Vec::new()),
            airborne: Vec::new(),
            contacts: [Vec::new(), Vec::new()],
            head_reach_m: Vec::new(),
        };
        for flight in flights {
            let (chain, frame) = (flight.chain(), flight.frame());
            for (uav, body) in chain.world().bodies().iter().enumerate() {
                let link = frame.links.iter().find(|link| link.uav == uav);
                let floats = [
                    body.at.x,
                    body.at.y,
                    body.heading_rad(),
                    body.forward_mps(),
                    body.lateral_mps(),
                    body.yaw_rate_radps,
                    link.map_or(f32::NAN, |link| link.true_db),
                ];
                for (all, value) in all.floats.iter_mut().zip(floats) {
                    all.push(value);
                }
                all.airborne.push(body.airborne);
                for (all, count) in all.contacts.iter_mut().zip([body.wall_contacts, body.uav_contacts]) {
                    all.push(count);
                }
            }
            all.head_reach_m.push(frame.head_reach_m);
        }
        all
    }

    /// As arrays, a row for each world.
    pub(super) fn done(self, py: Python<'_>, uavs: usize) -> PyResult<Truth> {
        let Self { floats, airborne, contacts, head_reach_m } = self;
        let mut arrays = Vec::with_capacity(ARRAYS);
        for values in floats {
            arrays.push(array(py, values, Some(uavs))?);
        }
        arrays.push(array(py, airborne, Some(uavs))?);
        for values in contacts {
            arrays.push(array(py, values, Some(uavs))?);
        }
        arrays.push(array(py, head_reach_m, None)?);
        Truth::of(arrays)
    }
}

/// Arrays of [`Truth`].
const ARRAYS: usize = FLOATS + 4;

impl Truth {
    /// Of its arrays, in the order of its attributes.
    fn of(arrays: Vec<Py<PyAny>>) -> PyResult<Self> {
        let [
            x_m,
            y_m,
            heading_rad,
            forward_mps,
            lateral_mps,
            yaw_rate_radps,
            true_db,
            airborne,
            wall_contacts,
            uav_contacts,
            head_reach_m,
        ]: [Py<PyAny>; ARRAYS] = arrays.try_into().map_err(|arrays: Vec<_>| {
            PyValueError::new_err(format!("{} arrays: expected {ARRAYS}", arrays.len()))
        })?;
        Ok(Self {
            x_m,
            y_m,
            heading_rad,
            forward_mps,
            lateral_mps,
            yaw_rate_radps,
            true_db,
            airborne,
            wall_contacts,
            uav_contacts,
            head_reach_m,
        })
    }
}

#[pymethods]
impl Truth {
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Vec<Py<PyAny>>,))> {
        let (py, this) = (slf.py(), slf.get());
        let arrays = [
            &this.x_m,
            &this.y_m,
            &this.heading_rad,
            &this.forward_mps,
            &this.lateral_mps,
            &this.yaw_rate_radps,
            &this.true_db,
            &this.airborne,
            &this.wall_contacts,
            &this.uav_contacts,
            &this.head_reach_m,
        ];
        let arrays = arrays.into_iter().map(|array| array.clone_ref(py)).collect();
        Ok((slf.get_type().getattr("_unpickled")?, (arrays,)))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(_: &Bound<'_, PyType>, arrays: Vec<Py<PyAny>>) -> PyResult<Self> {
        Self::of(arrays)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<uchain.Truth of shape {}>", self.x_m.bind(py).getattr("shape")?))
    }
}
