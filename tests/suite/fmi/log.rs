//! Is a log line safe in a printf-like logger? An unescaped `%` makes hosts read arguments that nobody passed (FMPy
//! crashes), and fixed buffers overflow beyond 2,048 bytes.

use ancf14::fmi::{
    LogCategory,
    log::{CATEGORIES, LONGEST, Switch, prepare},
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn prepared(message: &str) -> String {
    prepare(message).into_string().unwrap()
}

#[test]
fn percent_and_number_signs_are_doubled() {
    assert_eq!(prepared("/tmp/a%20b #r1#"), "/tmp/a%%20b ##r1##");
}

#[test]
fn no_final_newline_and_no_nul() {
    assert_eq!(prepared("two\nlines\r\n"), "two\nlines");
    assert_eq!(prepared("a\0b"), "a b");
}

/// The limit holds for the bytes sent; neither a character nor a doubled sign is cut in two.
#[test]
fn cut_on_a_boundary() {
    assert_eq!(prepared(&"x".repeat(3000)).len(), LONGEST);
    assert_eq!(prepared(&format!("x{}", "ü".repeat(2000))).len(), LONGEST - 1);
    let signs = prepared(&format!("x{}", "%".repeat(2000)));
    assert_eq!(signs.len(), LONGEST - 1);
    assert_eq!(signs.matches('%').count() % 2, 0);
}

// A fixed seed: the same cases in every run.
proptest! {
    #![proptest_config(ProptestConfig { cases: 256, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the text: printf would print it without looking at an argument.
    #[test]
    fn printf_finds_no_conversion(message in ".{0,1500}") {
        let text = prepared(&message);
        prop_assert!(text.len() <= LONGEST);
        prop_assert!(!text.replace("%%", "").contains('%'));
        prop_assert!(!text.replace("##", "").contains('#'));
    }
}

/// Names as in the standard, section 2.2.4, and no two alike.
#[test]
fn categories_have_the_standard_s_names() {
    let names: Vec<&str> = CATEGORIES.iter().map(|category| category.name()).collect();
    assert_eq!(
        names,
        [
            "logEvents",
            "logSingularLinearSystems",
            "logNonlinearSystems",
            "logStatusWarning",
            "logStatusDiscard",
            "logStatusError",
            "logStatusFatal"
        ]
    );
}

#[test]
fn the_switch_selects() {
    let mut switch = Switch::new(false);
    assert!(!switch.wants(LogCategory::Events));
    assert!(switch.select(true, &[]).is_empty());
    assert!(switch.wants(LogCategory::Events));
    assert_eq!(switch.select(true, &["logStatusError", "logNonsense"]), ["logNonsense"]);
    assert!(!switch.wants(LogCategory::Events) && switch.wants(LogCategory::StatusError));
    assert!(switch.select(true, &["logStatusError", "logAll"]).is_empty());
    assert!(switch.wants(LogCategory::Events));
    assert!(switch.select(false, &["logEvents"]).is_empty());
    assert!(!switch.wants(LogCategory::Events));
}
