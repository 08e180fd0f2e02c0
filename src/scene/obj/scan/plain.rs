//! The plain statements of a stretch of text, which most files consist of: `v` of three numbers,
//! `vt` of two or three, `vn` of three, `f` of positive indices.
//!
//! Stretches are read by many threads, and nothing here depends on what stands before one. Whatever
//! is not plain, faulty or merely rare, is only noted with its place, for the strict reading to
//! take it in the order of the file. What is taken here means the same to the strict reading: the
//! tests hold the two together.

use crate::mesh::NO_ATTRIBUTE;
use crate::scene::obj::scanned::Corner;
use crate::scene::obj::statement::Statements;
use std::ops::Range;
use std::path::Path;

/// What a stretch of text says.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) uvs: Vec<[f64; 2]>,
    pub(super) normals: Vec<[f64; 3]>,
    /// The corners of all faces, one after the other.
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<PlainFace>,
    pub(super) others: Vec<Other>,
    /// Number of lines that end in the stretch.
    pub(super) lines: u32,
    /// One more than the largest index of each kind.
    pub(super) reach: [u32; 3],
    /// A statement reaches beyond the stretch: it cannot be read by itself.
    pub(super) is_torn: bool,
}

/// A face of a stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlainFace {
    /// Line, 0-based from the start of the stretch.
    pub(super) line: u32,
    /// End of its corners.
    pub(super) corners_end: usize,
}

/// A statement that is left to the strict reading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Other {
    /// Byte position in the whole text.
    pub(super) position: usize,
    /// Line, 0-based from the start of the stretch.
    pub(super) line: u32,
    /// What of the stretch stands before it.
    pub(super) before: Before,
}

/// How many plain statements of each kind were read.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Before {
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
    pub(super) faces: usize,
}

impl Stretch {
    /// How many plain statements of each kind there are.
    pub(super) fn size(&self) -> Before {
        Before {
            positions: self.positions.len(),
            uvs: self.uvs.len(),
            normals: self.normals.len(),
            faces: self.faces.len(),
        }
    }
}

/// Reads a range of `text` that begins at a line's start.
pub(super) fn read(text: &str, file: &Path, range: Range<usize>) -> Stretch {
    let mut stretch = Stretch::default();
    let mut line = Line { bytes: text.as_bytes(), at: range.start };
    while line.at < range.end {
        let start = line.at;
        match read_line(&mut line, text, &mut stretch) {
            Some(()) => stretch.lines += 1,
            None => {
                // Take back a face's corners, and step over the statement as the strict reading does.
                stretch.corners.truncate(stretch.faces.last().map_or(0, |face| face.corners_end));
                let mut walk = Statements::resume(text, file, start, stretch.lines);
                if !walk.advance() || walk.position() > range.end {
                    stretch.is_torn = true;
                    return stretch;
                }
                let before = stretch.size();
                stretch.others.push(Other { position: start, line: stretch.lines, before });
                (line.at, stretch.lines) = (walk.position(), walk.line());
            }
        }
    }
    stretch
}

/// Reads a line with its end; `None` where it is neither empty nor plain.
fn read_line(line: &mut Line<'_>, text: &str, stretch: &mut Stretch) -> Option<()> {
    line.skip_blanks();
    let word = (line.peek(0), line.peek(1));
    let is_blank = |byte: Option<u8>| matches!(byte, Some(b' ' | b'\t'));
    match word {
        (None | Some(b'\n' | b'\r'), _) => {}
        (Some(b'#'), _) => line.skip_rest(),
        (Some(b'v'), second) if is_blank(second) => {
            line.at += 1;
            let position = [line.number(text)?, line.number(text)?, line.number(text)?];
            line.skip_blanks();
            line.end()?;
            stretch.positions.push(position);
            return Some(());
        }
        (Some(b'v'), Some(b't')) if is_blank(line.peek(2)) => {
            line.at += 2;
            let uv = [line.number(text)?, line.number(text)?];
            line.skip_blanks();
            if line.end().is_none() {
                // The third coordinate of a texture in space, which only must be a number.
                line.number(text)?;
                line.skip_blanks();
                line.end()?;
            }
            stretch.uvs.push(uv);
            return Some(());
        }
        (Some(b'v'), Some(b'n')) if is_blank(line.peek(2)) => {
            line.at += 2;
            let normal = [line.number(text)?, line.number(text)?, line.number(text)?];
            line.skip_blanks();
            line.end()?;
            // One of length 0 is remarked upon.
            return (normal != [0.0; 3]).then(|| stretch.normals.push(normal));
        }
        (Some(b'f'), second) if is_blank(second) => {
            line.at += 1;
            return read_face(line, stretch);
        }
        _ => return None,
    }
    line.end()
}

/// Reads the corners of a face and the line's end.
fn read_face(line: &mut Line<'_>, stretch: &mut Stretch) -> Option<()> {
    let first = stretch.corners.len();
    loop {
        line.skip_blanks();
        if line.end().is_some() {
            break;
        }
        let mut corner = [line.index()?, NO_ATTRIBUTE, NO_ATTRIBUTE];
        if line.take(b'/') {
            let has_uv = line.peek(0) != Some(b'/');
            if has_uv {
                corner[1] = line.index()?;
            }
            if line.take(b'/') {
                corner[2] = line.index()?;
            }
        }
        if !line.is_at_blank() {
            return None;
        }
        stretch.corners.push(corner);
    }
    let corners = &stretch.corners[first..];
    if corners.len() < 3 {
        return None;
    }
    for corner in corners {
        for (reach, &index) in stretch.reach.iter_mut().zip(corner) {
            // "None" wraps to 0.
            *reach = (*reach).max(index.wrapping_add(1));
        }
    }
    let corners_end = stretch.corners.len();
    stretch.faces.push(PlainFace { line: stretch.lines, corners_end });
    Some(())
}

/// A place in the text.
struct Line<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Line<'_> {
    #[inline]
    fn peek(&self, ahead: usize) -> Option<u8> {
        self.bytes.get(self.at + ahead).copied()
    }

    #[inline]
    fn skip_blanks(&mut self) {
        while matches!(self.peek(0), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    /// Steps over the rest of the line, up to its end.
    fn skip_rest(&mut self) {
        while !matches!(self.peek(0), None | Some(b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    /// Steps over a line's end, if one stands here. A lone `\r` is left to the strict reading.
    #[inline]
    fn end(&mut self) -> Option<()> {
        match self.peek(0) {
            Some(b'\n') => self.at += 1,
            Some(b'\r') if self.peek(1) == Some(b'\n') => self.at += 2,
            None => {}
            _ => return None,
        }
        Some(())
    }

    #[inline]
    fn take(&mut self, byte: u8) -> bool {
        let is_here = self.peek(0) == Some(byte);
        self.at += usize::from(is_here);
        is_here
    }

    #[inline]
    fn is_at_blank(&self) -> bool {
        matches!(self.peek(0), None | Some(b' ' | b'\t' | b'\n' | b'\r'))
    }

    /// A positive index, 0-based then. One of more than 9 digits is not plain: it might not fit.
    #[inline]
    fn index(&mut self) -> Option<u32> {
        let start = self.at;
        let mut index = 0_u32;
        while let Some(digit @ b'0'..=b'9') = self.peek(0) {
            if self.at - start == 9 {
                return None;
            }
            index = 10 * index + u32::from(digit - b'0');
            self.at += 1;
        }
        index.checked_sub(1)
    }

    /// A finite number between blanks.
    #[inline]
    fn number(&mut self, text: &str) -> Option<f64> {
        self.skip_blanks();
        let start = self.at;
        let is_negative = self.take(b'-');
        let (mut digits, mut value, mut decimals) = (0, 0_u64, 0);
        let mut has_point = false;
        while let Some(byte) = self.peek(0) {
            match byte {
                b'0'..=b'9' if digits < 19 => {
                    value = 10 * value + u64::from(byte - b'0');
                    digits += 1;
                    decimals += usize::from(has_point);
                }
                b'.' if !has_point => has_point = true,
                _ => break,
            }
            self.at += 1;
        }
        // Digits and a power of ten that are exact in f64: one division, correctly rounded, as
        // any correct reading rounds (W. D. Clinger, "How to Read Floating Point Numbers
        // Accurately", 1990). 19 digits fit a u64.
        if digits > 0 && value <= EXACT && self.is_at_blank() {
            let size = value as f64 / POWERS[decimals];
            return Some(if is_negative { -size } else { size });
        }
        while !self.is_at_blank() {
            self.at += 1;
        }
        let number: f64 = text.get(start..self.at)?.parse().ok()?;
        number.is_finite().then_some(number)
    }
}

/// Largest integer up to which all are exact in f64.
const EXACT: u64 = 1 << 53;

/// Powers of ten, all exact in f64.
const POWERS: [f64; 20] = {
    let mut powers = [1.0; 20];
    let mut exponent = 1;
    while exponent < 20 {
        powers[exponent] = 10.0 * powers[exponent - 1];
        exponent += 1;
    }
    powers
};
