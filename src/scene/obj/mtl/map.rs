//! `map_Kd` and `map_Ks`: the file of a texture and the options before it.
//!
//! `-s`, `-o` and `-clamp` are honoured; every other option is read over with a warning by name
//! unless it says what holds anyway. `-s` and `-o` act on the texture coordinates, uv·s + o, as
//! today's readers have it (Blender, three.js); the format's text, which speaks of the pattern's
//! size, can be read the other way round.

use crate::scene::error::{Place, SceneError};
use crate::scene::obj::report::{Report, quote};
use crate::scene::obj::statement::{Statements, Token, without_comment};
use crate::scene::texture::{Filter, TextureRequest, Wrap};
use std::path::Path;

/// Options that take a word, and the word that changes nothing.
const WORD_OPTIONS: [(&str, &str); 5] =
    [("-blendu", "on"), ("-blendv", "on"), ("-cc", "off"), ("-imfchan", ""), ("-type", "")];

/// Options that take numbers: how many at most, and those that change nothing.
const NUMBER_OPTIONS: [(&str, usize, &[f64]); 5] = [
    ("-t", 3, &[0.0, 0.0, 0.0]),
    ("-mm", 2, &[0.0, 1.0]),
    ("-bm", 1, &[1.0]),
    ("-boost", 1, &[0.0]),
    ("-texres", 1, &[]),
];

/// What a map's statement asks for.
pub(super) fn read_map(
    walk: &Statements<'_>,
    file: &Path,
    report: &mut Report,
) -> Result<TextureRequest, SceneError> {
    let keyword = walk.keyword();
    let (mut scale, mut offset, mut wrap) = ([1.0; 2], [0.0; 2], Wrap::Repeat);
    let mut options = Options { walk, position: 0 };
    while let Some(option) = options.next() {
        match option.text {
            "-s" => scale = options.coordinates([1.0; 2])?,
            "-o" => offset = options.coordinates([0.0; 2])?,
            "-clamp" => {
                wrap = match options.word()? {
                    Token { text: "on", .. } => Wrap::Clamp,
                    Token { text: "off", .. } => Wrap::Repeat,
                    other => {
                        let message = format!("`-clamp` is on or off, not {}", quote(other.text));
                        return Err(SceneError::scene(walk.place(&other), message));
                    }
                }
            }
            name => {
                if !options.pass(name)? {
                    let sentence = format!("`{name}` of a map is not simulated; left out");
                    report.warn(file, option.line, &sentence);
                }
            }
        }
    }
    let name = walk.name_behind(options.position);
    if name.is_empty() {
        let message = format!("`{}` names no file", keyword.text);
        return Err(SceneError::scene(walk.place(&keyword), message));
    }
    // Names may hold `#`, or a comment may follow; Windows exporters write backslashes.
    let folder = file.parent().unwrap_or(Path::new(""));
    let bare = without_comment(&name);
    let mut names = vec![name.clone(), name.replace('\\', "/")];
    names.extend([bare.to_owned(), bare.replace('\\', "/")]);
    let mut paths: Vec<_> = names.iter().map(|name| folder.join(name)).collect();
    paths.dedup();
    Ok(TextureRequest {
        paths,
        filter: Filter::Bilinear,
        wrap,
        scale,
        offset,
        place: Place::at(file, keyword.line, 0),
        required: false,
    })
}

/// Walks over the options in front of the file's name.
struct Options<'a, 't> {
    walk: &'a Statements<'t>,
    /// Values that were passed.
    position: usize,
}

impl<'t> Options<'_, 't> {
    /// The next word if it is an option. Other words that begin with `-` begin a name.
    fn next(&mut self) -> Option<Token<'t>> {
        let token = self.walk.values().get(self.position).copied()?;
        let is_known = ["-s", "-o", "-clamp"].contains(&token.text)
            || WORD_OPTIONS.iter().any(|(name, _)| *name == token.text)
            || NUMBER_OPTIONS.iter().any(|(name, ..)| *name == token.text);
        self.position += usize::from(is_known);
        is_known.then_some(token)
    }

    /// The word that an option takes.
    fn word(&mut self) -> Result<Token<'t>, SceneError> {
        self.position += 1;
        match self.walk.values().get(self.position - 1) {
            Some(token) => Ok(*token),
            None => Err(self.lacks("a word")),
        }
    }

    /// The numbers that an option takes, at least one; the last word is the file's name even where
    /// it is a number.
    fn numbers(&mut self, most: usize) -> Result<Vec<f64>, SceneError> {
        let mut numbers = Vec::new();
        while numbers.len() < most && self.position + 1 < self.walk.values().len() {
            let token = self.walk.values()[self.position];
            if token.text.parse::<f64>().is_err() {
                break;
            }
            numbers.push(self.walk.number(&token)?);
            self.position += 1;
        }
        if numbers.is_empty() { Err(self.lacks("a number")) } else { Ok(numbers) }
    }

    /// u and v of up to three numbers; those that are not there keep their default.
    fn coordinates(&mut self, default: [f64; 2]) -> Result<[f64; 2], SceneError> {
        let numbers = self.numbers(3)?;
        Ok([numbers[0], numbers.get(1).copied().unwrap_or(default[1])])
    }

    /// Passes an option that is not simulated; true when it changes nothing.
    fn pass(&mut self, name: &str) -> Result<bool, SceneError> {
        if let Some((_, most, neutral)) = NUMBER_OPTIONS.iter().find(|(known, ..)| *known == name) {
            let numbers = self.numbers(*most)?;
            return Ok(numbers.len() <= neutral.len() && neutral.starts_with(&numbers));
        }
        let word = self.word()?;
        Ok(WORD_OPTIONS.contains(&(name, word.text)))
    }

    fn lacks(&self, what: &str) -> SceneError {
        let values = self.walk.values();
        let option = values.get(self.position.min(values.len()).saturating_sub(1));
        let keyword = self.walk.keyword();
        let token = option.unwrap_or(&keyword);
        let message = format!("{} lacks {what}", quote(token.text));
        SceneError::scene(self.walk.place(token), message)
    }
}
