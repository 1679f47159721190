//! `uchain repro`: one row of a sweep, alone and recorded.

use uchain_sim::{
    registry::Registry,
    sweep::folder::{Folder, Known},
};

use super::Repro;
use crate::{exit::Failure, fly::KeptFlight, output};

pub(crate) fn repro(registry: Registry, asked: &Repro) -> Result<(), Failure> {
    let folder = Folder::open(&asked.folder)?.with_missions(registry);
    let sweep = folder.sweep()?;
    let Known { digest, failed } = folder.known(&sweep, asked.run)?;
    let run = sweep.run(asked.run);
    let scene = sweep.lay(run.variant)?;
    let file = folder.manifest().file.as_deref();
    let name = file.map_or_else(|| sweep.about().name.clone(), output::folder_name);
    let ours = || output::Folder::ours("runs", &name, &format!("-run{}", run.index));
    let flight =
        KeptFlight { seed: run.seed, folder: asked.out.folder(ours)?, is_recorded: true, say: &asked.say };
    let now = flight.fly(&*scene)?;
    // A row without a digest says why; now there is one.
    let then = digest.or(failed).unwrap_or_default();
    if then == now { Ok(()) } else { Err(Failure::DigestDiffers { run: run.index, then, now }) }
}
