//! The clock and the scales: CPU time of this process, so that other work of the machine does not count, and its
//! resident memory.
#![allow(unsafe_code, reason = "the system's clock is asked through C")]

/// Rounds of a measurement at least, of which the fastest counts: whatever disturbs a round makes it slower.
const ROUNDS: usize = 3;
/// CPU time of a measurement, s: rounds follow until they have taken as much together. The slowest rows take some
/// seconds a round.
const ENOUGH: f64 = 1.0;

/// CPU time of this process so far, s.
pub fn cpu() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `time` lives during the call, which writes nothing else.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &raw mut time) };
    assert_eq!(status, 0, "this system has no clock of CPU time");
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// CPU time of `work`, s.
pub fn timed(work: impl FnOnce()) -> f64 {
    let begin = cpu();
    work();
    cpu() - begin
}

/// The least of what `round` returns, s: the time of that part of a round which is measured.
pub fn least(mut round: impl FnMut() -> f64) -> f64 {
    let begin = cpu();
    let (mut least, mut rounds) = (f64::INFINITY, 0);
    while rounds < ROUNDS || cpu() - begin < ENOUGH {
        least = least.min(round());
        rounds += 1;
    }
    least
}

/// Least CPU time of a call of `work`, s, in rounds of `repeats` calls: for what the clock is too slow for.
pub fn least_call(repeats: usize, mut work: impl FnMut()) -> f64 {
    least(|| timed(|| (0..repeats).for_each(|_| work()))) / repeats as f64
}

/// Resident memory of this process, bytes; only Linux says.
pub fn resident() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}
