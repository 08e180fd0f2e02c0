//! `dialect` and `[switches]` as written.

use super::keys::Keys;
use super::text::Faults;
use super::values::{Value, kind, text};
use crate::scene::switches::{SWITCHES, SwitchValue};
use toml::Spanned;
use toml::de::DeValue;

/// A switch that the scene sets: its name and its value.
#[derive(Clone, Debug)]
pub struct SwitchFile {
    /// Name of the switch.
    pub name: &'static str,
    /// What it is set to.
    pub value: Spanned<SwitchValue>,
}

/// Reads `[switches]`; every value is one that its switch knows.
pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Vec<SwitchFile> {
    let mut set = Vec::new();
    for switch in SWITCHES {
        let Some(value) = keys.ask(switch.name) else { continue };
        match read_value(value, switch.words) {
            Some(read) => {
                let value = Spanned::new(value.span(), read);
                set.push(SwitchFile { name: switch.name, value });
            }
            None => {
                let words: Vec<String> =
                    switch.words.iter().map(|word| format!("\"{word}\"")).collect();
                let expected = match words.split_last() {
                    Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
                    None => "true or false".to_owned(),
                };
                let found = match text(value) {
                    Ok(word) => format!("\"{word}\""),
                    Err(_) => kind(value.get_ref()).to_owned(),
                };
                let message = format!("`{}` must be {expected}, not {found}", switch.name);
                faults.at(&value.span(), message);
            }
        }
    }
    keys.close(faults);
    set
}

fn read_value(value: &Value<'_>, words: &'static [&'static str]) -> Option<SwitchValue> {
    match value.get_ref() {
        DeValue::Boolean(boolean) if words.is_empty() => Some(SwitchValue::Is(*boolean)),
        DeValue::String(text) => {
            words.iter().find(|word| *word == text).map(|word| SwitchValue::Word(word))
        }
        _ => None,
    }
}
