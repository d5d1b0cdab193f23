//! Every whole example of docs/model-file.md and docs/language/ starts, and its drawing follows it:
//! docs/model-file/NAME.svg.

use ancf14::fmi::Model;
use ancf14::model::drawing::Drawing;
use ancf14_report::draw::{self, Projection};
use ancf14_testing::golden;
use ancf14_testing::pages;
use ancf14_testing::running;

/// The page that leads to all others.
const INDEX: &str = include_str!("../../../../docs/model-file.md");

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

/// The index names each page of the language, and each heading of the pages that have several.
#[test]
fn contents_are_those_of_the_pages() {
    let anchor = |heading: &str| {
        let kept = |letter: &char| letter.is_alphanumeric() || [' ', '-'].contains(letter);
        heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
    };
    for (path, page) in pages::pages_in("docs/language") {
        let path = path.strip_prefix("docs/").unwrap();
        let headings: Vec<_> = page.lines().filter_map(|line| line.strip_prefix("## ")).map(anchor).collect();
        if headings.is_empty() || headings.iter().any(|own| own == "model") {
            assert!(INDEX.contains(&format!("]({path})")), "docs/model-file.md does not lead to {path}");
            continue;
        }
        for heading in headings {
            assert!(
                INDEX.contains(&format!("]({path}#{heading})")),
                "docs/model-file.md does not lead to {path}#{heading}"
            );
        }
    }
}

/// The whole examples of a page, each with the text behind it.
fn examples(page: &str) -> Vec<(&str, &str)> {
    let listings = page.split("```toml\n").skip(1).map(|rest| rest.split_once("```\n").unwrap());
    listings.filter(|(text, _)| text.starts_with("format = 1")).collect()
}

#[test]
fn examples_start_and_are_drawn() {
    let mut pages = pages::pages_in("docs/language");
    // It shows every key, some of which exclude each other.
    pages.retain(|(path, _)| path != "docs/language/sections.md");
    pages.push((String::from("docs/model-file.md"), String::from(INDEX)));
    let mut drawn = 0;
    for (path, page) in &pages {
        for (text, after) in examples(page) {
            let simulation = running::start(text);
            let about = simulation.about();
            let picture = format!("model-file/{}.svg", file_name(&about.name));
            let link = if path == "docs/model-file.md" { picture.clone() } else { format!("../{picture}") };
            assert!(after.contains(&format!("]({link})")), "{path} does not show {picture} after its example");
            let svg = draw::svg(&Drawing::new(simulation.document()), &about.name, Projection::Oblique);
            golden::assert_current(&format!("docs/{picture}"), &svg);
            drawn += 1;
        }
    }
    assert!(drawn > 15, "{drawn} examples");
}
