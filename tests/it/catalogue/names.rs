//! No case is missing: the names of the catalogue against the tests in the sources.
//!
//! Cases D.1 to D.3 are tests of this folder; those of D.4 to D.6, traversal, scale and
//! transformations, belong to `scale`.

use crate::support::names::{rust_files, tested, tests_folder};
use crate::support::sizes::REDUCED;
use std::collections::BTreeSet;
use std::fs;

/// A section of the catalogue.
struct Section {
    /// Its cases.
    cases: &'static str,
    /// Where its tests are: the beginning of their sources' paths under `tests/it`.
    place: &'static str,
}

const SECTIONS: [Section; 7] = [
    // D.1: coverage ties.
    Section {
        cases: "h01 h02 h03 h04 h05 h06 h07 h08 h09 h10 h11 h12 h13 h14 h15 h16 h17 h18",
        place: "catalogue",
    },
    // D.2: depth.
    Section { cases: "h20 h21 h22 h23 h24 h25 h26 h27 h28 h29 h30 h31", place: "catalogue" },
    // D.3: the eye and what is near it.
    Section { cases: "h40 h41 h42 h43 h44 h45 h46 h47 h48 h49 h4a h4b", place: "catalogue" },
    // D.4: traversal.
    Section {
        cases: "h50 h51 h52 h53 h54 h55 h56 h57 h58 h59 h60 h61 h62 h63 h64 h65",
        place: "scale",
    },
    // D.5: scale, translation and extremes.
    Section { cases: "h70 h71 h72 h73 h74 h75 h76 h77 h78 h79 h7a", place: "scale" },
    // D.6: transformations that change no picture.
    Section { cases: "h80 h81 h82 h83 h84 h85 h86 h87 h88 h89", place: "scale" },
    // D.6, the stability mask.
    Section { cases: "h8a", place: "stability" },
];

#[test]
fn every_case_is_here() {
    let tests_folder = tests_folder();
    for section in SECTIONS {
        let found: BTreeSet<String> = rust_files(&tests_folder)
            .iter()
            .filter(|path| {
                let inside = path.strip_prefix(&tests_folder).unwrap();
                inside.to_str().unwrap().starts_with(section.place)
            })
            .flat_map(|path| tested(&fs::read_to_string(path).unwrap(), is_case))
            .collect();
        let missing: Vec<&str> =
            section.cases.split(' ').filter(|case| !found.contains(*case)).collect();
        assert!(missing.is_empty(), "no test is named after {missing:?}");
    }
}

/// The table of all cases, with the size at which they run: read it with `--nocapture`.
#[test]
#[expect(clippy::print_stdout, reason = "the table is what this test is run for")]
fn sizes_of_all_cases() {
    let all: Vec<&str> = SECTIONS.iter().flat_map(|section| section.cases.split(' ')).collect();
    let listed = REDUCED.map(|size| size.case);
    assert!(listed.is_sorted() && listed.iter().all(|case| all.contains(case)), "{listed:?}");
    println!("{:<5} {:<36} {:>9} {:>9}", "case", "size", "runs", "full");
    for case in all {
        match REDUCED.iter().find(|size| size.case == case) {
            None => println!("{case:<5} {:<36} {:>9} {:>9}", "as in the catalogue", "full", "full"),
            Some(size) => {
                let (runs, full) = (size.running(), size.full());
                assert!(runs <= full, "{case}");
                println!("{case:<5} {:<36} {runs:>9} {full:>9}", size.unit);
            }
        }
    }
}

fn is_case(part: &str) -> bool {
    let [b'h', section @ b'0'..=b'8', number] = part.as_bytes() else { return false };
    section.is_ascii_digit() && (number.is_ascii_digit() || (b'a'..=b'b').contains(number))
}

#[test]
fn only_tests_count_as_cases() {
    let source = "#[test]\nfn h01_fan() {}\nfn h02_left_out() {}\n#[test]\nfn h51_h4a_both() {}\n\
                  // #[test]\nfn h03_commented() {}\n#[test]\nfn hub() {}\n";
    assert_eq!(tested(source, is_case), ["h01", "h51", "h4a"]);
}
