//! Slower, noise, and what is refused, by numbers chosen by hand.

use super::super::machine::Machine;
use super::super::report::to_json;
use super::super::rounds::Row;
use super::super::workload::Work;
use super::super::{Measured, Report, Subject};
use super::{Baseline, BaselineError};
use crate::pixel::Resolution;
use crate::simd::SimdLevel;
use crate::statistics::Statistics;

/// A row of this median and deviation in seconds; no median is a wrong answer.
fn row(name: &str, time: Option<[f64; 2]>) -> Row {
    Row {
        name: name.to_owned(),
        work: Work::Closest,
        amount: Work::Closest.of(12),
        program: None,
        is_exact: true,
        wrong_pixels: Some(usize::from(time.is_none())),
        times: time.map(|[median, deviation]| Statistics {
            n: 9,
            median,
            deviation,
            least: median - deviation,
            most: median + deviation,
        }),
        levels: None,
    }
}

fn measured(rows: Vec<Row>) -> Measured {
    Measured {
        subject: Subject {
            name: "a.toml".to_owned(),
            digest: "d1".to_owned(),
            resolution: Resolution::new(4, 3).unwrap(),
            threads: 2,
            simd: SimdLevel::Avx2,
        },
        triangles: 1,
        covered_pixels: 5,
        disputed_pixels: 0,
        audited_pixels: 12,
        trees: Vec::new(),
        rows,
        counters: Vec::new(),
        left_out: Vec::new(),
    }
}

/// What a report of these rows on two threads becomes as a baseline.
fn baseline(rows: Vec<Row>) -> Baseline {
    let report = Report {
        machine: Machine {
            logical_cores: Some(2),
            cpu: None,
            version: "0",
            rustc: None,
            commit: None,
        },
        rounds: 9,
        scenes: vec![measured(rows)],
        comparison: None,
    };
    Baseline::parse(&to_json(&report).to_string()).unwrap()
}

#[test]
fn slower_beyond_noise_and_nothing_else() {
    let old = baseline(vec![
        row("slower", Some([1.0, 0.01])),
        row("within noise", Some([1.0, 0.02])),
        row("within 5 %", Some([1.0, 0.0])),
        row("faster", Some([1.0, 0.01])),
        row("was wrong", None),
        row("is wrong", Some([1.0, 0.01])),
    ]);
    let new = measured(vec![
        // 0.08 more: above 3·0.02 and above 5 %.
        row("slower", Some([1.08, 0.01])),
        // 0.08 more: not above 3·0.04.
        row("within noise", Some([1.08, 0.02])),
        row("within 5 %", Some([1.04, 0.0])),
        row("faster", Some([0.5, 0.01])),
        row("was wrong", Some([9.0, 0.01])),
        row("is wrong", None),
        row("is new", Some([9.0, 0.01])),
    ]);
    let compared = old.compare(&new).unwrap();
    let names: Vec<_> = compared.iter().map(|c| (&*c.name, c.is_regression())).collect();
    let expected =
        [("slower", true), ("within noise", false), ("within 5 %", false), ("faster", false)];
    assert_eq!(names, expected);
}

#[test]
fn another_measurement_is_refused() {
    let old = baseline(vec![row("x", Some([1.0, 0.1]))]);
    let same = measured(vec![row("x", Some([1.0, 0.1]))]);
    let mut other = same.clone();
    other.subject.threads = 3;
    assert!(matches!(old.compare(&other), Err(BaselineError::Threads { new: 3, .. })));
    other.subject.threads = 2;
    other.subject.simd = SimdLevel::Sse42;
    let error = old.compare(&other).unwrap_err();
    assert!(error.to_string().contains("measured on avx2, not sse4.2"), "{error}");
    let mut larger = same.clone();
    larger.subject.digest = "d2".to_owned();
    larger.subject.resolution = Resolution::new(8, 6).unwrap();
    let error = old.compare(&larger).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a.toml was measured at 4x3, not 8x6; give --size 4x3, or measure it anew"
    );
    let mut changed = same.clone();
    changed.subject.digest = "d2".to_owned();
    assert!(matches!(old.compare(&changed), Err(BaselineError::Digest { .. })));
    changed.subject.name = "b.toml".to_owned();
    assert!(matches!(old.compare(&changed), Err(BaselineError::Missing { .. })));
    // Other programs' times are not compared.
    let mut theirs = row("x", Some([9.0, 0.1]));
    theirs.program = Some("theirs".to_owned());
    let only_theirs = old.compare(&measured(vec![theirs]));
    assert!(matches!(only_theirs, Err(BaselineError::NothingInCommon { .. })));
    // The same scene under another name is the same scene.
    let mut renamed = same;
    renamed.subject.name = "b.toml".to_owned();
    assert_eq!(old.compare(&renamed).unwrap().len(), 1);
    let wrong = measured(vec![row("x", None)]);
    assert!(matches!(old.compare(&wrong), Err(BaselineError::NothingInCommon { .. })));
}

#[test]
fn other_texts_are_refused() {
    let refused = |text: &str| Baseline::parse(text).unwrap_err().to_string();
    assert!(refused("{\n  ]").contains("line 2 column 3"), "{}", refused("{\n  ]"));
    assert!(refused("{}").contains("missing field `schema`"));
    assert!(refused(r#"{"schema": "truecast/check/1"}"#).contains("`truecast/check/1`"));
    assert!(refused(r#"{"schema": "truecast/bench/2"}"#).contains("missing field"));
}
