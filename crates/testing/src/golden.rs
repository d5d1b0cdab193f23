//! Files under version control that are generated: a test proves them current; `ANCF14_BLESS=1 cargo test` writes them.

use crate::root;
use std::fs;

/// The file at `path`, from the root of the repository, holds exactly `text`.
pub fn assert_current(path: &str, text: &str) {
    let file = root().join(path);
    if std::env::var_os("ANCF14_BLESS").is_some() {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(&file, text).unwrap();
    }
    let stored = fs::read_to_string(&file).unwrap_or_default();
    let place = stored.lines().zip(text.lines()).position(|(old, new)| old != new);
    assert!(
        stored == text,
        "{path} is not current (first difference in line {:?}); if the change is meant, run ANCF14_BLESS=1 cargo test",
        place.map(|line| line + 1)
    );
}
