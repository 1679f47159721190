//! The emulated chip: an STM32F405 under QEMU, one tick of its timers per instruction.

use std::{
    io::Read,
    path::Path,
    process::{Child, Command, Stdio},
    thread,
    time::Duration,
};

use anyhow::{Context as _, Result, bail};

/// How often it is looked whether it has ended.
const LOOK: Duration = Duration::from_millis(20);

/// Runs an image on the chip, with the folder it reads and writes files in, and the words it is started with. What it
/// prints; an error if it ends badly, or not within `limit_s`.
pub(crate) fn run(image: &Path, folder: &Path, words: &[&str], limit_s: u64) -> Result<String> {
    let mut semihosting = String::from("enable=on,target=native,arg=image");
    for word in words {
        semihosting += ",arg=";
        semihosting += word;
    }
    let mut command = Command::new("qemu-system-arm");
    command.args(["-machine", "netduinoplus2", "-nographic", "-monitor", "none", "-serial", "none"]);
    command.args(["-icount", "shift=0", "-semihosting-config", &semihosting, "-kernel"]).arg(image);
    println!("$ qemu-system-arm {} {}", image.file_name().unwrap_or_default().display(), words.join(" "));
    end_within(command.current_dir(folder), limit_s)
}

/// What a program prints that has to end well, and soon enough.
fn end_within(command: &mut Command, limit_s: u64) -> Result<String> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let name = command.get_program().display().to_string();
    let mut child = command.spawn().with_context(|| format!("cannot start {name}"))?;
    // Read while it runs, or it would wait for room in the pipe.
    let (out, err) = (child.stdout.take().map(printed), child.stderr.take().map(printed));
    let looks = u128::from(limit_s) * 1000 / LOOK.as_millis();
    let ended = wait(&mut child, looks)?;
    if ended.is_none() {
        child.kill().with_context(|| format!("cannot end {name}"))?;
        child.wait()?;
    }
    let said =
        |stream: Option<thread::JoinHandle<String>>| stream.and_then(|it| it.join().ok()).unwrap_or_default();
    let (out, err) = (said(out), said(err));
    match ended {
        Some(status) if status.success() => Ok(out + &err),
        Some(status) => bail!("{name} ended with {status}\n{out}{err}"),
        None => bail!("{name} was still running after {limit_s} s\n{out}{err}"),
    }
}

fn wait(child: &mut Child, looks: u128) -> Result<Option<std::process::ExitStatus>> {
    for _ in 0..looks {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        thread::sleep(LOOK);
    }
    Ok(child.try_wait()?)
}

fn printed(mut stream: impl Read + Send + 'static) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        // What was read before an error is what there is.
        let _ = stream.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(line: &str, limit_s: u64) -> Result<String> {
        end_within(Command::new("sh").args(["-c", line]), limit_s)
    }

    #[test]
    fn a_program_that_ends_badly_or_not_at_all_is_an_error_with_what_it_printed() {
        assert_eq!(shell("echo one; echo two >&2", 10).unwrap(), "one\ntwo\n");
        let bad = shell("echo half; exit 3", 10).unwrap_err().to_string();
        assert!(bad.contains("exit status: 3") && bad.contains("half"), "{bad}");
        let endless = shell("echo half; exec sleep 60", 1).unwrap_err().to_string();
        assert!(endless.contains("still running after 1 s") && endless.contains("half"), "{endless}");
    }

    #[test]
    fn more_than_a_pipe_holds_is_read() {
        assert_eq!(shell("head -c 300000 /dev/zero", 10).unwrap().len(), 300_000);
    }
}
