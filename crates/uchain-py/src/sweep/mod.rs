//! Sweeps, many runs of a scenario: what `uchain sweep` does, in memory or into its folder.

mod arguments;
mod arrow;
mod columns;
mod design;
mod html;
mod progress;
mod report;
mod table;

use std::path::{Path, PathBuf};

use pyo3::{exceptions::PyValueError, prelude::*};
use uchain_sim::{
    config::Source,
    sweep::{
        Design, DesignText, Sweep,
        folder::{Folder, FolderError, Job, Manifest, Record, Shard},
        on_threads, table as rows,
    },
};

use crate::{
    errors,
    own_law::{LawFlyer, OwnLaw},
    registry,
    run::Seed,
    scenario::Scenario,
    work::off_the_lock_until,
};
use arguments::{Part, Recorded, Replicates, Threads};
use progress::{Counting, Counts, Progress, Teller, Told};
use report::Report;
use table::Table;

/// What is flown, and where to.
struct Asked {
    source: Source,
    sets: Vec<String>,
    text: DesignText,
    label: String,
    replicates: u64,
    seed: u64,
    threads: Option<usize>,
    shard: Shard,
    out: Option<PathBuf>,
    resume: bool,
    record: Record,
}

/// Flies many runs of a scenario: every combination of what is varied, each as often as there are replicates.
///
/// The same as `uchain sweep`, and the same rows to the last bit, for any number of threads, in shards, after an interrupt.
/// The runs of a replicate have the same random numbers in all variants. A run that fails is a row that says why. The
/// interpreter's lock is free meanwhile; Ctrl-C ends a sweep within a second.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     The name of a scenario that comes along, the path of a file, or a scenario.
/// vary : dict, optional
///     Keys, and the values that each takes: a list, an array, or the text of the command line (`"1,3,5"`, or a range with
///     both ends, `"0..5/6"`). What comes last changes fastest.
/// design : path, dict of columns, list of dicts or data frame, optional
///     Variants row by row, columns named by keys: a CSV file, or whatever has `__arrow_c_stream__`. None, or an empty
///     cell, leaves the scenario's own value. With `vary` as well, every row is flown with every combination of that.
/// replicates : int
///     Runs of every variant, each with a seed of its own. At most 10,000,000 runs in all.
/// seed : int
///     Root seed, from 0 to 2**64 - 1: that of every run follows from it and the replicate.
/// threads : int, optional
///     Runs at one time, from 1 to 1024; by default one for every processor.
/// shard : (int, int), optional
///     `(number, of)`: only that part of the runs, for executors and other computers. `concat` puts parts together.
/// progress : bool or callable
///     Whether a line on the standard error output says how far it has come, or a function that is given a `Progress` now
///     and then, and at the end. What it raises ends the sweep.
/// out : path, optional
///     A folder for `sweep.json` and `runs.parquet`, those of `uchain sweep`. What is flown is kept there as it comes;
///     otherwise all is in memory.
/// resume : bool
///     Go on with the sweep in `out`; what is done stays.
/// record : "none", "failed" or "all"
///     Which runs leave a recording in `out`.
/// law : callable, optional
///     What levels the relays of a chain in place of the built-in law, as in `run`: `law(seen) -> forward_mps`, an object with
///     `start`, or `uchain.batched(law)`, for which up to 256 runs fly side by side. A run whose law raises or returns no
///     number is a row whose column `failed` says so. Runs on other threads wait while a law has the interpreter's lock. Not
///     with `out`: nobody can tell on resuming whether it is the same law; `Table.to_parquet` keeps the rows.
///
/// Returns
/// -------
/// Table
///
/// Raises
/// ------
/// ScenarioError
///     A scenario, or a variant of it, that cannot be flown; nothing is flown then.
/// SweepError
///     A design that is none, too many runs, a folder that holds something else or is damaged.
/// OSError
///     A file that cannot be read or written; what was flown stays in `out`, and `resume=True` goes on.
/// ValueError, TypeError
///     An argument that is none of these.
///
/// Examples
/// --------
/// >>> straight = uchain.Scenario.from_name("straight").with_(duration_s=5)
/// >>> table = uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=3, progress=False)
/// >>> table
/// <uchain.Table straight: 6 runs, ... columns>
/// >>> table == uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=3, threads=1, progress=False)
/// True
#[pyfunction]
#[pyo3(signature = (
    what,
    vary=None,
    *,
    design=None,
    replicates=Replicates(30),
    seed=Seed(0),
    threads=Threads(None),
    shard=Part::WHOLE,
    progress=Told::People,
    out=None,
    resume=false,
    record=Recorded(Record::None),
    law=None,
))]
#[pyo3(
    text_signature = "(what, vary=None, *, design=None, replicates=30, seed=0, threads=None, shard=None, \
                         progress=True, out=None, resume=False, record='none', law=None)"
)]
#[expect(clippy::too_many_arguments, reason = "the arguments of the command line")]
fn sweep(
    py: Python<'_>,
    what: &Bound<'_, PyAny>,
    vary: Option<&Bound<'_, PyAny>>,
    design: Option<&Bound<'_, PyAny>>,
    replicates: Replicates,
    seed: Seed,
    threads: Threads,
    shard: Part,
    progress: Told,
    out: Option<PathBuf>,
    resume: bool,
    record: Recorded,
    law: Option<&Bound<'_, PyAny>>,
) -> PyResult<Table> {
    let flyer = law.map(OwnLaw::of).transpose()?.map(LawFlyer::new);
    if flyer.is_some() && out.is_some() {
        return Err(PyValueError::new_err(
            "law with out=: nobody can tell on resuming whether it is the same law; expected a sweep in memory, whose \
             rows Table.to_parquet keeps",
        ));
    }
    if out.is_none() && (resume || record.0 != Record::None) {
        let name = if resume { "resume=True" } else { "record" };
        return Err(PyValueError::new_err(format!("{name} needs a folder: expected out=, too")));
    }
    let (source, sets) = Scenario::read(what)?;
    let (text, label) = design::read(vary, design)?;
    let asked = Asked {
        source,
        sets,
        text,
        label,
        replicates: replicates.0,
        seed: seed.0,
        threads: threads.0,
        shard: shard.0,
        out,
        resume,
        record: record.0,
    };
    let counts = Counts::default();
    let mut teller = Teller::new(&counts, progress);
    let flown = off_the_lock_until(
        py,
        |stop| errors::caught(|| fly(asked, &counts, &Counting { counts: &counts, stop }, flyer.as_ref())),
        |py| teller.tell(py),
        |py| flyer.iter().for_each(|flyer| flyer.interrupt(py)),
    );
    let table = flown.and_then(|flown| flown?.map_err(errors::sweep));
    // What a law raised says more than that the sweep was stopped.
    let table = table.map_err(|error| flyer.as_ref().and_then(LawFlyer::take).unwrap_or(error));
    match table {
        Ok(table) => teller.end(py).map(|()| Table::of(table)),
        Err(error) => {
            teller.give_up(py);
            Err(error)
        }
    }
}

/// Checks and flies, in memory or into a folder.
fn fly(
    asked: Asked,
    counts: &Counts,
    watch: &Counting<'_>,
    flyer: Option<&LawFlyer>,
) -> Result<rows::Table, FolderError> {
    let Asked { source, sets, text, label, replicates, seed, threads, shard, out, resume, record } = asked;
    let design = Design::parse(&text, &label)?;
    let scenes = source.folder.clone();
    let sweep = Sweep::of(registry(), source, sets, design, replicates, seed)?;
    counts.expect(shard.runs(&sweep));
    on_threads(threads, || match out {
        None => match flyer {
            Some(flyer) => rows::Table::fly_by(&sweep, &scenes, shard, watch, flyer),
            None => rows::Table::fly(&sweep, &scenes, shard, watch),
        },
        Some(out) => fly_into(&out, &sweep, &scenes, resume, Job { shard, record, watch }),
    })?
}

fn fly_into(
    out: &Path,
    sweep: &Sweep,
    scenes: &Path,
    resume: bool,
    job: Job<'_>,
) -> Result<rows::Table, FolderError> {
    let walls = sweep.check_until(&|| job.watch.stop())?.ok_or(FolderError::Interrupted)?;
    let folder = Folder::begin(out, Manifest::of(sweep, walls), scenes, resume)?.with_missions(registry());
    // From here on as the folder has it: a row says nothing of where the files lie that were read.
    let sweep = folder.sweep()?;
    folder.fly(&sweep, job)?;
    folder.finish(&sweep)?;
    rows::Table::read(&folder)
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Table>()?;
    module.add_class::<Report>()?;
    module.add_class::<Progress>()?;
    module.add_function(wrap_pyfunction!(sweep, module)?)?;
    module.add_function(wrap_pyfunction!(table::open_sweep, module)?)?;
    module.add_function(wrap_pyfunction!(table::concat, module)?)
}
