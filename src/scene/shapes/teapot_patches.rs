//! The control points of the Utah teapot, as numbers.
//!
//! M. Newell, "The utilization of procedure models in digital image synthesis", PhD thesis,
//! University of Utah, 1975: 28 bicubic patches; the four of the bottom were added later by
//! F. Crow. The heights are those of the data set as it has been passed on since, which J. Blinn
//! had divided by 1.3. Coordinates are those of the data set: z up, the spout towards +x.
//!
//! Every horizontal ring of body, lid and bottom is four equal quarters, every ring of handle and
//! spout two mirrored halves, so each ring is written once.

/// A ring of a surface of revolution: radius, distance of the inner control points from the axis
/// planes, and height. Its first quarter has the control points
/// (r, 0, z), (r, k, z), (k, r, z), (0, r, z).
pub(super) type Ring = [f64; 3];

/// A ring of a tube: x and z where it crosses the plane y = 0 first, x and z where it crosses
/// second, and its half width. Its first half has the control points
/// (x, 0, z), (x, w, z), (x', w, z'), (x', 0, z').
pub(super) type Loop = [f64; 5];

/// The rim and the body, from the rim's inner edge down: three bands of four patches.
pub(super) const BODY: [[Ring; 4]; 3] = [
    [[1.4, 0.784, 2.4], [1.3375, 0.749, 2.53125], [1.4375, 0.805, 2.53125], [1.5, 0.84, 2.4]],
    [[1.5, 0.84, 2.4], [1.75, 0.98, 1.875], [2.0, 1.12, 1.35], [2.0, 1.12, 0.9]],
    [[2.0, 1.12, 0.9], [2.0, 1.12, 0.45], [1.5, 0.84, 0.225], [1.5, 0.84, 0.15]],
];

/// The bottom, from the body's lower edge to the centre: one band of four patches.
pub(super) const BOTTOM: [Ring; 4] =
    [[1.5, 0.84, 0.15], [1.5, 0.84, 0.075], [1.425, 0.798, 0.0], [0.0, 0.0, 0.0]];

/// The lid with its knob, from the tip down: two bands of four patches. (The knob's 0.45 is
/// Newell's; 0.56 times the radius, as everywhere else, would be 0.448.)
pub(super) const LID: [[Ring; 4]; 2] = [
    [[0.0, 0.0, 3.15], [0.8, 0.45, 3.15], [0.0, 0.0, 2.85], [0.2, 0.112, 2.7]],
    [[0.2, 0.112, 2.7], [0.4, 0.224, 2.55], [1.3, 0.728, 2.55], [1.3, 0.728, 2.4]],
];

/// The handle, from its upper to its lower end: two bands of two patches.
pub(super) const HANDLE: [[Loop; 4]; 2] = [
    [
        [-1.6, 2.025, -1.5, 2.25, 0.3],
        [-2.3, 2.025, -2.5, 2.25, 0.3],
        [-2.7, 2.025, -3.0, 2.25, 0.3],
        [-2.7, 1.8, -3.0, 1.8, 0.3],
    ],
    [
        [-2.7, 1.8, -3.0, 1.8, 0.3],
        [-2.7, 1.575, -3.0, 1.35, 0.3],
        [-2.5, 1.125, -2.65, 0.9375, 0.3],
        [-2.0, 0.9, -1.9, 0.6, 0.3],
    ],
];

/// The spout, from the body to its mouth: two bands of two patches.
pub(super) const SPOUT: [[Loop; 4]; 2] = [
    [
        [1.7, 1.425, 1.7, 0.6, 0.66],
        [2.6, 1.425, 3.1, 0.825, 0.66],
        [2.3, 2.1, 2.4, 2.025, 0.25],
        [2.7, 2.4, 3.3, 2.4, 0.25],
    ],
    [
        [2.7, 2.4, 3.3, 2.4, 0.25],
        [2.8, 2.475, 3.525, 2.49375, 0.25],
        [2.9, 2.475, 3.45, 2.5125, 0.15],
        [2.8, 2.4, 3.2, 2.4, 0.15],
    ],
];
