//! What is measured on a scene: a list of variants, each a piece of work with an answer to check.
//!
//! Another accuracy, another width of SIMD or another program's kernel is one more variant; ours are
//! listed by [`super::kernels`], other programs' by [`super::peers`].

use super::peers::Hits;
use crate::film::Film;
use crate::visibility::{NearestBuffer, VisibilityBuffer};
use std::cell::RefCell;
use std::hint::black_box;
use std::rc::Rc;
use std::sync::Arc;

/// A kind of work, of which a workload may leave out any.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Work {
    /// Building a tree over the mesh.
    Build,
    /// The nearest triangle along one ray per pixel.
    Closest,
    /// Whether anything stands between each visible point and a light: the first of the scene that
    /// has a place or a direction, whether it casts shadows in its pictures or not.
    Any,
    /// The nearest triangle at every pixel by the rasterizer.
    Raster,
    /// Every triangle at every pixel, counted, by either path.
    Cover,
    /// Colours from what is visible, and the planes of the film.
    Shade,
    /// A whole frame from the scene.
    Frame,
}

impl Work {
    /// Every kind, in the order of a report.
    pub const ALL: [Self; 7] = [
        Self::Build,
        Self::Closest,
        Self::Any,
        Self::Raster,
        Self::Cover,
        Self::Shade,
        Self::Frame,
    ];

    /// Its word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Build => "build",
            Self::Closest => "closest",
            Self::Any => "any",
            Self::Raster => "raster",
            Self::Cover => "cover",
            Self::Shade => "shade",
            Self::Frame => "frame",
        }
    }

    /// What it works through.
    pub const fn unit(self) -> Unit {
        match self {
            Self::Build => Unit::Triangles,
            Self::Closest | Self::Any => Unit::Rays,
            Self::Raster | Self::Cover | Self::Shade | Self::Frame => Unit::Pixels,
        }
    }

    /// So many of its unit.
    pub const fn of(self, count: usize) -> Amount {
        Amount { count, unit: self.unit() }
    }
}

/// How much a variant works through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Amount {
    /// How many.
    pub count: usize,
    /// Of what.
    pub unit: Unit,
}

/// What a variant works through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Triangles of the mesh.
    Triangles,
    /// Rays: one per pixel, or one per visible point.
    Rays,
    /// Pixels of the frame.
    Pixels,
}

impl Unit {
    /// Its name, one of them.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Triangles => "triangle",
            Self::Rays => "ray",
            Self::Pixels => "pixel",
        }
    }

    /// The unit of its rate.
    pub const fn rate(self) -> &'static str {
        match self {
            Self::Triangles => "Mtriangle/s",
            Self::Rays => "Mray/s",
            Self::Pixels => "Mpixel/s",
        }
    }
}

/// What a variant hands back to be checked.
#[derive(Debug)]
pub enum Answer {
    /// Which triangle is visible at each pixel.
    Visibility(VisibilityBuffer),
    /// The nearest triangle at each pixel, in a buffer that is there already.
    Nearest(Rc<RefCell<NearestBuffer>>),
    /// A film with the plane `id.prim`.
    Film(Film),
    /// What another program has written.
    Hits(Arc<Hits>),
    /// Whether something stands before the light at each pixel.
    Shadowed(Vec<bool>),
    /// Nothing that can be right or wrong.
    Unchecked,
}

/// One thing that is measured.
pub struct Variant<'a> {
    /// Its name, unique in the workload: the key by which reports are compared.
    pub name: String,
    /// What kind of work it is.
    pub work: Work,
    /// What it works through.
    pub amount: Amount,
    /// The other program whose work it is; `None` for ours.
    pub program: Option<String>,
    /// Whether its answers are promised to be exact.
    pub is_exact: bool,
    run: Box<dyn Fn() -> Answer + 'a>,
}

impl<'a> Variant<'a> {
    /// Any work, through `count` of its unit.
    pub fn new(
        name: impl Into<String>,
        work: Work,
        count: usize,
        run: impl Fn() -> Answer + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            work,
            amount: work.of(count),
            program: None,
            is_exact: true,
            run: Box::new(run),
        }
    }

    /// Work that answers what is visible.
    pub fn visibility(
        name: impl Into<String>,
        work: Work,
        count: usize,
        run: impl Fn() -> VisibilityBuffer + 'a,
    ) -> Self {
        Self::new(name, work, count, move || Answer::Visibility(run()))
    }

    /// The same as another program's work, which promises nothing.
    pub fn of(self, program: &str) -> Self {
        Self { program: Some(program.to_owned()), is_exact: false, ..self }
    }

    /// The same as work that promises nothing, to be compared with.
    pub fn unproven(self) -> Self {
        Self { is_exact: false, ..self }
    }

    /// Does the work once.
    pub fn run(&self) -> Answer {
        black_box((self.run)())
    }
}
