//! The floating-point environment of a host, put aside while the library computes.
//!
//! A host may let a division by zero, an invalid operation or an overflow end the program, round in another way, or
//! take subnormal numbers for 0. The compiler knows nothing of that: it computes quotients before it tests whether
//! they are needed. Expressions of a model file and estimates of errors have results that are not finite, which are
//! checked afterwards. Results are bit-identical in all hosts only under one rounding.

/// The registers of the host, until this is dropped; meanwhile nothing traps, and all rounds to nearest.
pub(super) struct Usual {
    #[cfg(target_arch = "x86_64")]
    of_host: u32,
}

#[cfg(target_arch = "x86_64")]
impl Usual {
    /// The register MXCSR as every program starts with it: no traps, round to nearest, subnormal numbers.
    const REGISTER: u32 = 0x1f80;

    pub fn enter() -> Self {
        let mut of_host = 0_u32;
        // SAFETY: every processor of this architecture has the register; it is written to a local variable.
        unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut of_host, options(nostack, preserves_flags)) };
        load(Self::REGISTER);
        Self { of_host }
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for Usual {
    fn drop(&mut self) {
        load(self.of_host);
    }
}

/// Loads the register MXCSR.
#[cfg(target_arch = "x86_64")]
fn load(register: u32) {
    // SAFETY: both values that come here are those of a register; the usual one is what Rust expects, and that of the
    // host is there when no code of this library runs.
    unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const register, options(nostack, preserves_flags)) };
}

/// Other processors that the library is built for have no traps.
#[cfg(not(target_arch = "x86_64"))]
impl Usual {
    pub fn enter() -> Self {
        Self {}
    }
}
