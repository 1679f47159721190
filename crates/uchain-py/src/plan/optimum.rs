//! The best chain in a tunnel.

use numpy::PyArray1;
use pyo3::{exceptions::PyValueError, prelude::*};
use uchain_sim::{
    analyse::optimum::MOST_LINKS,
    mission::chain::{Course, PlanError},
};

use super::{
    arguments::{count, length},
    no_plan,
};
use crate::{
    errors::{self, ScenarioError},
    run::array,
    scenario::Scenario,
    work::off_the_lock,
};

/// The best chain in a tunnel: the one whose worst link is best, over all ordered places of its relays.
///
/// All lists begin at the head and end at the base.
///
/// >>> best = uchain.optimum("straight", head_depth_m=12, relays=2)
/// >>> best.relays, best.depths_m.shape, best.link_loss_db.shape
/// (2, (4,), (3,))
#[pyclass(frozen, get_all, module = "uchain")]
pub(crate) struct Optimum {
    /// Relays between head and base.
    relays: usize,
    /// The largest loss of a link (dB).
    bottleneck_db: f64,
    /// Depth of head, relays and base along the tunnel (m), falling to 0: shape (relays + 2,), float64.
    depths_m: Py<PyAny>,
    /// Where they are in the map's frame, that of `Run.frames` (m): shape (relays + 2, x and y), float32.
    places_m: Py<PyAny>,
    /// Loss of every link (dB), that to the base last: shape (relays + 1,), float64.
    link_loss_db: Py<PyAny>,
}

#[pymethods]
impl Optimum {
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (usize, f64, Py<PyAny>, Py<PyAny>, Py<PyAny>))> {
        let (py, this) = (slf.py(), slf.get());
        let arrays = [&this.depths_m, &this.places_m, &this.link_loss_db].map(|array| array.clone_ref(py));
        let [depths_m, places_m, link_loss_db] = arrays;
        let parts = (this.relays, this.bottleneck_db, depths_m, places_m, link_loss_db);
        Ok((slf.get_type().getattr("_unpickled")?, parts))
    }

    /// How pickle makes one.
    #[staticmethod]
    fn _unpickled(
        relays: usize,
        bottleneck_db: f64,
        depths_m: Py<PyAny>,
        places_m: Py<PyAny>,
        link_loss_db: Py<PyAny>,
    ) -> Self {
        Self { relays, bottleneck_db, depths_m, places_m, link_loss_db }
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Optimum {} relays, the worst link {:.2} dB>", self.relays, self.bottleneck_db)
    }
}

/// The best chain for a depth of the head: where its relays would stand (Laclau 2021, Eq. 1, 2 and 9 to 11), by someone who
/// knows map and radio. It is what runs are measured by, noise left out.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     A scenario of a chain.
/// head_depth_m : float, optional
///     How deep in the tunnel the head is (m, more than 0, at most the tunnel's length); by default as deep as the tunnel
///     is known.
/// relays : int, optional
///     How many relays there are; by default as many as keep every link within `takeoff.s_min_db`, or all that the
///     scenario has where no number does.
///
/// Returns
/// -------
/// Optimum
///
/// Raises
/// ------
/// ScenarioError
///     It is no chain, or nobody knows the middle of its tunnel.
/// ValueError
///     A depth or a number of relays that cannot be.
///
/// Examples
/// --------
/// >>> uchain.optimum("straight", head_depth_m=12, relays=1).bottleneck_db > 60
/// True
#[pyfunction]
#[pyo3(signature = (what, head_depth_m=None, relays=None))]
fn optimum(
    what: &Bound<'_, PyAny>,
    head_depth_m: Option<f64>,
    relays: Option<&Bound<'_, PyAny>>,
) -> PyResult<Optimum> {
    let py = what.py();
    let head_depth_m = length("head_depth_m", head_depth_m)?;
    let relays = count("relays", relays, 0, MOST_LINKS - 1)?;
    let scenario = Scenario::of(what)?;
    let scenario = scenario.get();
    let Some(course) = scenario.scene.get::<Course>() else {
        let message = format!("{} is no chain: an optimum is that of a chain", scenario.scene.name());
        return Err(ScenarioError::new_err(message));
    };
    let best = off_the_lock(py, |_| errors::caught(|| best(course, head_depth_m, relays)), |_| Ok(()))???;
    let (optimum, places_m) = best;
    Ok(Optimum {
        relays: optimum.link_loss_db.len() - 1,
        bottleneck_db: optimum.bottleneck_db,
        places_m: array(py, places_m, optimum.depths_m.len(), Some(2))?.unbind(),
        depths_m: PyArray1::from_vec(py, optimum.depths_m).into_any().unbind(),
        link_loss_db: PyArray1::from_vec(py, optimum.link_loss_db).into_any().unbind(),
    })
}

type Placed = (uchain_sim::analyse::optimum::Optimum, Vec<f32>);

fn best(course: &Course, head_depth_m: Option<f64>, relays: Option<usize>) -> PyResult<Placed> {
    let best = course.optimum().ok_or_else(|| no_plan(&PlanError::NoTunnel))?;
    let length_m = best.tunnel().length_m();
    let depth_m = head_depth_m.unwrap_or(length_m);
    // A centimetre of grace for a depth that was read off a rounded table.
    if depth_m > length_m + 0.01 {
        let message = format!("head_depth_m = {depth_m}: the tunnel ends {length_m:.2} m from the base");
        return Err(PyValueError::new_err(message));
    }
    let links = relays.map(|relays| relays + 1).or_else(|| best.links_needed(depth_m));
    let optimum = best.optimum(depth_m, links.unwrap_or(course.scenario.chain.uavs.max(1)));
    let places_m = optimum.depths_m.iter().flat_map(|&depth_m| best.tunnel().at(depth_m).0.to_array());
    let places_m = places_m.collect();
    Ok((optimum, places_m))
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Optimum>()?;
    module.add_function(wrap_pyfunction!(optimum, module)?)
}
