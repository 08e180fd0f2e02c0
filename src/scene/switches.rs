//! Where the course texts disagree, a switch decides; a dialect is a preset of all switches.
//!
//! The words stand here, and what they mean as types ([`Rules`]); `shade` acts on them.

mod rules;

pub use rules::{BacklitSpecular, FlatMeaning, HemisphereCurve, Rules, SpecularModel};

use std::fmt;

/// The dialects, in the order of [`Switch::presets`].
pub const DIALECTS: [&str; 5] = ["curless", "angel", "iit", "cs315", "opengl"];

/// The value of a switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SwitchValue {
    /// On or off.
    Is(bool),
    /// One of the switch's words.
    Word(&'static str),
}

impl fmt::Display for SwitchValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Is(value) => value.fmt(f),
            Self::Word(word) => word.fmt(f),
        }
    }
}

/// One switch: its name, its words and what each dialect sets it to.
#[derive(Clone, Copy, Debug)]
pub struct Switch {
    /// Key in `[switches]`.
    pub name: &'static str,
    /// The words it may be set to; empty for a switch that is on or off.
    pub words: &'static [&'static str],
    /// Its value in each of [`DIALECTS`].
    pub presets: [SwitchValue; 5],
}

const fn word(
    name: &'static str,
    words: &'static [&'static str],
    presets: [&'static str; 5],
) -> Switch {
    let [a, b, c, d, e] = presets;
    use SwitchValue::Word;
    Switch { name, words, presets: [Word(a), Word(b), Word(c), Word(d), Word(e)] }
}

const fn on_or_off(name: &'static str, presets: [bool; 5]) -> Switch {
    let [a, b, c, d, e] = presets;
    use SwitchValue::Is;
    Switch { name, words: &[], presets: [Is(a), Is(b), Is(c), Is(d), Is(e)] }
}

/// All switches.
pub const SWITCHES: [Switch; 12] = [
    word("backlit_specular", &["le0", "lt0", "none"], ["le0", "lt0", "le0", "none", "le0"]),
    on_or_off("attenuate_ambient", [false, false, false, true, true]),
    word("ka", &["own", "kd"], ["own"; 5]),
    word("specular", &["blinn", "phong"], ["blinn", "blinn", "phong", "blinn", "blinn"]),
    on_or_off("specular_cosine", [false; 5]),
    word("viewer", &["local", "distant"], ["local", "local", "local", "local", "distant"]),
    word(
        "interpolation",
        &["perspective", "screen"],
        ["perspective", "perspective", "screen", "perspective", "perspective"],
    ),
    on_or_off("renormalize", [true; 5]),
    word(
        "fragment_vectors",
        &["recompute", "interpolate"],
        ["recompute", "interpolate", "recompute", "recompute", "recompute"],
    ),
    word(
        "flat",
        &["face-normal", "one-point", "vertex-face-normal", "provoking"],
        ["face-normal", "one-point", "one-point", "vertex-face-normal", "provoking"],
    ),
    word("hemisphere", &["cosine", "sine", "linear"], ["cosine"; 5]),
    on_or_off("naive_normals", [false; 5]),
];

/// The resolved switches of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Switches {
    /// The dialect that the scene names, or the default one.
    pub dialect: &'static str,
    /// Name and value of every switch, in the order of [`SWITCHES`].
    values: [(&'static str, SwitchValue); 12],
    /// What the values mean; always follows them.
    rules: Rules,
}

impl Default for Switches {
    /// The dialect `curless`.
    fn default() -> Self {
        Self::preset(0)
    }
}

impl Switches {
    /// The preset of a dialect, or `None` when there is no dialect of that name.
    pub fn of_dialect(name: &str) -> Option<Self> {
        let position = DIALECTS.iter().position(|known| *known == name)?;
        Some(Self::preset(position))
    }

    fn preset(position: usize) -> Self {
        let values = SWITCHES.map(|switch| (switch.name, switch.presets[position]));
        Self { dialect: DIALECTS[position], values, rules: Rules::of(&values) }
    }

    /// These switches with one of them set; unchanged where there is no switch of that name or it
    /// does not know the value.
    #[must_use]
    pub fn with(mut self, name: &str, value: SwitchValue) -> Self {
        let knows = |switch: &Switch| match value {
            SwitchValue::Is(_) => switch.words.is_empty(),
            SwitchValue::Word(word) => switch.words.contains(&word),
        };
        for (slot, switch) in self.values.iter_mut().zip(&SWITCHES) {
            if switch.name == name && knows(switch) {
                slot.1 = value;
            }
        }
        self.rules = Rules::of(&self.values);
        self
    }

    /// What the words mean.
    pub const fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The value of a switch, or `None` when there is no switch of that name.
    pub fn get(&self, name: &str) -> Option<SwitchValue> {
        self.values.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
    }

    /// Name and value of every switch as one JSON object.
    pub fn table(&self) -> serde_json::Value {
        let value = |value: SwitchValue| match value {
            SwitchValue::Is(is) => serde_json::Value::Bool(is),
            SwitchValue::Word(word) => serde_json::Value::String(word.to_owned()),
        };
        self.values.iter().map(|&(name, v)| (name.to_owned(), value(v))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_a_word_of_its_switch() {
        for switch in SWITCHES {
            for preset in switch.presets {
                match preset {
                    SwitchValue::Is(_) => assert!(switch.words.is_empty(), "{}", switch.name),
                    SwitchValue::Word(word) => {
                        assert!(switch.words.contains(&word), "{}: {word}", switch.name);
                    }
                }
            }
        }
    }

    #[test]
    fn the_default_is_curless() {
        let switches = Switches::default();
        assert_eq!(switches.dialect, "curless");
        assert_eq!(switches.get("backlit_specular"), Some(SwitchValue::Word("le0")));
        assert_eq!(switches.get("renormalize"), Some(SwitchValue::Is(true)));
        assert_eq!(switches.get("lens"), None);
    }

    #[test]
    fn dialects_are_their_columns_and_each_switch_moves_alone() {
        let iit = Switches::of_dialect("iit").unwrap();
        assert_eq!(iit.get("specular"), Some(SwitchValue::Word("phong")));
        assert_eq!(iit.get("interpolation"), Some(SwitchValue::Word("screen")));
        assert_eq!(iit.rules().flat, FlatMeaning::OnePoint);
        assert!(Switches::of_dialect("opengl").unwrap().rules().distant_viewer);
        assert_eq!(Switches::of_dialect("phong"), None);
        // Every word of every switch changes the rules, and a value of another kind nothing.
        for switch in SWITCHES {
            let values: Vec<SwitchValue> = match switch.words {
                [] => vec![SwitchValue::Is(false), SwitchValue::Is(true)],
                words => words.iter().map(|word| SwitchValue::Word(word)).collect(),
            };
            let rules: Vec<Rules> = values
                .iter()
                .map(|&value| *Switches::default().with(switch.name, value).rules())
                .collect();
            for (i, a) in rules.iter().enumerate() {
                assert!(!rules[..i].contains(a), "{}: {a:?}", switch.name);
            }
            let strange = Switches::default().with(switch.name, SwitchValue::Word("strange"));
            assert_eq!(strange, Switches::default());
        }
    }
}
