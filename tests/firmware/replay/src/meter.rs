//! What calls cost: instructions by kind of call, and memory.

use core::{fmt, hint::black_box};

#[cfg(feature = "explore")]
use arrayvec::ArrayVec;

/// Measures calls. A host that measures nothing gives zeros: [`Unmetered`].
pub trait Meter {
    /// Instructions so far; it may run over.
    fn now(&mut self) -> u32;

    /// Makes a call of a kind; what it returns, and the instructions it took. Whoever looks at the stack as well, or knows
    /// what reading the clock costs, makes it in a way of his own.
    #[inline]
    fn call<T>(&mut self, _call: Call, make: impl FnOnce() -> T) -> (T, u32) {
        let from = self.now();
        let made = black_box(make());
        (made, self.now().wrapping_sub(from))
    }

    /// The heap now, and at most since the last call of [`Meter::forget_peak`].
    fn heap(&mut self) -> Heap {
        Heap::default()
    }

    /// From now on the heap's peak is counted anew.
    fn forget_peak(&mut self) {}
}

/// Measures nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unmetered;

impl Meter for Unmetered {
    fn now(&mut self) -> u32 {
        0
    }
}

/// What is taken of a heap (bytes).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Heap {
    /// Now.
    pub used: u32,
    /// At most.
    pub peak: u32,
}

macro_rules! calls {
    ($($(#[doc = $doc:literal])* $Call:ident = $word:literal,)*) => {
        /// A kind of call.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Call {
            $($(#[doc = $doc])* $Call,)*
        }

        impl Call {
            /// All there are, in order.
            pub const ALL: &'static [Self] = &[$(Self::$Call),*];

            /// In a word, for programs.
            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$Call => $word,)*
                }
            }
        }
    };
}

calls! {
    /// A head decides, whatever it sees.
    Head = "head",
    /// A relay decides on packets and distances.
    RelayRadioTof = "relay-radio-tof",
    /// A relay decides on packets: on the ground there are no distances.
    RelayRadio = "relay-radio",
    /// A relay steers by distances alone.
    RelayTof = "relay-tof",
    /// A relay is shown nothing new.
    RelayNothing = "relay-nothing",
    /// What a UAV tells whoever hears it.
    Say = "say",
    /// The default centering.
    CenterWall = "center-wall",
    /// Centering as printed in the paper.
    CenterPaper = "center-paper",
    /// Centering of the authors' firmware.
    CenterFirmware = "center-firmware",
    /// Levelling by Eq. 12.
    EqualizeLipschitz = "equalize-lipschitz",
    /// Levelling of the authors' simulator.
    EqualizeInverseModel = "equalize-inverse-model",
    /// Levelling of the authors' firmware.
    EqualizeBangBang = "equalize-bang-bang",
    /// One step of a link's filter: prediction and correction.
    Kalman = "kalman",
    /// A robot takes in where it is and what it has scanned.
    Perceive = "perceive",
    /// A robot alone takes in what another one says.
    Hear = "hear",
    /// A robot chooses where to fly.
    Announce = "announce",
    /// Conflicts of a whole team.
    Rule = "rule",
    /// A robot follows a ruling, or resolves its conflicts itself.
    Follow = "follow",
    /// All of one robot's decision of a round: what it perceives, announces and follows.
    Decision = "decision",
}

/// What calls of one kind have cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Count {
    /// How many there were.
    pub calls: u32,
    /// Instructions of all of them.
    pub instructions: u64,
    /// Instructions of the dearest.
    pub most: u32,
}

impl Count {
    fn add(&mut self, instructions: u32) {
        self.calls = self.calls.saturating_add(1);
        self.instructions = self.instructions.saturating_add(u64::from(instructions));
        self.most = self.most.max(instructions);
    }

    /// Instructions of one call in the mean, rounded down.
    pub fn mean(&self) -> u64 {
        self.instructions.checked_div(u64::from(self.calls)).unwrap_or(0)
    }
}

/// What one exploration took.
#[cfg(feature = "explore")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Explored {
    /// Brains flown: the whole team on one store, or one robot.
    pub brains: u16,
    /// Rounds.
    pub rounds: u32,
    /// Nodes of the store at the end.
    pub nodes: u32,
    /// What stores and brains took of the heap at the end (bytes).
    pub used: u32,
    /// What was taken of the heap at most, rooms for growing lists included (bytes).
    pub peak: u32,
}

/// What a replay came to.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally {
    /// Decisions: of every UAV at every tick, and of every robot in every round.
    pub ticks: u32,
    /// Explorations, in the order in which they were flown.
    #[cfg(feature = "explore")]
    pub explored: ArrayVec<Explored, 8>,
    counts: [Count; Call::ALL.len()],
}

impl Tally {
    /// What calls of a kind have cost.
    pub fn count(&self, call: Call) -> Count {
        self.counts.get(call as usize).copied().unwrap_or_default()
    }

    fn add(&mut self, call: Call, instructions: u32) {
        if let Some(count) = self.counts.get_mut(call as usize) {
            count.add(instructions);
        }
    }
}

/// One line each: `ticks N`, then `call WORD CALLS MEAN MOST` in instructions of those that were made, then
/// `explored BRAINS ROUNDS NODES USED PEAK` in bytes.
impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "ticks {}", self.ticks)?;
        for &call in Call::ALL {
            let count = self.count(call);
            if count.calls > 0 {
                writeln!(f, "call {} {} {} {}", call.word(), count.calls, count.mean(), count.most)?;
            }
        }
        #[cfg(feature = "explore")]
        for e in &self.explored {
            writeln!(f, "explored {} {} {} {} {}", e.brains, e.rounds, e.nodes, e.used, e.peak)?;
        }
        Ok(())
    }
}

/// A tally in the making.
pub(crate) struct Metered<'a, M> {
    meter: &'a mut M,
    pub(crate) tally: Tally,
}

impl<'a, M: Meter> Metered<'a, M> {
    pub(crate) fn new(meter: &'a mut M) -> Self {
        Self { meter, tally: Tally::default() }
    }

    /// Makes a call, and counts what it cost.
    pub(crate) fn time<T>(&mut self, call: Call, make: impl FnOnce() -> T) -> T {
        self.timed(call, make).0
    }

    /// The same, with the instructions.
    pub(crate) fn timed<T>(&mut self, call: Call, make: impl FnOnce() -> T) -> (T, u32) {
        let timed = self.meter.call(call, make);
        self.tally.add(call, timed.1);
        timed
    }
}

#[cfg(feature = "explore")]
impl<M: Meter> Metered<'_, M> {
    /// Instructions of several calls that are one decision.
    pub(crate) fn decided(&mut self, instructions: u32) {
        self.tally.add(Call::Decision, instructions);
    }

    /// The heap.
    pub(crate) fn heap(&mut self) -> Heap {
        self.meter.heap()
    }

    /// The heap's peak is counted anew.
    pub(crate) fn forget_peak(&mut self) {
        self.meter.forget_peak();
    }
}
