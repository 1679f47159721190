//! The graph that explorers make of a building.

use pyo3::{
    exceptions::PyImportError,
    prelude::*,
    types::{PyDict, PyType},
};
use uchain_sim::mission;

use super::columns::{Columns, array};

/// A graph of places, as it is at the end of a run.
///
/// Of an exploration it is the sensor-based graph (Kim 2021, §5): a node for each scan, an edge for each way that is known
/// to be free. Places are in the map's frame, as those of frames are.
///
/// >>> hall = uchain.Scenario.from_name("apartment").with_(duration_s=10)
/// >>> graph = uchain.run(hall).graph
/// >>> graph.edges.shape[1], len(graph.lengths_m) == len(graph.edges)
/// (2, True)
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Graph {
    /// A row for each node: `robot` and `number` name it, `x_m` and `y_m` is where it is, `believed_x_m` and `believed_y_m`
    /// where its robot believed to be, `frontiers` how many of its sectors are unexplored still.
    #[pyo3(get)]
    nodes: Py<Columns>,
    /// Rows of `nodes` that are joined: shape (edges, 2), uint32.
    #[pyo3(get)]
    edges: Py<PyAny>,
    /// How far they are apart over ground (m): shape (edges,), float32.
    #[pyo3(get)]
    lengths_m: Py<PyAny>,
}

impl Graph {
    pub(super) fn of(py: Python<'_>, graph: mission::Graph) -> PyResult<Self> {
        let mission::Graph { nodes, edges, lengths_m } = graph;
        let count = edges.len();
        Ok(Self {
            nodes: Py::new(py, Columns::of(py, nodes)?)?,
            edges: array(py, edges.into_flattened(), count, Some(2))?.unbind(),
            lengths_m: array(py, lengths_m, count, None)?.unbind(),
        })
    }
}

#[pymethods]
impl Graph {
    /// The same as a `networkx.Graph`: nodes are rows of `nodes` with its columns as attributes, edges have `length_m`.
    ///
    /// Raises `ImportError` if networkx is not installed.
    fn to_networkx<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let networkx = py.import("networkx").map_err(|error| {
            let text = "networkx is not installed: pip install networkx, or pip install 'uchain[graph]'";
            let missing = PyImportError::new_err(text);
            missing.set_cause(py, Some(error));
            missing
        })?;
        let graph = networkx.call_method0("Graph")?;
        let nodes = self.nodes.get();
        let lists = PyDict::new(py);
        for (name, column) in nodes.arrays(py) {
            lists.set_item(name, column.call_method0("tolist")?)?;
        }
        for row in 0..nodes.rows() {
            let attributes = PyDict::new(py);
            for (name, column) in &lists {
                attributes.set_item(name, column.get_item(row)?)?;
            }
            graph.call_method("add_node", (row,), Some(&attributes))?;
        }
        let ends = self.edges.bind(py).call_method0("tolist")?;
        let lengths_m = self.lengths_m.bind(py).call_method0("tolist")?;
        for (ends, length_m) in ends.try_iter()?.zip(lengths_m.try_iter()?) {
            let attributes = PyDict::new(py);
            attributes.set_item("length_m", length_m?)?;
            let ends = ends?;
            graph.call_method("add_edge", (ends.get_item(0)?, ends.get_item(1)?), Some(&attributes))?;
        }
        Ok(graph)
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Py<Columns>, Py<PyAny>, Py<PyAny>))> {
        let (py, this) = (slf.py(), slf.get());
        let parts = (this.nodes.clone_ref(py), this.edges.clone_ref(py), this.lengths_m.clone_ref(py));
        Ok((slf.get_type().getattr("_unpickled")?, parts))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(_: &Bound<'_, PyType>, nodes: Py<Columns>, edges: Py<PyAny>, lengths_m: Py<PyAny>) -> Self {
        Self { nodes, edges, lengths_m }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (nodes, edges) = (self.nodes.get().rows(), self.edges.bind(py).len()?);
        Ok(format!("<uchain.Graph {nodes} nodes, {edges} edges>"))
    }
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Graph>()
}
