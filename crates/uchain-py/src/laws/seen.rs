//! What a UAV of a chain sees.

use pyo3::{exceptions::PyValueError, prelude::*};
use uchain_core::chain::{self, HEARD_MAX, PilotInput, RadioSlot, Tof};

use super::words;

/// One packet as received.
///
/// `sender`: its id, 65535 for the base; `loss_db`: measured loss of the link (dB), the negated RSSI (dBm); `place`: the
/// sender's place in the chain, 0 leads it, 65535 for the base. What else it says has defaults.
///
/// >>> from uchain.laws import Heard
/// >>> Heard(0, 53.0, place=0, ground_speed_mps=0.2)
/// Heard(sender=0, loss_db=53, place=0)
#[pyclass(frozen, module = "uchain.laws")]
#[derive(Clone, Copy)]
pub(super) struct Heard(pub(super) chain::Heard);

#[pymethods]
impl Heard {
    #[new]
    #[pyo3(signature = (sender, loss_db, *, place, ground_speed_mps=0.0, flown_s=0.0, follow="centre",
        imbalance_db=0.0, is_base=false, battery=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn new(
        sender: u16,
        loss_db: f32,
        place: u16,
        ground_speed_mps: f32,
        flown_s: f32,
        follow: &str,
        imbalance_db: f32,
        is_base: bool,
        battery: Option<f32>,
    ) -> PyResult<Self> {
        let follow = words::choice("follow", follow, &words::FOLLOW)?;
        let own = chain::Packet::default().own;
        let packet =
            chain::Packet { place, ground_speed_mps, flown_s, follow, imbalance_db, is_base, battery, own };
        Ok(Self(chain::Heard { from: sender, loss_db, packet }))
    }

    /// A packet from the base, at a loss (dB).
    #[staticmethod]
    fn base(loss_db: f32) -> Self {
        Self(chain::Heard { from: chain::BASE_ID, loss_db, packet: chain::Packet::BASE })
    }

    /// The sender's id; 65535 for the base.
    #[getter]
    fn sender(&self) -> u16 {
        self.0.from
    }

    /// Measured loss of the link (dB).
    #[getter]
    fn loss_db(&self) -> f32 {
        self.0.loss_db
    }

    /// The sender's place in the chain.
    #[getter]
    fn place(&self) -> u16 {
        self.0.packet.place
    }

    fn __repr__(&self) -> String {
        let chain::Heard { from, loss_db, packet } = &self.0;
        format!("Heard(sender={from}, loss_db={loss_db}, place={})", packet.place)
    }
}

/// All that a UAV of a chain may know at one instant; nowhere a position.
///
/// `place`: its place in the chain, 0 leads it (None: what it was told last). `heard`: a decision is due, with the packets
/// since the last one, at most 8 (None: no decision is due). `tof_m`: a new set of distances, front left, front right, rear
/// left, rear right (m). `ground_speed_mps`: own forward speed by optic flow (m/s). `battery`: 0 to 1. `pilot_mps`,
/// `follow`: what the head's pilot asks for.
///
/// Raises `ValueError` of too many packets, or a word that is none.
#[pyclass(frozen, module = "uchain.laws")]
pub(super) struct Observation(pub(super) chain::Observation);

#[pymethods]
impl Observation {
    #[new]
    #[pyo3(signature = (*, place=None, heard=None, tof_m=None, ground_speed_mps=None, battery=None, pilot_mps=None,
        follow="centre"))]
    fn new(
        place: Option<u16>,
        heard: Option<Vec<PyRef<'_, Heard>>>,
        tof_m: Option<[f32; 4]>,
        ground_speed_mps: Option<f32>,
        battery: Option<f32>,
        pilot_mps: Option<f32>,
        follow: &str,
    ) -> PyResult<Self> {
        let follow = words::choice("follow", follow, &words::FOLLOW)?;
        let radio = match heard {
            Some(heard) if heard.len() > HEARD_MAX => {
                let message = format!("heard: {} packets; expected at most {HEARD_MAX}", heard.len());
                return Err(PyValueError::new_err(message));
            }
            heard => heard.map(|heard| heard.iter().map(|heard| heard.0).collect::<RadioSlot>()),
        };
        Ok(Self(chain::Observation {
            place,
            tof: tof_m.map(|[nw_m, ne_m, sw_m, se_m]| Tof { nw_m, ne_m, sw_m, se_m }),
            radio,
            ground_speed_mps,
            battery,
            pilot: pilot_mps.map(|speed_mps| PilotInput { speed_mps, follow }),
        }))
    }

    fn __repr__(&self) -> String {
        let heard = self.0.radio.as_ref().map(|radio| radio.heard().len());
        let heard = heard.map_or("no decision due".to_owned(), |heard| format!("{heard} heard"));
        format!("<uchain.laws.Observation: {heard}>")
    }
}
