//! Which file goes where, decided and checked before any work.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use chamfer_formats::paths::identity;
use chamfer_formats::{endings, row_of};
use walkdir::WalkDir;

use crate::args::Args;

/// One model to chamfer.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The file to read.
    pub input: PathBuf,
    /// The file to write.
    pub output: PathBuf,
}

/// What a run has to do.
#[derive(Debug, Default)]
pub struct Plan {
    pub jobs: Vec<Job>,
    /// What could not be searched, a line each.
    pub notes: Vec<String>,
    /// Whether a model may be missing for that.
    pub is_incomplete: bool,
}

/// A model found, and its path below the folder that results go to.
struct Found {
    input: PathBuf,
    below: PathBuf,
}

/// Finds the models that the arguments name and where each result goes.
///
/// # Errors
/// Where the arguments leave that open, or results would overwrite inputs or each other.
pub fn plan(args: &Args) -> Result<Plan> {
    args.choices.check()?;
    let single = args.inputs.len() == 1 && !args.inputs[0].is_dir();
    let plan = if single {
        let input = args.inputs[0].clone();
        let output = single_output(&input, args.output.as_deref())?;
        Plan { jobs: vec![Job { input, output }], ..Plan::default() }
    } else {
        several(&args.inputs, args.output.as_deref())?
    };
    let jobs = &plan.jobs;
    // One file may be replaced by name; a folder after -o does not name the files in it.
    let may_replace = single && args.output.as_ref() == Some(&jobs[0].output);
    let extras = [args.report.as_deref(), args.preview.as_deref(), args.html.as_deref()];
    check_overlaps(jobs, may_replace, extras.into_iter().flatten())?;
    Ok(plan)
}

fn single_output(input: &Path, output: Option<&Path>) -> Result<PathBuf> {
    let Some(output) = output else {
        let name = usual_name(input);
        let extension = name.extension().unwrap_or_default().to_string_lossy();
        return Ok(name.with_extension(format!("chamfered.{extension}")));
    };
    if output.is_dir() || names_folder(output) {
        let name = usual_name(input);
        return Ok(output.join(name.file_name().context("the input has no file name")?));
    }
    let Some(format) = row_of(output) else {
        bail!(
            "-o {}: not a folder, and its ending names no format: end it in {}, or in a slash for \
             a folder",
            output.display(),
            endings()
        );
    };
    if let Some(from) = row_of(input) {
        from.check_conversion(format).with_context(|| format!("-o {}", output.display()))?;
    }
    Ok(output.to_path_buf())
}

fn names_folder(path: &Path) -> bool {
    path.as_os_str().to_string_lossy().ends_with(std::path::is_separator)
}

/// The input's path with the extension of the format that it usually becomes.
fn usual_name(input: &Path) -> PathBuf {
    match row_of(input) {
        Some(row) if row.usual_output().format != row.format => {
            input.with_extension(row.usual_output().ending)
        }
        _ => input.to_path_buf(),
    }
}

fn several(inputs: &[PathBuf], output: Option<&Path>) -> Result<Plan> {
    let Some(folder) = output else {
        bail!("several inputs or a folder need a folder for the results: add -o DIR");
    };
    if folder.is_file() || (row_of(folder).is_some() && !folder.is_dir()) {
        bail!("-o {}: several inputs or a folder need a folder, not a file", folder.display());
    }
    let mut plan = Plan::default();
    for input in inputs {
        for found in find_models(input, &identity(folder), &mut plan)? {
            let output = folder.join(usual_name(&found.below));
            plan.jobs.push(Job { input: found.input, output });
        }
    }
    Ok(plan)
}

/// The models in a folder, sorted, without those in `results`; or the file itself.
fn find_models(input: &Path, results: &Path, plan: &mut Plan) -> Result<Vec<Found>> {
    if !input.is_dir() {
        let below = input.file_name().context("an input has no file name")?.into();
        return Ok(vec![Found { input: input.to_path_buf(), below }]);
    }
    let mut found = Vec::new();
    // Results of an earlier run below the input folder are not inputs of this one.
    let walk = WalkDir::new(input).follow_links(true).sort_by_file_name().into_iter();
    for entry in walk.filter_entry(|e| e.depth() == 0 || identity(e.path()) != results) {
        let entry = match entry {
            Ok(entry) => entry,
            Err(error) => {
                plan.leave_out(&error, input);
                continue;
            }
        };
        if entry.file_type().is_file() && row_of(entry.path()).is_some() {
            let below = entry.path().strip_prefix(input)?.to_path_buf();
            found.push(Found { input: entry.path().to_path_buf(), below });
        }
    }
    if found.is_empty() {
        let left_out: String = plan.notes.iter().map(|note| format!("; {note}")).collect();
        bail!("{}: no {} file in this folder{left_out}", input.display(), endings());
    }
    Ok(found)
}

impl Plan {
    /// What a search of a folder stumbles over does not stop it.
    fn leave_out(&mut self, error: &walkdir::Error, folder: &Path) {
        let path = error.path().unwrap_or(folder);
        let is_link = fs::symlink_metadata(path).is_ok_and(|file| file.is_symlink());
        let (why, is_failure) = match error.io_error() {
            None => ("a link to a folder that it lies in".to_owned(), false),
            Some(error) if is_link && error.kind() == ErrorKind::NotFound => {
                ("a link that leads nowhere".to_owned(), row_of(path).is_some())
            }
            Some(error) => (format!("cannot be read: {error}"), true),
        };
        self.notes.push(format!("{}: left out, {why}", path.display()));
        self.is_incomplete |= is_failure;
    }
}

fn check_overlaps<'a>(
    jobs: &[Job],
    may_replace: bool,
    extras: impl Iterator<Item = &'a Path>,
) -> Result<()> {
    let inputs: BTreeSet<PathBuf> = jobs.iter().map(|job| identity(&job.input)).collect();
    let mut written = BTreeMap::new();
    for Job { input, output } in jobs {
        let path = identity(output);
        let (input, output) = (input.display(), output.display());
        if inputs.contains(&path) && !may_replace {
            bail!("the result of {input} would overwrite {output}: choose another folder");
        }
        if let Some(other) = written.insert(path, input.to_string()) {
            bail!("{other} and {input} would both go to {output}: choose different folders");
        }
    }
    for extra in extras {
        let path = identity(extra);
        if inputs.contains(&path) || written.insert(path, String::new()).is_some() {
            bail!("{}: named for two different files", extra.display());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    struct Folder(tempfile::TempDir);

    impl Folder {
        fn with(files: &[&str]) -> Folder {
            let folder = tempfile::tempdir().unwrap();
            for file in files {
                let path = folder.path().join(file);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, "").unwrap();
            }
            Folder(folder)
        }

        /// Plans a command line in which `@` stands for this folder; so it does in the result.
        fn jobs(&self, line: &str) -> Result<Vec<String>> {
            let root = self.0.path().to_str().unwrap();
            let line = format!("chamfer {}", line.replace('@', root));
            let Plan { jobs, .. } = plan(&Args::try_parse_from(line.split(' '))?)?;
            let show = |job: &Job| format!("{}>{}", job.input.display(), job.output.display());
            Ok(jobs.iter().map(|job| show(job).replace(root, "@")).collect())
        }

        fn error(&self, line: &str) -> String {
            format!("{:#}", self.jobs(line).unwrap_err())
        }
    }

    #[test]
    fn a_result_without_a_place_goes_beside_its_input() {
        let folder = Folder::with(&["a.obj", "b.stl"]);
        assert_eq!(folder.jobs("@/a.obj").unwrap(), ["@/a.obj>@/a.chamfered.obj"]);
        assert_eq!(folder.jobs("@/b.stl").unwrap(), ["@/b.stl>@/b.chamfered.glb"]);
    }

    #[test]
    fn a_single_result_goes_to_a_file_or_into_a_folder() {
        let folder = Folder::with(&["a.obj", "b.stl", "out/x.txt"]);
        assert_eq!(folder.jobs("@/a.obj -o @/c.glb").unwrap(), ["@/a.obj>@/c.glb"]);
        assert_eq!(folder.jobs("@/a.obj -o @/out").unwrap(), ["@/a.obj>@/out/a.obj"]);
        assert_eq!(folder.jobs("@/b.stl -o @/new/").unwrap(), ["@/b.stl>@/new/b.glb"]);
        assert_eq!(folder.jobs("@/b.stl -o @/c.stl").unwrap(), ["@/b.stl>@/c.stl"]);
    }

    #[test]
    fn an_output_of_no_or_the_wrong_format_is_refused() {
        let folder = Folder::with(&["a.glb"]);
        assert!(folder.error("@/a.glb -o @/c").contains("names no format"));
        assert!(folder.error("@/a.glb -o @/c.obj").contains(".glb cannot be written as .obj"));
    }

    #[test]
    fn folders_are_searched_sorted_and_keep_their_shape() {
        let folder = Folder::with(&["in/b.obj", "in/a/z.STL", "in/a/readme.txt", "c.glb"]);
        assert_eq!(
            folder.jobs("@/in @/c.glb -o @/out").unwrap(),
            ["@/in/a/z.STL>@/out/a/z.glb", "@/in/b.obj>@/out/b.obj", "@/c.glb>@/out/c.glb"]
        );
    }

    #[test]
    fn earlier_results_below_the_input_folder_are_not_inputs() {
        let folder = Folder::with(&["in/a.obj", "in/out/a.obj"]);
        assert_eq!(folder.jobs("@/in -o @/in/out").unwrap(), ["@/in/a.obj>@/in/out/a.obj"]);
    }

    #[test]
    fn several_inputs_need_a_folder() {
        let folder = Folder::with(&["a.obj", "b.obj", "in/c.obj"]);
        assert!(folder.error("@/a.obj @/b.obj").contains("add -o DIR"));
        assert!(folder.error("@/in").contains("add -o DIR"));
        assert!(folder.error("@/a.obj @/b.obj -o @/c.obj").contains("need a folder"));
    }

    #[test]
    fn only_a_name_after_o_may_replace_an_input() {
        let folder = Folder::with(&["a.obj", "b.obj"]);
        assert_eq!(folder.jobs("@/a.obj -o @/a.obj").unwrap(), ["@/a.obj>@/a.obj"]);
        assert!(folder.error("@/a.obj -o @/").contains("would overwrite"));
        assert!(folder.error("@/ -o @/").contains("would overwrite"));
    }

    #[test]
    fn two_results_in_one_place_are_refused() {
        let folder = Folder::with(&["a/m.stl", "b/m.glb"]);
        assert!(folder.error("@/a @/b -o @/out").contains("would both go to"));
        assert!(folder.error("@/a @/a -o @/out").contains("would both go to"));
    }

    #[test]
    fn a_report_cannot_replace_a_model() {
        let folder = Folder::with(&["a.obj"]);
        assert!(folder.error("@/a.obj --report @/a.obj").contains("two different files"));
        assert!(folder.error("@/a.obj --report @/r --preview @/r").contains("two different"));
    }
}
