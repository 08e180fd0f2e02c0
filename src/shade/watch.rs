//! Who looks on while a kernel works: counts of doubtful cases, counts of evaluations, or nobody.
//!
//! The kernel is compiled once per watcher, so what nobody looks at costs nothing.

use super::effects::Effects;
use super::terms::LightTerm;

/// A doubtful case that the kernel met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Note {
    /// See [`Notes::lights_at_surface`].
    LightAtSurface,
    /// See [`Notes::near_terminator`].
    NearTerminator,
    /// See [`Notes::opposite_view`].
    OppositeView,
    /// See [`Notes::cancelled_normals`].
    CancelledNormal,
    /// See [`Notes::missing_normals`].
    MissingNormal,
    /// See [`Notes::cancelled_vectors`].
    CancelledVectors,
    /// See [`Notes::perspective_kept`].
    PerspectiveKept,
    /// See [`Notes::non_finite`].
    NonFinite,
}

/// What the kernel tells; every default does nothing.
pub(super) trait Watch {
    /// Whether terms are evaluated that no colour calls for.
    const UNGATED: bool = false;
    /// Whether it may be told of doubtful cases alone, so that several pixels without any are shaded
    /// at once.
    const KNOWS_LANES: bool = false;
    /// A doubtful case.
    #[inline(always)]
    fn note(&mut self, _note: Note) {}
    /// The term of one effect is about to be computed.
    #[inline(always)]
    fn evaluated(&mut self, _effect: Effects) {}
    /// One light is done.
    #[inline(always)]
    fn light(&mut self, _index: usize, _term: &LightTerm) {}
}

/// How often shading met a case that a user should know of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Notes {
    /// Pairs of pixel and light where the light lies at the surface point (r = 0) and gave its
    /// ambient part only.
    pub lights_at_surface: u64,
    /// Pairs of pixel and light with |N·L| < 1e-13: which side of the terminator the point is on
    /// is a matter of rounding, and with it the whole specular part.
    pub near_terminator: u64,
    /// Pairs of pixel and light with L = −V, which have no halfway vector and no specular part.
    pub opposite_view: u64,
    /// Pixels where the interpolated normals cancelled and the face normal was used.
    pub cancelled_normals: u64,
    /// Pixels on faces too thin to have a normal in f64; they get no directed light.
    pub missing_normals: u64,
    /// Pairs of pixel and light where directions interpolated from the corners cancelled (or none
    /// of them exists) and left no direction: none to the light, which gave its ambient part only,
    /// or none to the eye, and no highlight.
    pub cancelled_vectors: u64,
    /// Pixels on triangles with a corner at or behind the eye plane, whose weights stayed
    /// perspective-correct though the scene asks for weights linear on the screen.
    pub perspective_kept: u64,
    /// Pixels whose radiance left the range of f64. Never NaN, but infinite: a defect of the
    /// scene's numbers.
    pub non_finite: u64,
}

impl Notes {
    /// Adds another part's counts.
    pub fn add(&mut self, other: Self) {
        self.lights_at_surface += other.lights_at_surface;
        self.near_terminator += other.near_terminator;
        self.opposite_view += other.opposite_view;
        self.cancelled_normals += other.cancelled_normals;
        self.missing_normals += other.missing_normals;
        self.cancelled_vectors += other.cancelled_vectors;
        self.perspective_kept += other.perspective_kept;
        self.non_finite += other.non_finite;
    }
}

impl Watch for Notes {
    const KNOWS_LANES: bool = true;

    #[inline]
    fn note(&mut self, note: Note) {
        *match note {
            Note::LightAtSurface => &mut self.lights_at_surface,
            Note::NearTerminator => &mut self.near_terminator,
            Note::OppositeView => &mut self.opposite_view,
            Note::CancelledNormal => &mut self.cancelled_normals,
            Note::MissingNormal => &mut self.missing_normals,
            Note::CancelledVectors => &mut self.cancelled_vectors,
            Note::PerspectiveKept => &mut self.perspective_kept,
            Note::NonFinite => &mut self.non_finite,
        } += 1;
    }
}

/// Nobody looks on.
pub(super) struct Nobody;

impl Watch for Nobody {}

/// Nobody looks on, and no term is left out for want of colour.
#[derive(Clone, Copy, Default)]
pub(super) struct Ungated;

impl Watch for Ungated {
    const UNGATED: bool = true;
}

/// How often the term of each effect was computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Evaluations([u64; Effects::NAMED.len()]);

impl Evaluations {
    /// Count of one effect (for a set of several: of its first).
    pub fn of(&self, effect: Effects) -> u64 {
        self.0.get(effect.position()).copied().unwrap_or(0)
    }

    /// The effects with a count above 0.
    pub fn evaluated(&self) -> Effects {
        Effects::NAMED
            .iter()
            .filter(|(effect, _)| self.of(*effect) > 0)
            .fold(Effects::NONE, |set, (effect, _)| set.with(*effect))
    }

    /// Adds another part's counts.
    pub fn add(&mut self, other: Self) {
        for (count, more) in self.0.iter_mut().zip(other.0) {
            *count += more;
        }
    }
}

impl Watch for Evaluations {
    fn evaluated(&mut self, effect: Effects) {
        self.0[effect.position()] += 1;
    }
}
