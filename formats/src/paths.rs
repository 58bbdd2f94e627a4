//! Paths of files: which two are one, and which a model may name.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

/// Reads a file that a model refers to, which the user may know nothing of: a plain one, because a
/// pipe or a device could block for ever, in the model's folder or below, also where links lead.
///
/// # Errors
/// Where it is missing, elsewhere, may not be read, or is something else. Callers say which file it
/// was.
pub fn read_beside(folder: &Path, name: &Path) -> Result<Vec<u8>> {
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let path = folder.join(name).canonicalize()?;
    if !path.starts_with(folder.canonicalize()?) {
        bail!("a link leads out of the model's folder: put the file itself there");
    }
    if !fs::metadata(&path)?.is_file() {
        bail!("not a file");
    }
    Ok(fs::read(&path)?)
}

/// Tells one file from another whatever way its path is written.
pub fn identity(path: &Path) -> PathBuf {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let resolved = path.canonicalize().or_else(|_| {
        let folder = parent.unwrap_or(Path::new(".")).canonicalize()?;
        Ok::<_, std::io::Error>(folder.join(path.file_name().unwrap_or_default()))
    });
    let path = resolved.or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.into());
    if cfg!(any(windows, target_os = "macos")) {
        // These file systems usually do not tell upper from lower case.
        return path.to_string_lossy().to_lowercase().into();
    }
    path
}
