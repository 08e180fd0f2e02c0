//! tests

mod cast;
