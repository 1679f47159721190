//! A picture, as notebooks and files want it.

use std::path::{Path, PathBuf};

use pyo3::{exceptions::PyValueError, prelude::*, types::PyBytes};

/// A PNG picture. Notebooks show it; `bytes(picture)` is the file.
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Picture(Py<PyBytes>);

impl Picture {
    pub(crate) fn of(py: Python<'_>, png: &[u8]) -> Self {
        Self(PyBytes::new(py, png).unbind())
    }

    /// Into a file.
    pub(crate) fn write(&self, py: Python<'_>, path: &Path) -> PyResult<()> {
        let bytes = self.0.as_bytes(py);
        py.detach(|| std::fs::write(path, bytes)).map_err(|cause| {
            let text = format!("{}: cannot write the picture: {cause}", path.display());
            std::io::Error::new(cause.kind(), text).into()
        })
    }
}

/// What a PNG begins with.
const BEGINNING: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

#[pymethods]
impl Picture {
    #[new]
    #[pyo3(signature = (png, /))]
    fn new(png: Py<PyBytes>, py: Python<'_>) -> PyResult<Self> {
        if png.as_bytes(py).len() < 24 || !png.as_bytes(py).starts_with(&BEGINNING) {
            return Err(PyValueError::new_err("expected the bytes of a PNG picture"));
        }
        Ok(Self(png))
    }

    /// Width and height (pixels).
    #[getter]
    fn size_px(&self, py: Python<'_>) -> (u32, u32) {
        // The first chunk of a PNG says so, at a fixed place.
        let number = |from: usize| {
            let bytes = self.0.as_bytes(py).get(from..from + 4).and_then(|bytes| bytes.try_into().ok());
            u32::from_be_bytes(bytes.unwrap_or_default())
        };
        (number(16), number(20))
    }

    /// Writes the picture into a file, whatever was there before.
    ///
    /// Raises `OSError` if that cannot be done.
    #[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.write(py, &path)
    }

    fn __bytes__(&self, py: Python<'_>) -> Py<PyBytes> {
        self.0.clone_ref(py)
    }

    fn _repr_png_(&self, py: Python<'_>) -> Py<PyBytes> {
        self.0.clone_ref(py)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (Py<PyBytes>,)) {
        (slf.get_type().into_any(), (slf.get().0.clone_ref(slf.py()),))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let py = other.py();
        other.cast::<Self>().is_ok_and(|other| self.0.as_bytes(py) == other.get().0.as_bytes(py))
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        self.0.bind(py).hash()
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let (width, height) = self.size_px(py);
        format!("<uchain.Picture {width} x {height} px, {} bytes>", self.0.as_bytes(py).len())
    }
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Picture>()
}
