//! Sobol points scrambled by Owen's method, the same on every machine (crate `sobol_burley`), as many as are wanted.

/// Points of one sequence of the crate.
const LENGTH: u64 = 1 << 16;
/// Dimensions that there are.
pub const MOST_DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;

/// Coordinate `dimension` of point `index`, in [0, 1).
///
/// Beyond 2^16 points the next sequence begins, scrambled by a seed of its own: each block of 2^16 points fills the box evenly, and
/// the blocks are independent of one another.
pub fn sobol(index: u64, dimension: usize, seed: u64) -> f64 {
    let (block, within) = (index / LENGTH, index % LENGTH);
    // The first block keeps the seed as it is.
    let seed = (seed as u32 ^ (seed >> 32) as u32) ^ spread(block);
    f64::from(sobol_burley::sample(within as u32, (dimension % MOST_DIMENSIONS) as u32, seed))
}

/// 32 bits that look like chance, 0 for 0: the finisher of MurmurHash3, 64 bits, folded.
fn spread(block: u64) -> u32 {
    let mut k = block;
    k = (k ^ (k >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    k = (k ^ (k >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    k ^= k >> 33;
    k as u32 ^ (k >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each sixteenth of each axis holds a sixteenth of the points, in every block: the net's property.
    #[test]
    fn every_block_fills_every_axis_evenly() {
        for block in [0, 1, 15_258] {
            for dimension in [0, 1, 2, 9] {
                let mut counts = [0; 16];
                (0..256).for_each(|i| {
                    counts[(16.0 * sobol(block * LENGTH + i, dimension, 7)) as usize] += 1;
                });
                assert_eq!(counts, [16; 16], "block {block}, dimension {dimension}");
            }
        }
    }

    #[test]
    fn blocks_and_seeds_differ() {
        assert_ne!(sobol(3, 0, 1), sobol(3 + LENGTH, 0, 1));
        assert_ne!(sobol(3, 0, 1), sobol(3, 0, 2));
        assert_eq!(sobol(3, 1, 9), f64::from(sobol_burley::sample(3, 1, 9)));
    }
}
