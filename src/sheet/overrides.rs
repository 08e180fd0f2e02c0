//! What a cell sets in the document of its scene, by dotted path.

use crate::scene::file::suggestion;
use toml::Value;

/// Why a path leads nowhere: what is wrong, and what to do about it.
#[derive(Debug, PartialEq)]
pub(super) struct Misled {
    pub(super) message: String,
    pub(super) help: Option<String>,
}

fn misled(message: String, help: impl Into<Option<String>>) -> Misled {
    Misled { message, help: help.into() }
}

/// Sets the value at `path`. Every step but the last must be there, except that a table directly
/// under the root is made.
pub(super) fn set(root: &mut Value, path: &str, value: Value) -> Result<(), Misled> {
    let steps: Vec<&str> = path.split('.').collect();
    if steps.iter().any(|step| step.is_empty()) {
        let message = format!("`{path}` has an empty step");
        return Err(misled(message, "write a path such as \"light.0.exponent\"".to_owned()));
    }
    if let (Value::Table(table), [first, second, ..]) = (&mut *root, &steps[..])
        && !table.contains_key(*first)
        && second.parse::<usize>().is_err()
    {
        table.insert((*first).to_owned(), Value::Table(toml::Table::new()));
    }
    let mut node = root;
    for (depth, step) in steps[..steps.len() - 1].iter().enumerate() {
        node = child(node, step, &steps[..depth])?;
    }
    let (last, parents) = (steps[steps.len() - 1], &steps[..steps.len() - 1]);
    match node {
        Value::Table(table) => {
            table.insert(last.to_owned(), value);
        }
        _ => *child(node, last, parents)? = value,
    }
    Ok(())
}

/// The value one step further. `walked` led to `node`.
fn child<'v>(node: &'v mut Value, step: &str, walked: &[&str]) -> Result<&'v mut Value, Misled> {
    let place = match walked {
        [] => "the scene".to_owned(),
        steps => format!("`{}` of the scene", steps.join(".")),
    };
    match node {
        Value::Table(table) => {
            let known: Vec<String> = table.keys().cloned().collect();
            table.get_mut(step).ok_or_else(|| {
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                misled(format!("{place} has no `{step}`"), suggestion(step, &known))
            })
        }
        Value::Array(elements) => {
            let count = elements.len();
            let index = step.parse::<usize>().map_err(|_| {
                let help = format!("write {}.0 for its first element", walked.join("."));
                misled(format!("{place} is a list and has no `{step}`"), help)
            })?;
            elements.get_mut(index).ok_or_else(|| {
                let help = "lists count from 0".to_owned();
                misled(format!("{place} has {count} elements and no number {index}"), help)
            })
        }
        other => {
            let kind = other.type_str();
            Err(misled(format!("{place} is a {kind} and has no `{step}`"), None))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Value {
        let text = "[image]\nwidth = 4\n[[mesh]]\nshape = { torus = { around = 8 } }\n\
                    [[light]]\nintensity = [1.0, 2.0, 3.0]\n";
        Value::Table(text.parse().unwrap())
    }

    #[test]
    fn values_are_replaced_and_made_where_their_table_stands() {
        let mut root = scene();
        set(&mut root, "mesh.0.shape.torus.around", 9.into()).unwrap();
        set(&mut root, "mesh.0.shading", "flat".into()).unwrap();
        set(&mut root, "light.0.intensity.1", 0.5.into()).unwrap();
        set(&mut root, "switches.specular", "phong".into()).unwrap();
        set(&mut root, "dialect", "iit".into()).unwrap();
        assert_eq!(root["mesh"][0]["shape"]["torus"]["around"].as_integer(), Some(9));
        assert_eq!(root["mesh"][0]["shading"].as_str(), Some("flat"));
        assert_eq!(root["light"][0]["intensity"][1].as_float(), Some(0.5));
        assert_eq!(root["switches"]["specular"].as_str(), Some("phong"));
        assert_eq!(root["dialect"].as_str(), Some("iit"));
    }

    #[test]
    fn paths_that_lead_nowhere_are_refused_and_change_nothing() {
        for (path, words) in [
            ("mesh.1.shading", "has 1 elements and no number 1"),
            ("mesh.shading", "is a list and has no `shading`"),
            ("mesh.0.shpae.torus.around", "has no `shpae`"),
            ("image.width.x", "is a integer"),
            ("material.0.ns", "has no `material`"),
            ("light.0.intensity.3", "no number 3"),
            ("mesh..x", "empty step"),
            ("", "empty step"),
        ] {
            let mut root = scene();
            let misled = set(&mut root, path, 1.into()).unwrap_err();
            assert!(misled.message.contains(words), "{path}: {}", misled.message);
            assert_eq!(root, scene(), "{path}");
        }
        let misled = set(&mut scene(), "mesh.0.shpae.x", 1.into()).unwrap_err();
        assert_eq!(misled.help.unwrap(), "did you mean `shape`?");
    }
}
