//! The integration tests: one binary.

mod first;
