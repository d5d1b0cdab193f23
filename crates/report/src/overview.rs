//! The page of a run: one HTML file with the drawing, all charts, a table of extremes, warnings and links to the other
//! files.

use crate::draw::escaped;
use crate::extremes::{Extremes, Peak, chosen};
use crate::numbers::{significant, trimmed};
use crate::summary::Summary;
use std::fmt::Write;

/// What is on the page.
#[derive(Debug)]
pub struct Overview<'a> {
    /// The facts.
    pub summary: &'a Summary,
    /// What the rows of results are at.
    pub row_heading: &'a str,
    /// Why the run ended early.
    pub errors: &'a [String],
    /// What should be known of the results.
    pub warnings: &'a [String],
    /// Drawings of the mechanism, with the names of their views.
    pub drawings: &'a [(&'a str, String)],
    /// Pictures in the folder, with their names.
    pub pictures: &'a [(String, String)],
    /// Other files in the folder.
    pub files: &'a [&'a str],
}

/// An error below this share of the range is told as that.
const LEAST_TOLD: f64 = 1e-6;
const STYLE: &str = include_str!("overview.css");
/// Lines of the first table, and of the table of all columns.
const LINES: usize = 40;
const MOST: usize = 2_000;
/// Links to charts that are shown without a click.
const LINKS: usize = 60;
/// Digits of the numbers in them.
const DIGITS: usize = 5;
/// Bytes of pictures that are in the page itself; a browser loads the others from their files.
const INLINE: usize = 12_000_000;

impl Overview<'_> {
    /// The text of the page.
    pub fn html(&self) -> String {
        let name = escaped(&self.summary.model);
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{name}{}</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n<main>\n",
            if self.summary.complete { "" } else { " (incomplete)" },
            self.tabs(),
        );
        // Writing into a String cannot fail.
        let _ = self.body(&mut page, &name);
        page.push_str("</main>\n</body>\n</html>\n");
        page
    }

    /// The rules that show the drawing that is chosen.
    fn tabs(&self) -> String {
        let rule = |number: usize| format!("#view{number}:checked ~ #drawing{number} {{ display: block; }}\n");
        (0..self.drawings.len()).map(rule).collect()
    }

    fn body(&self, page: &mut String, name: &str) -> std::fmt::Result {
        let Summary { description, reached, .. } = self.summary;
        writeln!(page, "<h1>{name}</h1>")?;
        if !description.is_empty() {
            writeln!(page, "<p class=\"quiet\">{}</p>", escaped(description))?;
        }
        writeln!(page, "<ul class=\"files\">")?;
        for file in self.files {
            writeln!(page, "<li><a href=\"{file}\">{file}</a></li>")?;
        }
        writeln!(page, "</ul>")?;
        self.facts(page)?;
        if !self.summary.complete {
            writeln!(
                page,
                "<p class=\"note bad\">The run ended early, at t = {reached} s: these results are incomplete.</p>"
            )?;
        }
        for error in self.errors {
            writeln!(page, "<p class=\"note bad\">{}</p>", lines(error))?;
        }
        for warning in self.warnings {
            writeln!(page, "<p class=\"note\">{}</p>", escaped(warning))?;
        }
        self.mechanism(page)?;
        self.extremes(page)?;
        self.charts(page)?;
        writeln!(page, "<footer>{}, model {}</footer>", self.summary.program, self.summary.guid)
    }

    fn facts(&self, page: &mut String) -> std::fmt::Result {
        let Summary {
            reached,
            rows,
            steps,
            iterations,
            rejected,
            wall_time,
            step_limits,
            time_step_errors,
            mesh_errors,
            accuracy,
            settings,
            ..
        } = self.summary;
        let limits = step_limits.as_ref().map_or_else(String::new, |limits| format!("; {limits}"));
        let mut facts = vec![
            ("simulated time", format!("{reached} s"), format!("{rows} rows")),
            ("steps", steps.to_string(), format!("{rejected} rejected, {iterations} Newton iterations{limits}")),
            ("wall time", format!("{} s", significant(*wall_time, 3)), String::new()),
        ];
        let errors = [("time-step error", time_step_errors), ("mesh error", mesh_errors)];
        facts.extend(errors.into_iter().filter_map(|(word, errors)| {
            let worst = errors.first()?;
            let remark = format!("of the range of {}, the least accurate result", worst.quantity);
            // Of a model at rest it is round-off.
            let size = if worst.of_range < LEAST_TOLD {
                format!("less than {} %", significant(100.0 * LEAST_TOLD, 2))
            } else {
                format!("{} %", significant(100.0 * worst.of_range, 2))
            };
            Some((word, size, remark))
        }));
        facts.extend(accuracy.as_ref().and_then(|own| {
            let worst = own.worst.as_ref()?;
            let plural = if own.runs == 1 { "" } else { "s" };
            let remark = format!(
                "{} run{plural}, {} elements; {} is the least accurate result",
                own.runs, own.elements, worst.quantity
            );
            Some(("accuracy reached", format!("{} %", significant(100.0 * worst.of_range, 2)), remark))
        }));
        facts.extend(settings.iter().map(|(key, value)| ("--set", format!("{key} = {value}"), String::new())));
        writeln!(page, "<dl class=\"facts\">")?;
        for (name, value, remark) in facts {
            let remark = if remark.is_empty() { remark } else { format!("<small>{}</small>", escaped(&remark)) };
            writeln!(page, "<div><dt>{name}</dt><dd>{}{remark}</dd></div>", escaped(&value))?;
        }
        writeln!(page, "</dl>")
    }

    /// The drawings, one at a time.
    fn mechanism(&self, page: &mut String) -> std::fmt::Result {
        if self.drawings.is_empty() {
            return Ok(());
        }
        writeln!(page, "<h2>Mechanism</h2>\n<div class=\"views\">")?;
        for (number, (view, _)) in self.drawings.iter().enumerate() {
            let checked = if number == 0 { " checked" } else { "" };
            writeln!(
                page,
                "<input type=\"radio\" name=\"view\" id=\"view{number}\"{checked}><label for=\"view{number}\">{view}</label>"
            )?;
        }
        for (number, (_, svg)) in self.drawings.iter().enumerate() {
            writeln!(page, "<figure id=\"drawing{number}\">\n{svg}</figure>")?;
        }
        writeln!(page, "</div>")
    }

    /// The extremes of the outputs that tell most, and behind a click those of all columns.
    fn extremes(&self, page: &mut String) -> std::fmt::Result {
        let columns = &self.summary.columns;
        let places = chosen(columns, LINES);
        if !places.is_empty() {
            writeln!(page, "<h2>Extremes</h2>")?;
            table(page, self.row_heading, places.iter().map(|place| &columns[*place]))?;
        }
        if places.len() < columns.len() {
            let remark = if columns.len() > MOST { format!(", the first {MOST}") } else { String::new() };
            writeln!(page, "<details><summary>All {} columns{remark}</summary>", columns.len())?;
            table(page, self.row_heading, columns.iter().take(MOST))?;
            writeln!(page, "</details>")?;
        }
        Ok(())
    }

    fn charts(&self, page: &mut String) -> std::fmt::Result {
        if self.pictures.is_empty() {
            return Ok(());
        }
        let is_long = self.pictures.len() > LINKS;
        let (open, close) = match is_long {
            true => {
                (format!("<details><summary>List of the {} charts</summary>\n", self.pictures.len()), "</details>\n")
            }
            false => (String::new(), ""),
        };
        writeln!(page, "<h2>Charts</h2>\n{open}<nav>")?;
        let title = |file: &str| escaped(file.trim_end_matches(".svg"));
        for (file, _) in self.pictures {
            writeln!(page, "<a href=\"#{0}\">{0}</a>", title(file))?;
        }
        writeln!(page, "</nav>\n{close}<div class=\"charts\">")?;
        let mut bytes = 0;
        for (file, svg) in self.pictures {
            bytes += svg.len();
            let picture = match bytes <= INLINE {
                true => svg.clone(),
                false => format!("<img src=\"{file}\" alt=\"{0}\" loading=\"lazy\">\n", title(file)),
            };
            writeln!(
                page,
                "<figure id=\"{}\">\n{picture}<figcaption><a href=\"{file}\">{file}</a></figcaption></figure>",
                title(file)
            )?;
        }
        writeln!(page, "</div>")
    }
}

/// A table of extremes, `at` their rows.
fn table<'a>(page: &mut String, at: &str, columns: impl Iterator<Item = &'a Extremes>) -> std::fmt::Result {
    writeln!(
        page,
        "<div class=\"scroll\"><table>\n<thead><tr><th>output</th><td></td><th>minimum</th><th>{at}</th><th>maximum</th>\
         <th>{at}</th><th>at the end</th></tr></thead>\n<tbody>"
    )?;
    for Extremes { name, unit, minimum, maximum, last, .. } in columns {
        let [low, high] = [minimum, maximum].map(|peak| {
            let time = peak.map_or_else(String::new, |Peak { time, .. }| trimmed(time, DIGITS));
            format!("<td>{}</td><td class=\"time\">{time}</td>", number(peak.map(|Peak { value, .. }| value)))
        });
        let (name, unit) = (escaped(name), escaped(unit));
        writeln!(page, "<tr><th>{name}</th><td>{unit}</td>{low}{high}<td>{}</td></tr>", number(*last))?;
    }
    writeln!(page, "</tbody>\n</table></div>")
}

/// A number for people, with the sign of its own length.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| {
        significant(value, DIGITS).replace('-', "\u{2212}").replace("e\u{2212}", "e-")
    })
}

/// A text of several lines.
fn lines(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(complete: bool) -> Summary {
        Summary {
            program: String::from("ancf14 0"),
            model: String::from("a < b"),
            description: String::new(),
            guid: String::from("{1}"),
            settings: [(String::from("arm.elements"), String::from("3"))].into(),
            complete,
            stop: 1.0,
            reached: 0.5,
            rows: 2,
            steps: 10,
            iterations: 20,
            rejected: 0,
            wall_time: 0.125,
            step_limits: None,
            time_step_errors: Vec::new(),
            mesh_errors: Vec::new(),
            accuracy: None,
            columns: vec![Extremes {
                name: String::from("tip.position[3]"),
                unit: String::from("m"),
                minimum: Some(Peak { value: -0.25, time: 0.5 }),
                maximum: Some(Peak { value: 0.0, time: 0.0 }),
                last: Some(-0.25),
                beyond_rows: 0.0,
            }],
        }
    }

    /// Of very many charts the list is behind a click, and those beyond the bound of the page stay in their files.
    #[test]
    fn many_charts_keep_the_page_small() {
        let svg = format!("<svg>{}</svg>\n", " ".repeat(INLINE / 100));
        let pictures: Vec<(String, String)> = (0..120).map(|k| (format!("a{k}.b.svg"), svg.clone())).collect();
        let summary = summary(true);
        let of = |pictures: &[(String, String)]| {
            Overview {
                summary: &summary,
                row_heading: "at t (s)",
                errors: &[],
                warnings: &[],
                drawings: &[],
                pictures,
                files: &[],
            }
            .html()
        };
        let page = of(&pictures);
        assert!(page.len() < INLINE + 100_000 && page.contains("List of the 120 charts"), "{}", page.len());
        assert!(!page.contains("<img src=\"a98.b.svg\"") && page.contains("<img src=\"a119.b.svg\""));
        assert!(!of(&pictures[..10]).contains("List of the"));
    }

    /// Names and messages of the user are text, not markup; what went wrong is said; nothing is loaded from elsewhere.
    #[test]
    fn the_page_says_what_happened() {
        let svg = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>\n");
        let (errors, warnings) = ([String::from("no <solution>\nhere")], [String::from("x < y")]);
        let pictures = [(String::from("tip.position.svg"), svg.clone())];
        let drawings = [("oblique", svg)];
        let summaries = [summary(false), summary(true)];
        let [page, complete] = summaries.each_ref().map(|summary| {
            let errors: &[String] = if summary.complete { &[] } else { &errors };
            let (pictures, drawings, files) = (&pictures, &drawings, &["results.csv"]);
            Overview { summary, row_heading: "at t (s)", errors, warnings: &warnings, drawings, pictures, files }.html()
        });
        for words in [
            "a &lt; b (incomplete)",
            "no &lt;solution&gt;\nhere",
            "x &lt; y",
            "t = 0.5 s",
            "arm.elements = 3",
            "\u{2212}0.25000",
        ] {
            assert!(page.contains(words), "{words} is not in {page}");
        }
        assert!(page.contains("href=\"results.csv\"") && page.contains("id=\"tip.position\"") && page.contains("<svg"));
        assert!(!complete.contains("incomplete") && !complete.contains("note bad\""), "{complete}");
        let addresses = page.matches("http").count();
        assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    }
}
