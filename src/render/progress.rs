//! Who is told how far a frame is.

/// Receives the progress of a frame's stages: a stage begins with its number of steps, then each
/// step is announced from any thread.
pub trait Progress: Sync {
    /// A stage of `steps` steps begins.
    fn begin(&self, stage: &str, steps: usize);
    /// One step of the current stage is done.
    fn step(&self);
}

/// Progress that nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn begin(&self, _stage: &str, _steps: usize) {}
    fn step(&self) {}
}
