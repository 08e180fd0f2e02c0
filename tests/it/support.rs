//! What several test modules need: scenes with known answers, the standard camera, shapes.

pub(crate) mod closed;
pub(crate) mod configurations;
pub(crate) mod golden;
pub(crate) mod names;
pub(crate) mod program;
pub(crate) mod rays;
pub(crate) mod scenes;
pub(crate) mod sizes;
