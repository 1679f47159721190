//! What a page may ask, and who answers.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::{
    flown::Flight,
    library,
    open::{self, NamedFile},
    problem::Problem,
    told::{self, FlightFile, Input, Since},
};

/// Longest request (bytes): a recording of 64 MiB, and what is said of it.
const REQUEST_MAX_BYTES: usize = (64 << 20) + (1 << 16);

/// One flight, and what a page may do with it.
#[derive(Debug, Default)]
pub struct Engine {
    flight: Option<Box<dyn Flight>>,
    payload: Vec<u8>,
}

/// What a page asks for.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "lowercase", deny_unknown_fields)]
enum Asked {
    About {},
    Text {
        name: String,
    },
    Check {
        text: String,
        label: String,
    },
    Explain {
        key: String,
    },
    Open {
        flight: FlightFile,
    },
    Recording {
        label: String,
    },
    Map {
        files: Vec<NamedFile>,
        #[serde(default)]
        cell_m: Option<f64>,
        #[serde(default)]
        text: Option<String>,
        #[serde(default)]
        label: Option<String>,
        #[serde(default = "told::one", with = "crate::seed")]
        seed: u64,
    },
    Advance {
        ticks: u64,
    },
    Steer(Input),
    Cut {
        tick: u64,
    },
    Frame {
        tick: u64,
    },
    Why {
        tick: u64,
        uav: usize,
    },
    Series {
        #[serde(default)]
        from: usize,
    },
    Events {},
    Graph {
        #[serde(default)]
        from: Since,
    },
    Inputs {},
    Summary {},
    Flight {},
    Toml {
        by_hand: bool,
    },
    Record {
        ticks: u64,
    },
}

/// Whatever can be said, in JSON.
fn said(value: &impl Serialize) -> Result<String, Problem> {
    serde_json::to_string(value).map_err(Problem::new)
}

impl Engine {
    /// Answers a request: JSON, or JSON, a byte 0 and files. The answer is JSON, whatever the request was.
    pub fn call(&mut self, request: &[u8]) -> Vec<u8> {
        let (word, said) = match self.answer(request) {
            Ok(said) => ("ok", said),
            Err(problem) => ("error", said(&problem).unwrap_or_default()),
        };
        format!("{{\"{word}\":{said}}}").into_bytes()
    }

    /// What came besides the last answer: numbers over time (32-bit floats, little-endian), or a file.
    pub fn payload(&self) -> &[u8] {
        &self.payload
    }

    fn answer(&mut self, request: &[u8]) -> Result<String, Problem> {
        self.payload.clear();
        if request.len() > REQUEST_MAX_BYTES {
            let mib = request.len() >> 20;
            return Err(Problem::new(format!("{mib} MiB are too much for a page: expected at most 64 MiB")));
        }
        let end = request.iter().position(|byte| *byte == 0).unwrap_or(request.len());
        let files = request.get(end + 1..).unwrap_or_default();
        let asked: Asked = serde_json::from_slice(&request[..end]).map_err(Problem::new)?;
        match asked {
            Asked::About {} => said(&library::about()?),
            Asked::Text { name } => said(&json!({ "text": library::text(&name)? })),
            Asked::Check { text, label } => said(&library::check(text, label)?),
            Asked::Explain { key } => said(&json!({ "cards": library::explain(&key)? })),
            Asked::Open { flight } => self.open(open::scenario(flight)),
            Asked::Recording { label } => self.open(open::recording(files.to_vec(), &label)),
            Asked::Map { files: named, cell_m, text, label, seed } => {
                let files = open::split(&named, files)?;
                self.open(open::map(&files, cell_m, text, label, seed))
            }
            asked => self.of_flight(&asked),
        }
    }

    /// What is asked of the flight that is open.
    fn of_flight(&mut self, asked: &Asked) -> Result<String, Problem> {
        let flight = self.flight.as_mut().ok_or_else(Problem::nothing_is_open)?;
        match *asked {
            Asked::Advance { ticks } => said(&flight.advance(ticks)?),
            Asked::Steer(input) => flight.steer(input).and_then(|()| said(&Value::Null)),
            Asked::Cut { tick } => flight.cut(tick).and_then(|()| said(&flight.scene()?)),
            Asked::Frame { tick } => flight.frame(tick),
            Asked::Why { tick, uav } => said(&flight.why(tick, uav)?),
            Asked::Series { from } => {
                let series = flight.series(from);
                self.payload = series.numbers;
                said(
                    &json!({ "columns": series.columns, "rows": series.rows, "generation": series.generation }),
                )
            }
            Asked::Events {} => said(&json!({ "events": flight.events() })),
            Asked::Graph { from } => said(&flight.graph(from)),
            Asked::Inputs {} => said(&flight.inputs()),
            Asked::Summary {} => said(&flight.summary()?),
            Asked::Flight {} => said(&flight.to_file()),
            Asked::Toml { by_hand } => said(&json!({ "text": flight.toml(by_hand)? })),
            Asked::Record { ticks } => {
                let taped = flight.record(ticks)?;
                let done = taped.file.is_some();
                self.payload = taped.file.unwrap_or_default();
                said(&json!({ "done": done, "tick": taped.tick }))
            }
            _ => Err(Problem::nothing_is_open()),
        }
    }

    /// The flight that was opened takes the place of the one before; if it could not be, that one stays.
    fn open(&mut self, opened: Result<Box<dyn Flight>, Problem>) -> Result<String, Problem> {
        let opened = opened?;
        let scene = said(&opened.scene()?)?;
        self.flight = Some(opened);
        Ok(scene)
    }
}
