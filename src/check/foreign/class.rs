//! What a pixel of another program's picture can be.

/// What a pixel of theirs is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Another triangle than the visible one, or an id that no triangle has.
    Wrong,
    /// Nothing, where a triangle is visible.
    Missing,
    /// A triangle, where nothing is visible.
    Extra,
    /// The right triangle at a wrong depth.
    DepthOff,
    /// Right for a sample at most [`super::stability::UNSTABLE_HALF_WIDTH_PIXELS`] beside the centre.
    Unstable,
    /// Right under another tie rule.
    AllowedTie,
    /// The exact answer.
    Agree,
}

impl Class {
    /// Every class, the worst first.
    pub const ALL: [Self; 7] = [
        Self::Wrong,
        Self::Missing,
        Self::Extra,
        Self::DepthOff,
        Self::Unstable,
        Self::AllowedTie,
        Self::Agree,
    ];

    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wrong => "wrong",
            Self::Missing => "missing",
            Self::Extra => "extra",
            Self::DepthOff => "depth off",
            Self::Unstable => "unstable",
            Self::AllowedTie => "allowed tie",
            Self::Agree => "agree",
        }
    }

    /// Whether it is an error of theirs.
    pub const fn is_error(self) -> bool {
        matches!(self, Self::Wrong | Self::Missing | Self::Extra | Self::DepthOff)
    }
}
