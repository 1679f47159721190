//! Python bindings of uchain: sweeps and runs from a notebook. Empty so far; nothing depends on it.
