//! The page: one HTML file with the program of viewer/ and the data in it; nothing is loaded from anywhere.

use super::block::{Effort, packed};
use super::live::Live;
use super::second::{Second, Shown};

/// The program, as viewer/build.mjs makes it.
const PROGRAM: &str = include_str!("../../../viewer/dist/viewer.js");
const STYLE: &str = include_str!("../../../viewer/dist/viewer.css");

/// Licences of all that is linked into the solver; made by scripts/licenses.py.
const LICENCES: &str = include_str!("../../../licenses/solver.txt");

/// The page with `@@names@@` for what goes into it. Its policy lets a browser load nothing but what is written in the
/// page.
const TEMPLATE: &str = include_str!("page.html");
const MARK: &str = "@@";

/// What the policy lets a page with the solver do in addition: compile it, and run it in a worker that the page makes.
const LIVE_POLICY: &str = " 'wasm-unsafe-eval' blob:; worker-src blob:";

/// What the policy lets a page of `view --watch` do in addition: ask the program that serves it.
const WATCH_POLICY: &str = "; connect-src 'self'";

/// The whole file; with a second run to compare with, and with the solver.
pub fn html(run: &Shown, second: Option<&Second>, live: Option<&Live>) -> Result<String, serde_json::Error> {
    let policy = if live.is_some() { LIVE_POLICY } else { "" };
    let second = second.map(Second::json).transpose()?;
    let second = second.map(|json| script("application/json", "second", &script_safe(&json))).unwrap_or_default();
    let live = live.map(scripts).transpose()?.unwrap_or_default();
    Ok(filled(&run.name, policy, &script_safe(&run.json), &(second + &live)))
}

/// A page without data: it asks the program that serves it, for `news` and `data`.
pub fn watching(title: &str) -> String {
    filled(title, WATCH_POLICY, "", "")
}

fn filled(title: &str, policy: &str, data: &str, others: &str) -> String {
    let title = escaped(title);
    // Every second piece is a name; what is put in is not looked at again.
    let pieces = TEMPLATE.split(MARK).map(|piece| match piece {
        "title" => &title,
        "policy" => policy,
        "style" => STYLE,
        "data" => data,
        "others" => others,
        "program" => PROGRAM,
        text => text,
    });
    pieces.collect()
}

/// The model, the solver and its licences, which no browser shows.
fn scripts(live: &Live) -> Result<String, serde_json::Error> {
    let model = script_safe(&serde_json::to_string(live)?);
    let solver = packed(&live.solver, Effort::Small);
    let scripts = [
        script("application/json", "live", &model),
        script("text/plain", "licences", LICENCES),
        script("text/plain", "solver", &solver),
    ];
    Ok(scripts.concat())
}

/// A script that is not a program.
fn script(kind: &str, id: &str, text: &str) -> String {
    format!("<script type=\"{kind}\" id=\"{id}\">{text}</script>\n")
}

/// JSON that ends no script, whatever names are in it: a `<` of JSON is always inside a string.
fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::super::format::FORMAT;
    use super::super::second::data;
    use super::*;

    /// A name cannot end the script that it stands in, and reads back as it was.
    #[test]
    fn names_do_no_harm() {
        let name = "</script><script>alert(1)</script><!--";
        let json = script_safe(&serde_json::to_string(name).unwrap());
        assert!(!json.contains('<'), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), name);
        assert_eq!(escaped("<b>&"), "&lt;b&gt;&amp;");
    }

    fn shown(name: &str) -> Shown {
        let json = serde_json::json!({ "format": FORMAT, "scene": { "name": name }, "instants": 3 }).to_string();
        Shown { name: name.to_owned(), instants: 3, json }
    }

    /// A page reads back as the run that it was made of, whatever its name is; of two runs the first one.
    #[test]
    fn a_page_has_its_run() {
        let run = shown("</script><b>");
        let second = Second { names: ["a".to_owned(), "</script>".to_owned()], run: shown("other") };
        let page = html(&run, Some(&second), None).unwrap();
        let found = Shown::of_page(&page).unwrap();
        assert_eq!((found.name.as_str(), found.instants), ("</script><b>", 3));
        assert_eq!(html(&found, Some(&second), None).unwrap(), page);
    }

    /// Other files are refused, and so are pages of another format.
    #[test]
    fn other_files_are_refused() {
        let page = html(&shown("a"), None, None).unwrap();
        assert!(Shown::of_page(&page).is_some());
        let format = format!("\"format\":{FORMAT}");
        let next = format!("\"format\":{}", FORMAT + 1);
        for text in [String::new(), "<!DOCTYPE html>".to_owned(), page.replace(&format, &next), page.replace("{\"", "")]
        {
            assert!(Shown::of_page(&text).is_none(), "{}", &text[..text.len().min(80)]);
        }
    }

    /// The place of the data is that of the template.
    #[test]
    fn the_data_are_found() {
        assert_eq!(data(TEMPLATE), Some("@@data@@"));
    }

    /// The program itself must not end its script either, nor load anything.
    #[test]
    fn the_program_stays_in_its_script() {
        let lower = PROGRAM.to_lowercase();
        for word in ["</script", "<!--"] {
            assert!(!lower.contains(word), "{word}");
        }
        assert!(!STYLE.to_lowercase().contains("</style"));
        for word in ["</script", "<!--"] {
            assert!(!LICENCES.to_lowercase().contains(word), "{word}");
        }
    }
}
