//! Dialect and switches: the preset that the scene names, and what it sets apart from it.

use crate::scene::file::text::Faults;
use crate::scene::file::{SceneFile, suggestion};
use crate::scene::switches::{DIALECTS, Switches};

pub(super) fn resolve(file: &SceneFile, faults: &mut Faults<'_>) -> Switches {
    let mut switches = Switches::default();
    if let Some(dialect) = &file.dialect {
        let name = dialect.get_ref().as_str();
        match Switches::of_dialect(name) {
            Some(preset) => switches = preset,
            None => {
                let help = suggestion(name, &DIALECTS);
                faults.at_with_help(&dialect.span(), format!("there is no dialect `{name}`"), help);
            }
        }
    }
    for switch in &file.switches {
        switches = switches.with(switch.name, *switch.value.get_ref());
    }
    switches
}
