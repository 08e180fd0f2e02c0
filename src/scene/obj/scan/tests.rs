//! Both readings of a text are the same, wherever it is cut.

use super::*;

/// Lines of every kind, plain, rare and faulty.
const LINES: &[&str] = &[
    "v 1 2 3",
    "v -0 .5 1e3",
    "  v\t1.25 -2.5e-3 +7 ",
    "v 0.1234567890123456789 123456789012345678901234567890 1.",
    "v 1 2 3 1",
    "v 1 2 3 0.5",
    "v 1 2 3 0.25 0.5 1",
    "v nan 0 0",
    "v 1 inf 0",
    "v 1 2",
    "v 1 2 x",
    "v 1,5 2 3",
    "v - 2 3",
    "v 1..5 2 3",
    "vt 0.5",
    "vt 0.5 0.25",
    "vt 0.5 0.25 0.125",
    "vt 0.5 0.25 0.125 1",
    "vt 0.5 0.25 q",
    "vn 0 0 1",
    "vn 0 0 0",
    "vn 0 -0 0",
    "vn 0 0",
    "f 1 2 3",
    "f 1/1 2/1 3/1",
    "f 1//1 2//1 3//1 4//1",
    "f 1/1/1 2/1/1 3/1/1",
    "f 1/ 2// 3",
    "f 1/1/ 2 3",
    "f -1 -2 -3",
    "f 1 2",
    "f 0 1 2",
    "f 1 2 3/4/5/6",
    "f 1 2 a",
    "f 1 2 99999",
    "f 1 2 12345678901",
    "f 9 9 9 # a comment",
    "f 1 2 \\",
    "3",
    "fo 1 2 3",
    "# a comment",
    "#",
    "",
    "   ",
    "\\",
    "\\   ",
    "# ends in a backslash \\",
    "g a b",
    "o x",
    "s 1",
    "s off",
    "s maybe",
    "usemtl red",
    "usemtl blue # green",
    "usemtl",
    "mtllib a\\b.mtl",
    "l 1 2",
    "vp 1 2",
    "nonsense",
    "v\u{b}1 2 3",
    "v 1 2 3\u{a0}",
    "v 1 2 3\rv 4 5 6",
    "v 1 2 3#",
    "vertex 1 2 3",
    "face",
    "v",
    "f",
];

/// Says how often the text could be read in stretches.
fn read_both_ways(text: &str, skip_bad: bool) -> usize {
    let mut count = 0;
    let file = Path::new("t.obj");
    let mut strictly = Report::default();
    let expected = scan_strictly(text, file, skip_bad, &mut strictly);
    for size in [1, 7, 40, 1 << 20] {
        let mut report = Report::default();
        let Some(found) = scan_stretches(text, file, skip_bad, &mut report, size) else { continue };
        let told = |report: &Report| format!("{report:?}");
        assert_eq!(told(&report), told(&strictly), "{size}: {text:?}");
        if !report.has_errors() {
            // By bits: −0 is not 0.
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{size}: {text:?}");
            count += 1;
        }
    }
    count
}

#[test]
fn every_line_alone_and_in_company() {
    for line in LINES {
        for end in ["\n", "\r\n", ""] {
            let before = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\n";
            for skip_bad in [false, true] {
                read_both_ways(&format!("{line}{end}"), skip_bad);
                read_both_ways(&format!("{before}f 1 2 3\n{line}{end}"), skip_bad);
                read_both_ways(&format!("{before}{line}{end}f 2 3 4\n{line}{end}"), skip_bad);
            }
        }
    }
}

#[test]
fn any_order_of_lines() {
    let mut state = 1_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    let mut compared = 0;
    for _ in 0..2000 {
        let count = 1 + next(12);
        let text: String = (0..count)
            .map(|_| LINES[next(LINES.len())].to_owned() + ["\n", "\n", "\r\n"][next(3)])
            .collect();
        // Something to use, so that not every text is faulty.
        let text = format!("v 1 2 3\nv 4 5 6\nv 7 8 9\nvt 0 0\nvn 1 0 0\nf 1 2 3\n{text}");
        compared += read_both_ways(&text, next(2) == 0);
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn a_plain_file_is_read_in_stretches() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    (0..100).for_each(|_| text += "usemtl a\nf 1 2 3\ns 1\n");
    let mut report = Report::default();
    let found = scan_stretches(&text, Path::new("t.obj"), false, &mut report, 50).unwrap();
    assert_eq!(found.faces.len(), 100);
    assert_eq!(found.faces[99].line, 3 + 3 * 99 + 2);
    // And one whose faces use what is not there is not.
    text += "f 1 2 4\n";
    assert!(scan_stretches(&text, Path::new("t.obj"), false, &mut report, 50).is_none());
}
