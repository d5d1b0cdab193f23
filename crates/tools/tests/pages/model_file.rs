//! Every whole example of docs/model-file.md, docs/language/ and docs/how-do-i/ starts, and its drawing follows it.

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

/// Starts each example of a page in `docs/`. Compares its drawing with `folder`/NAME.svg, if the page leads there by a
/// link that begins with `up`. Returns the numbers of examples and of drawings.
fn draw_examples(path: &str, page: &str, folder: &str, up: &str) -> [usize; 2] {
    let all = examples(page);
    let mut drawn = 0;
    for (text, after) in &all {
        let simulation = running::start(text);
        let name = &simulation.about().name;
        let file = format!("{}.svg", file_name(name));
        let behind = after.split("```").next().unwrap_or_default();
        assert!(!behind.contains(".svg)") || behind.contains(&format!("]({up}{file})")), "{path} lacks {up}{file}");
        if behind.contains(".svg)") {
            let svg = draw::svg(&Drawing::new(simulation.document()), name, Projection::Oblique);
            golden::assert_current(&format!("docs/{folder}/{file}"), &svg);
            drawn += 1;
        }
    }
    [all.len(), drawn]
}

/// Every example has its drawing.
#[test]
fn examples_start_and_are_drawn() {
    let mut all = vec![draw_examples("docs/model-file.md", INDEX, "model-file", "model-file/")];
    for (path, page) in pages::pages_in("docs/language") {
        // It shows every key, some of which exclude each other.
        if path != "docs/language/sections.md" {
            let [found, drawn] = draw_examples(&path, &page, "model-file", "../model-file/");
            assert_eq!(found, drawn, "{path} has {found} examples and {drawn} drawings");
            all.push([found, drawn]);
        }
    }
    let drawn: usize = all.iter().map(|[_, drawn]| drawn).sum();
    assert!(drawn > 15, "{drawn} examples");
}

/// Models of docs/how-do-i/ have a drawing where it shows more than a body.
#[test]
fn models_to_copy_are_drawn() {
    let pages = pages::pages_in("docs/how-do-i");
    let drawn: usize = pages.iter().map(|(path, page)| draw_examples(path, page, "how-do-i", "")[1]).sum();
    let pictures = std::fs::read_dir(ancf14_testing::root().join("docs/how-do-i")).unwrap();
    let pictures = pictures.filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|own| own == "svg"));
    assert_eq!(drawn, pictures.count());
    assert!(drawn > 10, "{drawn} models");
}
