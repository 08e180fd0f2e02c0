//! The paths of a source text that start at `crate`, `truecast`, `self` or `super`, resolved
//! against the module in which they stand.

use super::tokens::Token;

/// What a source text refers to.
#[derive(Debug, Default, PartialEq)]
pub(super) struct References {
    /// Absolute paths from the crate's root. A path that ends at the root itself (`use crate::*`,
    /// `use crate as c`, `extern crate self`) is empty.
    pub(super) paths: Vec<Vec<String>>,
    /// `#[path = "file"] mod name;`: file and absolute module path.
    pub(super) moved_modules: Vec<(String, Vec<String>)>,
    /// Whether source text is pulled in by `include!`.
    pub(super) includes_source: bool,
}

/// Finds them in the tokens of a file that is the module `module`.
pub(super) fn references(tokens: &[Token], module: &[String]) -> References {
    let mut found = References::default();
    // Modules opened in this file, each with the brace depth inside it.
    let mut open: Vec<(String, usize)> = Vec::new();
    let mut depth = 0;
    let mut moved_file = None;
    let mut i = 0;
    while i < tokens.len() {
        let here =
            || module.iter().cloned().chain(open.iter().map(|(name, _)| name.clone())).collect();
        match &tokens[i..] {
            [Token::Mark('{'), ..] => depth += 1,
            [Token::Mark('}'), ..] => {
                open.retain(|(_, inside)| *inside < depth);
                depth -= 1;
            }
            [Token::Mark('['), word, Token::Mark('='), Token::Text(file), ..]
                if word.is_word("path") =>
            {
                moved_file = Some(file.clone());
            }
            [word, Token::Word(name), Token::Mark('{'), ..] if word.is_word("mod") => {
                depth += 1;
                open.push((name.clone(), depth));
                i += 2;
            }
            [word, Token::Word(name), Token::Mark(';'), ..] if word.is_word("mod") => {
                if let Some(file) = moved_file.take() {
                    let mut path: Vec<String> = here();
                    path.push(name.clone());
                    found.moved_modules.push((file, path));
                }
            }
            [word, Token::Mark('!'), ..] if word.is_word("include") => {
                found.includes_source = true;
            }
            [first, second, ..] if first.is_word("crate") && second.is_word("self") => {
                found.paths.push(Vec::new());
            }
            [use_word, ..] if use_word.is_word("use") => {
                let (end, paths) = use_tree(tokens, i + 1);
                let here: Vec<String> = here();
                found.paths.extend(paths.iter().filter_map(|path| resolved(path, &here)));
                i = end;
                continue;
            }
            [Token::Word(_), Token::Colons, ..] => {
                let (end, path) = expression_path(tokens, i);
                found.paths.extend(resolved(&path, &here()));
                i = end;
                continue;
            }
            _ => {}
        }
        i += 1;
    }
    found
}

/// All paths of the use-tree at `i`, and the position behind it.
fn use_tree(tokens: &[Token], mut i: usize) -> (usize, Vec<Vec<String>>) {
    let mut prefix = Vec::new();
    loop {
        match tokens.get(i) {
            Some(Token::Colons) => i += 1,
            Some(Token::Word(word)) if word == "as" => i += 2,
            Some(Token::Word(word)) => {
                prefix.push(word.clone());
                i += 1;
            }
            Some(Token::Mark('*')) => {
                prefix.push("*".to_owned());
                i += 1;
            }
            Some(Token::Mark('$')) => i += 1,
            Some(Token::Mark('{')) => {
                let mut paths = Vec::new();
                i += 1;
                while tokens.get(i).is_some_and(|token| *token != Token::Mark('}')) {
                    let (end, branch) = use_tree(tokens, i);
                    let whole = branch.into_iter().map(|tail| [prefix.clone(), tail].concat());
                    paths.extend(whole);
                    // Go on behind the comma, and never stand still.
                    i = end + usize::from(tokens.get(end) == Some(&Token::Mark(',')));
                    i += usize::from(i == end && tokens.get(i) != Some(&Token::Mark('}')));
                }
                return (i + 1, paths);
            }
            _ => return (i, vec![prefix]),
        }
    }
}

/// The words joined by `::` from `i` on, and the position behind them.
fn expression_path(tokens: &[Token], mut i: usize) -> (usize, Vec<String>) {
    let mut path = Vec::new();
    while let Some(Token::Word(word)) = tokens.get(i) {
        path.push(word.clone());
        match tokens.get(i + 1) {
            Some(Token::Colons) => i += 2,
            _ => return (i + 1, path),
        }
    }
    (i, path)
}

/// The path from the crate's root, or `None` for a path that does not start inside the crate.
fn resolved(path: &[String], here: &[String]) -> Option<Vec<String>> {
    let mut absolute = match path.first()?.as_str() {
        "crate" | "truecast" => Vec::new(),
        "self" => here.to_vec(),
        "super" => here[..here.len().saturating_sub(1)].to_vec(),
        _ => return None,
    };
    for segment in &path[1..] {
        match segment.as_str() {
            "super" => {
                absolute.pop();
            }
            "self" | "*" => {}
            name => absolute.push(name.to_owned()),
        }
    }
    Some(absolute)
}
