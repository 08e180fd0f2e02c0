//! Ours beside the others': at the closest hit, the fastest of each.
//!
//! Both sides choose their best after the fact, from medians of the same rounds. Only right answers
//! of ours stand, and none without proof; another program's need not be right.

use super::kernels::{PROVEN, UNPROVEN};
use super::rounds::Row;
use super::workload::Work;

/// Our fastest closest hit beside another program's.
#[derive(Clone, Debug, PartialEq)]
pub struct Rivalry {
    /// The other program.
    pub program: String,
    /// The name of its fastest row.
    pub theirs: String,
    /// The name of ours.
    pub ours: String,
    /// Its median time over ours: above 1 where ours is faster.
    pub ratio: f64,
    /// The same of the least times.
    pub ratio_of_least: f64,
}

/// What proof costs: the caster's median time over the same kernel's without proof; `None` where one
/// of both has no time.
pub fn price_of_proof(rows: &[Row]) -> Option<f64> {
    let median =
        |name: &str| rows.iter().find(|row| row.name == name)?.times.map(|times| times.median);
    Some(median(PROVEN)? / median(UNPROVEN)?)
}

/// One per other program that has a time, in the order of the rows; none where ours has none.
pub fn rivalries(rows: &[Row]) -> Vec<Rivalry> {
    let fastest = |program: Option<&str>| {
        rows.iter()
            .filter(|row| row.work == Work::Closest && row.program.as_deref() == program)
            .filter(|row| row.is_exact || program.is_some())
            .filter_map(|row| Some((row, row.times?)))
            .min_by(|(_, a), (_, b)| a.median.total_cmp(&b.median))
    };
    let Some((ours, our_times)) = fastest(None) else { return Vec::new() };
    let mut programs: Vec<&str> = Vec::new();
    for program in rows.iter().filter_map(|row| row.program.as_deref()) {
        if !programs.contains(&program) {
            programs.push(program);
        }
    }
    let against = |program: &str| {
        let (theirs, times) = fastest(Some(program))?;
        Some(Rivalry {
            program: program.to_owned(),
            theirs: theirs.name.clone(),
            ours: ours.name.clone(),
            ratio: times.median / our_times.median,
            ratio_of_least: times.least / our_times.least,
        })
    };
    programs.into_iter().filter_map(against).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Statistics;
    use std::time::Duration;

    fn row(name: &str, program: Option<&str>, work: Work, milliseconds: &[u64]) -> Row {
        let times: Vec<_> = milliseconds.iter().map(|&time| Duration::from_millis(time)).collect();
        Row {
            name: name.to_owned(),
            work,
            amount: work.of(1),
            program: program.map(str::to_owned),
            is_exact: program.is_none() && name != UNPROVEN,
            wrong_pixels: Some(0),
            times: Statistics::of(&times),
            levels: None,
        }
    }

    #[test]
    fn the_fastest_of_each_side_are_compared() {
        let rows = [
            row("build", None, Work::Build, &[1]),
            row("slow", None, Work::Closest, &[8, 9, 10]),
            row("wrong", None, Work::Closest, &[]),
            row(PROVEN, None, Work::Closest, &[4, 4, 5]),
            row(UNPROVEN, None, Work::Closest, &[2, 2, 2]),
            row("build of theirs", Some("theirs"), Work::Build, &[1]),
            row("their single", Some("theirs"), Work::Closest, &[30, 30, 30]),
            row("their packet", Some("theirs"), Work::Closest, &[6, 12, 13]),
            row("builder", Some("builds only"), Work::Build, &[1]),
        ];
        let found = rivalries(&rows);
        assert_eq!(found.len(), 1);
        assert_eq!((&*found[0].ours, &*found[0].theirs), (PROVEN, "their packet"));
        assert_eq!((found[0].ratio, found[0].ratio_of_least), (3.0, 1.5));
        assert_eq!(rivalries(&rows[4..]), []);
        assert_eq!(price_of_proof(&rows), Some(2.0));
        assert_eq!(price_of_proof(&rows[4..]), None);
    }
}
