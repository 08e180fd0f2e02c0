//! Rust source as a list of tokens: comments gone, strings kept apart from words.
//! Only as fine as finding paths needs: numbers are words, lifetimes are words.

/// A piece of source text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// An identifier, a keyword or a number; `r#x` is `x`.
    Word(String),
    /// The inside of a string, byte string or raw string.
    Text(String),
    /// `::`
    Colons,
    /// Any other character.
    Mark(char),
}

impl Token {
    pub(super) fn is_word(&self, word: &str) -> bool {
        matches!(self, Self::Word(own) if own == word)
    }
}

/// The tokens of a source text.
pub(super) fn tokens(source: &str) -> Vec<Token> {
    let text: Vec<char> = source.chars().collect();
    let at = |i: usize| text.get(i).copied().unwrap_or('\0');
    let mut tokens = Vec::new();
    let mut i = 0;
    while i < text.len() {
        let c = at(i);
        if c.is_whitespace() {
            i += 1;
        } else if c == '/' && at(i + 1) == '/' {
            while i < text.len() && at(i) != '\n' {
                i += 1;
            }
        } else if c == '/' && at(i + 1) == '*' {
            i = after_block_comment(&text, i);
        } else if let Some((inside, end)) = raw_string(&text, i) {
            tokens.push(Token::Text(inside));
            i = end;
        } else if c == '"' {
            let end = after_quoted(&text, i, '"');
            tokens.push(Token::Text(text[i + 1..end - 1].iter().collect()));
            i = end;
        } else if c == '\'' && (at(i + 1) == '\\' || at(i + 2) == '\'') {
            i = after_quoted(&text, i, '\'');
        } else if is_word_part(c) {
            let start = if c == 'r' && at(i + 1) == '#' { i + 2 } else { i };
            i = start;
            while is_word_part(at(i)) {
                i += 1;
            }
            let word: String = text[start..i].iter().collect();
            // The prefix of b"…" and c"…" is part of the string.
            if !(at(i) == '"' && matches!(word.as_str(), "b" | "c")) {
                tokens.push(Token::Word(word));
            }
        } else if c == ':' && at(i + 1) == ':' {
            tokens.push(Token::Colons);
            i += 2;
        } else {
            tokens.push(Token::Mark(c));
            i += 1;
        }
    }
    tokens
}

fn is_word_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Block comments nest.
fn after_block_comment(text: &[char], start: usize) -> usize {
    let (mut i, mut depth) = (start, 0);
    while i < text.len() {
        match (text[i], text.get(i + 1)) {
            ('/', Some('*')) => (i, depth) = (i + 2, depth + 1),
            ('*', Some('/')) => (i, depth) = (i + 2, depth - 1),
            _ => i += 1,
        }
        if depth == 0 {
            break;
        }
    }
    i
}

/// Behind the closing quote of a string or character that opens at `start`.
fn after_quoted(text: &[char], start: usize, quote: char) -> usize {
    let mut i = start + 1;
    while i < text.len() && text[i] != quote {
        i += if text[i] == '\\' { 2 } else { 1 };
    }
    assert!(i < text.len(), "an unclosed {quote} in the source");
    i + 1
}

/// The inside of `r"…"`, `r#"…"#`, `br"…"`, `cr"…"` and the position behind it.
fn raw_string(text: &[char], start: usize) -> Option<(String, usize)> {
    let r = start + usize::from(matches!(text[start], 'b' | 'c'));
    if text.get(r) != Some(&'r') {
        return None;
    }
    let hashes = text[r + 1..].iter().take_while(|&&c| c == '#').count();
    let open = r + 1 + hashes;
    if text.get(open) != Some(&'"') {
        return None;
    }
    let closing: Vec<char> = std::iter::once('"').chain(vec!['#'; hashes]).collect();
    let length = text[open + 1..].windows(closing.len()).position(|w| w == closing)?;
    let end = open + 1 + length;
    Some((text[open + 1..end].iter().collect(), end + closing.len()))
}
