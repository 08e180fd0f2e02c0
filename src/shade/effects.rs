//! Effects: the features of shading that a scene may or may not call for.
//!
//! They are found once per frame; what is not called for is not evaluated. Leaving out an effect
//! that a scene does not call for never changes a bit of the picture, because an unneeded effect
//! contributes exactly neutral values (× 1, + 0 on sums that are not negative).

use super::calls::visit_calls;
use crate::scene::Scene;

/// A set of effects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct Effects(u16);

impl Effects {
    /// No effect: every surface is black.
    pub const NONE: Self = Self(0);
    /// ke of materials.
    pub const EMISSION: Self = Self(1);
    /// ka·Ia of lights of any kind.
    pub const AMBIENT: Self = Self(1 << 1);
    /// Diffuse and specular parts of directional lights.
    pub const DIRECTIONAL: Self = Self(1 << 2);
    /// Diffuse and specular parts of point lights.
    pub const POINT: Self = Self(1 << 3);
    /// Diffuse and specular parts of spotlights.
    pub const SPOT: Self = Self(1 << 4);
    /// 1/(a + b·r + c·r²).
    pub const ATTENUATION: Self = Self(1 << 5);
    /// The cutoff of spotlights.
    pub const CONE: Self = Self(1 << 6);
    /// (L·S)^e of spotlights.
    pub const EXPONENT: Self = Self(1 << 7);
    /// kd·Id·(N·L).
    pub const DIFFUSE: Self = Self(1 << 8);
    /// ks·Is·(N·H)^ns.
    pub const SPECULAR: Self = Self(1 << 9);
    /// Corner normals, interpolated.
    pub const INTERPOLATED_NORMALS: Self = Self(1 << 10);
    /// kd·(a·top + (1 − a)·bottom) of hemisphere lights.
    pub const HEMISPHERE: Self = Self(1 << 11);
    /// Shadow rays of lights that cast shadows.
    pub const SHADOWS: Self = Self(1 << 12);
    /// Textures of kd and ks.
    pub const TEXTURES: Self = Self(1 << 13);
    /// Surfaces seen through others: blended by `render`, which shades each as any other.
    pub const OPACITY: Self = Self(1 << 14);
    /// Several samples per pixel: averaged by `render`.
    pub const SUPERSAMPLING: Self = Self(1 << 15);
    /// Every effect: the reference that every smaller set is compared with.
    pub const ALL: Self = Self(u16::MAX);

    /// Each single effect with its name, in the order of the bits.
    pub const NAMED: [(Self, &'static str); 16] = [
        (Self::EMISSION, "emission"),
        (Self::AMBIENT, "ambient"),
        (Self::DIRECTIONAL, "directional"),
        (Self::POINT, "point"),
        (Self::SPOT, "spot"),
        (Self::ATTENUATION, "attenuation"),
        (Self::CONE, "cone"),
        (Self::EXPONENT, "exponent"),
        (Self::DIFFUSE, "diffuse"),
        (Self::SPECULAR, "specular"),
        (Self::INTERPOLATED_NORMALS, "interpolated normals"),
        (Self::HEMISPHERE, "hemisphere"),
        (Self::SHADOWS, "shadows"),
        (Self::TEXTURES, "textures"),
        (Self::OPACITY, "opacity"),
        (Self::SUPERSAMPLING, "supersampling"),
    ];

    /// The effects that a scene calls for.
    pub fn of(scene: &Scene) -> Self {
        let mut effects = Self::NONE;
        visit_calls(scene, |effect, _| effects = effects.with(effect));
        effects
    }

    /// Whether any effect of `other` is in this set.
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Whether every effect of `other` is in this set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The union.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// This set without the effects of `other`.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Names of the effects in this set, in the order of [`Self::NAMED`].
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().filter(move |(effect, _)| self.has(*effect)).map(|(_, name)| name)
    }

    /// Position of a single effect in [`Self::NAMED`].
    pub(super) const fn position(self) -> usize {
        self.0.trailing_zeros() as usize
    }
}
