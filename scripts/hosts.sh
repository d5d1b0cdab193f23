#!/bin/sh
# Runs FMUs of FMI 3.0 in the crate `fmi` of crates.io (tests/hosts/fmi), and compares the outputs with results.csv of `ancf14 run`, bit for bit. By hand: the crate and its
# dependencies take minutes to compile. After scripts/build.sh. A model fails if a command or the host does, or if an output is missing. Python's package `libclang` reads the standard's headers for the crate.
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
requirements=tests/hosts/fmi/requirements.txt
if ! cmp -s "$requirements" "$environment/made-from.txt"; then
    rm -rf "$environment"
    "${PYTHON:-python3}" -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$requirements"
    cp "$requirements" "$environment/made-from.txt"
fi
LIBCLANG_PATH=$("$environment/bin/python" -c 'import clang.native; print(clang.native.__path__[0])')
BINDGEN_EXTRA_CLANG_ARGS="-I$(cc -print-file-name=include)"
export LIBCLANG_PATH BINDGEN_EXTRA_CLANG_ARGS
cargo build --locked --release --quiet --manifest-path tests/hosts/fmi/Cargo.toml --target-dir "$target/hosts"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0
models=0

# `logged COMMAND...` runs it with its messages in the log of the model; a failure shows them, and counts.
logged() {
    "$@" 2> "$folder/$name.log" || {
        echo "$name: $1 $2 failed" >&2
        cat "$folder/$name.log" >&2
        failed=$((failed + 1))
        return 1
    }
}

for model in models/*.toml tests/suite/fmi/*.toml; do
    name=$(basename "$model" .toml)
    models=$((models + 1))
    logged "$program" pack "$model" --fmi 3 -o "$folder/$name.fmu" > /dev/null || continue
    logged "$program" run "$model" --out "$folder/$name" > /dev/null || continue
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
    logged "$target/hosts/release/fmi-host" "$folder/$name-plain.fmu" > "$folder/$name.csv" || continue
    "$environment/bin/python" - "$folder/$name.csv" "$folder/$name/results.csv" "$name" << 'END' || failed=$((failed + 1))
import csv, sys

def table(path):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, [[float(cell) for cell in row] for row in rows]

(header, rows), (names, expected) = map(table, sys.argv[1:3])
# The host writes all Float64 outputs of the description.
columns = header[1:]
missing = [name for name in columns if name not in names]
if not columns or missing:
    sys.exit(f"{sys.argv[3]}: {len(columns)} outputs; not in results.csv: {', '.join(missing) or 'none'}")
pairs = [(place, names.index(name)) for place, name in enumerate(header) if place > 0]
same = len(rows) == len(expected) and all(row[a] == other[b] for row, other in zip(rows, expected) for a, b in pairs)
print(f"{sys.argv[3]}: {len(columns)} outputs, {len(rows)} rows, {'bit-identical' if same else 'DIFFERENT'}")
sys.exit(not same)
END
done
echo "$((models - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
