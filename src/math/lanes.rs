//! Kernels in the widest lanes that the processor has: on x86-64 four doubles at a time (AVX2) instead of two.
//!
//! The compiler compiles a kernel twice, once for each width. Both versions make the same operations in the same order, and fuse none of them, so that results do not
//! depend on the processor. Only what is inlined into a kernel is compiled for wide lanes: the functions that it calls are `#[inline(always)]`.

use std::sync::atomic::{AtomicU8, Ordering};

/// The lanes of this process: not known yet, narrow, wide.
static LANES: AtomicU8 = AtomicU8::new(UNKNOWN);

const UNKNOWN: u8 = 0;
const NARROW: u8 = 1;
const WIDE: u8 = 2;

/// Calls `kernel`, a closure that is `#[inline(always)]`.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub fn in_widest<R>(kernel: impl FnOnce() -> R) -> R {
    if are_wide()
        && let Some(wide) = pulp::x86::V3::try_new()
    {
        return wide.vectorize(kernel);
    }
    kernel()
}

/// Calls `kernel`.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
pub fn in_widest<R>(kernel: impl FnOnce() -> R) -> R {
    kernel()
}

/// Whether kernels run in wide lanes.
#[inline(always)]
pub fn are_wide() -> bool {
    match LANES.load(Ordering::Relaxed) {
        UNKNOWN => find(),
        lanes => lanes == WIDE,
    }
}

/// Lets all kernels of this process run in narrow lanes, or again in the widest ones: for tests that compare both.
pub fn set_narrow(is_narrow: bool) {
    LANES.store(if is_narrow { NARROW } else { UNKNOWN }, Ordering::Relaxed);
}

#[cold]
fn find() -> bool {
    let is_wide = has_wide();
    LANES.store(if is_wide { WIDE } else { NARROW }, Ordering::Relaxed);
    is_wide
}

/// Whether processor and operating system have wide lanes; `pulp` asks the processor alone.
///
/// The kernels do not use ADX. Valgrind 3.19 claims AVX2 but lacks one of its instructions, and does not claim ADX: there kernels run in narrow lanes. So they do on the first
/// processors with AVX2 (Haswell, 2013), which have no ADX either.
#[cfg(target_arch = "x86_64")]
fn has_wide() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("adx") && pulp::x86::V3::is_available()
}

#[cfg(not(target_arch = "x86_64"))]
fn has_wide() -> bool {
    false
}
