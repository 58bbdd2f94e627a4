//! Numbers that look random, the same ones for the same seed.

/// A generator of repeatable noise (Marsaglia's xorshift).
pub struct Noise(u64);

impl Noise {
    /// Zero would stay zero, so it stands for another seed.
    pub fn new(seed: u64) -> Noise {
        Noise(if seed == 0 { 0x9E37_79B9_7F4A_7C15 } else { seed })
    }

    /// The next 32 bits.
    pub fn bits(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 32) as u32
    }

    /// From -1 up to 1.
    pub fn signed(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}
