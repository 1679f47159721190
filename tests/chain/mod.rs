//! A chain: its laws, its sensors, its tunnels.

/// Into a real cave, as its survey has it.
mod caves;
/// Every promise of a law holds in the world it flies in.
mod centering;
/// Heads come round the corners of the shipped scenarios.
mod corners;
/// On maps of kilometres a run is what it is on small ones.
mod far;
/// What is left out for speed changes no bit.
mod fast;
/// Whatever goes wrong with the radio, a run ends in words.
mod faults;
/// Claims of the laws for whatever they may meet.
mod laws;
/// Relays may be levelled from elsewhere, all at once or at another time.
mod levelling;
/// Ids are for life, and the chain's order is a list that changes.
mod members;
/// A law of one's own flies where the built-in one does.
mod own_law;
/// What a link loses is one question with several answers, a user's own among them.
mod radio;
/// The shipped scenarios do what their descriptions say.
mod scenarios;
/// What stays in place of fading is known to a run, and to a plan that is told its seed.
mod shadowing;
/// A run says what happened: as asked, or what went wrong.
mod verdict;
/// Relays level as well over packets in bytes.
mod wire;
