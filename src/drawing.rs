//! Drawings: marks on a white page, in order, kept apart from how they are written.
//!
//! Two writers show the same marks: [`Drawing::to_svg`] as text, [`Drawing::to_picture`] as pixels.
//! Lengths are page units, x to the right, y downwards; one unit is one pixel at scale 1. No axes,
//! no data: what a drawing means is decided by whoever makes the marks.

pub(crate) mod axis;
pub mod glyphs;
pub(crate) mod page;
mod picture;
mod svg;

/// An 8-bit sRGB colour.
pub type Ink = [u8; 3];

/// A point of the page, page units.
pub type Point = [f64; 2];

/// Where a text stands in relation to its point. Vertically it is centred on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// One mark. Coordinates are finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A line through points, with round joins and ends.
    Polyline {
        /// Its points, at least two.
        points: Vec<Point>,
        /// Its colour.
        ink: Ink,
        /// Its width.
        width: f64,
    },
    /// A filled polygon.
    Polygon {
        /// Its corners, at least three.
        points: Vec<Point>,
        /// Its colour.
        ink: Ink,
    },
    /// A filled disc.
    Dot {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
        /// Its colour.
        ink: Ink,
    },
    /// One line of text; every character is [`glyphs::WIDTH`] units wide.
    Text {
        /// Where it stands.
        at: Point,
        /// Which part of it stands there.
        anchor: Anchor,
        /// Its colour.
        ink: Ink,
        /// What it says.
        text: String,
    },
}

/// Marks on a page; later ones cover earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Width of the page, at least 1.
    pub width: u16,
    /// Height of the page, at least 1.
    pub height: u16,
    /// The marks.
    pub marks: Vec<Mark>,
}

impl Drawing {
    /// An empty page; a side of 0 becomes 1.
    pub fn new(width: u16, height: u16) -> Self {
        Self { width: width.max(1), height: height.max(1), marks: Vec::new() }
    }

    /// Adds a line through `points`.
    pub fn line(&mut self, points: Vec<Point>, ink: Ink, width: f64) {
        self.marks.push(Mark::Polyline { points, ink, width });
    }

    /// Adds an arrow from `tail` to `tip`: a line and a filled head of `5 × width` units in length.
    pub fn arrow(&mut self, tail: Point, tip: Point, ink: Ink, width: f64) {
        let along = [tip[0] - tail[0], tip[1] - tail[1]];
        let length = along[0].hypot(along[1]);
        if length == 0.0 {
            return;
        }
        let [x, y] = along.map(|c| c / length);
        let (back, aside) = (5.0 * width, 2.2 * width);
        let base = [tip[0] - back * x, tip[1] - back * y];
        let corner = |side: f64| [base[0] - side * aside * y, base[1] + side * aside * x];
        self.line(vec![tail, base], ink, width);
        self.marks.push(Mark::Polygon { points: vec![tip, corner(1.0), corner(-1.0)], ink });
    }

    /// Adds a disc.
    pub fn dot(&mut self, center: Point, radius: f64, ink: Ink) {
        self.marks.push(Mark::Dot { center, radius, ink });
    }

    /// Adds a line of text.
    pub fn text(&mut self, at: Point, anchor: Anchor, ink: Ink, text: impl Into<String>) {
        self.marks.push(Mark::Text { at, anchor, ink, text: text.into() });
    }

    /// Adds a line of text from its left end on, cut where the page ends.
    pub fn text_cut(&mut self, at: Point, ink: Ink, text: &str) {
        let room = ((f64::from(self.width) - at[0]) / f64::from(glyphs::WIDTH)) as usize;
        let text: String = text.chars().take(room).collect();
        self.text(at, Anchor::Start, ink, text);
    }
}
