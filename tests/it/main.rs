//! tests

mod film;
