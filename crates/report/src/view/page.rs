//! The page: one HTML file with the program of viewer/ and the data in it; nothing is loaded from anywhere.

use super::format::Data;

/// The program, as viewer/build.mjs makes it.
const PROGRAM: &str = include_str!("../../../../viewer/dist/viewer.js");
const STYLE: &str = include_str!("../../../../viewer/dist/viewer.css");

/// The page with `@@names@@` for what goes into it. Its policy lets a browser load nothing but what is written in the page.
const TEMPLATE: &str = include_str!("page.html");
const MARK: &str = "@@";

/// The whole file.
pub fn html(title: &str, data: &Data) -> Result<String, serde_json::Error> {
    let title = escaped(title);
    let data = script_safe(&serde_json::to_string(data)?);
    // Every second piece is a name; what is put in is not looked at again.
    let pieces = TEMPLATE.split(MARK).map(|piece| match piece {
        "title" => &title,
        "style" => STYLE,
        "data" => &data,
        "program" => PROGRAM,
        text => text,
    });
    Ok(pieces.collect())
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

    /// The program itself must not end its script either, nor load anything.
    #[test]
    fn the_program_stays_in_its_script() {
        let lower = PROGRAM.to_lowercase();
        for word in ["</script", "<!--"] {
            assert!(!lower.contains(word), "{word}");
        }
        assert!(!STYLE.to_lowercase().contains("</style"));
    }
}
