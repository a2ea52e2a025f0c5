//! The source of random numbers: Owen-scrambled Sobol points, one sequence for each pixel.

/// Samples of one index that [`sobol_burley`] can tell apart.
const SEQUENCE_LENGTH: u32 = 1 << 16;

/// The numbers of one sample of one pixel.
///
/// Every call of [`Sampler::next_4d`] takes four fresh dimensions: the first four of the Sobol sequence,
/// scrambled and shuffled by the pixel, the seed and the number of the call (Burley, "Practical Hash-based
/// Owen Scrambling", JCGT 9(4), 2020, section 5). Nothing depends on other pixels, so neither does a picture
/// on its tiles or threads.
#[derive(Clone, Debug)]
pub(crate) struct Sampler {
    index: u32,
    seed: u32,
    call: u32,
}

impl Sampler {
    /// The sampler of sample number `index` of a pixel, for a picture's seed.
    #[must_use]
    pub(crate) fn new(pixel: [u32; 2], index: u32, seed: u32) -> Self {
        let epoch = index / SEQUENCE_LENGTH;
        let seed = [pixel[0], pixel[1], seed, epoch].into_iter().fold(0x9e37_79b9, combine);
        Self { index: index % SEQUENCE_LENGTH, seed, call: 0 }
    }

    /// The next four numbers in `[0, 1)`.
    #[inline]
    pub(crate) fn next_4d(&mut self) -> [f32; 4] {
        self.call += 1;
        sobol_burley::sample_4d(self.index, 0, combine(self.seed, self.call))
    }
}

/// Mixes a value into a hash (the finaliser of `MurmurHash3`, Austin Appleby, public domain).
#[inline]
pub(crate) fn combine(hash: u32, value: u32) -> u32 {
    let mut h = hash.rotate_left(13) ^ value.wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_stratified_in_every_pixel() {
        for pixel in [[0, 0], [1, 0], [959, 539]] {
            let mut strata = [0; 16];
            for index in 0..16 {
                let [x, ..] = Sampler::new(pixel, index, 1).next_4d();
                strata[(x * 16.0) as usize] += 1;
            }
            assert_eq!(strata, [1; 16], "pixel {pixel:?}");
        }
    }

    #[test]
    fn sequences_longer_than_the_generator_go_on() {
        let first = Sampler::new([3, 4], 0, 7).next_4d();
        let later = Sampler::new([3, 4], SEQUENCE_LENGTH, 7).next_4d();
        assert_ne!(first, later);
    }
}
