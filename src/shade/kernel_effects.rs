//! Which kernel a set of effects needs: the effects that are worth compiling the equation for.

use super::effects::Effects;

/// Effects that are worth a kernel of their own: each saves per-pixel set-up or transcendental
/// functions. The others are decided once per light, when lights are prepared.
#[derive(Clone, Copy)]
pub(super) struct KernelEffects(pub(super) u8);

impl KernelEffects {
    /// A light at a point: the world position is needed.
    pub(super) const POSITIONAL: Self = Self(1);
    /// Cone or falloff of a spotlight.
    pub(super) const CONE: Self = Self(2);
    /// Specular terms: the eye direction is needed.
    pub(super) const SPECULAR: Self = Self(4);
    /// Interpolated normals.
    pub(super) const NORMALS: Self = Self(8);
    /// Everything, for single points.
    pub(super) const ALL: u8 = 15;

    pub(super) const fn has(self, effect: Self) -> bool {
        self.0 & effect.0 != 0
    }

    pub(super) fn of(effects: Effects) -> Self {
        let pairs = [
            (Effects::POINT.with(Effects::SPOT), Self::POSITIONAL),
            (Effects::CONE.with(Effects::EXPONENT), Self::CONE),
            (Effects::SPECULAR, Self::SPECULAR),
            (Effects::INTERPOLATED_NORMALS, Self::NORMALS),
        ];
        Self(pairs.iter().filter(|(set, _)| effects.has(*set)).map(|(_, bit)| bit.0).sum())
    }

    /// Position in a table over all sets.
    pub(super) fn index(self) -> usize {
        usize::from(self.0)
    }
}
