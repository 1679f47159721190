//! Opens a page in the user's browser.

use std::{
    fs,
    path::Path,
    process::{Child, Command, Stdio},
    thread,
    time::Duration,
};

/// How often a program that opens pages is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// Looks until it is taken for the browser itself, which stays.
const LOOKS: u32 = 40;

/// Opens a page; why not, in words.
pub(super) fn open(file: &Path) -> Result<(), String> {
    // A browser starts in a folder of its own, and a name may begin with a dash.
    let file = fs::canonicalize(file).map_err(|error| error.to_string())?;
    let mut why = "nothing here opens pages".to_owned();
    for mut opener in open::commands(&file) {
        let name = opener.get_program().to_string_lossy().into_owned();
        match start(&mut opener).map(is_well) {
            Ok(true) => return Ok(()),
            Ok(false) => why = format!("{name} found no browser"),
            // The next one may be there.
            Err(_) => {}
        }
    }
    Err(why)
}

/// A browser talks a lot, and reads nothing from a terminal.
fn start(opener: &mut Command) -> std::io::Result<Child> {
    opener.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn()
}

/// Whether a program has ended well, or goes on.
fn is_well(mut opening: Child) -> bool {
    for _ in 0..LOOKS {
        match opening.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) => thread::sleep(LOOK),
            Err(_) => return false,
        }
    }
    true
}
