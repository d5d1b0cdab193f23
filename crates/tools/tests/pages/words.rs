//! Pages stay short enough to be read: the README, every page of the book, and the sentences of the pages for
//! users. Whoever needs more words splits the page, or cuts what is said twice.

use ancf14_testing::pages::pages_in;
use ancf14_testing::root;
use std::fs;

const README_WORDS: usize = 700;
const PAGE_WORDS: usize = 4_000;
/// Tables that a program writes, and that are longer therefore.
const GENERATED: [&str; 1] = ["docs/language/reference.md"];
/// A page that a program writes as a whole.
const WRITTEN: &str = "docs/accuracy/truth.md";
/// Words of a sentence on the pages for users, on average.
const SENTENCE_WORDS: f64 = 18.0;
/// Folders of pages for users, and pages for users in docs/ itself.
const FOLDERS: [&str; 3] = ["docs/how-do-i", "docs/language", "docs/accuracy"];
const PAGES: [&str; 20] = [
    "README.md",
    "docs/index.md",
    "docs/first-steps.md",
    "docs/tutorial.md",
    "docs/command-line.md",
    "docs/viewer.md",
    "docs/limits.md",
    "docs/versions.md",
    "docs/how-do-i.md",
    "docs/accuracy.md",
    "docs/fmu.md",
    "docs/coupling.md",
    "docs/python.md",
    "docs/programming.md",
    "docs/controller.md",
    "docs/linearization.md",
    "docs/water.md",
    "docs/gallery.md",
    "docs/model-file.md",
    "docs/portability.md",
];

/// All pages of the book, those in folders of docs/ too: the path and the text of each.
fn pages() -> Vec<(String, String)> {
    let entries = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap());
    let folders = entries.filter(|entry| entry.path().is_dir()).map(|entry| entry.file_name());
    let folders = folders.map(|name| format!("docs/{}", name.into_string().unwrap()));
    folders.chain([String::from("docs")]).flat_map(|folder| pages_in(&folder)).collect()
}

fn words(text: &str) -> usize {
    text.split_whitespace().count()
}

/// The paragraphs and the items of lists, without listings, tables, headings and the targets of links.
fn paragraphs(page: &str) -> Vec<String> {
    let mut list = vec![String::new()];
    let mut is_listing = false;
    for line in page.lines() {
        let line = line.trim();
        if line.starts_with("```") {
            is_listing = !is_listing;
        }
        if is_listing || line.is_empty() || ["```", "|", "#", "!["].iter().any(|mark| line.starts_with(mark)) {
            list.push(String::new());
            continue;
        }
        let item = ["- ", "* ", "1. ", "2. ", "3. ", "4. ", "5. "].iter().find_map(|mark| line.strip_prefix(mark));
        if item.is_some() {
            list.push(String::new());
        }
        let own = list.last_mut().unwrap();
        own.push_str(item.unwrap_or(line));
        own.push(' ');
    }
    list
}

/// The number of words of each sentence. A piece of code and a link each count as the words that are shown.
fn sentences(page: &str) -> Vec<usize> {
    let mut lengths = Vec::new();
    for paragraph in paragraphs(page) {
        let mut length = 0;
        for word in paragraph.split_whitespace() {
            length += 1;
            let shown = word.split("](").next().unwrap_or(word);
            let end = if word.contains("](") && !word.ends_with(['.', '?', '!']) { shown } else { word };
            if end.trim_end_matches([')', '*']).ends_with(['.', '?', '!']) {
                lengths.push(length);
                length = 0;
            }
        }
        if length > 0 {
            lengths.push(length);
        }
    }
    lengths
}

#[test]
fn pages_are_short() {
    let readme = words(&fs::read_to_string(root().join("README.md")).unwrap());
    assert!(readme <= README_WORDS, "README.md has {readme} words, at most {README_WORDS}");
    let pages = pages();
    assert!(pages.len() > 50, "{} pages", pages.len());
    for (path, text) in &pages {
        let found = words(text);
        let allowed = GENERATED.contains(&path.as_str());
        assert!(allowed || found <= PAGE_WORDS, "{path} has {found} words, at most {PAGE_WORDS}: split it");
    }
    for path in GENERATED {
        assert!(pages.iter().any(|(own, _)| own == path), "{path} is gone: take it from the list");
    }
}

#[test]
fn sentences_of_pages_for_users_are_short() {
    let of_folders = FOLDERS.iter().flat_map(|folder| pages_in(folder)).filter(|(path, _)| path != WRITTEN);
    let named = PAGES.iter().map(|path| ((*path).to_owned(), fs::read_to_string(root().join(path)).unwrap()));
    for (path, text) in named.chain(of_folders) {
        let lengths = sentences(&text);
        let mean = lengths.iter().sum::<usize>() as f64 / lengths.len() as f64;
        println!("{path}: {} words, {mean:.1} in a sentence", words(&text));
        assert!(mean <= SENTENCE_WORDS, "{path}: a sentence has {mean:.1} words on average, at most {SENTENCE_WORDS}");
    }
}

/// The counter of this test, on a text that was counted by hand.
#[test]
fn sentences_are_counted() {
    let page = "# Title\n\nOne two three. Four `five.six` [seven\neight](a.md) nine?\n\n- ten\n- eleven (twelve).\n\n\
        ```sh\nnot this.\n```\n\n| nor | this. |\n";
    assert_eq!(sentences(page), [3, 5, 1, 2]);
}
