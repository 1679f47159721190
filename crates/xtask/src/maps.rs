//! What becomes of every map file of others that is at hand, as a table in the docs: read, planned, flown. The files are
//! in a folder beside the project, not in it.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    time::Duration,
};

use anyhow::{Context as _, Result, ensure};
use serde_json::Value;

use crate::house::{House, run};

/// Folders in the folder beside the project.
const FOLDERS: [&str; 3] = ["maps", "caves", "subt"];
/// Ends of the names of map files. A picture that a yaml file names is read with that.
const ENDS: [&str; 7] = ["map", "yaml", "pgm", "png", "3d", "tsv", "dot"];
/// What some files need to be said, for they do not say it themselves; a file may stand here more than once.
const SAID: [(&str, &[&str], &str); 3] = [
    ("willow-full-0.05.pgm", &["--cell", "0.05"], "a bare picture; its name says 0.05 m"),
    ("DowProv.3d", &[], "all of it"),
    ("DowProv.3d", &["--from", "dowcave.entrance", "--to", "dow1.12"], "the way to a station"),
];
/// Longest that one command may take.
const PATIENCE: Duration = Duration::from_secs(120);
/// Between two looks whether it has ended.
const LOOK: Duration = Duration::from_millis(20);
/// Flights per plan.
const FLIGHTS: &str = "3";
/// The page.
const PAGE: &str = "docs/map-table.md";

/// Makes the page, by a `uchain` that is built already or by one that is built now.
pub(crate) fn maps(house: &House, uchain: Option<&Path>) -> Result<()> {
    let data = house.root.join("../shared/data");
    ensure!(data.is_dir(), "{}: the maps of others are not here", data.display());
    let built = house.target.join("release/uchain");
    let uchain = match uchain {
        Some(uchain) => std::path::absolute(uchain)?,
        None => run(&mut house.cargo("build --release --locked --bin uchain")).map(|()| built)?,
    };
    let mut page = String::from(HEAD);
    for folder in FOLDERS {
        for file in files(&data.join(folder))? {
            let name = file.strip_prefix(&data)?.display().to_string();
            let own = file.file_name().unwrap_or_default().to_string_lossy();
            let said: Vec<_> =
                SAID.iter().filter(|(of, ..)| *of == own).map(|(_, args, why)| (*args, *why)).collect();
            let said = if said.is_empty() { vec![(&[][..], "")] } else { said };
            for (args, why) in said {
                let row = Row::of(&uchain, &file, args)?;
                println!("{name}: {}", row.outcome);
                page += &row.line(&name, args, why);
            }
        }
    }
    fs::write(house.root.join(PAGE), page).with_context(|| format!("cannot write {PAGE}"))
}

const HEAD: &str = "\
# Maps of others

Every map file that was at hand and that nobody wrote for this project: what `uchain map info` says of it, what `uchain plan` plans in
it, and what became of the plan in the air (`--fly 3`: seeds 1 to 3, their median; a command has 120 s). The files keep their own licences and are not in the
project: MovingAI grids (Sturtevant 2012), ROS maps of f1tenth_simulator and of Willow Garage, the Dow cave (CPC, WRCPC,
RRCPC) and the worlds of the DARPA Subterranean Challenge. `cargo xtask maps` makes this page again where they are.

Base and goal are what `uchain map info` proposes: in the connected piece that is largest of what a UAV fits through,
the two ends of passages that are farthest from each other along the way. Everything else is left to the defaults.

| file | read as | size (m), walls | dropped, guessed, merged, separated | base → goal, way (m) | planned | flown | outcome |
|---|---|---|---|---|---|---|---|
";

/// What became of a file.
#[derive(Default)]
struct Row {
    format: String,
    size: String,
    remarks: String,
    ends: String,
    planned: String,
    flown: String,
    outcome: String,
}

impl Row {
    fn of(uchain: &Path, file: &Path, args: &[&str]) -> Result<Self> {
        let mut row = Self::default();
        let info =
            match answer(Command::new(uchain).args(["map", "info", "--json"]).arg(file).args(args), file)? {
                Ok(info) => info,
                Err(why) => {
                    row.outcome = format!("not read: {why}");
                    return Ok(row);
                }
            };
        row.format = info["format"].as_str().map(str::to_owned).unwrap_or_default();
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        row.size = format!(
            "{:.0} × {:.0}, {}",
            number(&info["size_m"][0]),
            number(&info["size_m"][1]),
            info["walls"]
        );
        let remarks =
            info["remarks"].as_array().into_iter().flatten().filter(|remark| remark["kind"] != "read");
        let words = remarks.map(|remark| {
            let text = |key: &str| remark[key].as_str().unwrap_or_default().to_owned();
            format!("{} {} {}", text("kind"), remark["count"], text("what"))
        });
        row.remarks = words.collect::<Vec<_>>().join("; ");
        let ends = &info["ends"];
        if ends.is_null() {
            row.outcome += "read; no two places to plan between";
            return Ok(row);
        }
        let place = |key: &str| format!("{},{}", number(&ends[key][0]), number(&ends[key][1]));
        let (base, goal) = (place("base_m"), place("goal_m"));
        row.ends = format!("{base} → {goal}, {:.0}", number(&ends["way_m"]));
        row.plan(uchain, file, args, &[format!("--base={base}"), format!("--goal={goal}")])?;
        Ok(row)
    }

    fn plan(&mut self, uchain: &Path, file: &Path, args: &[&str], ends: &[String; 2]) -> Result<()> {
        let folder = std::env::temp_dir().join(format!("uchain-maps-{}", std::process::id()));
        let command = |more: &[&str]| {
            let mut command = Command::new(uchain);
            command
                .args(["plan", "--json", "--force", "--out"])
                .arg(&folder)
                .arg(file)
                .args(args)
                .args(ends)
                .args(more);
            command
        };
        match answer(&mut command(&[]), file)? {
            Err(why) => self.outcome = format!("read, not planned: {why}"),
            Ok(plan) => {
                let length_m = plan["tunnel_m"].as_f64().unwrap_or(f64::NAN);
                self.planned = match plan["uavs_needed"].as_u64() {
                    Some(uavs) => format!("{} relays for {length_m:.0} m", uavs.saturating_sub(1)),
                    None => format!("no number of relays holds {length_m:.0} m"),
                };
                self.outcome += "planned";
                match answer(&mut command(&["--fly", FLIGHTS]), file)? {
                    Err(why) => self.outcome = format!("planned, not flown: {why}"),
                    Ok(plan) => self.fly(&plan["flown"], length_m),
                }
            }
        }
        let _ = fs::remove_dir_all(folder);
        Ok(())
    }

    fn fly(&mut self, flown: &Value, length_m: f64) {
        let median = &flown["median"];
        let Some(reach_m) = median["reach_m"].as_f64() else { return };
        self.flown = format!("{reach_m:.0} m, {} relays, {} contacts", median["relays"], median["contacts"]);
        let ends: Vec<&str> =
            flown["runs"].as_array().into_iter().flatten().filter_map(|run| run["ended"].as_str()).collect();
        let mut kinds = ends.clone();
        kinds.sort_unstable();
        kinds.dedup();
        let said = |kind: &&str| {
            let count = ends.iter().filter(|end| *end == kind).count();
            format!("{count} {}", kind.replace('-', " "))
        };
        let said: Vec<String> = kinds.iter().map(said).collect();
        self.outcome = format!("flown {:.0} % of the way: {}", 100.0 * reach_m / length_m, said.join(", "));
    }

    fn line(&self, name: &str, args: &[&str], why: &str) -> String {
        let said = if args.is_empty() { String::new() } else { format!("<br>`{}`: {why}", args.join(" ")) };
        let mut line = format!("| {name}{said} ");
        for cell in
            [&self.format, &self.size, &self.remarks, &self.ends, &self.planned, &self.flown, &self.outcome]
        {
            // Writing to a String cannot fail.
            let _ = write!(line, "| {} ", cell.replace('|', "\\|"));
        }
        line + "|\n"
    }
}

/// The JSON that a command prints, or in words why there is none.
fn answer(command: &mut Command, file: &Path) -> Result<Result<Value, String>> {
    let Some(output) = patiently(command)? else {
        return Ok(Err(format!("no answer within {} s", PATIENCE.as_secs())));
    };
    if output.status.success() {
        return Ok(Ok(serde_json::from_slice(&output.stdout)?));
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let error =
        said.lines().find_map(|line| line.strip_prefix("error: ")).unwrap_or("it ended without a word");
    // Paths are of the machine that made the page.
    let folder = file.parent().unwrap_or(Path::new("")).display().to_string() + "/";
    Ok(Err(error.replace(&folder, "")))
}

/// What a command leaves, unless it takes too long.
fn patiently(command: &mut Command) -> Result<Option<Output>> {
    // Into files: a full pipe would stop it.
    let folder = std::env::temp_dir();
    let paths = ["out", "err"].map(|end| folder.join(format!("uchain-maps-{}.{end}", std::process::id())));
    let [out, err] = [fs::File::create(&paths[0])?, fs::File::create(&paths[1])?];
    let mut child = command.stdin(Stdio::null()).stdout(out).stderr(err).spawn()?;
    let mut looks = PATIENCE.as_millis() / LOOK.as_millis();
    let status = loop {
        looks = looks.saturating_sub(1);
        match child.try_wait()? {
            Some(status) => break Some(status),
            None if looks == 0 => {
                child.kill()?;
                child.wait()?;
                break None;
            }
            None => std::thread::sleep(LOOK),
        }
    };
    let [stdout, stderr] = [fs::read(&paths[0])?, fs::read(&paths[1])?];
    for path in paths {
        fs::remove_file(path)?;
    }
    Ok(status.map(|status| Output { status, stdout, stderr }))
}

/// Map files below a folder, sorted; pictures that a yaml file beside them is about are left out.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(files(&path)?);
            continue;
        }
        let end = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        let is_of_a_yaml = ["pgm", "png"].contains(&end.as_str()) && path.with_extension("yaml").exists();
        if ENDS.contains(&end.as_str()) && !is_of_a_yaml {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
