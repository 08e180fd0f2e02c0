//! tests

mod arbiter;
mod layers;
mod support;
