//! `host [--plant equalize|reading] TRACE RESULT...` flies a trace natively and compares every result of it, of a chip or of
//! the simulator, with its own: commands and all that is believed, bit by bit. It ends with 1 if anything differs.

mod compare;
#[cfg(test)]
mod tests;

use std::{
    env,
    fs::File,
    io::{BufReader, Read},
    path::Path,
    process::ExitCode,
};

use replay::{Input, Output, Plant, Short, Unmetered, replay};

use compare::{Differences, compare};

const USAGE: &str = "expected: host [--plant equalize|reading] TRACE RESULT...";

/// Bytes of a file.
struct Bytes<R>(R);

impl<R: Read> Input for Bytes<R> {
    fn read(&mut self, into: &mut [u8]) -> Result<(), Short> {
        self.0.read_exact(into).map_err(|_| Short)
    }
}

/// Bytes in memory that do not count as taken by what is flown.
#[derive(Default)]
struct Uncounted(Vec<u8>);

impl Output for Uncounted {
    fn write(&mut self, bytes: &[u8]) {
        allocation_counter::opt_out(|| self.0.extend_from_slice(bytes));
    }
}

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    match run(&args) {
        Ok(found) if found.rows == 0 => {
            println!("same bits: {} ticks, 0 differences", found.ticks);
            ExitCode::SUCCESS
        }
        Ok(found) => {
            println!("other bits: {} ticks, {} differences", found.ticks, found.rows);
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Compares all results; what differs in any of them.
fn run(args: &[String]) -> Result<Differences, String> {
    let (plant, files) = match args {
        [option, word, files @ ..] if option == "--plant" => match word.as_str() {
            "equalize" => (Plant::Equalize, files),
            "reading" => (Plant::Reading, files),
            _ => return Err(format!("--plant {word}: {USAGE}")),
        },
        files => (Plant::None, files),
    };
    let [trace, results @ ..] = files else { return Err(USAGE.to_owned()) };
    if results.is_empty() {
        return Err(USAGE.to_owned());
    }
    let (mut input, mut ours) = (open(trace)?, Uncounted::default());
    let mut flown = None;
    let heap = allocation_counter::measure(|| {
        flown = Some(replay(&mut input, &mut ours, &mut Unmetered, plant));
    });
    flown.transpose().map_err(|fault| format!("{trace}: {fault}"))?;
    println!("{trace}: {} bytes of the host's heap at most", heap.bytes_max);
    let mut all = Differences::default();
    for result in results {
        let found = compare(&mut ours.0.as_slice(), &mut open(result)?)
            .map_err(|unlike| format!("{result}: {unlike}"))?;
        println!(
            "{result}: {} ticks, {} differences: {} commands, {} states",
            found.ticks, found.rows, found.commands, found.states
        );
        if let Some(first) = &found.first {
            println!("{result}: first {first}");
        }
        all.ticks = found.ticks;
        all.rows += found.rows;
    }
    Ok(all)
}

fn open(path: &str) -> Result<Bytes<BufReader<File>>, String> {
    let file = File::open(Path::new(path)).map_err(|error| format!("{path}: {error}"))?;
    Ok(Bytes(BufReader::new(file)))
}
