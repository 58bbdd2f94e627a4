//! A small SVG writer: shapes in the order in which they are drawn, numbers to one decimal, so
//! that the bytes are the same on every machine.

use std::fmt::Write;

use glam::DVec2;

/// Behind everything: the figures are read on light and on dark pages.
pub const PAPER: &str = "#f7f5f0";
pub const INK: &str = "#33373d";
pub const FAINT: &str = "#a9a69d";
pub const RED: &str = "#c5392b";
pub const BLUE: &str = "#2f6fb0";
pub const ORANGE: &str = "#d9822b";
pub const GREEN: &str = "#3c8d5a";
pub const PURPLE: &str = "#7d4fa0";
pub const TEAL: &str = "#2f9a9a";

/// Told apart by most eyes, for what has no meaning but being different.
pub const PALETTE: [&str; 8] = [BLUE, ORANGE, GREEN, PURPLE, TEAL, RED, "#8c6d31", "#5b6270"];

const ARROW_HEAD: f64 = 6.0;

/// How a line is drawn.
#[derive(Clone, Copy)]
pub struct Pen {
    pub color: &'static str,
    pub width: f64,
    pub is_dashed: bool,
}

impl Pen {
    pub const fn new(color: &'static str, width: f64) -> Pen {
        Pen { color, width, is_dashed: false }
    }

    pub const fn dashed(color: &'static str, width: f64) -> Pen {
        Pen { color, width, is_dashed: true }
    }
}

/// Where a text stands beside its point.
#[derive(Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
}

/// A picture under construction.
pub struct Drawing {
    size: [u32; 2],
    body: String,
}

impl Drawing {
    pub fn new(width: u32, height: u32) -> Drawing {
        Drawing { size: [width, height], body: String::new() }
    }

    pub fn polygon(&mut self, points: &[DVec2], fill: &str) {
        let path = points.iter().map(|&point| pair(point)).collect::<Vec<_>>().join(" ");
        // A thin outline of the same colour hides the hairlines between neighbours.
        self.add(format_args!(
            "<polygon points=\"{path}\" fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\"0.5\"/>"
        ));
    }

    pub fn line(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        let dashes = if pen.is_dashed { " stroke-dasharray=\"4 3\"" } else { "" };
        let ([x1, y1], [x2, y2]) = (coordinates(from), coordinates(to));
        let (color, width) = (pen.color, number(pen.width));
        self.add(format_args!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" stroke=\"{color}\" \
             stroke-width=\"{width}\" stroke-linecap=\"round\"{dashes}/>"
        ));
    }

    pub fn arrow(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        let length = from.distance(to);
        if length == 0.0 {
            return;
        }
        let ahead = (to - from) / length;
        let head = ARROW_HEAD.min(length * 0.6);
        let back = to - ahead * head;
        self.line(from, back, pen);
        let aside = ahead.perp() * head * 0.45;
        self.polygon(&[to, back + aside, back - aside], pen.color);
    }

    pub fn dot(&mut self, at: DVec2, radius: f64, fill: &str) {
        let ([x, y], radius) = (coordinates(at), number(radius));
        self.add(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{PAPER}\"/>"
        ));
    }

    pub fn text(&mut self, at: DVec2, anchor: Anchor, color: &str, text: &str) {
        self.write_text(at, anchor, &format!("fill=\"{color}\""), text);
    }

    /// Text in the middle, with a rim of paper around, to be read on top of lines.
    pub fn label(&mut self, at: DVec2, color: &str, text: &str) {
        let at = at + DVec2::new(0.0, 4.0);
        let rim = format!("stroke=\"{PAPER}\" stroke-width=\"3\" stroke-linejoin=\"round\"");
        self.write_text(at, Anchor::Middle, &rim, text);
        self.text(at, Anchor::Middle, color, text);
    }

    /// Text in columns, for values of arrays.
    pub fn code(&mut self, at: DVec2, text: &str) {
        let look = format!("fill=\"{INK}\" font-family=\"monospace\" xml:space=\"preserve\"");
        self.write_text(at, Anchor::Start, &look, text);
    }

    /// The heading of a part of the figure.
    pub fn title(&mut self, x: f64, text: &str) {
        let look = format!("fill=\"{INK}\" font-weight=\"bold\"");
        self.write_text(DVec2::new(x, 24.0), Anchor::Middle, &look, text);
    }

    /// A row of colours and what they mean, along the lower edge.
    pub fn legend(&mut self, entries: &[(&str, &str)]) {
        let width = |text: &str| 34.0 + 6.6 * text.chars().count() as f64;
        let total: f64 = entries.iter().map(|(_, text)| width(text)).sum();
        let mut at =
            DVec2::new((f64::from(self.size[0]) - total) / 2.0, f64::from(self.size[1]) - 18.0);
        for (color, text) in entries {
            self.dot(at, 5.0, color);
            self.text(at + DVec2::new(10.0, 4.0), Anchor::Start, INK, text);
            at.x += width(text);
        }
    }

    /// The whole file.
    pub fn finish(self) -> String {
        let [width, height] = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"{PAPER}\"/>\n{}</svg>\n",
            self.body
        )
    }

    fn write_text(&mut self, at: DVec2, anchor: Anchor, look: &str, text: &str) {
        let [x, y] = coordinates(at);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
        };
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        self.add(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" {look}>{text}</text>"
        ));
    }

    fn add(&mut self, element: std::fmt::Arguments) {
        writeln!(self.body, "{element}").unwrap();
    }
}

/// A colour between two others.
pub fn mixed(from: [f64; 3], to: [f64; 3], share: f64) -> String {
    let [r, g, b] = [0, 1, 2].map(|k| (from[k] + (to[k] - from[k]) * share).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// One decimal where it is not zero, and one zero only.
fn number(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let text = format!("{}{}", if tenths < 0 { "-" } else { "" }, tenths.abs() / 10);
    if tenths % 10 == 0 { text } else { format!("{text}.{}", tenths.abs() % 10) }
}

fn coordinates(point: DVec2) -> [String; 2] {
    [number(point.x), number(point.y)]
}

fn pair(point: DVec2) -> String {
    coordinates(point).join(",")
}
