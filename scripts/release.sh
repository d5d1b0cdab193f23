#!/bin/sh
# Makes a release in dist/: the Python wheel; for those without Python an archive with the program, the libraries, the header, files for pkg-config and CMake,
# models, examples and the book; the list of all components (CycloneDX); checksums. Builds what is missing, but for the libraries of other
# platforms, which scripts/build-platforms.sh builds: wheel and archive have those that are there. With the library for 64-bit ARM there is a wheel for it, too; with the
# program for Windows a wheel and an archive for it. The same commit gives the same archives.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
scripts/build.sh
# The solver of pages takes as long as all the rest: ANCF14_LIVE=no takes it only if it is there.
if [ "${ANCF14_LIVE:-yes}" = yes ]; then
    scripts/build-wasm.sh
fi
scripts/wheel.sh
if [ -f "$target/fmu/aarch64-linux/libancf14.so" ]; then
    scripts/wheel.sh aarch64-linux
fi
if [ -f "$target/fmu/x86_64-windows/ancf14.exe" ]; then
    scripts/wheel.sh x86_64-windows
fi
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
name=ancf14-$version-$(uname -s | tr '[:upper:]' '[:lower:]')-$(uname -m)
tree=$target/release-tree
rm -rf dist "$tree"
mkdir -p dist
sh scripts/install.sh "$tree/$name"
share=$tree/$name/share/ancf14
mkdir -p "$share"
cp -r models c-examples "$share"
cp README.md CHANGELOG.md "$tree/$name"
# Motions that a reader can drag; the solver in every page would double the archive.
PYTHONDONTWRITEBYTECODE=1 ANCF14="$target/fmu/ancf14" "${PYTHON:-python3}" scripts/gallery.py --live=pendulum,four_bar,robot "$target/gallery"
scripts/book.sh
cp -r "$target/book" "$tree/$name/share/doc/ancf14/book"
time=$(git log -1 --format=%ct)
tar --create --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$time" --directory "$tree" "$name" | gzip -9 --no-name > "dist/$name.tar.gz"
if [ -f "$target/fmu/x86_64-windows/ancf14.exe" ]; then
    windows=ancf14-$version-windows-x86_64
    sh scripts/install-windows.sh "$tree/$name" "$tree/$windows"
    find "$tree/$windows" -exec touch --no-dereference --date="@$time" {} +
    # It sorts the names of files; their times are those of the time zone.
    (cd "$tree" && TZ=UTC "${PYTHON:-python3}" -m zipfile --create "$windows.zip" "$windows")
    mv "$tree/$windows.zip" dist
fi
cp "$target"/wheels/ancf14-*.whl dist
scripts/python-env.sh
SOURCE_DATE_EPOCH=$time "$target/python-env/bin/python" scripts/components.py "dist/ancf14-$version.cdx.json"
(cd dist && sha256sum -- * > SHA256SUMS)
