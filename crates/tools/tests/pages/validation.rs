//! docs/validation.md must be what its generator writes: the short runs are repeated here, and the page must hold every
//! number of them.

use ancf14_tools::validation as page;

const PAGE: &str = include_str!("../../../../docs/validation.md");

#[test]
fn the_page_holds_the_numbers_of_the_short_runs() {
    for case in page::CASES.iter().filter(|case| case.runs == page::Runs::Short) {
        let text = case.section().text;
        for line in text.lines() {
            assert!(PAGE.lines().any(|own| own == line), "{}: docs/validation.md lacks\n{line}", case.title);
        }
        assert!(PAGE.contains(text.trim_end()), "{}: the lines of docs/validation.md are in another order", case.title);
    }
}

/// docs/accuracy/truth.md has the tables on estimated errors of this page.
#[test]
fn the_page_on_truth_has_its_tables() {
    let accuracy = include_str!("../../../../docs/accuracy/truth.md");
    assert_eq!(accuracy, page::truth(accuracy, PAGE));
    assert!(accuracy.contains("| rolled up |") && accuracy.contains("| rotating shaft |"));
}

/// Every section has its place, and every picture is there.
#[test]
fn the_page_is_whole() {
    for case in &page::CASES {
        assert!(PAGE.contains(&format!("## {}\n", case.title)), "{} is missing", case.title);
    }
    let pictures: Vec<&str> = PAGE.split("](validation/").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(pictures.len() > 10);
    for picture in pictures {
        let path = ancf14_testing::root().join("docs/validation").join(picture);
        let svg = std::fs::read_to_string(&path).unwrap_or_else(|reason| panic!("{picture}: {reason}"));
        assert!(svg.contains("<svg") && !svg.contains("NaN"), "{picture}");
    }
}
