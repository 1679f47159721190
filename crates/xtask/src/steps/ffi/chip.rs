//! C on the emulated chip: the same bits, what the library brings into a program and what it does not, and how deep its
//! calls go into the stack.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail, ensure};

use super::{APP, ARM_CC, FOLDER, STRICT, ask, built, must_be_the_same, must_differ, sources};
use crate::{
    firmware::{chip, toolchain::Toolchain},
    house::{House, capture, read, run},
};

/// The Crazyflie's processor, and newlib as its firmware has it.
const CPU: [&str; 4] = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"];

/// How long the chip may take (s).
const LIMIT_S: u64 = 300;

/// What an app's task has for its stack unless its author says otherwise: 350 words.
const APP_STACK: usize = 350 * 4;
/// What a switch of tasks puts on it: all registers, those of the floating point unit as well.
const SWITCH: usize = 51 * 4;

/// What each call may take of the stack (bytes), as docs/guide/firmware.md says.
const STACK_MAX: [(&str, usize); 6] = [
    ("uchain_node_init", 1024),
    ("uchain_params_...", 512),
    ("uchain_hear", 256),
    ("uchain_say", 256),
    ("uchain_step", 768),
    ("uchain_explain", 768),
];
/// What the library may bring into a program that calls all of it (bytes).
const SIZE_MAX: usize = 24 * 1024;

pub(super) fn answers(house: &House, rust: Toolchain, recorded: &Path) -> Result<()> {
    let folder = built(house).join("on-chip");
    fs::create_dir_all(&folder)?;
    brings_no_more_than_it_has_to(house, rust, &folder)?;

    let object = object(house, rust, "", &folder)?;
    let on_chip = ["harness/main.c", "harness/abuse.c", "harness/chip/startup.c", "harness/chip/stack.c"];
    let harness = sources(house, FOLDER, &on_chip);
    let harness = link(house, &folder.join("harness.elf"), "crates/uchain-ffi/harness", harness, &object)?;
    let fly = |words: &[&str]| chip::run(&harness, &folder, words, LIMIT_S);
    print!("{}", fly(&["abuse"])?);
    ask(house, &folder, recorded)?;
    let said = fly(&["asked.bin", "replies.bin"])?;
    print!("{said}");
    must_be_the_same(house, &folder, "C on the chip")?;
    let taken = stacks(&said)?;
    for (call, most) in STACK_MAX {
        let bytes = taken.iter().find(|(name, _)| *name == call).map(|(_, bytes)| *bytes);
        let bytes = bytes.with_context(|| format!("nothing is said of the stack of {call}"))?;
        ensure!(bytes <= most, "{call} takes {bytes} bytes of the stack, and may take {most}");
    }
    fly(&["asked.bin", "replies.bin", "plant"])?;
    must_differ(house, &folder, "C on the chip")?;

    let app = sources(house, APP, &["src/uchain_app.c", "stubs/world.c"]).chain(sources(
        house,
        FOLDER,
        &["harness/chip/startup.c"],
    ));
    let app = link(house, &folder.join("crazyflie.elf"), "examples/crazyflie-app/stubs", app, &object)?;
    let said = chip::run(&app, &folder, &[], LIMIT_S)?;
    print!("{said}");
    let deepest = stacks(&said)?.first().map_or(0, |(_, bytes)| *bytes);
    ensure!(
        deepest + SWITCH <= APP_STACK,
        "the app takes {deepest} bytes of its stack, and a switch of tasks {SWITCH}: more than {APP_STACK}"
    );
    println!("the app's stack: {deepest} bytes, {SWITCH} for a switch of tasks, of {APP_STACK}");
    let deaf = chip::run(&app, &folder, &["deaf"], LIMIT_S).err().map(|error| error.to_string());
    ensure!(
        deaf.as_ref().is_some_and(|said| said.contains("not so: it takes off")),
        "the app without a radio has to stay on the ground, and says {deaf:?}"
    );
    Ok(())
}

/// What a call took of the stack, of what a program printed: `stack uchain_step 648 bytes`.
fn stacks(said: &str) -> Result<Vec<(&str, usize)>> {
    let line = |line: &'_ str| -> Option<(usize, usize)> {
        let (call, bytes) = line.strip_prefix("stack ")?.strip_suffix(" bytes")?.split_once(' ')?;
        Some((call.len(), bytes.parse().ok()?))
    };
    let found: Vec<_> = said
        .lines()
        .filter_map(|text| line(text).map(|(name, bytes)| (&text["stack ".len()..][..name], bytes)))
        .collect();
    if found.is_empty() {
        bail!("nothing is said of stacks:\n{said}");
    }
    Ok(found)
}

/// A program that calls every function, and nothing else, holds no panic, no text formatting, no heap and no double; the
/// control does.
fn brings_no_more_than_it_has_to(house: &House, rust: Toolchain, folder: &Path) -> Result<()> {
    let strays = |features: &str| -> Result<(Vec<String>, PathBuf)> {
        let object = object(house, rust, features, folder)?;
        let image = folder.join("bare.elf");
        let mut command = compiler();
        command.args(["-nostartfiles", "-Wl,--gc-sections,--no-warn-rwx-segments,-e,uchain_step"]);
        let header = fs::read_to_string(house.root.join(FOLDER).join("uchain.h"))?;
        let functions = functions(&header);
        ensure!(functions.len() > 5, "uchain.h declares {functions:?}");
        command.args(functions.iter().map(|name| format!("-Wl,-u,{name}")));
        run(command.args(["-z", "noexecstack"]).arg(&object).args(["-lm", "-o"]).arg(&image))?;
        let listing = read(Command::new("arm-none-eabi-nm").arg("--demangle").arg(&image))?;
        Ok((stray(&listing), image))
    };
    let (found, _) = strays("--features control")?;
    ensure!(
        found.iter().any(|name| name.contains("panic"))
            && found.iter().any(|name| name.contains("aeabi_dmul")),
        "the control panics and computes with doubles, and the check sees {found:?}"
    );
    println!("the control is caught: {} symbols of panics, text and doubles", found.len());
    let (found, image) = strays("")?;
    ensure!(found.is_empty(), "a program that calls the library holds {found:?}");
    let sizes = read(Command::new("arm-none-eabi-size").arg(&image))?;
    let size = |line: &str| line.split_whitespace().next()?.parse::<usize>().ok();
    let size = sizes.lines().nth(1).and_then(size).context("what does arm-none-eabi-size say?")?;
    println!("all of the library: {size} bytes, no panic, no text, no heap, no double");
    ensure!(size <= SIZE_MAX, "the library brings {size} bytes, and may bring {SIZE_MAX}");
    Ok(())
}

/// Names of the functions that a header declares.
fn functions(header: &str) -> Vec<&str> {
    let name = |line: &str| -> Option<usize> {
        let before = line.split_once('(')?.0;
        (!line.starts_with(['/', ' ', '#']) && !line.starts_with("typedef")).then_some(before.len())
    };
    let word = |line: &'_ str, end: usize| line[..end].rfind([' ', '*']).map_or(0, |at| at + 1)..end;
    header.lines().filter_map(|line| name(line).map(|end| &line[word(line, end)])).collect()
}

/// Symbols that tell of panics, of text, of a heap, or of doubles in software.
fn stray(listing: &str) -> Vec<String> {
    let names = listing.lines().filter_map(|line| line.splitn(3, ' ').nth(2));
    let is_stray = |name: &str| {
        let of_doubles = name.strip_prefix("__aeabi_").is_some_and(|rest| {
            rest.starts_with('d') || rest.ends_with("2d") // operations, and conversions to one
        });
        of_doubles
            || ["panic", "core::fmt", "rust_begin_unwind", "__rust_alloc", "malloc", "_sbrk", "df3"]
                .iter()
                .any(|word| name.contains(word))
    };
    names.filter(|name| is_stray(name)).map(str::to_owned).collect()
}

/// The library for the chip as one object, as the app's `Kbuild` makes it: the archive's one member of our own. The rest is
/// the compiler's functions, which newlib and libgcc bring under the same names.
fn object(house: &House, rust: Toolchain, features: &str, folder: &Path) -> Result<PathBuf> {
    let args = format!("build --locked --release --package uchain-ffi {features}");
    run(&mut rust.cargo(house, FOLDER, &args))?;
    let archive = folder.join("uchain.a");
    fs::copy(rust.built(house, FOLDER).join("libuchain_ffi.a"), &archive)
        .context("cannot copy the library for the chip")?;
    let members = capture(Command::new("arm-none-eabi-ar").arg("t").arg(&archive))?;
    let members = String::from_utf8_lossy(&members.stdout);
    let theirs = members.lines().filter(|name| !name.starts_with("uchain_ffi"));
    let mut drop = Command::new("arm-none-eabi-ar");
    ensure!(drop.arg("d").arg(&archive).args(theirs).status()?.success(), "arm-none-eabi-ar drops nothing");
    let object = folder.join("uchain.o");
    let mut link = Command::new("arm-none-eabi-ld");
    link.args(["-r", "-z", "noexecstack", "--whole-archive"]).arg(&archive).arg("-o").arg(&object);
    run(&mut link)?;
    Ok(object)
}

fn compiler() -> Command {
    let mut command = Command::new(ARM_CC);
    command.args(CPU).args(["--specs=nano.specs", "--specs=rdimon.specs"]);
    command
}

/// A program for the chip.
fn link(
    house: &House,
    to: &Path,
    includes: &str,
    sources: impl Iterator<Item = PathBuf>,
    object: &Path,
) -> Result<PathBuf> {
    let mut command = compiler();
    command.args(["-std=c99", "-O2", "-DON_CHIP", "-Wdouble-promotion", "-ffp-contract=off"]).args(STRICT);
    command.args(["-ffunction-sections", "-fdata-sections", "-nostartfiles", "-T"]);
    command.arg(house.root.join(FOLDER).join("harness/chip/chip.ld"));
    command.args(["-Wl,--gc-sections,--no-warn-rwx-segments", "-z", "noexecstack"]);
    for folder in [FOLDER, includes] {
        command.arg("-I").arg(house.root.join(folder));
    }
    run(command.args(sources).arg(object).args(["-lm", "-o"]).arg(to))?;
    Ok(to.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_text_heaps_and_doubles_are_told_from_what_a_node_needs() {
        let listing = "08000000 T uchain_step\n08000010 t libm::math::expf::expf\n08000020 T __aeabi_memcpy\n\
                       08000030 T __aeabi_fmul\n08000040 t core::panicking::panic_bounds_check\n\
                       08000050 T __aeabi_dmul\n08000060 T __aeabi_f2d\n08000070 T malloc\n08000080 t core::fmt::write\n";
        let found = stray(listing);
        let expected = [
            "core::panicking::panic_bounds_check",
            "__aeabi_dmul",
            "__aeabi_f2d",
            "malloc",
            "core::fmt::write",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn a_header_is_read_for_its_functions_and_a_run_for_its_stacks() {
        let header = "// uchain_no(\nuint8_t uchain_say(struct uchain_node *node,\n                   uint8_t *out);\n\
                      typedef char size[sizeof(int)];\nconst char *uchain_key(void);\n";
        assert_eq!(functions(header), ["uchain_say", "uchain_key"]);
        let said = "33000 steps\nstack uchain_step 648 bytes\nstack appMain 1104 bytes\n";
        assert_eq!(stacks(said).unwrap(), [("uchain_step", 648), ("appMain", 1104)]);
        assert!(stacks("33000 steps\n").is_err());
    }
}
