//! Files of options: what the command line takes, under the names that scripts have for it.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser};
use toml::{Table, Value};

use crate::args::Args;
use crate::choices::Choices;
use crate::report::Asked;

/// The keys of a file, each with the flag that it stands for. `docs/options.md` tells of them.
const KEYS: [(&str, &str); 20] = [
    ("width", "width"),
    ("width_unit", "width"),
    ("per_mesh", "per-mesh"),
    ("width_mode", "width-mode"),
    ("material_width", "material-width"),
    ("mask", "mask"),
    ("min_angle", "min-angle"),
    ("max_angle", "max-angle"),
    ("convexity", "convexity"),
    ("hard_angle", "hard-angle"),
    ("segments", "segments"),
    ("profile", "profile"),
    ("least_breadth", "least-breadth"),
    ("evenness", "evenness"),
    ("verify", "verify"),
    ("submesh", "chamfer-submesh"),
    ("normals", "normals"),
    ("smoothing_angle", "smoothing-angle"),
    ("weld", "weld"),
    ("threads", "threads"),
];

/// What a width can count, and what stands behind its number then.
const WIDTH_UNITS: [(&str, &str); 7] = [
    ("percent", "%"),
    ("scene", ""),
    ("mesh", ""),
    ("mm", "mm"),
    ("cm", "cm"),
    ("m", "m"),
    ("in", "in"),
];

/// How alike a word and the one that was meant are, from 0 to 1.
const LEAST_LIKENESS: f64 = 0.7;

/// A flag of the command line, and the word that says it.
struct Flag {
    name: &'static str,
    word: String,
}

/// Reads the command line, and the file of options that it names. What the command line says wins.
///
/// # Errors
/// What is wrong with either.
pub fn parse(words: &[OsString]) -> Result<Args, clap::Error> {
    let matches = Args::command().try_get_matches_from(words)?;
    let args = Args::from_arg_matches(&matches)?;
    let Some(path) = &args.options else { return Ok(args) };
    let refuse = |why: String| {
        let why = format!("{}: {why}\n", path.display());
        Args::command().error(ErrorKind::ValueValidation, why.trim_end())
    };
    let flags = read(path).map_err(|error| refuse(format!("{error:#}")))?;
    alone(&flags).map_err(|error| refuse(first_paragraph(&error)))?;
    let kept = flags.iter().filter(|flag| !is_given(&matches, flag.name));
    let kept = kept.map(|flag| OsString::from(&flag.word));
    let (program, rest) = words.split_at(1.min(words.len()));
    Args::try_parse_from(program.iter().cloned().chain(kept).chain(rest.iter().cloned()))
}

/// What a file asks for by itself.
///
/// # Errors
/// What is wrong with it.
pub fn choices(path: &Path) -> Result<Choices> {
    let name = || path.display().to_string();
    let args = alone(&read(path).with_context(name)?);
    Ok(args.map_err(|error| anyhow!(first_paragraph(&error))).with_context(name)?.choices)
}

/// What flags stand for where nothing else is said.
fn alone(flags: &[Flag]) -> Result<Args, clap::Error> {
    let nothing = [OsString::from("chamfer"), "--print-options".into()];
    let words = flags.iter().map(|flag| OsString::from(&flag.word));
    Args::try_parse_from(nothing.into_iter().chain(words))
}

/// What an error says, without how the command is used.
fn first_paragraph(error: &clap::Error) -> String {
    let text = error.to_string();
    let text = text.trim_start_matches("error: ");
    text.split("\n\n").next().unwrap_or_default().replace("'--print-options'", "'the file'")
}

/// Whether the command line says what a flag says. Widths of other materials are no such thing: of
/// one material, the last counts.
fn is_given(matches: &ArgMatches, flag: &str) -> bool {
    let is = |id: &str| matches.value_source(id) == Some(ValueSource::CommandLine);
    match flag {
        "material-width" => false,
        "width" => is("width") || is("width_percent"),
        _ => is(&flag.replace('-', "_")),
    }
}

fn read(path: &Path) -> Result<Vec<Flag>> {
    let text = fs::read_to_string(path).context("cannot be read")?;
    flags(&text.parse::<Table>().context("is no TOML")?)
}

/// The flags that a file stands for.
fn flags(table: &Table) -> Result<Vec<Flag>> {
    let mut flags = Vec::new();
    for (key, value) in table {
        let known = KEYS.iter().find(|(known, _)| known == key);
        let Some(&(key, name)) = known else {
            bail!("there is no option {key:?}: {}", meant(key, KEYS.iter().map(|(key, _)| *key)));
        };
        match (key, value) {
            ("material_width", Value::Table(widths)) => {
                for (material, width) in widths {
                    let word = format!("--{name}={material}={}", word(material, width)?);
                    flags.push(Flag { name, word });
                }
            }
            ("per_mesh", Value::Boolean(is_set)) => {
                flags.extend(is_set.then(|| Flag { name, word: format!("--{name}") }));
            }
            ("width" | "width_unit", _) => {}
            ("least_breadth" | "evenness", Value::Integer(_) | Value::Float(_)) => {
                let percent = number(value) * 100.0;
                flags.push(Flag { name, word: format!("--{name}={}", percent as f32) });
            }
            _ => flags.push(Flag { name, word: format!("--{name}={}", word(key, value)?) }),
        }
    }
    flags.extend(width(table)?);
    Ok(flags)
}

/// A width, and whether it is that of each mesh.
fn width(table: &Table) -> Result<Vec<Flag>> {
    let unit = match table.get("width_unit") {
        None => "percent".to_owned(),
        Some(unit) => word("width_unit", unit)?,
    };
    let Some((unit, sign)) = WIDTH_UNITS.iter().find(|(known, _)| *known == unit) else {
        let units = WIDTH_UNITS.iter().map(|(unit, _)| *unit);
        bail!("width_unit cannot be {unit:?}: {}", meant(&unit, units));
    };
    let mut flags = Vec::new();
    match table.get("width") {
        None => {}
        // One with its unit.
        Some(Value::String(width)) => flags.push(format!("--width={width}")),
        Some(width) => flags.push(format!("--width={}{sign}", word("width", width)?)),
    }
    let mut flags: Vec<Flag> = flags.into_iter().map(|word| Flag { name: "width", word }).collect();
    if *unit == "mesh" && table.get("per_mesh") != Some(&Value::Boolean(true)) {
        flags.push(Flag { name: "per-mesh", word: "--per-mesh".into() });
    }
    Ok(flags)
}

fn number(value: &Value) -> f64 {
    value.as_float().or(value.as_integer().map(|whole| whole as f64)).unwrap_or(f64::NAN)
}

/// A value as the command line has it.
fn word(key: &str, value: &Value) -> Result<String> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(whole) => Ok(whole.to_string()),
        Value::Float(number) => Ok(number.to_string()),
        other => bail!("{key} is {other}: give a number or a word"),
    }
}

/// The word that was meant, or all that there are.
fn meant<'a>(given: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    let likeness = |known: &&&str| strsim::jaro_winkler(given, known);
    let likest = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    match likest.filter(|known| likeness(known) >= LEAST_LIKENESS) {
        Some(likest) => format!("did you mean {likest:?}?"),
        None => format!("there are {}", known.join(", ")),
    }
}

/// All options as a file.
pub fn text(choices: &Choices) -> String {
    let Asked { width, width_unit, min_angle, max_angle, hard_angle, smoothing_angle, .. } =
        choices.asked();
    let asked = choices.asked();
    let quoted = |text: &str| Value::from(text).to_string();
    let submesh = match asked.chamfer_submesh.parse::<u32>() {
        Ok(number) => number.to_string(),
        Err(_) => quoted(&asked.chamfer_submesh),
    };
    let lines = [
        ("width", Some(width.to_string())),
        ("width_unit", Some(quoted(width_unit))),
        ("per_mesh", Some(asked.per_mesh.to_string())),
        ("width_mode", Some(quoted(&asked.width_mode))),
        ("mask", asked.mask.as_deref().map(quoted)),
        ("min_angle", Some(min_angle.to_string())),
        ("max_angle", Some(max_angle.to_string())),
        ("convexity", Some(quoted(&asked.convexity))),
        ("hard_angle", Some(hard_angle.to_string())),
        ("segments", Some(asked.segments.to_string())),
        ("profile", Some(asked.profile.to_string())),
        ("least_breadth", Some((asked.least_breadth / 100.0).to_string())),
        ("evenness", Some((asked.evenness / 100.0).to_string())),
        ("verify", Some(quoted(&asked.verify))),
        ("submesh", Some(submesh)),
        ("normals", Some(quoted(&asked.normals))),
        ("smoothing_angle", Some(smoothing_angle.to_string())),
        ("weld", asked.weld.as_deref().map(quoted)),
        ("threads", Some(choices.threads.to_string())),
    ];
    let lines = lines.into_iter().filter_map(|(key, value)| Some(format!("{key} = {}\n", value?)));
    let widths = asked.material_width.iter();
    let widths = widths.map(|(name, width)| format!("{} = {}\n", quoted(name), quoted(width)));
    let widths: String = widths.collect();
    let section = if widths.is_empty() { "" } else { "\n[material_width]\n" };
    lines.collect::<String>() + section + &widths
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn words(text: &str) -> Result<String, String> {
        let table = text.parse::<Table>().unwrap();
        let flags = flags(&table).map_err(|error| format!("{error:#}"))?;
        Ok(flags.into_iter().map(|flag| flag.word).collect::<Vec<_>>().join(" "))
    }

    fn args(line: &str) -> Args {
        Args::try_parse_from(line.split(' ')).unwrap()
    }

    #[test]
    fn keys_stand_for_flags() {
        assert_eq!(
            words("min_angle = 20\nverify = \"fast\"").unwrap(),
            "--min-angle=20 --verify=fast"
        );
        assert_eq!(words("width = 2").unwrap(), "--width=2%");
        assert_eq!(words("width = 5\nwidth_unit = \"mm\"").unwrap(), "--width=5mm");
        assert_eq!(words("width = \"2cm\"").unwrap(), "--width=2cm");
        assert_eq!(words("width = 2\nwidth_unit = \"mesh\"").unwrap(), "--width=2 --per-mesh");
        assert_eq!(
            words("least_breadth = 0.25\nper_mesh = true").unwrap(),
            "--least-breadth=25 --per-mesh"
        );
        let materials = "[material_width]\nMetal = \"1mm\"\n\"a=b\" = 0";
        assert_eq!(words(materials).unwrap(), "--material-width=Metal=1mm --material-width=a=b=0");
    }

    #[test]
    fn what_is_unknown_is_told_with_what_was_meant() {
        assert_eq!(
            words("minangle = 3").unwrap_err(),
            "there is no option \"minangle\": did you mean \"min_angle\"?"
        );
        assert!(words("qqq = 3").unwrap_err().contains("there are width, width_unit"));
        let unit = words("width_unit = \"percents\"").unwrap_err();
        assert_eq!(unit, "width_unit cannot be \"percents\": did you mean \"percent\"?");
        assert_eq!(words("mask = [1]").unwrap_err(), "mask is [1]: give a number or a word");
    }

    /// What is printed, read again, is the same.
    #[test]
    fn what_is_printed_is_what_was_asked_for() {
        let line = "chamfer a.glb --width 5mm --width-mode chord --material-width Metal=1mm \
            --material-width a=b=2% --mask g --min-angle 5.5 --max-angle 170 --convexity convex \
            --hard-angle 2 --least-breadth 7 --verify full --chamfer-submesh 3 --normals angle \
            --smoothing-angle 40 --weld auto --threads 2 --per-mesh";
        for line in ["chamfer a.glb", line, "chamfer a.glb --width 0.1"] {
            let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
            let printed = text(&args(&line).choices);
            let again = args(&format!("chamfer a.glb {}", words(&printed).unwrap()));
            assert_eq!(text(&again.choices), printed);
            assert_eq!(again.choices.wish(1).core, args(&line).choices.wish(1).core);
        }
    }

    const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

    /// What stands between two places of a file.
    fn part(file: &str, from: &str, to: &str) -> String {
        let text = fs::read_to_string(Path::new(ROOT).join(file)).unwrap();
        let (_, rest) = text.split_once(from).unwrap_or_else(|| panic!("{file} has no {from}"));
        rest.split_once(to).map_or(rest, |(part, _)| part).to_owned()
    }

    /// The last word of each line that ends with `end`, but for comments, calls and what is computed.
    fn fields(text: &str, end: &str) -> BTreeSet<String> {
        let lines = text.lines().map(str::trim).filter(|line| !line.starts_with(['*', '/', '[']));
        let lines = lines.filter_map(|line| line.strip_suffix(end));
        let last = |line: &str| line.split(' ').next_back().unwrap_or_default().to_owned();
        let is_field = |line: &&str| !line.contains(['(', '=']);
        lines.filter(is_field).map(|line| last(line.split('[').next().unwrap_or(line))).collect()
    }

    /// The names of Unity's settings in one of its files.
    fn settings(file: &str, name: &str) -> BTreeSet<String> {
        let text = part(
            &format!("unity-package/Runtime/{file}"),
            &format!("struct {name}"),
            "public static",
        );
        let declared = text.lines().filter_map(|line| line.split_once("public ").map(|(_, of)| of));
        fields(&declared.map(|line| line.replace("[]", "") + "\n").collect::<String>(), ";")
    }

    #[test]
    fn the_table_of_options_has_the_names_of_all_ways_in() {
        let table = part("docs/options.md", "|---|---|---|---|---|---|\n", "\n\n");
        let column = |number: usize| -> BTreeSet<String> {
            let cells = table.lines().filter_map(|row| row.split('|').nth(number + 1));
            cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(str::to_owned).collect()
        };
        let set = |names: Vec<String>| names.into_iter().collect::<BTreeSet<_>>();
        assert_eq!(column(0), set(KEYS.iter().map(|(key, _)| (*key).to_owned()).collect()));

        let command = <Choices as clap::Args>::augment_args(clap::Command::new("chamfer"));
        let flags = command.get_arguments().filter_map(|argument| argument.get_long());
        assert_eq!(column(1), set(flags.map(|flag| format!("--{flag}")).collect()));

        let mut header =
            fields(&part("include/chamfer.h", "typedef struct chamfer_options {", "}"), ";");
        assert!(header.remove("struct_size"));
        assert_eq!(column(2), header);

        let keywords = part(
            "python/src/chamfer/_options.py",
            "class Options(TypedDict, total=False):",
            "\n\n\n",
        );
        let keywords = keywords.lines().filter_map(|line| line.trim().split_once(':'));
        let keywords = keywords.filter(|(word, _)| !word.starts_with('#') && !word.contains(' '));
        assert_eq!(column(3), keywords.map(|(word, _)| word.to_owned()).collect());

        let mut unity = settings("ChamferSettings.cs", "ChamferSettings");
        assert!(unity.remove("edges"), "these stand beside it");
        unity.extend(settings("EdgeSettings.cs", "EdgeSettings"));
        assert_eq!(column(4), unity);
    }

    #[test]
    fn each_flag_has_its_key() {
        let known = |flag: &str| KEYS.iter().any(|(_, known)| *known == flag);
        let command = <Choices as clap::Args>::augment_args(clap::Command::new("chamfer"));
        let flags = command.get_arguments().filter_map(|argument| argument.get_long());
        let unknown: Vec<&str> = flags.filter(|flag| !known(flag)).collect();
        assert_eq!(unknown, ["width-percent"], "a unit says it");
    }
}
