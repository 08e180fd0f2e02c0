//! tests

mod obj;
