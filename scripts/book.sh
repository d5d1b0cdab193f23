#!/bin/sh
# Builds the book into target/book, from docs/ and mkdocs.yml: open target/book/index.html. A link or an anchor that leads nowhere, a page that the
# book does not list, and anything that a page would load from the net are errors. Needs Python 3.11 or later; PYTHON names another one than python3.
# The pictures of the gallery lead to pages that move, where scripts/gallery.py has made them; ANCF14_GALLERY names another folder than target/gallery.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
requirements=scripts/book-requirements.txt
environment=$target/book-env
if ! cmp -s "$requirements" "$environment/made-from.txt"; then
    rm -rf "$environment"
    "${PYTHON:-python3}" -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --requirement "$requirements"
    cp "$requirements" "$environment/made-from.txt"
fi
export ANCF14_GALLERY="${ANCF14_GALLERY:-$target/gallery}"
# The theme asks to read about its successor. `--quiet` would hide warnings from `--strict`.
log=$target/book.log
if ! NO_MKDOCS_2_WARNING=1 PYTHONDONTWRITEBYTECODE=1 "$environment/bin/python" -m mkdocs build --strict --clean --site-dir "$target/book" > "$log" 2>&1; then
    grep -v '^INFO' "$log" >&2
    exit 1
fi
# Not used in a book from disk, in English: languages of the search, maps for those who debug the theme, and pages for servers. The same pages give the
# same bytes.
rm -rf "$target/book/assets/javascripts/lunr"
rm -f "$target/book/sitemap.xml" "$target/book/sitemap.xml.gz" "$target/book/404.html"
find "$target/book" -name '*.map' -delete
cp "$environment"/lib/python3*/site-packages/mkdocs_material-*.dist-info/licenses/LICENSE "$target/book/assets/license-of-the-theme.txt"
if grep -rlE '(src|srcset)="?https?://|<link[^>]*href="?https?://|url\("?https?://|import\("?https?://' "$target/book" --include='*.html' --include='*.css'; then
    echo "these pages of the book load something from the net" >&2
    exit 1
fi
echo "the book: $target/book/index.html"
