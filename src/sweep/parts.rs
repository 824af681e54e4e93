//! A sweep in parts.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Part `number` of `of`, counted from 1: as in `3/8`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SweepPart {
    number: u64,
    of: u64,
}

impl SweepPart {
    /// Part `number` of `of`; `None` unless 1 <= number <= of.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// Its points among `count`: all parts together are all of them, and no two parts differ by more than one in size.
    pub fn range(self, count: u64) -> Range<u64> {
        let until = |k: u64| (u128::from(count) * u128::from(k) / u128::from(self.of)) as u64;
        until(self.number - 1)..until(self.number)
    }
}

impl FromStr for SweepPart {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, m)| Some((k.parse().ok()?, m.parse().ok()?)));
        numbers
            .and_then(|(k, m)| Self::new(k, m))
            .ok_or_else(|| "K/M is needed, part K of M with 1 <= K <= M, such as 3/8".to_owned())
    }
}

impl fmt::Display for SweepPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_everything_once() {
        for (count, of) in [(10, 3), (2, 5), (0, 2), (u64::MAX, 7), (1000, 1000)] {
            let mut next = 0;
            for number in 1..=of {
                let range = SweepPart::new(number, of).unwrap().range(count);
                assert_eq!(range.start, next);
                next = range.end;
            }
            assert_eq!(next, count);
        }
    }

    #[test]
    fn senseless_parts_are_refused() {
        for text in ["0/3", "4/3", "1", "a/b", "1/0", "-1/2", "1/2/3", ""] {
            assert!(text.parse::<SweepPart>().is_err(), "{text}");
        }
        assert_eq!("3/8".parse::<SweepPart>().unwrap().to_string(), "3/8");
    }
}
