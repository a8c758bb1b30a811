//! Tests.

mod shader;
