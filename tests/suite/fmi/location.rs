//! Which directory does a resource location mean? Hosts write it in six ways; a wrong reading looks for the model in
//! the wrong place, and decoding twice breaks paths with a percent sign.

use std::path::Path;

use ancf14::fmi::location::directory;

fn assert_means(location: &str, path: &str) {
    assert_eq!(directory(location).unwrap().as_deref(), Some(Path::new(path)), "{location}");
}

#[test]
fn all_forms_of_one_place() {
    for location in [
        "file:///tmp/unit/resources",
        "file:///tmp/unit/resources/",
        "file:/tmp/unit/resources",
        "file://localhost/tmp/unit/resources",
        "FILE:///tmp/unit/resources",
        "file:////tmp/unit/resources",
        "/tmp/unit/resources",
        "/tmp/unit/resources/",
    ] {
        assert_means(location, "/tmp/unit/resources");
    }
}

#[test]
fn empty_means_the_library_s_own() {
    assert_eq!(directory("").unwrap(), None);
    assert_eq!(directory("  ").unwrap(), None);
}

#[test]
fn decoded_once() {
    assert_means("file:///tmp/a%20b/100%25", "/tmp/a b/100%");
    assert_means("file:///tmp/%2525", "/tmp/%25");
    assert_means("file:///tmp/M%C3%BCnchen", "/tmp/München");
    assert_means("file:///tmp/München 1", "/tmp/München 1");
}

/// A stray `%` is part of the name, and so is any `%` of a bare path.
#[test]
fn percent_signs_that_encode_nothing() {
    assert_means("file:///tmp/50%", "/tmp/50%");
    assert_means("file:///tmp/5%z1", "/tmp/5%z1");
    assert_means("/tmp/a%20b", "/tmp/a%20b");
}

#[test]
fn refused_with_a_reason() {
    for (location, reason) in [
        ("http://host/resources", "only `file:`"),
        ("file://server/share", "another machine"),
        ("file:///tmp/%FF%FE", "UTF-8"),
        ("file://", "no path"),
        ("file:", "no path"),
    ] {
        let error = directory(location).unwrap_err().to_string();
        assert!(error.contains(reason) && error.contains(location), "{location}: {error}");
    }
}

/// A drive letter is no scheme.
#[test]
fn one_letter_is_a_drive() {
    assert_means("C:/unit/resources", "C:/unit/resources");
}
