//! Where the rows of a sweep are: in a folder, or in memory.

use crate::{
    analyse::{Cell, Column},
    sweep::{
        Sweep,
        folder::{Folder, FolderError, Manifest, Totals},
    },
};

/// Cells in order, some thousands at a time.
pub type Groups<'a> = Box<dyn Iterator<Item = Result<Vec<Cell>, FolderError>> + 'a>;

/// The rows of a complete sweep, wherever they are.
pub trait Rows {
    /// What is flown.
    fn manifest(&self) -> &Manifest;

    /// All cells of a column of scalars.
    ///
    /// # Errors
    /// They cannot be read, now or later.
    fn cells<'a>(&'a self, column: &Column) -> Result<Groups<'a>, FolderError>;

    /// What all runs came to.
    ///
    /// # Errors
    /// What is there cannot be read.
    fn totals(&self, sweep: &Sweep) -> Result<Totals, FolderError>;
}

impl Rows for Folder {
    fn manifest(&self) -> &Manifest {
        Self::manifest(self)
    }

    fn cells<'a>(&'a self, column: &Column) -> Result<Groups<'a>, FolderError> {
        Ok(Box::new(self.column(column)?))
    }

    fn totals(&self, sweep: &Sweep) -> Result<Totals, FolderError> {
        Self::totals(self, sweep)
    }
}
