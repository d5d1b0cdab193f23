#!/bin/sh
# Runs FMUs of FMI 3.0 in the crate `fmi` of crates.io (tests/hosts/fmi), and compares the outputs with results.csv of `ancf14 run`, bit for bit. By hand: the crate and its
# dependencies take minutes to compile. After scripts/build.sh. Python's package `libclang` reads the standard's headers for the crate.
#
# Version 0.8.0 of the crate refuses legal parts of the description: attributes of Float64 variables (unit, displayUnit, nominal), the exponent K of units, and elements inside annotations. The copies
# that it gets are without them.
#
#     sh scripts/hosts.sh [ANCF14]     the program [default: target/fmu/ancf14]
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
program=${1:-$target/fmu/ancf14}
environment=$target/hosts-env
if [ ! -f "$environment/made" ]; then
    "${PYTHON:-python3}" -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check libclang==18.1.1
    touch "$environment/made"
fi
LIBCLANG_PATH=$("$environment/bin/python" -c 'import clang.native; print(clang.native.__path__[0])')
BINDGEN_EXTRA_CLANG_ARGS="-I$(cc -print-file-name=include)"
export LIBCLANG_PATH BINDGEN_EXTRA_CLANG_ARGS
cargo build --locked --release --quiet --manifest-path tests/hosts/fmi/Cargo.toml --target-dir "$target/hosts"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0
models=0
for model in models/*.toml tests/suite/fmi/*.toml; do
    name=$(basename "$model" .toml)
    "$program" pack "$model" --fmi 3 -o "$folder/$name.fmu" > /dev/null 2>&1
    "$program" run "$model" --out "$folder/$name" > /dev/null 2>&1
    "$environment/bin/python" - "$folder/$name.fmu" "$folder/$name-plain.fmu" << 'END'
import re, sys, zipfile

with zipfile.ZipFile(sys.argv[1]) as source, zipfile.ZipFile(sys.argv[2], "w", zipfile.ZIP_DEFLATED) as target:
    for name in source.namelist():
        data = source.read(name)
        if name == "modelDescription.xml":
            text = data.decode()
            text = re.sub(r"<Float64 [^>]*>", lambda found: re.sub(r' (unit|displayUnit|nominal)="[^"]*"', "", found[0]), text)
            text = re.sub(r"<Annotations>.*</Annotations>", "", text, flags=re.DOTALL)
            data = re.sub(r'(<BaseUnit[^>]*) K="[^"]*"', r"\1", text).encode()
        target.writestr(name, data)
END
    models=$((models + 1))
    "$target/hosts/release/fmi-host" "$folder/$name-plain.fmu" > "$folder/$name.csv" 2> "$folder/$name.log" || {
        cat "$folder/$name.log" >&2
        failed=$((failed + 1))
        continue
    }
    "$environment/bin/python" - "$folder/$name.csv" "$folder/$name/results.csv" "$name" << 'END' || failed=$((failed + 1))
import csv, sys

def table(path):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, [[float(cell) for cell in row] for row in rows]

(header, rows), (names, expected) = map(table, sys.argv[1:3])
columns = [name for name in names if name in header and name != "time"]
pairs = [(header.index(name), names.index(name)) for name in columns]
same = len(rows) == len(expected) and all(row[a] == other[b] for row, other in zip(rows, expected) for a, b in pairs)
print(f"{sys.argv[3]}: {len(columns)} outputs, {len(rows)} rows, {'bit-identical' if same else 'DIFFERENT'}")
sys.exit(not same)
END
done
echo "$((models - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
