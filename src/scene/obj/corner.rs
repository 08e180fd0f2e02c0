//! One corner of a face as OBJ writes it: `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or
//! backwards from −1.

use crate::scene::obj::report::quote;

/// What an index refers to; also its position between the slashes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Position = 0,
    Uv = 1,
    Normal = 2,
}

impl Kind {
    /// In the order of the slashes.
    pub(super) const ALL: [Self; 3] = [Self::Position, Self::Uv, Self::Normal];

    fn statement(self) -> &'static str {
        ["v", "vt", "vn"][self as usize]
    }
}

/// Largest index that is kept: `u32::MAX` marks a missing attribute.
const MAX_INDEX: i64 = u32::MAX as i64 - 1;

/// The three indices as written, never 0; `None` where the corner gives none.
///
/// # Errors
/// A sentence: not a corner, index 0, no position.
pub(super) fn parse(text: &str) -> Result<[Option<i64>; 3], String> {
    let mut indices = [None; 3];
    for (position, part) in text.split('/').enumerate() {
        if position == 3 {
            return Err(format!("{} has more than three indices", quote(text)));
        }
        if part.is_empty() {
            continue;
        }
        let index: i64 =
            part.parse().map_err(|_| format!("{} is not a corner of a face", quote(text)))?;
        if index == 0 {
            return Err(format!("index 0 in {}: OBJ counts from 1", quote(text)));
        }
        indices[position] = Some(index);
    }
    match indices[0] {
        Some(_) => Ok(indices),
        None => Err(format!("{} names no position", quote(text))),
    }
}

/// The 0-based index; `count` statements of its kind precede the face. A positive index may lie
/// beyond them, for the caller to check at the end of the file.
///
/// # Errors
/// A sentence: a negative index reaches before the first statement, or the index is too large.
pub(super) fn resolve(kind: Kind, index: i64, count: u32) -> Result<u32, String> {
    let resolved = if index > 0 { index - 1 } else { index.saturating_add(i64::from(count)) };
    match (0..=MAX_INDEX).contains(&resolved) {
        true => Ok(resolved as u32),
        false => Err(describe_missing(kind, index, count)),
    }
}

/// The sentence for an index that refers to nothing.
pub(super) fn describe_missing(kind: Kind, index: i64, count: u32) -> String {
    let statement = kind.statement();
    let reach = if index < 0 { "precede it" } else { "are in the file" };
    format!("`{statement}` {index} does not exist; {count} {reach}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_forms() {
        assert_eq!(parse("7"), Ok([Some(7), None, None]));
        assert_eq!(parse("7/8"), Ok([Some(7), Some(8), None]));
        assert_eq!(parse("7//-9"), Ok([Some(7), None, Some(-9)]));
        assert_eq!(parse("+7/8/9"), Ok([Some(7), Some(8), Some(9)]));
        assert_eq!(parse("7//"), Ok([Some(7), None, None]));
        for wrong in ["", "/1", "0", "1/0", "1/2/3/4", "1.0", "a", "1/2/3/", "99999999999999999999"]
        {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(resolve(Kind::Position, 1, 4), Ok(0));
        assert_eq!(resolve(Kind::Position, 9, 4), Ok(8));
        assert_eq!(resolve(Kind::Position, -1, 4), Ok(3));
        assert_eq!(resolve(Kind::Position, -4, 4), Ok(0));
        assert!(resolve(Kind::Normal, -5, 4).unwrap_err().contains("`vn` -5"));
        assert!(resolve(Kind::Normal, i64::MIN, 4).is_err());
        assert!(resolve(Kind::Normal, i64::MAX, 4).is_err());
        assert!(resolve(Kind::Normal, i64::from(u32::MAX) + 1, 4).is_err());
    }
}
