//! Choices as bytes. A field that holds one is a `uint8_t`: C may write any number into it.

use uchain_core::chain;

/// What a node is made as.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Role {
    /// The explorer: flies as its pilot asks, as long as its back link holds.
    Head = 0,
    /// Levels its two links.
    Relay = 1,
}

/// Which wall to follow.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Follow {
    /// Keep to the middle.
    Centre = 0,
    /// Keep the left wall.
    Left = 1,
    /// Keep the right wall.
    Right = 2,
}

/// How an imbalance becomes a speed: `equalize_law`.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum SpeedLaw {
    /// "lipschitz": `s_d / (3 k T_s)` (Laclau 2021, Eq. 12).
    Lipschitz = 0,
    /// "inverse-model": a third of the distance that a path-loss model reads from the two losses.
    InverseModel = 1,
    /// "bang-bang": a fixed speed outside a band.
    BangBang = 2,
}

/// Whose centering: `center_law`.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum CenterLaw {
    /// "wall": both walls while they run alike, else along the nearer one, and away from a wall ahead.
    Wall = 0,
    /// "paper": Laclau 2021, Eq. 20 and 21 as printed.
    Paper = 1,
    /// "firmware": the authors' flight firmware.
    Firmware = 2,
}

/// Which loss is looked at: `link_signal` and `takeoff_launch_signal`.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Signal {
    /// "filtered": the Kalman filter's estimate.
    Filtered = 0,
    /// "raw": the last sample.
    Raw = 1,
}

/// What a filter does in a decision period without a packet: `link_gap`.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Gap {
    /// "hold": nothing.
    Hold = 0,
    /// "predict": it goes on with the neighbour's last speed, for `link_predict_s` at most.
    Predict = 1,
}

/// What a take-off waits for besides the threshold: `takeoff_launch`.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Launch {
    /// "threshold": nothing.
    Threshold = 0,
    /// "converged": the flying chain has levelled.
    Converged = 1,
}

/// What a node is doing.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Stage {
    /// On the ground, until the link that will be its own is weak enough for long enough.
    Waiting = 0,
    /// Rising and hovering, until it has settled.
    Rising = 1,
    /// Flying by its laws.
    Flying = 2,
}

/// Why a UAV flies otherwise than its law, or its pilot, wishes.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Override {
    /// It flies as wished.
    None = 0,
    /// A head that has heard nobody behind it yet stays.
    NeverHeard = 1,
    /// The head's back link is too weak to go on (`link_head_stop_db`).
    HeadStop = 2,
    /// The back link is so weak that it flies backward (`link_head_back_db`, `link_relay_back_db`).
    Retreat = 3,
    /// The back link is lost (`link_lost_s`): it flies backward.
    BackLost = 4,
    /// The front link is lost (`link_lost_s`): it hovers.
    FrontLost = 5,
    /// A relay is nearer to a neighbour than `equalize_spacing_db` and backs away from it.
    Spacing = 6,
}

/// Which walls centering steers by.
#[repr(u8)]
#[derive(Debug, Clone, Copy)]
pub enum Walls {
    /// None, or there are no distances in the observation.
    None = 0,
    /// It keeps to the middle.
    Both = 1,
    /// It runs along the left one.
    Left = 2,
    /// It runs along the right one.
    Right = 3,
}

/// Names the variants of a choice of ours and of the core's once, for both ways.
macro_rules! both_ways {
    ($($Choice:ident { $($Variant:ident)* })*) => { $(
        impl $Choice {
            pub(crate) fn of(choice: chain::$Choice) -> u8 {
                match choice { $( chain::$Choice::$Variant => Self::$Variant as u8, )* }
            }

            pub(crate) fn read(byte: u8) -> Option<chain::$Choice> {
                match byte {
                    $( byte if byte == Self::$Variant as u8 => Some(chain::$Choice::$Variant), )*
                    _ => None,
                }
            }
        }
    )* };
}

both_ways! {
    Role { Head Relay }
    Follow { Centre Left Right }
    SpeedLaw { Lipschitz InverseModel BangBang }
    CenterLaw { Wall Paper Firmware }
    Signal { Filtered Raw }
    Gap { Hold Predict }
    Launch { Threshold Converged }
}

impl Stage {
    pub(crate) fn of(stage: chain::Stage) -> u8 {
        match stage {
            chain::Stage::Waiting => Self::Waiting as u8,
            chain::Stage::Rising => Self::Rising as u8,
            _ => Self::Flying as u8,
        }
    }
}

// The core numbers its overrides in this order too, and new ones come last.
const _: () = assert!(chain::Override::ALL.len() == Override::Spacing as usize);

impl Override {
    pub(crate) fn of(overridden: Option<chain::Override>) -> u8 {
        let place = |why| chain::Override::ALL.iter().position(|known| *known == why);
        overridden.and_then(place).map_or(Self::None as u8, |place| place as u8 + 1)
    }
}

impl Walls {
    pub(crate) fn of(walls: Option<chain::Walls>) -> u8 {
        match walls {
            None => Self::None as u8,
            Some(chain::Walls::Both) => Self::Both as u8,
            Some(chain::Walls::Left) => Self::Left as u8,
            Some(chain::Walls::Right) => Self::Right as u8,
        }
    }
}

/// 0 or 1.
pub(crate) fn switch(byte: u8) -> Option<bool> {
    match byte {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    }
}
