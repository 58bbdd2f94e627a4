//! The report as a page: one file with all in it, which asks no network for anything.

use std::fmt::Write;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use chamfer::Reason;

use crate::report::{BINS, Counts, FileReport, Report, histogram, mean_narrowed_width, mean_width};

/// What the page looks like, and how it sorts.
const STYLE: &str = include_str!("html/style.css");
const SCRIPT: &str = include_str!("html/sort.js");

/// Forbids all that is not in the file itself.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// Models of less than this share of their width are marked.
const NARROW: f32 = 0.75;

/// A model before and after, as PNGs.
pub type Pictures = Option<[Vec<u8>; 2]>;

/// The page of a report that goes to `place`. `pictures`: `#files`.
pub fn page(report: &Report, pictures: &[Pictures], place: &Path) -> String {
    let mut rows: Vec<Row> = report.files.iter().zip(pictures).map(Row::new).collect();
    rows.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    let body: String = rows.iter().map(|row| row.html(place)).collect();
    let title = format!("Chamfer: {} models", report.totals.files);
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style></head><body>\n\
         <h1>{title}</h1>\n{}<table id=\"models\"><thead><tr>{}</tr></thead><tbody>\n{body}\
         </tbody></table>\n<script>\n{SCRIPT}</script></body></html>\n",
        summary(report),
        COLUMNS.map(|name| format!("<th><button>{name}</button></th>")).concat(),
    )
}

const COLUMNS: [&str; 9] = [
    "model",
    "before",
    "after",
    "hard edges",
    "full",
    "narrowed",
    "skipped",
    "mean width",
    "triangles",
];

/// What there is to say of all models together.
fn summary(report: &Report) -> String {
    let totals = &report.totals;
    let options = &report.options;
    let unit = match options.width_unit {
        "percent" => "%",
        "scene" | "mesh" => "units",
        measure => measure,
    };
    let interrupted =
        if report.interrupted { "<p class=\"failed\">The run was interrupted.</p>\n" } else { "" };
    let notes: String =
        report.notes.iter().map(|note| format!("<p class=\"note\">{}</p>\n", text(note))).collect();
    format!(
        "{interrupted}{notes}<p>{} files, {} failed; width {} {unit}, verified: {}; version {}; \
         {:.1} s of work.</p>\n<div class=\"figures\"><section><h2>What became of {} hard edges</h2>\
         {}</section><section><h2>Widths of chamfers, in shares of the width asked for</h2>{}\
         </section></div>\n",
        totals.files,
        totals.failed,
        options.width,
        options.verify,
        text(report.chamfer),
        totals.milliseconds / 1000.0,
        totals.counts.hard_edges,
        coverage(&totals.counts),
        chart(&histogram(report.files.iter().flat_map(|file| &file.meshes))),
    )
}

/// A bar of all outcomes, with the reasons of what was skipped below.
fn coverage(counts: &Counts) -> String {
    let all = counts.hard_edges.max(1) as f64;
    let part = |class: &str, name: &str, count: u64| match count {
        0 => String::new(),
        _ => {
            let share = count as f64 / all * 100.0;
            format!(
                "<tr><td>{name}</td><td>{count}</td><td>{share:.1} %</td>\
                 <td><i class=\"{class}\" style=\"width:{share:.1}%\"></i></td></tr>"
            )
        }
    };
    let skipped = Reason::ALL.iter().zip(counts.skipped.0);
    let skipped: String =
        skipped.map(|(reason, count)| part("skipped", reason.name(), count)).collect();
    format!(
        "<table class=\"coverage\">{}{}{skipped}</table>",
        part("full", "full", counts.full),
        part("narrowed", "narrowed", counts.narrowed),
    )
}

/// How many chamfers there are of each tenth of the width.
fn chart(bins: &[u64; BINS]) -> String {
    const HEIGHT: f64 = 100.0;
    let most = bins.iter().copied().max().unwrap_or(0).max(1) as f64;
    let mut svg = String::from("<svg viewBox=\"0 0 300 130\" role=\"img\">");
    for (number, &count) in bins.iter().enumerate() {
        let (x, height) = (number as f64 * 300.0 / BINS as f64, count as f64 / most * HEIGHT);
        let (y, from) = (HEIGHT - height + 10.0, number as f64 / BINS as f64);
        let to = from + 1.0 / BINS as f64;
        let _ = write!(
            svg,
            "<rect x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{height:.1}\"><title>{from:.1} \
             to {to:.1}: {count}</title></rect><text x=\"{:.1}\" y=\"124\">{to:.1}</text>",
            x + 1.0,
            300.0 / BINS as f64 - 2.0,
            x + 150.0 / BINS as f64,
        );
    }
    svg + "</svg>"
}

/// A model of the table.
struct Row<'a> {
    file: &'a FileReport,
    pictures: &'a Pictures,
    counts: Counts,
    mean: f32,
    /// Refused models are on top, then those that were narrowed most; what has no edges is below.
    rank: f32,
}

impl<'a> Row<'a> {
    fn new((file, pictures): (&'a FileReport, &'a Pictures)) -> Row<'a> {
        let counts = Counts::sum(file.meshes.iter());
        let mean = mean_width(file.meshes.iter());
        let rank = match (&file.error, counts.hard_edges) {
            (Some(_), _) => -1.0,
            (None, 0) => f32::MAX,
            _ => mean,
        };
        Row { file, pictures, counts, mean, rank }
    }

    fn html(&self, place: &Path) -> String {
        let counts = &self.counts;
        let narrowed = match counts.narrowed {
            0 => "0".to_owned(),
            count => match mean_narrowed_width(self.file.meshes.iter()) {
                0.0 => count.to_string(),
                mean => format!("{count} ({mean:.2})"),
            },
        };
        let skipped = match counts.skipped.total() {
            0 => "0".to_owned(),
            count => format!("{count}<br><small>{}</small>", counts.skipped.text()),
        };
        let has_edges = counts.hard_edges > 0;
        let mean = if has_edges { format!("{:.2}", self.mean) } else { "-".to_owned() };
        let class = match self.file.error {
            Some(_) => "failed",
            None if has_edges && self.mean < NARROW => "narrow",
            None => "",
        };
        let cell = |value: f64, html: &str| format!("<td data-value=\"{value}\">{html}</td>");
        let [before, after] = [0, 1].map(|which| self.picture(which));
        let triangles = format!("{} &rarr; {}", counts.triangles_in, counts.triangles_out);
        let cells = [
            cell(counts.hard_edges as f64, &counts.hard_edges.to_string()),
            cell(counts.full as f64, &counts.full.to_string()),
            cell(counts.narrowed as f64, &narrowed),
            cell(counts.skipped.total() as f64, &skipped),
            cell(f64::from(self.rank), &mean),
            cell(counts.triangles_out as f64, &triangles),
        ];
        format!(
            "<tr class=\"{class}\">{}<td>{before}</td><td>{after}</td>{}</tr>\n",
            self.name(place),
            cells.concat()
        )
    }

    fn name(&self, place: &Path) -> String {
        let file = self.file;
        let name = text(&file.file);
        let mut html = format!("<td data-value=\"{name}\">{}", link(&file.file, place, &name));
        match &file.error {
            Some(error) => {
                let _ = write!(html, "<p class=\"failed\">{}</p>", text(error));
            }
            None => {
                let output = text(&file.output);
                let _ = write!(html, "<br>&rarr; {}", link(&file.output, place, &output));
                let _ = write!(html, "<br><small>{:.1} ms</small>", file.milliseconds);
            }
        }
        for note in &file.notes {
            let _ = write!(html, "<p class=\"note\">{}</p>", text(note));
        }
        html + "</td>"
    }

    fn picture(&self, which: usize) -> String {
        let Some(pictures) = self.pictures else { return String::new() };
        let data = STANDARD.encode(&pictures[which]);
        let when = ["before", "after"][which];
        format!("<img alt=\"{when}\" src=\"data:image/png;base64,{data}\">")
    }
}

/// A link to a file from the page at `place`.
fn link(file: &str, place: &Path, shown: &str) -> String {
    format!("<a href=\"{}\">{shown}</a>", text(&address(Path::new(file), place)))
}

/// Relative where both are on one drive, so that the folder can be moved as a whole.
fn address(file: &Path, place: &Path) -> String {
    let full = |path: &Path| {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        path.components().filter(|part| *part != Component::CurDir).collect::<PathBuf>()
    };
    let (file, folder) = (full(file), full(place));
    let folder = folder.parent().unwrap_or(Path::new("")).to_owned();
    let same = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().count() - same;
    let names = file.components().skip(same).map(|part| part.as_os_str().to_string_lossy());
    let parts: Vec<String> =
        std::iter::repeat_n("..".to_owned(), up).chain(names.map(|name| escaped(&name))).collect();
    parts.join("/")
}

/// A name as a part of a URL's path.
fn escaped(name: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.~".contains(&byte);
    let mut told = String::new();
    for byte in name.bytes() {
        match is_plain(byte) {
            true => told.push(char::from(byte)),
            false => {
                let _ = write!(told, "%{byte:02X}");
            }
        }
    }
    told
}

/// Text as HTML says it; names in files may hold anything.
fn text(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            _ if character.is_control() => html.push('\u{fffd}'),
            _ => html.push(character),
        }
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_from_the_page_to_the_files() {
        let address = |file: &str, place: &str| address(Path::new(file), Path::new(place));
        assert_eq!(address("in/a b.glb", "report.html"), "in/a%20b.glb");
        assert_eq!(address("in/a.glb", "out/deep/report.html"), "../../in/a.glb");
        assert_eq!(address("out/\u{e9}#.glb", "./out/report.html"), "%C3%A9%23.glb");
    }

    #[test]
    fn names_cannot_write_html() {
        assert_eq!(text("<b a=\"'&\u{1b}"), "&lt;b a=&quot;&#39;&amp;\u{fffd}");
    }
}
