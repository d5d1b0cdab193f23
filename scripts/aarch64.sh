# Sourced by scripts/build-aarch64.sh and scripts/wheel.sh, in the root of the repository: the compiler for Linux on 64-bit ARM (aarch64, glibc 2.17), which is Debian's own, not one of rustup.
# The standard library is built from its source (`standard_library`, an unstable feature of cargo), since the compiler of the distribution is all there is. Needs Python 3.11 or later and, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src
#
# shellcheck shell=sh disable=SC2034
scripts/python-env.sh
triple=aarch64-unknown-linux-gnu
standard_library=build-std=std,panic_unwind
export PATH=/usr/bin:/bin RUSTC=/usr/bin/rustc CARGO=/usr/bin/cargo RUSTC_BOOTSTRAP=1
export ANCF14_MACHINE=aarch64 CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=scripts/linker.sh
