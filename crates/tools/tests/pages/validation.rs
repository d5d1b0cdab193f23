//! docs/validation/ and docs/accuracy/truth.md must be what their generator writes: the short runs are repeated here, and
//! the pages must hold every number of them.

use ancf14_testing::root;
use ancf14_tools::validation::{self, Page, Runs, part};
use std::fs;

fn written(page: &Page) -> String {
    fs::read_to_string(root().join("docs").join(page.path)).unwrap()
}

#[test]
fn the_pages_hold_the_numbers_of_the_short_runs() {
    let mut lacks = Vec::new();
    for page in &validation::PAGES {
        let own = written(page);
        for case in page.cases.iter().filter(|case| case.runs == Runs::Short) {
            let text = case.section().text;
            let lacking: Vec<&str> = text.lines().filter(|line| own.lines().all(|own| own != *line)).collect();
            if !lacking.is_empty() {
                lacks.push(format!("{}: docs/{} lacks\n{}", case.title, page.path, lacking.join("\n")));
                continue;
            }
            let title = case.title;
            assert!(own.contains(text.trim_end()), "{title}: the lines of docs/{} are in another order", page.path);
        }
    }
    assert!(lacks.is_empty(), "{}", lacks.join("\n"));
}

/// A page tells all that it takes to write it: sections that are not asked for stay. Every picture is there.
#[test]
fn the_pages_are_whole() {
    let mut pictures = 0;
    for page in &validation::PAGES {
        let own = written(page);
        let sections: Vec<String> =
            page.cases.iter().filter_map(|case| part(&own, case.title)).map(str::to_owned).collect();
        assert_eq!(sections.len(), page.cases.len(), "a section of docs/{} is missing", page.path);
        assert!(own == page.text(&sections), "docs/{} has other text than its sections", page.path);
        for picture in own.split("](").skip(1).filter_map(|rest| rest.split(')').next()?.strip_suffix(".svg")) {
            let path = root().join(format!("docs/validation/{picture}.svg"));
            let svg = fs::read_to_string(&path).unwrap_or_else(|reason| panic!("{picture}: {reason}"));
            assert!(svg.contains("<svg") && !svg.contains("NaN"), "{picture}");
            pictures += 1;
        }
    }
    assert!(pictures > 10, "{pictures} pictures");
}
