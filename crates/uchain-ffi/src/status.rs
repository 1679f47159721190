//! How a call went.

/// How a call went. `UCHAIN_STATUS_OK` is 0.
#[repr(u8)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// As asked.
    Ok = 0,
    /// A pointer is NULL, or not aligned for what it points to.
    BadPointer = 1,
    /// The node was never initialised: call `uchain_node_init` first.
    NotInitialised = 2,
    /// A choice (role, wall, law, 0 or 1) that there is none of: see the constants.
    BadChoice = 3,
    /// A number outside its range, NaN and infinities included.
    OutOfRange = 4,
    /// Too few bytes for a packet.
    TooShort = 5,
    /// Too many bytes for a packet.
    TooLong = 6,
    /// A packet of another version, or no packet of this project: its first byte is not the version.
    OtherVersion = 7,
    /// A packet whose content makes no sense.
    Malformed = 8,
    /// A packet that says it comes from this very node: two UAVs have the same id.
    OwnId = 9,
}
