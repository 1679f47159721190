//! What a plan takes for granted: read it before the numbers.

use serde::Serialize;

use super::{PlanOptions, clock::Clock};
use crate::{
    config::MapConfig,
    mission::chain::Course,
    radio::{LossTable, MultiWall, PathLoss, RadioParams, Slopes, Visibility},
};

/// Everything a plan stands on.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Assumptions {
    /// The map.
    pub map: MapAssumed,
    /// What links lose.
    pub radio: RadioAssumed,
    /// Loss no link may exceed (dB), `takeoff.s_min_db`.
    pub s_min_db: f64,
    /// The head.
    pub head: HeadAssumed,
    /// The batteries.
    pub battery: BatteryAssumed,
    /// What makes it a best case.
    pub best_case: Vec<&'static str>,
}

/// The map a plan is made for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapAssumed {
    /// Its table in a scenario.
    pub table: &'static str,
    /// What kind of file it was: "ROS map"; empty for a map that stands in the scenario.
    pub format: &'static str,
    /// What was read, dropped, guessed, merged or separated on the way.
    pub remarks: Vec<String>,
    /// What that table says, key by key, lists left out: the file, the size of its cells.
    pub keys: toml::Table,
    /// Width and height of the box around its walls (m).
    pub size_m: [f64; 2],
    /// How many walls it has.
    pub walls: usize,
    /// The base, in the map's own frame (m).
    pub base_m: [f64; 2],
    /// The goal, if one was given (m).
    pub goal_m: Option<[f64; 2]>,
}

/// The radio a plan is made for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RadioAssumed {
    /// `radio.model`.
    pub model: String,
    /// `radio.range_m`, of a model that has it.
    pub range_m: Option<f64>,
    /// `radio.reference_loss_db`.
    pub reference_loss_db: f64,
    /// `radio.reference_m`.
    pub reference_m: f64,
    /// `radio.alpha_free`.
    pub alpha_free: f64,
    /// `radio.alpha_wall`.
    pub alpha_wall: f64,
    /// `radio.detour_db_per_m`.
    pub detour_db_per_m: f64,
    /// `radio.antenna_db`.
    pub antenna_db: f64,
    /// `radio.sigma_db`, which is left out.
    pub sigma_db: f64,
    /// What a model goes by that is neither "path-loss" nor "disc", in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goes_by: Option<String>,
    /// What becomes of `radio.sigma_static_db`, in words, where there is any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_place: Option<String>,
}

/// What a model goes by that is neither "path-loss" nor "disc".
fn goes_by(radio: &RadioParams) -> Option<String> {
    if radio.model == LossTable::WORD {
        return radio.table_file.as_ref().map(|file| format!("the losses in {file}"));
    }
    let known = if radio.align {
        format!("{} dB at {} m", radio.reference_loss_db, radio.reference_m)
    } else {
        "its own loss at 1 m".to_owned()
    };
    let more = match radio.model.as_str() {
        Slopes::LOG_DISTANCE => format!("exponent {}", radio.exponent),
        Slopes::P1238 => format!("{} dB a decade", radio.p1238_n),
        Slopes::TWO_SLOPE => {
            format!("exponent {} to {} m and {} beyond", radio.exponent, radio.break_m, radio.exponent_far)
        }
        MultiWall::WORD => format!(
            "free space, {} dB a light wall and {} dB a heavy one",
            radio.wall_light_db, radio.wall_heavy_db
        ),
        Visibility::WORD => format!(
            "exponent {}, {} more for each unit of cost, no link beyond {}",
            radio.exponent, radio.exponent_per_cost, radio.cost_max
        ),
        _ => return None,
    };
    Some(format!("{known}, {more}"))
}

fn in_place(radio: &RadioParams) -> Option<String> {
    (radio.sigma_static_db > 0.0).then(|| match radio.shadowing_seed {
        Some(seed) => format!("what stays in place ({} dB) as seed {seed} has it", radio.sigma_static_db),
        None => format!("what stays in place ({} dB) left out", radio.sigma_static_db),
    })
}

/// How fast the head is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeadAssumed {
    /// Its speed (m/s); `None` if it does not fly forward.
    pub speed_mps: Option<f64>,
    /// What was asked of it (m/s), where that is more than `equalize.v_max_mps`.
    pub speed_asked_mps: Option<f64>,
    /// `equalize.v_max_mps`.
    pub v_max_mps: f64,
    /// Where it starts (m along the tunnel), and how long it takes to be ready (s).
    pub start_m: f64,
    /// The same.
    pub ready_s: f64,
    /// How long it stays where it is to go (s).
    pub stay_s: f64,
}

/// How long batteries last.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BatteryAssumed {
    /// `chain.endurance_s`.
    pub endurance_s: f64,
    /// Share of it that nobody may use (1).
    pub reserve: f64,
}

/// What a plan leaves out.
const BEST_CASE: &[&str] = &[
    "relays stand at once where they are best, in mid-tunnel",
    "losses are those of the model, without noise",
    "the head never waits, and flies back at the speed at which it came",
];

impl Assumptions {
    pub(super) fn of(course: &Course, clock: &Clock, asked: &PlanOptions) -> Self {
        let scenario = &course.scenario;
        let radio = &scenario.radio;
        let (low, high) = course.map.bounds();
        let size = (high - low).as_dvec2();
        Self {
            map: MapAssumed {
                table: scenario.map.format().table,
                format: course.map.import().format,
                remarks: course.map.import().remarks.iter().map(ToString::to_string).collect(),
                keys: said(&scenario.map),
                size_m: [size.x, size.y],
                walls: course.map.walls().len(),
                base_m: scenario.chain.base_m,
                goal_m: scenario.chain.goal_m,
            },
            radio: RadioAssumed {
                model: radio.model.clone(),
                range_m: radio.range_m.filter(|_| radio.model != PathLoss::WORD).map(decimal),
                reference_loss_db: decimal(radio.reference_loss_db),
                reference_m: decimal(radio.reference_m),
                alpha_free: decimal(radio.alpha_free),
                alpha_wall: decimal(radio.alpha_wall),
                detour_db_per_m: decimal(radio.detour_db_per_m),
                antenna_db: decimal(radio.antenna_db),
                sigma_db: decimal(radio.sigma_db),
                goes_by: goes_by(radio),
                in_place: in_place(radio),
            },
            s_min_db: decimal(scenario.takeoff.s_min_db),
            head: HeadAssumed {
                speed_mps: clock.speed_mps,
                speed_asked_mps: clock.speed_asked_mps,
                v_max_mps: decimal(scenario.equalize.v_max_mps),
                start_m: clock.start_m,
                ready_s: clock.ready_s,
                stay_s: asked.stay_s,
            },
            battery: BatteryAssumed {
                endurance_s: decimal(scenario.chain.endurance_s),
                reserve: asked.reserve,
            },
            best_case: BEST_CASE.to_vec(),
        }
    }
}

/// The number that was written: 0.3 rather than the 0.30000001192092896 that its bits come to.
fn decimal(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| value.into())
}

/// What a map's table says, lists left out.
fn said(map: &MapConfig) -> toml::Table {
    let Ok(toml::Value::Table(whole)) = toml::Value::try_from(map) else { return toml::Table::new() };
    let tables = whole.into_iter().filter_map(|(_, table)| match table {
        toml::Value::Table(table) => Some(table),
        _ => None,
    });
    tables
        .flatten()
        .filter(|(_, value)| !matches!(value, toml::Value::Array(_) | toml::Value::Table(_)))
        .collect()
}
