//! Arguments of `uchain node`.

use std::path::PathBuf;

use clap::{Args, ValueEnum, ValueHint};
use uchain_sim::{
    config::ConfigError,
    log::{Settings, about_columns},
};

use crate::{
    exit::Failure,
    flags::{Out, Say, Sets},
    output::{Folder, folder_name},
};

const SET: &str =
    "Write one value over the node's, such as takeoff.s_min_db=66 or equalize.law=bang-bang (repeatable)";

const EXAMPLES: &str = "\
Examples:
  uchain node --template > log.csv           a header and two rows, for your drone to go on with
  uchain node log.csv                        what would a relay have asked for?
  uchain node log.csv --preset cavemod --set takeoff.s_min_db=62
  uchain node log.csv --role head --json | jq .overrides
  uchain node log.csv --airborne --csv > asked.csv

The log's rows go through the node that flies: distances as they come, packets at every decision, which are due by time_s every
equalize.decision_s from the first row on. Writes node.png, commands.csv with all that the node asked for and believed, and
node.json. A number with all its digits keeps its bits: what the simulator or a drone asked for comes out again.
";

const NOTES: &str = "\
A log is CSV of at most 64 MiB and 500,000 rows, most of them at the rate of the distance sensors. A column that the drone does not
have is left out; a # before a name leaves that column out. Of a packet that falls between two decisions the next one hears, of
several of one neighbour the last. A cell that is no number (nan) counts as not measured, a distance as a beam that sees nothing;
it is told, and so are readings that look stuck or in another unit. Rows that are too far apart are told as well: in between the
node decides on time, and hears nothing.
";

/// A log through the node.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\nColumns:\n{}\n{NOTES}", about_columns()))]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: nodes/<log>, overwritten]")))]
#[command(mut_arg("json", |json| json.help("Print the summary as JSON on stdout, and nothing else there")))]
#[command(mut_arg("set", |set| set.help(SET)))]
pub(crate) struct Node {
    /// The log of a flight, a table in CSV: a row for every moment, columns as listed below
    #[arg(value_name = "LOG", value_hint = ValueHint::FilePath, required_unless_present = "template")]
    pub(crate) log: Option<PathBuf>,
    /// Print the header of a log and two rows, and do nothing else
    #[arg(long, conflicts_with_all = ["log", "csv", "json", "out"])]
    pub(crate) template: bool,
    /// What the drone of the log is, where no column says its place [default: relay]
    #[arg(long, value_enum)]
    role: Option<Role>,
    /// Its place in the chain, where no column says it: 0 is the head [default: 1, of a head 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(..=65533))]
    place: Option<u16>,
    /// The log begins in the air: the node takes off at its first packet, and has risen at once
    #[arg(long)]
    airborne: bool,
    /// Whose values (short for --set preset=NAME); uchain list names them
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    sets: Sets,
    #[command(flatten)]
    out: Out,
    /// Print commands.csv on stdout, and nothing else there
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) say: Say,
}

/// What a drone is in the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Role {
    /// Flies as its pilot asks
    Head,
    /// Levels its two links
    Relay,
}

impl Node {
    /// What the node is set to.
    pub(crate) fn settings(&self) -> Result<Settings, Failure> {
        let place = match (self.role.unwrap_or(Role::Relay), self.place) {
            (Role::Head, None | Some(0)) => 0,
            (Role::Relay, None) => 1,
            (Role::Relay, Some(place)) if place > 0 => place,
            (Role::Head, Some(place)) => {
                return Err(Failure::Usage(format!("--role head --place {place}: the head has place 0")));
            }
            (Role::Relay, Some(_)) => {
                return Err(Failure::Usage("--place 0: that is the head; add --role head".to_owned()));
            }
        };
        let preset = self.preset.iter().map(|name| format!("preset={name}"));
        let sets: Vec<String> = preset.chain(self.sets.set.iter().cloned()).collect();
        let settings = Settings::read(&sets).map_err(|error| self.as_typed(error))?;
        let is_place_asked = self.role == Some(Role::Head) || self.place.is_some();
        Ok(Settings { place, is_place_asked, is_airborne: self.airborne, ..settings })
    }

    /// An error about the preset, named by the option that it came by.
    fn as_typed(&self, error: ConfigError) -> ConfigError {
        match &self.preset {
            Some(name) => error.typed_as(&format!("preset={name}"), &format!("--preset {name}")),
            None => error,
        }
    }

    /// Where the results go.
    pub(crate) fn folder(&self, log: &str) -> Result<Folder, Failure> {
        self.out.folder(|| Folder::ours("nodes", &folder_name(log), ""))
    }
}
