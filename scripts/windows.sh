# Sourced by scripts/build-windows.sh and scripts/wheel.sh, in the root of the repository: the compiler for Windows (x86-64), which is Debian's own, not one of rustup.
# The standard library is built from its source (`standard_library`, an unstable feature of cargo), since the compiler of the distribution is all there is. Needs, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src gcc-mingw-w64-x86-64
#
# shellcheck shell=sh disable=SC2034
triple=x86_64-pc-windows-gnu
standard_library=build-std=std,panic_unwind
export PATH=/usr/bin:/bin RUSTC=/usr/bin/rustc CARGO=/usr/bin/cargo RUSTC_BOOTSTRAP=1
