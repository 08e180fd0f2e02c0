//! The scene file as it is written.

pub mod shape;
