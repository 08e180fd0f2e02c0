//! Dialect and switches: known words, and of them what this version simulates.

use crate::scene::file::text::Faults;
use crate::scene::file::{SceneFile, suggestion};
use crate::scene::switches::{DIALECTS, Switches};

pub(super) fn resolve(file: &SceneFile, faults: &mut Faults<'_>) -> Switches {
    let simulated = Switches::default();
    if let Some(dialect) = &file.dialect {
        let name = dialect.get_ref().as_str();
        if !DIALECTS.contains(&name) {
            let help = suggestion(name, &DIALECTS);
            faults.at_with_help(&dialect.span(), format!("there is no dialect `{name}`"), help);
        } else if name != simulated.dialect {
            let message = format!("the dialect `{name}` is not simulated by this version");
            faults.at_with_help(&dialect.span(), message, "only `curless` is");
        }
    }
    for switch in &file.switches {
        let only = simulated.get(switch.name);
        if let Some(only) = only.filter(|only| only != switch.value.get_ref()) {
            let (name, value) = (switch.name, switch.value.get_ref());
            let message = format!("`{name} = {value}` is not simulated by this version");
            faults.at_with_help(&switch.value.span(), message, format!("only `{only}` is"));
        }
    }
    simulated
}
