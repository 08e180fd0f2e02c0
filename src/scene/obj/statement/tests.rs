//! Texts with odd line ends, comments, continuations, names and encodings.

use super::*;

/// Every statement as its keyword's line and its words.
fn statements(text: &str) -> Vec<String> {
    let mut walk = Statements::new(text, Path::new("t.obj"));
    let mut all = Vec::new();
    while walk.advance() {
        let words: Vec<&str> = walk.tokens.iter().map(|token| token.text).collect();
        all.push(format!("{}: {}", walk.keyword().line, words.join(" ")));
    }
    all
}

#[test]
fn comments_continuations_and_line_ends() {
    let text = "# one\r\nv 1 2 3 # c \\\nf 1 \\\r\n 2\\\n\t3\rg a#b\n\n#\nl";
    assert_eq!(statements(text), ["2: v 1 2 3", "3: f 1 2 3", "6: g a", "9: l"]);
}

#[test]
fn a_place_counts_characters_on_the_token_own_line() {
    let mut walk = Statements::new("v 1\\\n é 2x", Path::new("t.obj"));
    assert!(walk.advance());
    let token = walk.values()[2];
    assert_eq!(walk.place(&token), Place::at(Path::new("t.obj"), 2, 4));
}

#[test]
fn names_keep_blanks_and_hashes() {
    let mut walk = Statements::new("usemtl\t Material  #25 \r\nusemtl a \\\n b", Path::new("t"));
    assert!(walk.advance());
    assert_eq!(walk.name(), "Material  #25");
    assert_eq!(without_comment(&walk.name()), "Material");
    assert!(walk.advance());
    assert_eq!(walk.name(), "a b");
    assert_eq!(without_comment("a#b"), "a#b");
    assert_eq!(without_comment("#b"), "");
}

#[test]
fn utf16_and_binary_are_refused_and_latin1_is_replaced() {
    let file = Path::new("t.obj");
    let mut report = Report::default();
    let utf16 = decode(&[0xFF, 0xFE, b'v', 0], file, &mut report).unwrap_err();
    assert!(utf16.message.contains("UTF-16"), "{utf16}");
    let binary = decode(b"v 1\n\0", file, &mut report).unwrap_err();
    assert_eq!(binary.place.line, 2);
    assert_eq!(decode(b"\xEF\xBB\xBFv", file, &mut report).unwrap(), "v");
    assert_eq!(decode(b"v\n# \xE9", file, &mut report).unwrap(), "v\n# \u{FFFD}");
    let warnings = report.into_warnings();
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].starts_with("t.obj:2: "), "{}", warnings[0]);
}
