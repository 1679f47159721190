//! Recorded observations, flown on the chip and on the host: the same bits, and faults that are planted are found.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail, ensure};

use super::{WORKSPACE, chip, figures::Figures};
use crate::house::{House, capture, read, run};

/// How long the chip may take for one trace (s).
const LIMIT_S: u64 = 300;

/// Traces, each with the program that flies it.
const TRACES: [(&str, &str); 2] = [("chains", "chain"), ("team", "explore")];

/// Faults to plant, with the trace that has to show each.
const PLANTED: [(&str, &str); 3] = [("chains", "equalize"), ("chains", "reading"), ("team", "reading")];

/// Traces, and whoever flies and compares them.
pub(crate) struct Flights {
    /// Where traces and results are.
    folder: PathBuf,
    /// Where the chip's programs are.
    images: PathBuf,
    /// The host's program.
    host: PathBuf,
}

impl Flights {
    /// Has the simulator record what its UAVs see.
    pub(crate) fn record(house: &House, images: PathBuf) -> Result<Self> {
        run(&mut house.cargo_in(WORKSPACE, "build --locked --release --package host"))?;
        let folder = recorded(house)?;
        Ok(Self { folder, images, host: house.built(WORKSPACE).join("release/host") })
    }

    /// The chip, the host and the simulator come to the same bits; at how many ticks, and what the chip said of its costs.
    pub(crate) fn fly(&self, figures: &mut Figures) -> Result<u64> {
        let mut ticks = 0;
        for (trace, image) in TRACES {
            let chips = format!("{trace}.chip");
            let said = chip::run(
                &self.images.join(image),
                &self.folder,
                &[&format!("{trace}.trace"), &chips],
                LIMIT_S,
            )?;
            figures.read(&if image == "explore" { of_explorer(&said) } else { said });
            let compared = read(&mut self.compare(trace, &[&format!("{trace}.result"), &chips]))?;
            println!("{compared}");
            ticks += same_bits(&compared)?;
        }
        Ok(ticks)
    }

    fn compare(&self, trace: &str, results: &[&str]) -> Command {
        let mut command = Command::new(&self.host);
        command.arg(format!("{trace}.trace")).args(results).current_dir(&self.folder);
        command
    }

    /// The controls: one bit more in one place of the chip's flight, and half a trace.
    pub(crate) fn notice_what_is_planted(&self) -> Result<()> {
        for (trace, fault) in PLANTED {
            let image = TRACES.iter().find(|(name, _)| *name == trace).map_or("chain", |(_, image)| image);
            let planted = format!("{trace}.{fault}");
            let words = [&format!("{trace}.trace"), &planted, fault];
            chip::run(&self.images.join(image), &self.folder, &words.map(|word| word), LIMIT_S)?;
            let output = capture(&mut self.compare(trace, &[&planted]))?;
            let said = String::from_utf8_lossy(&output.stdout);
            ensure!(
                !output.status.success() && said.contains("other bits: "),
                "one ulp in {fault} of {trace} is not noticed:\n{said}{}",
                String::from_utf8_lossy(&output.stderr)
            );
            println!("fails as it must, one ulp up in {fault}:\n{}", said.trim());
            remove(&self.folder.join(&planted))?;
        }
        self.refuses_half_a_trace()
    }

    /// A chip that cannot go on is noticed as well.
    fn refuses_half_a_trace(&self) -> Result<()> {
        let (whole, half) = (self.folder.join("chains.trace"), self.folder.join("half.trace"));
        let bytes = fs::read(&whole).with_context(|| format!("cannot read {}", whole.display()))?;
        fs::write(&half, &bytes[..bytes.len().min(100_000) / 2])
            .with_context(|| format!("cannot write {}", half.display()))?;
        let flown =
            chip::run(&self.images.join("chain"), &self.folder, &["half.trace", "half.chip"], LIMIT_S);
        remove(&half)?;
        remove(&self.folder.join("half.chip"))?;
        match flown {
            Err(error) if error.to_string().contains("ends in the middle") => {
                println!("fails as it must: half a trace ends in the middle");
                Ok(())
            }
            Err(error) => Err(error.context("half a trace is refused, and for another reason")),
            Ok(_) => bail!("the chip flew half a trace and said nothing of it"),
        }
    }
}

/// Has the simulator record what its UAVs see; the folder of the traces.
pub(crate) fn recorded(house: &House) -> Result<PathBuf> {
    // The whole workspace, as in the step `examples`: same features, so that nothing compiles a second time.
    run(&mut house.cargo("build --locked --profile checked --workspace --examples"))?;
    let folder = house.target.join("chip");
    fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    run(Command::new(house.target.join("checked/examples/observed")).arg(&folder))?;
    Ok(folder)
}

fn remove(file: &Path) -> Result<()> {
    fs::remove_file(file).with_context(|| format!("cannot remove {}", file.display()))
}

/// What explorers cost is another line than what chains cost.
fn of_explorer(said: &str) -> String {
    said.lines()
        .map(
            |line| {
                if line.starts_with("stack ") { format!("explorer {line}\n") } else { format!("{line}\n") }
            },
        )
        .collect()
}

/// How many ticks were compared, where nothing differs.
fn same_bits(compared: &str) -> Result<u64> {
    let ticks = compared.lines().find_map(|line| {
        line.strip_prefix("same bits: ")?.strip_suffix(" ticks, 0 differences")?.parse().ok()
    });
    match ticks {
        Some(0) | None => bail!("nothing was compared:\n{compared}"),
        Some(ticks) => Ok(ticks),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_count_where_there_are_some_and_none_differs() {
        assert_eq!(same_bits("a: 5 ticks\nsame bits: 4800 ticks, 0 differences").unwrap(), 4800);
        for other in
            ["same bits: 0 ticks, 0 differences", "same bits: 9 ticks, 1 differences", "other bits", ""]
        {
            assert!(same_bits(other).is_err(), "{other}");
        }
    }

    #[test]
    fn an_explorers_stack_has_a_name_of_its_own() {
        assert_eq!(of_explorer("call say 1 2 3\nstack say 40\n"), "call say 1 2 3\nexplorer stack say 40\n");
    }
}
