//! How exactly radiance is computed, where several pixels are shaded at once.

/// Which numbers the lanes of a vector hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// f64: the bits of one pixel after the other.
    #[default]
    Double,
    /// f32 where its error is bounded, with the decisions of f64: which side a light is on, whether
    /// a point lies in a cone, and whatever f32 leaves in doubt. The values are those of every
    /// instruction set, tile and thread count, and within [`single_error`](super::single_error) of
    /// `Double`.
    Single,
}
