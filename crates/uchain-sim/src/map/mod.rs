//! A tunnel: walls, free space, and the way through it.
