//! `uchain map convert`: the same map as another kind of file; what `make` writes goes the same way.

use std::path::{Path, PathBuf};

use uchain_sim::{
    map::{
        Map,
        write::{RosCells, write_csv, write_geojson, write_svg},
    },
    registry::Registry,
};

use super::args::Convert;
use crate::{
    exit::Failure,
    output::{file, inputs},
    waiting::spinner,
};

pub(super) fn convert(registry: Registry, asked: &Convert) -> Result<(), Failure> {
    let waiting = spinner(!asked.quiet.is_quiet(), "converting");
    let map = super::read(registry, &asked.read)?;
    let inputs = inputs(&asked.read.what);
    let written = Written::of(&map, &asked.out, asked.out_cell)?;
    written.write(&inputs, asked.force)?;
    waiting.finish_and_clear();
    asked.quiet.report(|| {
        let remarks = map.import().remarks.iter().map(|remark| remark.to_string() + "\n");
        remarks.collect::<String>() + &written.words
    })
}

/// A map as files, in the order in which they are to appear.
pub(super) struct Written {
    files: Vec<(PathBuf, Vec<u8>)>,
    /// What there is to say of them.
    pub(super) words: String,
    /// The one to give to other commands.
    pub(super) main: PathBuf,
}

impl Written {
    /// The kind is told by the end of the name.
    pub(super) fn of(map: &Map, out: &Path, cell_m: Option<f64>) -> Result<Self, Failure> {
        let end = out.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let is_ros = ["yaml", "yml", "pgm", "png"].contains(&end.as_str());
        if cell_m.is_some() && !is_ros {
            return Err(Failure::Usage(format!(
                "--out-cell is for maps in cells (.yaml, .pgm, .png); {} has walls as lines",
                out.display()
            )));
        }
        let one = |text: String, words: String| {
            let words = format!("{}: {words}\n", out.display());
            Self { files: vec![(out.to_owned(), text.into_bytes())], words, main: out.to_owned() }
        };
        match end.as_str() {
            _ if is_ros => Self::ros(map, out, &end, cell_m),
            "csv" => {
                let (text, left_out) = write_csv(map);
                let mut words =
                    format!("walls as a table of {} corners", text.lines().count().saturating_sub(1));
                if left_out > 0 {
                    words += "; ";
                    words += &left_out.to_string();
                    words += " loops of walls are not in it: a table holds one outer wall and what stands within it";
                }
                Ok(one(text, words))
            }
            "svg" => Ok(one(write_svg(map), "walls as outlines, to draw on in Inkscape".to_owned())),
            "geojson" | "json" => Ok(one(write_geojson(map), "walls as polygons, for a GIS".to_owned())),
            _ => Err(Failure::Usage(format!(
                "{}: expected a name that ends in .yaml, .pgm, .png, .svg, .geojson or .csv",
                out.display()
            ))),
        }
    }

    fn ros(map: &Map, out: &Path, end: &str, cell_m: Option<f64>) -> Result<Self, Failure> {
        let cells =
            RosCells::of(map, cell_m).map_err(|error| Failure::Usage(format!("--out-cell: {error}")))?;
        let is_yaml = end.starts_with('y');
        let (yaml, picture) = if is_yaml {
            (out.to_owned(), out.with_extension("pgm"))
        } else {
            (out.with_extension("yaml"), out.to_owned())
        };
        let name = picture.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = if end == "png" { cells.png() } else { cells.pgm() };
        let [cols, rows] = cells.size();
        let mut words = format!(
            "{} and {name}: {cols} × {rows} cells of {} m; walls lie within {} m of where they were\n",
            yaml.display(),
            cells.cell_m(),
            cells.cell_m() / 2.0,
        );
        if cells.thickened() > 0 {
            words += &cells.thickened().to_string();
            words += " cells are rock because it is thinner than a cell there; a smaller --out-cell keeps it thin\n";
        }
        // The yaml last: it never names a picture that is not there.
        let files = vec![(picture, bytes), (yaml.clone(), cells.yaml(&name).into_bytes())];
        Ok(Self { files, words, main: yaml })
    }

    /// Writes all files, or none.
    pub(super) fn write(&self, inputs: &[PathBuf], force: bool) -> Result<(), Failure> {
        file::write(&self.files, inputs, force)
    }
}
