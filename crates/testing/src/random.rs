//! Random but repeatable numbers: a test's figures must not change from run to run.

use ancf14::math::{Mat3, Vec3, rotation};

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A whole number from 0 on, below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (0.5 * (self.signed() + 1.0) * count as f64) as usize
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }

    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if v.norm() > 0.1 && v.norm() < 1.0 {
                return v.normalize();
            }
        }
    }

    pub fn rotation(&mut self) -> Mat3 {
        rotation::rotation_matrix(&(self.direction() * (self.signed() * 3.0)))
    }
}
