//! One library per statement, with the coefficients that must come out.

use super::*;

/// The library of a text without faults, and its warnings.
fn library(text: &str) -> (Library, Vec<String>) {
    let mut library = Library::default();
    let mut report = Report::default();
    read_library(text, Path::new("t.mtl"), &mut library, &mut report);
    assert!(!report.has_errors(), "{:?}", report.into_errors());
    (library, report.into_warnings())
}

/// The first fault of a text, as `file:line:column: message`.
fn fault(text: &str) -> String {
    let mut report = Report::default();
    read_library(text, Path::new("t.mtl"), &mut Library::default(), &mut report);
    report.into_errors().first().map(ToString::to_string).unwrap_or_default()
}

#[test]
fn coefficients_and_their_defaults() {
    let (library, warnings) = library(
        "newmtl a\nKa 1 1 1\nKd 0.1 0.2 0.3\nKs .5 .5 .5\nKe 0 0 2\nNs 250\nNi 1.5\nd 1\n\
         illum 2\nnewmtl b\nKd 0.8 # grey\nnewmtl c\n",
    );
    assert_eq!(warnings, [""; 0]);
    let expected = Material {
        name: "a".to_owned(),
        ka: [1.0; 3],
        kd: [0.1, 0.2, 0.3],
        ks: [0.5; 3],
        ke: [0.0, 0.0, 2.0],
        ns: 250.0,
        kd_map: None,
        ks_map: None,
        unlit: false,
        opacity: 1.0,
    };
    assert_eq!(library.find("a"), Some(&expected));
    assert_eq!(library.find("b"), Some(&Material::default_named("b")));
    assert_eq!(library.find("c"), Some(&Material::default_named("c")));
    assert_eq!(library.find("d"), None);
}

#[test]
fn ambient_follows_diffuse_in_any_order() {
    let (library, _) = library("newmtl a\nKd 0.1 0.2 0.3");
    assert_eq!(library.find("a").unwrap().ka, [0.1, 0.2, 0.3]);
}

#[test]
fn illumination_models() {
    for (model, ks, warned) in [(0, 0.0, false), (1, 0.0, false), (2, 0.5, false), (7, 0.5, true)] {
        for text in [format!("illum {model}\nKs 0.5"), format!("Ks 0.5\nillum {model}")] {
            let (library, warnings) = library(&format!("newmtl a\n{text}"));
            assert_eq!(library.find("a").unwrap().ks, [ks; 3], "{text}");
            assert_eq!(!warnings.is_empty(), warned, "{warnings:?}");
            assert_eq!(library.find("a").unwrap().unlit, model == 0, "{text}");
        }
    }
    assert_eq!(fault("newmtl a\nillum 300"), "t.mtl:2:7: `300` is no illumination model");
    assert_eq!(fault("newmtl a\nillum"), "t.mtl:2:1: `illum` is no illumination model");
}

#[test]
fn opacity_is_told() {
    let opaque = "newmtl a\nd 1.0\nTr 0.0\n";
    assert!(library(opaque).1.is_empty());
    for see_through in ["d 0.25", "Tr 0.75", "d 0.25\nTr 0.75", "Tr 0.75\nd 0.25"] {
        let (library, warnings) = library(&format!("newmtl a\n{see_through}"));
        assert!(warnings.is_empty(), "{see_through}: {warnings:?}");
        assert_eq!(library.find("a").unwrap().opacity, 0.25, "{see_through}");
    }
    for (text, opacity, word) in [
        ("d -halo 0.25", 0.25, "angle"),
        ("d 1\nTr 1", 1.0, "disagree"),
        ("d 2", 1.0, "`d` above 1"),
        ("Tr 1.5", 0.0, "`Tr` above 1"),
    ] {
        let (library, warnings) = library(&format!("newmtl a\n{text}"));
        assert!(warnings.len() == 1 && warnings[0].contains(word), "{text}: {warnings:?}");
        assert_eq!(library.find("a").unwrap().opacity, opacity, "{text}");
    }
    assert_eq!(fault("newmtl a\nd -0.5"), "t.mtl:2:3: `d` is negative: `-0.5`");
}

#[test]
fn what_is_left_out_is_named() {
    let (_, warnings) = library(
        "Kd 1 1 1\nnewmtl a\nmap_Ka -s 2 2 2 x.png\nTf 1 1 1\nKd spectral x.rfl\nmap_Ka y.png\n",
    );
    assert_eq!(
        warnings,
        [
            "t.mtl:1: statements before the first `newmtl` are left out",
            "t.mtl:3: `map_Ka` is not simulated by this version; left out (2 times; this is the \
             first)",
            "t.mtl:4: `Tf` is not simulated by this version; left out",
            "t.mtl:5: `Kd spectral` is not simulated; left out",
        ]
    );
}

#[test]
fn the_last_of_equal_names_counts() {
    let (library, warnings) = library("newmtl a\nKd 0\nnewmtl b\nnewmtl a\nKd 1\n");
    assert_eq!(library.find("a").unwrap().kd, [1.0; 3]);
    assert!(warnings.len() == 1 && warnings[0].starts_with("t.mtl:4: "), "{warnings:?}");
}

#[test]
fn names_with_hashes_and_names_with_comments() {
    let (library, _) = library("newmtl M #25\nKd 0.25\nnewmtl M #26\nKd 0.26\nnewmtl r # red\n");
    assert_eq!(library.find("M #25").unwrap().kd, [0.25; 3]);
    assert_eq!(library.find("M #26").unwrap().kd, [0.26; 3]);
    assert!(library.find("r").is_some());
    assert!(library.find("r # another").is_some());
    assert!(library.find("q").is_none());
}

#[test]
fn faults_have_a_place() {
    assert_eq!(fault("newmtl a\n Kd 1 -2 3"), "t.mtl:2:7: `Kd` is negative: `-2`");
    assert_eq!(fault("newmtl a\nNs nan"), "t.mtl:2:4: `nan` is not a finite number");
    assert_eq!(fault("newmtl a\nKs 1e999 0 0"), "t.mtl:2:4: `1e999` is not a finite number");
    assert_eq!(fault("newmtl a\nKs 1 2"), "t.mtl:2:1: `Ks` has 2 numbers; it takes 1 or 3");
    assert_eq!(fault("newmtl a\nd"), "t.mtl:2:1: `d` lacks a number");
    assert_eq!(fault("newmtl a\nd -halo"), "t.mtl:2:1: `d` lacks a number");
    assert_eq!(fault("newmtl a\nKd 0,8"), "t.mtl:2:4: `0,8` is not a number");
    assert_eq!(fault("newmtl"), "t.mtl:1:1: `newmtl` gives no name");
}
