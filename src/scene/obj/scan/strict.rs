//! The statements that are read one by one: what earlier ones mean for the following, and every fault
//! with its place.

use super::plain::{Before, Stretch};
use crate::mesh::NO_ATTRIBUTE;
use crate::scene::error::{Place, SceneError};
use crate::scene::obj::color::{self, WHITE};
use crate::scene::obj::corner::{self, Kind};
use crate::scene::obj::report::{Report, quote};
use crate::scene::obj::scanned::{Corner, Face, Name, Scan};
use crate::scene::obj::statement::{Statements, Token};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Words of the OBJ specification that make no surface of triangles.
const FREE_FORM: &[&str] = &[
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end", "con", "bzp", "bsp", "cdc", "cdp", "res",
];

/// Words of the OBJ specification about display, layers and other files.
const DISPLAY: &[&str] = &[
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "maplib",
    "usemap",
    "call",
    "csh",
    "mg",
];

/// What earlier statements mean for the following ones.
pub(super) struct State<'a> {
    pub(super) scan: Scan,
    /// How many `v` have a colour.
    colored: u32,
    group: u32,
    has_groups: bool,
    material: u32,
    /// A `usemtl` that no face has used yet.
    next_material: Option<Name>,
    material_positions: HashMap<String, u32>,
    /// References to statements that had not come yet when they were read.
    forward: Vec<(Kind, u32, Token<'a>)>,
    skip_bad: bool,
    /// Positions that are not finite, if they are skipped.
    bad_positions: HashSet<u32>,
}

impl<'a> State<'a> {
    pub(super) fn new(skip_bad: bool) -> Self {
        Self {
            scan: Scan::default(),
            colored: 0,
            group: 0,
            has_groups: false,
            material: NO_ATTRIBUTE,
            next_material: None,
            material_positions: HashMap::new(),
            forward: Vec::new(),
            skip_bad,
            bad_positions: HashSet::new(),
        }
    }

    /// Makes room for what stretches hold.
    pub(super) fn reserve(&mut self, stretches: &[Stretch]) {
        let sum = |count: fn(&Stretch) -> usize| stretches.iter().map(count).sum();
        self.scan.positions.reserve_exact(sum(|stretch| stretch.positions.len()));
        self.scan.uvs.reserve_exact(sum(|stretch| stretch.uvs.len()));
        self.scan.normals.reserve_exact(sum(|stretch| stretch.normals.len()));
        self.scan.corners.reserve_exact(sum(|stretch| stretch.corners.len()));
        self.scan.faces.reserve_exact(sum(|stretch| stretch.faces.len()));
    }

    /// Appends plain statements of a stretch that begins at a line.
    pub(super) fn append(&mut self, stretch: &Stretch, from: Before, to: Before, line: u32) {
        let scan = &mut self.scan;
        scan.positions.extend_from_slice(&stretch.positions[from.positions..to.positions]);
        scan.uvs.extend_from_slice(&stretch.uvs[from.uvs..to.uvs]);
        scan.normals.extend_from_slice(&stretch.normals[from.normals..to.normals]);
        let added = [
            (Kind::Position, to.positions - from.positions),
            (Kind::Uv, to.uvs - from.uvs),
            (Kind::Normal, to.normals - from.normals),
        ];
        for (kind, added) in added {
            let count = &mut scan.counts[kind as usize];
            *count = count.saturating_add(u32::try_from(added).unwrap_or(u32::MAX));
        }
        let faces = &stretch.faces[from.faces..to.faces];
        let Some(last) = faces.last() else { return };
        self.use_material();
        let first = from.faces.checked_sub(1).map_or(0, |face| stretch.faces[face].corners_end);
        let (group, material, before) = (self.group, self.material, self.scan.corners.len());
        self.scan.corners.extend_from_slice(&stretch.corners[first..last.corners_end]);
        self.scan.faces.extend(faces.iter().map(|face| Face {
            line: line + face.line,
            corners_end: before + face.corners_end - first,
            group,
            material,
        }));
    }

    pub(super) fn read(
        &mut self,
        walk: &Statements<'a>,
        file: &Path,
        report: &mut Report,
    ) -> Result<(), SceneError> {
        let keyword = walk.keyword();
        let line = keyword.line;
        match keyword.text {
            "v" => return self.read_position(walk, file, report),
            "vt" => return self.read_attribute(walk, Kind::Uv, &[1, 2, 3]),
            "vn" => {
                if walk.values().iter().all(|token| token.text.parse() == Ok(0.0)) {
                    report.warn(file, line, "a normal of length 0 counts as missing");
                }
                return self.read_attribute(walk, Kind::Normal, &[3]);
            }
            "f" | "fo" => return self.read_face(walk),
            "s" => return self.read_group(walk),
            "g" | "o" => {}
            "mtllib" => match walk.name() {
                name if name.is_empty() => report.warn(file, line, "`mtllib` names no file"),
                text => self.scan.libraries.push(Name { text, line }),
            },
            "usemtl" => {
                let text = walk.name();
                if text.is_empty() {
                    let sentence = "`usemtl` names no material; the default one is used";
                    report.warn(file, line, sentence);
                }
                self.next_material = Some(Name { text, line });
            }
            "l" => report.warn(file, line, "lines (`l`) are no surfaces and left out"),
            "p" => report.warn(file, line, "points (`p`) are no surfaces and left out"),
            word if FREE_FORM.contains(&word) => {
                report.warn(file, line, "free-form curves and surfaces are left out");
            }
            word if DISPLAY.contains(&word) => {
                let sentence = format!("`{word}` statements have no effect here");
                report.warn(file, line, &sentence);
            }
            word => {
                let sentence = format!("unknown statements {} are left out", quote(word));
                report.warn(file, line, &sentence);
            }
        }
        Ok(())
    }

    /// `v x y z`, with a weight or a colour or both behind it.
    fn read_position(
        &mut self,
        walk: &Statements<'_>,
        file: &Path,
        report: &mut Report,
    ) -> Result<(), SceneError> {
        let values = walk.values();
        if values.len() > 3 {
            // The weight is one of rational curves and surfaces; polygons do not divide by it.
            if matches!(values.len(), 4 | 7) && values[3].text.parse() != Ok(1.0) {
                let sentence = "the fourth number of `v` is a weight of free-form surfaces; it is \
                                ignored";
                report.warn(file, walk.keyword().line, sentence);
            }
        }
        self.read_attribute(walk, Kind::Position, &[3, 4, 6, 7])?;
        match values.len() {
            6 | 7 => self.read_color(walk, &values[values.len() - 3..], file, report),
            _ => Ok(()),
        }
    }

    /// The last three numbers of `v x y z r g b` and `v x y z w r g b`.
    fn read_color(
        &mut self,
        walk: &Statements<'_>,
        values: &[Token<'_>],
        file: &Path,
        report: &mut Report,
    ) -> Result<(), SceneError> {
        let color = color::read(walk, values, file, report)?;
        // The statements before the first colour had none.
        let number = self.scan.counts[Kind::Position as usize] as usize;
        self.scan.colors.resize(number, WHITE);
        self.scan.colors[number - 1] = color;
        self.colored += 1;
        Ok(())
    }

    /// Checks the numbers of a `v`, `vt` or `vn` and passes on those that count.
    fn read_attribute(
        &mut self,
        walk: &Statements<'_>,
        kind: Kind,
        lengths: &[usize],
    ) -> Result<(), SceneError> {
        // A wrong statement still counts, so that later indices are not all wrong with it.
        let count = &mut self.scan.counts[kind as usize];
        *count = count.saturating_add(1);
        let (keyword, values) = (walk.keyword(), walk.values());
        if !lengths.contains(&values.len()) {
            let wanted: Vec<String> = lengths.iter().map(ToString::to_string).collect();
            let message = format!(
                "`{}` has {} numbers; it takes {}",
                keyword.text,
                values.len(),
                wanted.join(" or ")
            );
            return Err(SceneError::scene(walk.place(&keyword), message));
        }
        let width = if kind == Kind::Uv { 2 } else { 3 };
        let is_skipped = self.skip_bad
            && kind == Kind::Position
            && values[..width].iter().any(|token| is_infinite_or_nan(token.text));
        let mut numbers = [0.0; 3];
        if is_skipped {
            // It keeps its number, and the faces that use it go in the end.
            self.bad_positions.insert(self.scan.counts[kind as usize] - 1);
        } else {
            for (position, token) in values.iter().enumerate() {
                let number = walk.number(token)?;
                if position < width {
                    numbers[position] = number;
                }
            }
        }
        match kind {
            Kind::Position => self.scan.positions.push(numbers),
            Kind::Uv => self.scan.uvs.push([numbers[0], numbers[1]]),
            Kind::Normal => self.scan.normals.push(numbers),
        }
        Ok(())
    }

    fn read_face(&mut self, walk: &Statements<'a>) -> Result<(), SceneError> {
        let (keyword, values) = (walk.keyword(), walk.values());
        if values.len() < 3 {
            let message = format!("a face of {} corners; it needs at least 3", values.len());
            return Err(SceneError::scene(walk.place(&keyword), message));
        }
        self.use_material();
        for token in values {
            let corner = self.read_corner(walk, token)?;
            self.scan.corners.push(corner);
        }
        self.scan.faces.push(Face {
            line: keyword.line,
            corners_end: self.scan.corners.len(),
            group: self.group,
            material: self.material,
        });
        Ok(())
    }

    fn read_corner(
        &mut self,
        walk: &Statements<'a>,
        token: &Token<'a>,
    ) -> Result<Corner, SceneError> {
        let fault = |message: String| SceneError::scene(walk.place(token), message);
        let written = corner::parse(token.text).map_err(fault)?;
        let mut resolved = [NO_ATTRIBUTE; 3];
        for kind in Kind::ALL {
            let Some(index) = written[kind as usize] else { continue };
            let count = self.scan.counts[kind as usize];
            let index = corner::resolve(kind, index, count).map_err(fault)?;
            if index >= count {
                self.forward.push((kind, index, *token));
            }
            resolved[kind as usize] = index;
        }
        Ok(resolved)
    }

    /// `s N`, `s on` (group 1), `s off` and `s 0` (none).
    fn read_group(&mut self, walk: &Statements<'_>) -> Result<(), SceneError> {
        self.has_groups = true;
        let word = walk.values().first().map_or("", |token| token.text);
        self.group = match word {
            "off" | "null" => 0,
            "on" => 1,
            number => number.parse().map_err(|_| {
                let place = walk.place(walk.values().first().unwrap_or(&walk.keyword()));
                let message = format!("{} is not a smoothing group", quote(number));
                SceneError::scene(place, message).with_help("write a number from 0 on, or `off`")
            })?,
        };
        Ok(())
    }

    /// Gives the last `usemtl` its position, now that a face uses it.
    fn use_material(&mut self) {
        let Some(name) = self.next_material.take() else { return };
        if name.text.is_empty() {
            self.material = NO_ATTRIBUTE;
        } else if let Some(&position) = self.material_positions.get(&name.text) {
            self.material = position;
        } else {
            self.material = self.scan.materials.len() as u32;
            self.material_positions.insert(name.text.clone(), self.material);
            self.scan.materials.push(name);
        }
    }

    pub(super) fn finish(
        mut self,
        walk: &Statements<'_>,
        file: &Path,
        report: &mut Report,
    ) -> Scan {
        // Positive indices may point forward, so that only the end shows which exist.
        for (kind, index, token) in std::mem::take(&mut self.forward) {
            let count = self.scan.counts[kind as usize];
            if index >= count {
                report.error_with(|| {
                    let message = corner::describe_missing(kind, i64::from(index) + 1, count);
                    SceneError::scene(walk.place(&token), message)
                });
            }
        }
        let positions = self.scan.counts[Kind::Position as usize];
        if self.colored > 0 && self.colored < positions {
            self.scan.colors.resize(positions as usize, WHITE);
            let missing = positions - self.colored;
            let sentence =
                format!("{missing} of {positions} vertices have no colour; they are white");
            report.warn(file, 0, &sentence);
        }
        self.leave_out_bad_faces(file, report);
        if !self.has_groups {
            self.scan.faces.iter_mut().for_each(|face| face.group = 1);
        }
        if self.scan.faces.is_empty() && !report.has_errors() {
            let message = match self.bad_positions.is_empty() {
                true => "the file holds no faces",
                false => "the file holds no faces with finite corners",
            };
            report.error(SceneError::scene(Place::file(file), message));
        }
        self.scan
    }

    /// Takes the faces out that use a bad position.
    fn leave_out_bad_faces(&mut self, file: &Path, report: &mut Report) {
        if self.bad_positions.is_empty() {
            return;
        }
        let all = std::mem::take(&mut self.scan.corners);
        let mut start = 0;
        self.scan.faces.retain_mut(|face| {
            let corners = &all[start..face.corners_end];
            start = face.corners_end;
            let is_bad = corners.iter().any(|corner| self.bad_positions.contains(&corner[0]));
            if is_bad {
                let sentence = "a face with a corner that is not finite is left out";
                report.warn(file, face.line, sentence);
                return false;
            }
            self.scan.corners.extend_from_slice(corners);
            face.corners_end = self.scan.corners.len();
            true
        });
    }
}

/// Whether a text is a number, but not a finite one.
fn is_infinite_or_nan(text: &str) -> bool {
    text.parse::<f64>().is_ok_and(|number| !number.is_finite())
}
