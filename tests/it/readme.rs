//! What the README shows is what the program does.

use std::path::Path;
use std::process::Command;
use truecast::scene::{Overrides, Scene};

const README: &str = include_str!("../../README.md");

/// The fenced blocks of a language.
fn blocks(language: &str) -> Vec<String> {
    README
        .split(&format!("```{language}\n"))
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap().to_owned())
        .collect()
}

#[test]
fn the_complete_example_is_a_scene() {
    let [example] = &blocks("toml")[..] else { panic!("one complete example") };
    let scene =
        Scene::from_toml(example, Path::new("README.md"), Path::new("."), &Overrides::default());
    let scene = scene.unwrap();
    assert_eq!((scene.materials.len(), scene.lights.len()), (1, 1));
    assert_eq!(scene.mesh.len(), 2 * 96 * 64);
}

/// A line that depends on the machine's speed.
fn is_timed(line: &str) -> bool {
    line.ends_with(" s")
}

#[test]
fn the_tour_prints_what_it_shows() {
    let mut shown = 0;
    for block in blocks("console") {
        let (command, output) = block.split_once('\n').unwrap();
        let arguments: Vec<_> =
            command.strip_prefix("$ truecast ").unwrap().split_whitespace().collect();
        if output.is_empty() {
            continue;
        }
        let ran = Command::new(env!("CARGO_BIN_EXE_truecast"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(&arguments)
            .output()
            .unwrap();
        let printed = String::from_utf8(ran.stdout).unwrap();
        let expected = output.lines().take_while(|line| *line != "...");
        for (line, printed) in expected.zip(printed.lines()) {
            assert!(line == printed || is_timed(line), "{command}:\n{line}\n{printed}");
            shown += 1;
        }
    }
    assert!(shown > 8, "the tour shows real output");
}
