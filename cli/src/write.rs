//! Writing files so that none is ever seen half done: each is completed under another name in its
//! folder and then renamed.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result, bail};
use chamfer_formats::OutputFile;
use tempfile::{NamedTempFile, TempPath};

/// What a shell reports for a command that the user interrupted: 128 and the number of SIGINT.
const INTERRUPTED: i32 = 130;

/// Files under a temporary name. Held locked while one is created and while those of a document
/// are renamed, so that an interrupt finds either all of a document or nothing.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A complete file under a temporary name.
struct Staged<'a> {
    temporary: TempPath,
    target: &'a Path,
}

/// Writes the files of a document: all of them or, where one cannot be written, none. Missing
/// folders are created. The first file is renamed last, because the others belong to it.
///
/// # Errors
/// Names the file that cannot be written, and why.
pub fn together(files: &[OutputFile]) -> Result<()> {
    let staged = files.iter().rev().map(stage).collect::<Result<Vec<_>>>();
    let mut unfinished = unfinished();
    let renamed = staged.and_then(|staged| staged.into_iter().try_for_each(rename));
    unfinished.retain(|path| path.exists());
    renamed
}

/// As [`together`], for a file alone.
///
/// # Errors
/// As [`together`].
pub fn alone(path: &Path, bytes: Vec<u8>) -> Result<()> {
    together(&[OutputFile { path: path.to_path_buf(), bytes }])
}

/// From now on an interrupt, a hang-up or a polite kill removes unfinished files and ends the
/// process.
pub fn clean_up_on_interrupt() {
    // Fails only where a handler exists already: then that one decides.
    let _ = ctrlc::set_handler(|| {
        // The lock is never given back, so that no other thread starts a file meanwhile.
        let unfinished = unfinished();
        for path in unfinished.iter() {
            let _ = fs::remove_file(path);
        }
        std::process::exit(INTERRUPTED);
    });
}

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

fn stage(file: &OutputFile) -> Result<Staged<'_>> {
    let mut temporary = create_beside(&file.path)?;
    temporary.write_all(&file.bytes).with_context(|| cannot_write(&file.path))?;
    Ok(Staged { temporary: temporary.into_temp_path(), target: &file.path })
}

fn create_beside(target: &Path) -> Result<NamedTempFile> {
    if target.is_dir() {
        bail!("{}: a folder is in the way", cannot_write(target));
    }
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot create the folder {}", folder.display()))?;
    let mut unfinished = unfinished();
    // The error would name the temporary file, which means nothing to the user: its kind is enough.
    let temporary = new_file_in(folder)
        .map_err(|error| io::Error::from(error.kind()))
        .with_context(|| cannot_write(target))?;
    unfinished.insert(temporary.path().to_path_buf());
    Ok(temporary)
}

fn new_file_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".chamfer-");
    // Temporary files are private unless told otherwise; a model is not.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn rename(file: Staged) -> Result<()> {
    // A file that is replaced keeps its permissions, and a link keeps pointing to it.
    let target = file.target.canonicalize().unwrap_or_else(|_| file.target.to_path_buf());
    if let Ok(existing) = fs::metadata(&target) {
        let _ = fs::set_permissions(&file.temporary, existing.permissions());
    }
    let renamed = file.temporary.persist(&target).map_err(|error| error.error);
    renamed.with_context(|| cannot_write(file.target))
}

fn cannot_write(path: &Path) -> String {
    format!("cannot write {}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: PathBuf, text: &str) -> OutputFile {
        OutputFile { path, bytes: text.into() }
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn files_and_their_folders_appear() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("x/y/a"), folder.path().join("x/b"));
        together(&[file(a.clone(), "1"), file(b.clone(), "2")]).unwrap();
        assert_eq!(fs::read(a).unwrap(), b"1");
        assert_eq!(fs::read(b).unwrap(), b"2");
        assert_eq!(names(folder.path()), ["x"]);
        assert_eq!(names(&folder.path().join("x")), ["b", "y"]);
    }

    #[test]
    fn when_one_cannot_be_written_none_is() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("taken")).unwrap();
        fs::write(folder.path().join("old"), "old").unwrap();
        let files =
            [file(folder.path().join("old"), "new"), file(folder.path().join("taken"), "new")];
        let error = together(&files).unwrap_err().to_string();
        assert!(error.contains("taken") && error.contains("a folder is in the way"), "{error}");
        assert_eq!(fs::read(folder.path().join("old")).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["old", "taken"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_permissions_and_its_links() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&real, "old").unwrap();
        fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&real, &link).unwrap();
        alone(&link, b"new".to_vec()).unwrap();
        assert_eq!(fs::read(&real).unwrap(), b"new");
        assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
