#!/bin/sh
# Tests what scripts/release.sh has made: the checksums; the archive, unpacked into another folder, by its program, a C program and its book, and
# by FMUs on 64-bit ARM (qemu) and Windows (Wine), if it has libraries for them; the archive for Windows under Wine, if it is there; the wheels, by their tags, hashes and libraries; the
# one for this computer, installed into an empty environment, target/wheel-env, by the tests of the Python package.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
(cd dist && sha256sum --check --quiet SHA256SUMS)

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
tar --extract --file dist/ancf14-*.tar.gz --directory "$place" --strip-components 1
PKG_CONFIG_PATH=$place/lib/pkgconfig
export PKG_CONFIG_PATH
(
    cd "$place"
    # shellcheck disable=SC2046 # Flags are words.
    cc -std=c99 share/ancf14/c-examples/simulate.c $(pkg-config --cflags --libs ancf14) -o simulate
    ./simulate share/ancf14/c-examples/arm.toml > table.txt
    bin/ancf14 run share/ancf14/models/cantilever.toml --set simulation.stop=0.05 > run.txt
    if [ -f lib/ancf14.wasm ]; then
        bin/ancf14 view share/ancf14/models/cantilever.toml --set simulation.stop=0.05 --live > view.txt
        grep -q 'id="solver"' cantilever.html
    fi
    bin/ancf14 pack share/ancf14/models/cantilever.toml -o cantilever.fmu
)
grep -q '^0.1, ' "$place/table.txt"
test -s "$place/cantilever-results/results.csv"
test -s "$place/cantilever.fmu"
echo "archive: the program and a C program run from another folder"
for page in index first-steps how-do-i/ropes language/reference theory/kinematics search/search_index; do
    ls "$place/share/doc/ancf14/book/$page".* > "$place/pages.txt"
done
# A picture of the gallery leads to a page that moves.
grep -q 'href="gallery/pendulum.html#play"' "$place/share/doc/ancf14/book/gallery.html"
grep -q 'id="data"' "$place/share/doc/ancf14/book/gallery/pendulum.html"
echo "archive: the book is there, with a gallery that moves"
if [ -f "$place/lib/ancf14.wasm" ]; then
    scripts/build-wasm.sh --check "$place/lib/ancf14.wasm"
    echo "archive: the solver of pages is of these sources"
fi
scripts/python-env.sh
if [ -d "$place/lib/aarch64-linux" ] && [ -d "$place/lib/x86_64-windows" ]; then
    "$target/python-env/bin/python" scripts/platforms.py "$place/bin/ancf14"
fi
for archive in dist/ancf14-*-windows-*.zip; do
    if [ -f "$archive" ]; then
        "$target/python-env/bin/python" scripts/windows.py "$place/bin/ancf14" "$archive"
    fi
done
for wheel in dist/ancf14-*.whl; do
    case $wheel in
        *manylinux* | *win_amd64*) "$target/python-env/bin/python" scripts/check_wheel.py "$wheel" ;;
        *) test -f "$wheel" ;;
    esac
done
if [ -d "$place/lib/aarch64-linux" ]; then
    ls dist/ancf14-*_aarch64.whl
fi

rm -rf "$target/wheel-env"
"${PYTHON:-python3}" -m venv "$target/wheel-env"
python="$target/wheel-env/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check dist/ancf14-*_"$(uname -m)".whl --requirement python/tests/requirements.txt
if [ -f "$target/fmu/ancf14.wasm" ]; then
    "$target/wheel-env/bin/ancf14" view models/cantilever.toml --set simulation.stop=0.05 --live -o "$place/wheel.html" > "$place/wheel.txt"
    grep -q 'id="solver"' "$place/wheel.html"
    echo "wheel: the command line writes a page with the solver"
fi
"$python" -m pytest -q -p no:cacheprovider --rootdir python/tests python/tests
for folder in python/tests python/examples; do
    (cd "$folder" && "$python" -m mypy --config-file ../pyproject.toml --cache-dir /dev/null .)
done
"$python" -m mypy --config-file python/pyproject.toml --cache-dir /dev/null --package ancf14
