//! Pictures are the same bits on every platform: the parts that compute them use no function of
//! `std` whose last bits the platform chooses ("non-deterministic precision" in its documentation)
//! and no fused operation that a target may lack, only `libm` and the correctly rounded + − × ÷ √.

use super::tokens::{Token, tokens};
use super::{module_of, sources};

/// Top-level modules that are held to it.
const HELD: [&str; 6] = ["shade", "scene", "color", "render", "film", "lobe"];

const FORBIDDEN: [&str; 28] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh",
    "asinh", "acosh", "atanh", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10",
    "powf", "powi", "hypot", "cbrt", "mul_add", "gamma",
];

/// The forbidden functions that are called as `.sin(` or named as `f64::sin`.
fn forbidden(source: &str) -> Vec<String> {
    let tokens = without_tests(tokens(source));
    let is_forbidden =
        |token: &Token| matches!(token, Token::Word(word) if FORBIDDEN.contains(&word.as_str()));
    let mut found = Vec::new();
    for (i, token) in tokens.iter().enumerate().skip(1).filter(|(_, token)| is_forbidden(token)) {
        let is_method =
            tokens[i - 1] == Token::Mark('.') && tokens.get(i + 1) == Some(&Token::Mark('('));
        let is_path = tokens[i - 1] == Token::Colons
            && i >= 2
            && (tokens[i - 2].is_word("f64") || tokens[i - 2].is_word("f32"));
        if is_method || is_path {
            found.push(format!("{token:?}"));
        }
    }
    found
}

/// The tokens without the modules, functions and imports behind `#[cfg(test)]`.
fn without_tests(tokens: Vec<Token>) -> Vec<Token> {
    let mark = |c| Token::Mark(c);
    let word = |w: &str| Token::Word(w.to_owned());
    let gate = [mark('#'), mark('['), word("cfg"), mark('('), word("test"), mark(')'), mark(']')];
    let mut kept = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        if !tokens[i..].starts_with(&gate) {
            kept.push(tokens[i].clone());
            i += 1;
            continue;
        }
        // Up to the end of the item: a `;` outside braces, or the brace that closes the first.
        let mut depth = 0;
        while i < tokens.len() {
            match &tokens[i] {
                Token::Mark('{') => depth += 1,
                Token::Mark('}') => depth -= 1,
                _ => {}
            }
            let ends = matches!(&tokens[i], Token::Mark(';' | '}')) && depth == 0;
            i += 1;
            if ends {
                break;
            }
        }
    }
    kept
}

#[test]
fn pictures_use_no_function_that_the_platform_chooses() {
    let mut wrong = Vec::new();
    let mut held = 0;
    for (file, text) in sources() {
        let module = module_of(&file);
        let is_test = module.iter().any(|name| name == "tests" || name.ends_with("_tests"));
        if !HELD.contains(&module[0].as_str()) || is_test {
            continue;
        }
        held += 1;
        for name in forbidden(&text) {
            wrong.push(format!("src/{}: {name}", file.display()));
        }
    }
    assert!(held > 60, "{held} files");
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn the_search_finds_what_it_looks_for() {
    for bad in [
        "let a = x.sin();",
        "let a = 2.0_f64.powi(3);",
        "let a = v.map(f64::exp);",
        "let a = f64 :: hypot(a, b);",
        "#[cfg(test)] mod tests { fn f() { 1.0_f64.sin(); } } fn g(x: f64) -> f64 { x . ln () }",
        "#[cfg(test)] use a::b; fn g(x: f64) -> f64 { x.mul_add(x, x) }",
        "#[cfg(test)]\nmod tests;\nfn g(x: f64) -> f64 { x.cbrt() }",
    ] {
        assert_eq!(forbidden(bad).len(), 1, "{bad}");
    }
    for good in [
        "let a = libm::sin(x);",
        "// x.sin()\nlet text = \"x.cos()\";",
        "let a = x.sqrt().abs(); let exp = material.exp; circle.sin = 3.0;",
        "#[cfg(test)] mod tests { fn f() { { 1.0_f64.sin(); } 2.0_f64.cos(); } }",
    ] {
        assert_eq!(forbidden(good), Vec::<String>::new(), "{good}");
    }
}
