//! What a deck says of itself in its head, and what the reader of its result needs to know.

/// Facts of one deck, written as comment lines and read back from them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    /// Hash of the design.
    pub hash: String,
    /// Name of the variant.
    pub variant: String,
    /// Spacing at the contacts, mm.
    pub mesh_mm: f64,
    /// Number of sprags.
    pub count: usize,
    /// Force of a whole sprag over the force in the deck (which holds half its length, or a thin layer).
    pub axial_factor: f64,
    /// Length of the sprag, mm.
    pub length_mm: f64,
    /// Windup at which the deck starts, rad.
    pub start_rad: f64,
    /// Radii of the driven circles, inner and outer, mm.
    pub driven_mm: [f64; 2],
    /// Azimuth by which the driven direction runs ahead of the tangent at rest, inner and outer, rad.
    pub ahead_rad: [f64; 2],
    /// Radii of the tracks, mm.
    pub track_mm: [f64; 2],
}

const MARK: &str = "** sprag-design ";

impl Facts {
    /// Comment lines for the deck.
    pub fn to_lines(&self) -> String {
        let pair = |p: [f64; 2]| format!("{:e} {:e}", p[0], p[1]);
        [
            ("design", self.hash.clone()),
            ("variant", self.variant.clone()),
            ("mesh_mm", format!("{:e}", self.mesh_mm)),
            ("count", self.count.to_string()),
            ("axial_factor", format!("{:e}", self.axial_factor)),
            ("length_mm", format!("{:e}", self.length_mm)),
            ("start_rad", format!("{:e}", self.start_rad)),
            ("driven_mm", pair(self.driven_mm)),
            ("ahead_rad", pair(self.ahead_rad)),
            ("track_mm", pair(self.track_mm)),
        ]
        .iter()
        .map(|(key, value)| format!("{MARK}{key} = {value}\n"))
        .collect()
    }

    /// Read them back from a deck; `Err` names the key that is missing or no number.
    ///
    /// # Errors
    /// The key.
    pub fn parse(deck: &str) -> Result<Self, &'static str> {
        let line = |key: &'static str| {
            deck.lines()
                .filter_map(|l| l.strip_prefix(MARK)?.split_once(" = "))
                .find(|(k, _)| *k == key)
                .map(|(_, v)| v.trim())
                .ok_or(key)
        };
        let numbers = |key: &'static str| -> Result<Vec<f64>, &'static str> {
            let all: Vec<f64> =
                line(key)?.split(' ').map(str::parse).collect::<Result<_, _>>().map_err(|_| key)?;
            if all.iter().all(|v| v.is_finite()) { Ok(all) } else { Err(key) }
        };
        let positive = |key| match numbers(key)?.as_slice() {
            [v] if *v > 0.0 => Ok(*v),
            _ => Err(key),
        };
        let pair = |key| match numbers(key)?.as_slice() {
            [a, b] => Ok([*a, *b]),
            _ => Err(key),
        };
        Ok(Self {
            hash: line("design")?.to_owned(),
            variant: line("variant")?.to_owned(),
            mesh_mm: positive("mesh_mm")?,
            count: line("count")?.parse().map_err(|_| "count")?,
            axial_factor: positive("axial_factor")?,
            length_mm: positive("length_mm")?,
            start_rad: positive("start_rad")?,
            driven_mm: pair("driven_mm")?,
            ahead_rad: pair("ahead_rad")?,
            track_mm: pair("track_mm")?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facts_survive_the_deck_and_a_damaged_one_names_the_key() {
        let facts = Facts {
            hash: "abc".into(),
            variant: "layer".into(),
            mesh_mm: 0.1 + 0.2,
            count: 12,
            axial_factor: 2.0,
            length_mm: 6.0,
            start_rad: 1.0 / 3.0,
            driven_mm: [7.21, 26.23],
            ahead_rad: [-0.01, 0.01],
            track_mm: [11.11, 19.44],
        };
        let text = format!("** a clutch\n{}*NODE\n", facts.to_lines());
        assert_eq!(Facts::parse(&text), Ok(facts));
        assert_eq!(Facts::parse(&text.replace("track_mm = 1", "track_mm = x")), Err("track_mm"));
        assert_eq!(Facts::parse("*NODE\n"), Err("design"));
    }
}
