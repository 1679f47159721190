//! What a program adds to the words of a chain's scenarios.

/// Answers of a program's own that a chain's scenario may name, beside those that are built in. Write what is not given
/// as `..Course::BUILTIN`: more kinds of answers may come.
#[derive(Debug, Clone, Copy)]
pub struct ChainExtensions {}
