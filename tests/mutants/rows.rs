//! Which case catches which mistake, where.
//!
//! A case's name is its hard case and then either a golden scene or a builder of `cases`. Where
//! one break alone changes nothing, because the code protects itself twice, the mistake breaks
//! both protections; the row says so.

use crate::judge::Path::{self, Cast, Exact, Raster};
use truecast::mutant::Mutant;

/// A mistake, the answerers that hold it, and the case that shows it in each of them.
pub(crate) struct Row {
    pub(crate) mutant: Mutant,
    pub(crate) paths: &'static [Path],
    pub(crate) case: &'static str,
}

const fn row(mutant: Mutant, paths: &'static [Path], case: &'static str) -> Row {
    Row { mutant, paths, case }
}

const ALL: &[Path] = &[Cast, Raster, Exact];
const BOTH: &[Path] = &[Cast, Raster];
const CAST: &[Path] = &[Cast];
const RASTER: &[Path] = &[Raster];
const EXACT: &[Path] = &[Exact];

/// The control: it must survive everywhere.
pub(crate) const CONTROL: Row = row(Mutant::Nothing, ALL, "H03 grid_exact");

pub(crate) const ROWS: &[Row] = &[
    // The tie rule. Edges along the axes and falling diagonals look the same with DX and DY
    // exchanged; the fan has rising ones.
    row(Mutant::InclusiveEdges, ALL, "H01 fan8"),
    row(Mutant::ExclusiveEdges, ALL, "H03 grid_exact"),
    row(Mutant::SwappedTies, ALL, "H01 fan8"),
    row(Mutant::DroppedDy, ALL, "H06 topleft_upper"),
    row(Mutant::SignBit, BOTH, "H03 grid_exact"),
    // Signs of edges. H12 as it stands is exact in f64, contracted or not: products of two f32 do
    // not round there. Rays with 53 bits through the edges of a sphere take its place.
    row(Mutant::BelievedEdges, BOTH, "H16 aimed rays"),
    row(Mutant::SingleEdges, CAST, "H16 aimed rays"),
    row(Mutant::ContractedEdges, BOTH, "H16 aimed rays"),
    row(Mutant::EyeTailDropped, CAST, "H72 eye 2^-60 beside an edge"),
    row(Mutant::CornerSamples, BOTH, "H03 grid_exact"),
    // The plane. Eyes in a plane but outside the triangle (H43) see edges of both signs, so that
    // V = 0 matters only for an eye inside it.
    row(Mutant::VolumeZeroHits, ALL, "H46 eye inside"),
    row(Mutant::MirrorGhost, BOTH, "H47 behind the eye"),
    row(Mutant::DeterminantEpsilon, ALL, "H70 grid_exact_scaled_2^-60"),
    row(Mutant::NearPlane, CAST, "H4B grid_exact_scaled_2^-60"),
    row(Mutant::EyePlaneRejected, RASTER, "H40 two_behind"),
    row(Mutant::OrientationIgnored, RASTER, "H83 mirrored camera"),
    row(Mutant::FacingFlipped, ALL, "H06 topleft_upper"),
    // Depth.
    row(Mutant::SingleDepth, BOTH, "H25 slanted one ulp apart"),
    row(Mutant::DoubleDepth, BOTH, "H26 interpenetrating_2^-20"),
    row(Mutant::DepthEpsilon, BOTH, "H24 parallel_1ulp_far_first"),
    row(Mutant::InwardInterval, BOTH, "H23 long coplanar"),
    row(Mutant::LowestIdFirst, ALL, "H27 fold"),
    row(Mutant::LastIdInPlane, ALL, "H23 coplanar_tilted"),
    // The walk. A closed comparison and the padding protect flat boxes twice: `open slabs` breaks
    // both. So do the strict comparison with the reach and the reach's own outward rounding:
    // `prune at equality` takes the lower end of the hit's interval as its reach.
    row(Mutant::UnpaddedSlabs, CAST, "H56 corner rays"),
    row(Mutant::OpenSlabs, CAST, "H54 grid_exact"),
    row(Mutant::ClampedReciprocal, CAST, "H51 box beside the ray"),
    row(Mutant::FiniteReciprocal, CAST, "H50 ray in a box face"),
    row(Mutant::PruneEqual, CAST, "H63 coplanar leaves"),
    row(Mutant::EdgeBoxes, CAST, "H62 one corner at 1e8"),
    // Duplicates and counts.
    row(Mutant::LostCopies, CAST, "H20 dup3"),
    row(Mutant::FoldedReversed, CAST, "H21 reversed copies"),
    row(Mutant::LastCopyKept, CAST, "H20 dup3"),
    row(Mutant::CoverTwice, CAST, "H20 dup3"),
    row(Mutant::UnsignedCount, ALL, "H21 reversed copies"),
    // Tiles. A right edge on samples is exclusive, and hides a box that ends early: the square's
    // edges lie between samples.
    row(Mutant::TileEdges, BOTH, "H84 grid_exact"),
    row(Mutant::ShortBounds, RASTER, "H07 square between samples"),
    row(Mutant::ShortSpan, RASTER, "H06 topleft_lower"),
    row(Mutant::ShortBins, RASTER, "H84 grid_exact"),
    row(Mutant::TileCorner, RASTER, "H06 topleft_upper"),
    row(Mutant::ClosedEdges, RASTER, "H03 grid_exact"),
    // Rays that walk together.
    row(Mutant::BelievedRows, CAST, "H03 grid_exact"),
    row(Mutant::NearerBlocks, CAST, "H23 long coplanar"),
    row(Mutant::StaleTies, CAST, "H22 near after a tie"),
    row(Mutant::TightCone, CAST, "H16 aimed rays"),
    row(Mutant::ShortSamples, CAST, "H16 aimed rays"),
    // What is reported.
    row(Mutant::ShiftedWeights, ALL, "H06 topleft_upper"),
    row(Mutant::UnmarkedTies, ALL, "H06 topleft_upper"),
    // Shadows; their cases have lights, and what is counted are wrong shadows too. A surface that is
    // parallel to an axis has points without rounding, so that the rounded sides are right: the
    // wall of the acne is slanted.
    row(Mutant::ShadowAcne, CAST, "shadow slanted wall"),
    row(Mutant::ShadowOffset, CAST, "shadow blade on a wall"),
    row(Mutant::ShadowBeyondLight, CAST, "shadow light before a blade"),
    row(Mutant::ShadowBothSides, CAST, "shadow grid_exact"),
    row(Mutant::ShadowNeitherSide, CAST, "shadow grid over a wall"),
    // The arbiter's shortcut.
    row(Mutant::DiscardDoubt, EXACT, "H03 grid_exact"),
];
