//! Logarithmic axes of a plot, from a round number to another. Lines and labels are drawn by whoever
//! has the plot.

/// One logarithmic axis, from a round number to another, over a stretch of the page.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// Round numbers, ascending, at least two.
    pub(crate) marks: Vec<Round>,
    start: f64,
    end: f64,
}

/// 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    factor: u32,
    power: i32,
}

impl Round {
    /// Its value.
    pub(crate) fn value(self) -> f64 {
        f64::from(self.factor) * libm::pow(10.0, f64::from(self.power))
    }

    fn next(self) -> Self {
        match self.factor {
            1 => Self { factor: 2, ..self },
            2 => Self { factor: 5, ..self },
            _ => Self { factor: 1, power: self.power + 1 },
        }
    }

    /// In full where that is short.
    pub(crate) fn label(self) -> String {
        let Self { factor, power } = self;
        match power {
            -2..=-1 => format!("{:.*}", power.unsigned_abs() as usize, self.value()),
            0..=3 => format!("{}", factor * 10_u32.pow(power.unsigned_abs())),
            _ => format!("{factor}e{power}"),
        }
    }
}

impl Axis {
    /// Around values above 0, or about 1 if there is none. Over more than two powers of ten only these
    /// are marked.
    pub(crate) fn around(values: impl Iterator<Item = f64>, start: f64, end: f64) -> Self {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
            (least, most) = (least.min(value), most.max(value));
        }
        if least > most {
            (least, most) = (1.0, 1.0);
        }
        let power = libm::log10(least).floor() as i32;
        let mut mark = Round { factor: 1, power };
        while mark.next().value() <= least {
            mark = mark.next();
        }
        let mut marks = vec![mark];
        while marks.len() < 2 || mark.value() < most {
            mark = mark.next();
            marks.push(mark);
        }
        if marks.last().is_some_and(|last| last.value() > 100.0 * marks[0].value()) {
            marks[0].factor = 1;
            while mark.factor != 1 {
                mark = mark.next();
                marks.push(mark);
            }
            marks.retain(|mark| mark.factor == 1);
        }
        Self { marks, start, end }
    }

    /// Where a value above 0 lies on the page.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let [low, high] = [self.marks.first(), self.marks.last()]
            .map(|mark| mark.map_or(0.0, |mark| libm::log10(mark.value())));
        let share = (libm::log10(value) - low) / (high - low);
        self.start + share * (self.end - self.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64]) -> Vec<String> {
        let axis = Axis::around(values.iter().copied(), 0.0, 1.0);
        axis.marks.iter().map(|mark| mark.label()).collect()
    }

    #[test]
    fn axes_begin_and_end_at_round_numbers() {
        assert_eq!(labels(&[13.0, 71.0, 0.0]), ["10", "20", "50", "100"]);
        assert_eq!(labels(&[0.02, 0.03]), ["0.02", "0.05"]);
        assert_eq!(labels(&[3.0, 800.0]), ["1", "10", "100", "1000"]);
        assert_eq!(labels(&[7e-5, 0.02]), ["1e-5", "1e-4", "1e-3", "0.01", "0.1"]);
        assert_eq!(labels(&[]), ["1", "2"]);
        let axis = Axis::around([10.0, 1000.0].into_iter(), 40.0, 20.0);
        assert_eq!([10.0, 100.0, 1000.0].map(|value| axis.at(value)), [40.0, 30.0, 20.0]);
    }
}
