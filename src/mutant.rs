//! Deliberate mistakes, for tests only: what shows that the tests can fail.
//!
//! Each [`Mutant`] is one wrong variant of production code, the kind of mistake that renderers are
//! known for. The places that decide something ask `is` whether a mistake is planted there; the
//! table of `tests/mutants` plants them one after the other and names the hard case that catches
//! each. Without the cargo feature `mutants` the question is the constant `false`, so that the
//! compiler leaves nothing of it; the program itself is built so.
//! Counted by callgrind on the default scene at 160 × 90, the hooks changed the instructions of a
//! render by −0.06 % (cast) and −0.01 % (raster): layout, not work.
//!
//! The choice is the crate's only global state. It exists only with the feature, and is global so
//! that no signature of production code carries something that production does not have. One
//! process therefore holds one mistake at a time, and a test that plants one has the process to
//! itself.

/// Names every mistake once: variant, name in words, what it does.
macro_rules! mutants {
    ($($variant:ident, $name:literal, $breaks:literal;)+) => {
        /// A wrong variant of production code.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum Mutant {
            $(#[doc = $breaks] $variant,)+
        }

        impl Mutant {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// Its name, in words.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// What goes wrong.
            pub const fn breaks(self) -> &'static str {
                match self { $(Self::$variant => $breaks,)+ }
            }
        }
    };
}

mutants! {
    // The tie rule.
    InclusiveEdges, "inclusive edges", "a sample on an edge belongs to both sides";
    ExclusiveEdges, "exclusive edges", "a sample on an edge belongs to neither side";
    SwappedTies, "swapped ties", "ties look at DY before DX";
    DroppedDy, "dropped DY", "ties look at DX only";
    SignBit, "sign bit", "an edge value of 0 counts by its sign bit, so -0 and +0 differ";
    // Signs of edges.
    BelievedEdges, "believed edges", "the rounded f64 edge value decides, whatever its bound";
    SingleEdges, "f32 edges", "the edge is computed in f32, and is believed";
    ContractedEdges, "contracted edges", "the edge is a fused multiply-add, and is believed";
    EyeTailDropped, "eye tail dropped", "v - e is rounded in the exact stage too";
    CornerSamples, "corner samples", "half a pixel is missing in one path";
    // The plane.
    VolumeZeroHits, "V = 0 hits", "a triangle whose plane holds the eye is seen";
    MirrorGhost, "mirror ghost", "what lies behind the eye is mirrored into view";
    DeterminantEpsilon, "determinant epsilon", "a determinant below 1e-6 means no hit";
    NearPlane, "near plane", "hits nearer than t = 1e-4 are lost";
    EyePlaneRejected, "eye plane rejected", "a triangle with a corner at w <= 0 is dropped";
    OrientationIgnored, "orientation ignored", "the sign of det(P) is taken as +1";
    FacingFlipped, "facing flipped", "front and back are exchanged";
    // Depth.
    SingleDepth, "f32 depth", "depths are computed in f32";
    DoubleDepth, "f64 depth", "depths are compared in f64, without bounds";
    DepthEpsilon, "depth epsilon", "depths that differ by less than 1e-6 count as equal";
    InwardInterval, "interval not outward", "the interval of t is one rounded number";
    LowestIdFirst, "lowest id first", "equal depth at the sample goes to the lowest id";
    LastIdInPlane, "last id in plane", "of triangles in one plane the highest id is seen";
    // The walk through the tree.
    UnpaddedSlabs, "kappa = 1", "slab bounds are compared without room for rounding";
    OpenSlabs, "open slabs", "a box that the ray only touches is missed";
    ClampedReciprocal, "clamped 1/d", "1/d is at most 2^23 in magnitude";
    FiniteReciprocal, "finite 1/0", "1/0 is the largest float, so 0/0 is 0";
    PruneEqual, "prune at equality", "a box at the depth of the nearest hit is skipped";
    EdgeBoxes, "boxes from edges", "boxes are fitted to v0 - (v0 - v1), rounded to f32";
    // Duplicates and counts.
    LostCopies, "lost copies", "folded duplicates count once";
    FoldedReversed, "folded reversed", "a reversed copy is folded with the original";
    LastCopyKept, "last copy kept", "folded duplicates go by their highest id";
    CoverTwice, "cover counted twice", "every copy of a duplicate counts all copies";
    UnsignedCount, "unsigned count", "the signed count ignores the side";
    // Tiles.
    TileEdges, "tile edges", "the last column of a tile is not drawn";
    ShortBounds, "short bounds", "the bounding box ends one pixel early";
    ShortSpan, "short span", "row spans begin two pixels late";
    ShortBins, "short bins", "a triangle misses the last tile that it enters";
    TileCorner, "tile corner", "a tile is dropped when one corner is outside one edge";
    ClosedEdges, "closed edges", "an edge that is 0 in a tile's corner counts as inside";
    // Rays that walk together in tiles.
    BelievedRows, "believed rows", "f32 decides edges and depths, whatever its bound";
    NearerBlocks, "nearer blocks", "a block is skipped unless a triangle is certainly nearer";
    StaleTies, "stale ties", "a tie stays when a nearer triangle covers it";
    TightCone, "tight cone", "a box that the cone of a tile only touches is missed";
    ShortSamples, "short samples", "the last row of a tile that a triangle may cover is left out";
    // What is reported.
    ShiftedWeights, "shifted weights", "barycentric weights belong to the wrong corners";
    UnmarkedTies, "unmarked ties", "a sample on an edge is not reported as a tie";
    // Shadows.
    ShadowAcne, "shadow acne", "rounded sides decide, for the surface's own triangle too";
    ShadowOffset, "shadow offset", "the shadow ray starts a thousandth of the way to the light";
    ShadowBeyondLight, "beyond the light", "what is behind the light casts a shadow";
    ShadowBothSides, "shadow, both sides", "a side of 0 counts as crossed";
    ShadowNeitherSide, "shadow, neither", "a side of 0 counts as missed";
    // The arbiter's shortcut.
    DiscardDoubt, "discard doubt", "the interval test discards what it is not sure of";
    // The control of the table itself.
    Nothing, "nothing (control)", "no place asks for it: it must survive";
}

#[cfg(feature = "mutants")]
mod planted {
    use super::Mutant;
    use std::sync::atomic::{AtomicU8, Ordering};

    /// No mistake.
    const NONE: u8 = u8::MAX;

    /// The mistake that is planted, by its discriminant.
    static PLANTED: AtomicU8 = AtomicU8::new(NONE);

    /// Plants a mistake for the whole process, or none. Not while a picture is computed.
    pub fn plant(mutant: Option<Mutant>) {
        PLANTED.store(mutant.map_or(NONE, |mutant| mutant as u8), Ordering::SeqCst);
    }

    /// Whether this mistake is planted.
    pub(crate) fn is(mutant: Mutant) -> bool {
        PLANTED.load(Ordering::Relaxed) == mutant as u8
    }
}

#[cfg(feature = "mutants")]
pub(crate) use planted::is;
#[cfg(feature = "mutants")]
pub use planted::plant;

/// Whether this mistake is planted: never, in a build without the feature `mutants`.
#[cfg(not(feature = "mutants"))]
#[inline(always)]
pub(crate) const fn is(_: Mutant) -> bool {
    false
}

/// Whether no mistake is planted in the decisions of single rays, or one is in the tiles': only
/// then rays may walk in tiles, which do not ask for the others.
#[inline(always)]
pub(crate) fn spares_tiles() -> bool {
    !cfg!(feature = "mutants")
        || Mutant::ALL.iter().all(|mutant| !is(*mutant) || TILES.contains(mutant))
}

/// The mistakes of rays that walk in tiles.
const TILES: &[Mutant] = &[
    Mutant::BelievedRows,
    Mutant::NearerBlocks,
    Mutant::StaleTies,
    Mutant::TightCone,
    Mutant::ShortSamples,
];

/// The value at the sample and its two derivatives, in the order in which the tie rule asks them:
/// as given, but for planted mistakes.
#[inline(always)]
pub(crate) fn moves<T: Copy>([value, along_x, along_y]: [T; 3]) -> [T; 3] {
    if is(Mutant::SwappedTies) {
        [value, along_y, along_x]
    } else if is(Mutant::DroppedDy) {
        [value, along_x, along_x]
    } else {
        [value, along_x, along_y]
    }
}

/// det(a, b, c) in f32 throughout.
pub(crate) fn single_determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f32 {
    let [a, b, c] = [a, b, c].map(|v| v.map(|component| component as f32));
    let [x, y, z] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| b[i] * c[j] - b[j] * c[i]);
    a[0] * x + a[1] * y + a[2] * z
}

/// t = V/D in f32, as a ray caster without bounds computes it.
pub(crate) fn single_t(eye: [f64; 3], direction: [f64; 3], vertices: &[[f64; 3]; 3]) -> f32 {
    let minus = |p: [f64; 3], q: [f64; 3]| std::array::from_fn(|k| p[k] - q[k]);
    let [v0, v1, v2] = *vertices;
    let (e1, e2) = (minus(v1, v0), minus(v2, v0));
    single_determinant(minus(v0, eye), e1, e2) / single_determinant(direction, e1, e2)
}

/// Weights of three corners: as given, but for a planted mistake.
#[inline(always)]
pub(crate) fn shifted<T>([a, b, c]: [T; 3]) -> [T; 3] {
    if is(Mutant::ShiftedWeights) { [b, c, a] } else { [a, b, c] }
}
