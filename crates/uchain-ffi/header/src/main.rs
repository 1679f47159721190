//! Writes `uchain.h` to the file it is told, out of the sources of `uchain-ffi`.

use std::{env, path::Path, process::ExitCode};

fn main() -> ExitCode {
    let Some(to) = env::args_os().nth(1) else {
        eprintln!("which file? cargo run -- ../uchain.h");
        return ExitCode::from(2);
    };
    let ffi = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let config = match cbindgen::Config::from_file(ffi.join("cbindgen.toml")) {
        Ok(config) => config,
        Err(error) => {
            eprintln!("cbindgen.toml: {error}");
            return ExitCode::FAILURE;
        }
    };
    // The one file and its modules: cargo need not be asked what the crate depends on.
    match cbindgen::Builder::new().with_config(config).with_src(ffi.join("src/lib.rs")).generate() {
        Ok(header) => {
            header.write_to_file(to);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
