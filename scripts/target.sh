# Sourced by scripts/build.sh and scripts/wheel.sh, after `target`, the folder of cargo: both build alike, so that they share all that is compiled. Sets `built`, the folder
# that the profile fmu is built into. On Linux on x86-64 what is built runs with glibc 2.17: scripts/linker.sh.
# shellcheck shell=sh disable=SC2034
CARGO_BUILD_TARGET=$(rustc -vV | sed -n 's/^host: //p')
export CARGO_BUILD_TARGET
built=$target/$CARGO_BUILD_TARGET/fmu
if [ "$(uname -sm)" = "Linux x86_64" ]; then
    scripts/python-env.sh
    # As a target is named, cargo keeps the flags away from the programs that run during the build. The path is relative, since flags may enter the names of symbols.
    export RUSTFLAGS="-C linker=scripts/linker.sh -C linker-features=-lld"
fi
