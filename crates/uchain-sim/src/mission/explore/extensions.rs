//! What a program adds to the words of an exploration's scenarios.

/// Answers of a program's own that an exploration's scenario may name, beside those that are built in. Write what is not
/// given as `..Site::BUILTIN`: more kinds of answers may come.
#[derive(Debug, Clone, Copy)]
pub struct SiteExtensions {}
