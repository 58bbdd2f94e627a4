//! The report for the terminal: a row for each mesh, and below what is wrong.

use super::report::{CheckReport, Counts, MeshCheck, Place, SeeThrough, Widths};

const HEADINGS: [&str; 14] = [
    "mesh",
    "closed",
    "borders",
    "non-manifold",
    "flipped",
    "no area",
    "cuts",
    "normals",
    "tangents",
    "hard edges",
    "chamfers",
    "min",
    "mean",
    "max",
];

type Row = [String; HEADINGS.len()];

/// What was found, without a line end. Where before and after differ, both are in the table.
pub fn table(report: &CheckReport) -> String {
    let mut rows = vec![HEADINGS.map(str::to_owned)];
    rows.extend(report.meshes.iter().map(|mesh| row(&mesh.name, &mesh.counts)));
    if report.meshes.len() != 1 {
        rows.push(row("total", &report.totals));
    }
    let mut lines = aligned(&rows);
    report.meshes.iter().for_each(|mesh| lines.extend(remarks(mesh)));
    lines.extend(report.missing.iter().map(|name| format!("{name}: missing")));
    lines.extend(report.moved.iter().map(|name| format!("{name}: placed otherwise")));
    let added = report.added.iter();
    lines.extend(added.map(|name| format!("{name}: not checked: there was none before")));
    lines.extend(light(&report.see_through));
    lines.push(report.verdict.name().into());
    lines.join("\n")
}

/// How many places where light shows are named.
const NAMED_PLACES: usize = 6;

fn light(found: &SeeThrough) -> Vec<String> {
    if let Some(reason) = found.not_checked {
        return vec![format!("not fully checked: see-through: {reason}")];
    }
    let place = |place: &Place| light_at(place, found.width);
    let mut lines: Vec<String> = found.places.iter().take(NAMED_PLACES).map(place).collect();
    match found.places.len().saturating_sub(NAMED_PLACES) {
        0 => {}
        1 => lines.push("light shows at 1 more place".into()),
        more => lines.push(format!("light shows at {more} more places")),
    }
    lines
}

fn light_at(place: &Place, width: Option<f32>) -> String {
    let vector = |values: [f32; 3], digit: fn(f32) -> String| {
        let [x, y, z] = values.map(digit);
        format!("({x}, {y}, {z})")
    };
    let at = vector(place.at, |value| length(Some(value)));
    let from = vector(place.toward_eye, |value| format!("{value:.2}"));
    let behind = match (place.deeper, width) {
        (Some(deeper), Some(width)) => format!("{:.0} widths deeper", deeper / width),
        _ => "nothing behind".into(),
    };
    let samples = place.samples;
    format!("light shows at {at}, seen from {from}: {samples} samples, {behind}")
}

fn row(name: &str, counts: &Counts) -> Row {
    let (before, after) = (&counts.before, &counts.after);
    let Widths { count, min, mean, max, .. } = counts.chamfers;
    let yes = |closed: bool| String::from(if closed { "yes" } else { "no" });
    let cuts = |cuts: Option<usize>| cuts.map_or("-".into(), |cuts| cuts.to_string());
    [
        name.into(),
        change(yes(before.closed), yes(after.closed)),
        change(before.border_loops, after.border_loops),
        change(before.non_manifold_edges, after.non_manifold_edges),
        counts.flipped.to_string(),
        change(before.without_area, after.without_area),
        change(cuts(before.self_intersections), cuts(after.self_intersections)),
        change(before.odd_normals, after.odd_normals),
        change(before.odd_tangents, after.odd_tangents),
        change(before.hard_edges, after.hard_edges),
        count.to_string(),
        length(min),
        length(mean),
        length(max),
    ]
}

fn change<T: PartialEq + ToString>(before: T, after: T) -> String {
    if before == after {
        return after.to_string();
    }
    format!("{} -> {}", before.to_string(), after.to_string())
}

/// Four digits: enough to compare widths by eye.
fn length(length: Option<f32>) -> String {
    match length {
        None => "-".into(),
        Some(0.0) => "0".into(),
        Some(length) => {
            let digits = 3 - length.abs().log10().floor() as i32;
            format!("{length:.*}", digits.clamp(0, 9) as usize)
        }
    }
}

fn remarks(mesh: &MeshCheck) -> Vec<String> {
    let name = &mesh.name;
    let mut lines = Vec::new();
    if let Some(width) = mesh.counts.chamfers.asked {
        lines.push(format!("{name}: the width asked for is {}", length(Some(width))));
    }
    for defect in &mesh.defects {
        let more = if defect.count > defect.first.len() { ", ..." } else { "" };
        let first = defect.first.join(", ");
        lines.push(format!("{name}: {}: {} ({first}{more})", defect.rule, defect.count));
    }
    if mesh.nearly_touching > 0 {
        lines.push(format!(
            "{name}: note: {} vertices of the source nearly touch others; if it was chamfered with \
             --weld, check it with the same",
            mesh.nearly_touching
        ));
    }
    if mesh.matched_by == "geometry" {
        let lost = mesh.not_found;
        lines.push(format!(
            "{name}: note: the order of triangles has changed; {lost} of the source's not found"
        ));
    }
    let unchecked = mesh.unchecked.iter();
    lines.extend(
        unchecked.map(|rule| format!("{name}: not fully checked: {}: {}", rule.rule, rule.reason)),
    );
    lines
}

/// Columns as wide as their widest cell, names to the left and figures to the right.
fn aligned(rows: &[Row]) -> Vec<String> {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<usize> = (0..HEADINGS.len()).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &Row| {
        let figures = row.iter().zip(&widths).skip(1);
        let figures = figures.map(|(cell, &width)| format!("  {cell:>width$}"));
        format!("{:<first$}{}", row[0], figures.collect::<String>(), first = widths[0])
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chamfer::see_through::Leak;

    #[test]
    fn lengths_have_four_digits() {
        let texts = [1.0, 0.012_345_6, 123.46, 54_321.0, 0.0].map(|width| length(Some(width)));
        assert_eq!(texts, ["1.000", "0.01235", "123.5", "54321", "0"]);
    }

    #[test]
    fn the_worst_places_are_named_and_the_rest_counted() {
        let leak = |depth| Leak::new([0.0, 0.0, 1.0], vec![[0.5, 1.0, -2.0]; 3], depth);
        let found = |count: usize| {
            let places = [f32::INFINITY, 0.6].into_iter().cycle().take(count);
            let places = places.map(|depth| Place::new(leak(depth))).collect();
            light(&SeeThrough { width: Some(0.05), places, ..SeeThrough::default() })
        };
        let at = "light shows at (0.5000, 1.000, -2.000), seen from (0.00, 0.00, 1.00): 3 samples";
        let two = [format!("{at}, nothing behind"), format!("{at}, 12 widths deeper")];
        assert_eq!(found(2), two);
        assert_eq!(found(7)[6..], ["light shows at 1 more place"]);
        assert_eq!(found(9)[6..], ["light shows at 3 more places"]);
    }

    #[test]
    fn columns_are_aligned() {
        let mut row: Row = Default::default();
        row[0] = "cube".into();
        row[1] = "yes -> no".into();
        let lines = aligned(&[HEADINGS.map(str::to_owned), row]);
        assert!(lines[0].starts_with("mesh     closed  borders"), "{}", lines[0]);
        assert!(lines[1].starts_with("cube  yes -> no  "), "{}", lines[1]);
    }
}
