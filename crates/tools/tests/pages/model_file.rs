//! Every whole example of docs/model-file.md starts, and its drawing follows it: docs/model-file/NAME.svg.

use ancf14::fmi::Model;
use ancf14::model::drawing::Drawing;
use ancf14_report::draw::{self, Projection};
use ancf14_testing::golden;
use ancf14_testing::running;

const PAGE: &str = include_str!("../../../../docs/model-file.md");

/// The name of its model in the words of a file name: `valve_train` for `ValveTrain`.
fn file_name(model: &str) -> String {
    let mut words = String::new();
    for letter in model.chars() {
        if letter.is_uppercase() && words.chars().last().is_some_and(char::is_lowercase) {
            words.push('_');
        }
        words.extend(letter.to_lowercase());
    }
    words
}

/// Each heading is in the contents at the top of the page, and each link of the contents leads to a heading.
#[test]
fn contents_are_those_of_the_page() {
    let anchor = |heading: &str| {
        let kept = |letter: &char| letter.is_alphanumeric() || [' ', '-'].contains(letter);
        heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
    };
    let (contents, page) = PAGE.split_once("\n## Principles\n").unwrap();
    let headings = page.lines().filter_map(|line| line.strip_prefix("### ").or(line.strip_prefix("## "))).map(anchor);
    // It only groups others.
    let mut headings: Vec<_> = headings.filter(|own| own != "details").collect();
    let links = contents.split("](#").skip(1).filter_map(|rest| rest.split_once(')'));
    let mut links: Vec<_> = links.map(|(link, _)| link.to_owned()).collect();
    headings.sort();
    links.sort();
    assert_eq!(links, headings);
}

#[test]
fn examples_start_and_are_drawn() {
    let listings = PAGE.split("```toml\n").skip(1).map(|rest| rest.split_once("```\n").unwrap());
    // The first one shows every key, some of which exclude each other.
    let examples: Vec<_> = listings.filter(|(text, _)| text.starts_with("format = 1")).skip(1).collect();
    assert!(examples.len() > 15, "{} examples", examples.len());
    for (text, after) in examples {
        let simulation = running::start(text);
        let about = simulation.about();
        let picture = format!("model-file/{}.svg", file_name(&about.name));
        assert!(
            after.contains(&format!("]({picture})")),
            "docs/model-file.md does not show {picture} after its example"
        );
        let svg = draw::svg(&Drawing::new(simulation.document()), &about.name, Projection::Oblique);
        golden::assert_current(&format!("docs/{picture}"), &svg);
    }
}
