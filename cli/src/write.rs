//! Writing files so that none is ever seen half done: each is completed under another name in its
//! folder and then renamed.
//!
//! A .gltf and its buffers are two files, and no system renames two at once. Where a buffer is
//! replaced, the new one first goes beside it, with a .gltf that names it there; then it takes the
//! old one's place, and the .gltf that names it there follows. At every moment the .gltf fits its
//! buffers.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result, bail};
use chamfer_formats::OutputFile;
use chamfer_formats::gltf_file::buffers;
use tempfile::{NamedTempFile, TempPath};

/// What a shell reports for a command that the user interrupted: 128 and the number of SIGINT.
pub const INTERRUPTED: i32 = 130;

/// What temporary names begin with.
const PREFIX: &str = ".chamfer-";

/// Files under a temporary name. Held locked while one is created and while those of a document
/// are renamed, so that an interrupt finds either all of a document or nothing.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Folders without leftovers of killed runs.
static CLEARED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// What is done one after the other once all bytes are on the disk.
enum Step {
    /// A complete file gets its name.
    Rename {
        temporary: TempPath,
        target: PathBuf,
    },
    /// All names of a folder are on the disk, before anything after.
    Sync(PathBuf),
    Remove(PathBuf),
}

/// Writes the files of a document: all of them or, where one cannot be written, none. Missing
/// folders are created. The first file comes last, because the others belong to it: they never take
/// the place of a file with another content, unless that is a buffer of the .gltf that is replaced,
/// and of no other.
///
/// # Errors
/// Names the file that cannot be written, and why.
pub fn together(files: &[OutputFile]) -> Result<()> {
    let mut stage = Stage::default();
    let steps = steps(files, &mut stage);
    let mut unfinished = unfinished();
    let done = steps.and_then(|steps| steps.into_iter().try_for_each(Step::run));
    unfinished.retain(|path| path.exists());
    done
}

/// As [`together`], for the result of a model: none gets its name once the run is stopped.
///
/// # Errors
/// As [`together`].
pub fn model(files: &[OutputFile]) -> Result<Written> {
    let mut stage = Stage { is_model: true, ..Stage::default() };
    let steps = steps(files, &mut stage)?;
    let mut unfinished = unfinished();
    if STOPPED.load(Ordering::SeqCst) {
        drop(unfinished);
        wait_for_the_end();
    }
    let written = Written::new();
    let done = steps.into_iter().try_for_each(Step::run);
    unfinished.retain(|path| path.exists());
    done.map(|()| written)
}

/// A result that has its name and that nobody has been told of.
pub struct Written(());

/// How many such results there are.
static WRITTEN: AtomicUsize = AtomicUsize::new(0);

/// Whether the run was interrupted.
static STOPPED: AtomicBool = AtomicBool::new(false);

impl Written {
    fn new() -> Written {
        WRITTEN.fetch_add(1, Ordering::SeqCst);
        Written(())
    }

    /// How many there are.
    pub fn count() -> usize {
        WRITTEN.load(Ordering::SeqCst)
    }
}

impl Drop for Written {
    fn drop(&mut self) {
        WRITTEN.fetch_sub(1, Ordering::SeqCst);
    }
}

fn wait_for_the_end() -> ! {
    loop {
        std::thread::park();
    }
}

/// As [`together`], for a file alone.
///
/// # Errors
/// As [`together`].
pub fn alone(path: &Path, bytes: Vec<u8>) -> Result<()> {
    together(&[OutputFile { path: path.to_path_buf(), bytes }])
}

fn steps(files: &[OutputFile], stage: &mut Stage) -> Result<Vec<Step>> {
    let Some((main, companions)) = files.split_first() else { return Ok(Vec::new()) };
    let Companions { new, replaced } = Companions::sort(main, companions)?;
    let stale: Vec<PathBuf> = companions.iter().flat_map(|file| asides(&file.path)).collect();
    let sync = || Step::Sync(folder_of(&main.path));
    let mut steps = Vec::new();
    for file in &new {
        steps.push(stage.rename(&file.path, &file.bytes)?);
    }
    let beside = replaced.iter().map(|file| (&*file.path, free_aside(&file.path)));
    let beside: Vec<(&Path, PathBuf)> = beside.collect();
    for (file, (_, aside)) in replaced.iter().zip(&beside) {
        steps.push(stage.rename(aside, &file.bytes)?);
    }
    if !replaced.is_empty() {
        let between = buffers::renamed(&main.bytes, &main.path, &beside)?;
        steps.extend([sync(), stage.rename(&main.path, &between)?, sync()]);
    }
    for file in &replaced {
        steps.push(stage.rename(&file.path, &file.bytes)?);
    }
    if !companions.is_empty() {
        steps.push(sync());
    }
    steps.extend([stage.rename(&main.path, &main.bytes)?, sync()]);
    let asides = stale.into_iter().chain(beside.into_iter().map(|(_, aside)| aside));
    steps.extend(asides.map(Step::Remove));
    Ok(steps)
}

/// The files that belong to the first of a document, without those that are there already.
struct Companions<'a> {
    new: Vec<&'a OutputFile>,
    replaced: Vec<&'a OutputFile>,
}

impl<'a> Companions<'a> {
    fn sort(main: &OutputFile, companions: &'a [OutputFile]) -> Result<Companions<'a>> {
        let mut sorted = Companions { new: Vec::new(), replaced: Vec::new() };
        for file in companions {
            match fs::read(&file.path) {
                Ok(bytes) if bytes == file.bytes => {}
                Ok(_) => match why_kept(&file.path, &main.path) {
                    None => sorted.replaced.push(file),
                    Some(why) => bail!(
                        "{} is there already with another content, and {why}: choose another \
                         folder or name for the result",
                        file.path.display()
                    ),
                },
                Err(_) => sorted.new.push(file),
            }
        }
        Ok(sorted)
    }
}

/// Why a file may not be replaced. A killed run can have left the .gltf with a buffer beside it.
fn why_kept(file: &Path, model: &Path) -> Option<String> {
    let why = buffers::why_kept(file, model)?;
    let is_own = |aside: PathBuf| buffers::why_kept(&aside, model).is_none();
    (!asides(file).into_iter().any(is_own)).then_some(why)
}

/// The names of a buffer until it has its own.
fn aside(buffer: &Path, number: usize) -> PathBuf {
    let end = buffer.extension().unwrap_or_default().to_string_lossy();
    buffer.with_extension(format!("chamfer-new{number}.{end}"))
}

/// Those that killed runs have left.
fn asides(buffer: &Path) -> Vec<PathBuf> {
    (0..).map(|number| aside(buffer, number)).take_while(|path| path.exists()).collect()
}

fn free_aside(buffer: &Path) -> PathBuf {
    aside(buffer, asides(buffer).len())
}

/// From now on an interrupt, a hang-up or a polite kill removes unfinished files and ends the
/// process, unless `tell` says that somebody else will end it: the first time alone.
pub fn on_interrupt(tell: impl Fn() -> bool + Send + 'static) {
    let mut is_first = true;
    // Fails only where a handler exists already: then that one decides.
    let _ = ctrlc::set_handler(move || {
        if std::mem::take(&mut is_first) && tell() {
            return;
        }
        // The lock is never given back, so that no other thread starts a file meanwhile.
        let unfinished = unfinished();
        remove(&unfinished);
        std::process::exit(INTERRUPTED);
    });
}

/// Removes what models have begun; none begins any more.
pub fn stop() {
    let unfinished = unfinished();
    STOPPED.store(true, Ordering::SeqCst);
    remove(&unfinished);
}

fn remove(unfinished: &BTreeSet<PathBuf>) {
    for path in unfinished {
        let _ = fs::remove_file(path);
    }
}

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Files under temporary names. Of each folder the first is held locked until all are done: so
/// other runs know that what is there is not left over.
#[derive(Default)]
struct Stage {
    held: Vec<(PathBuf, File)>,
    /// Whether it is for a model: then it ends where the run is stopped.
    is_model: bool,
}

impl Stage {
    /// Puts the bytes on the disk.
    fn rename(&mut self, target: &Path, bytes: &[u8]) -> Result<Step> {
        let mut temporary = self.create_beside(target)?;
        let written = temporary.write_all(bytes).and_then(|()| temporary.as_file().sync_all());
        written.with_context(|| cannot_write(target))?;
        let (file, temporary) = temporary.into_parts();
        let folder = folder_of(target);
        if !self.held.iter().any(|(held, _)| *held == folder) {
            self.held.push((folder, file));
        }
        Ok(Step::Rename { temporary, target: target.to_path_buf() })
    }

    fn create_beside(&self, target: &Path) -> Result<NamedTempFile> {
        if target.is_dir() {
            bail!("{}: a folder is in the way", cannot_write(target));
        }
        let folder = folder_of(target);
        fs::create_dir_all(&folder)
            .with_context(|| format!("cannot create the folder {}", folder.display()))?;
        let mut unfinished = unfinished();
        if self.is_model && STOPPED.load(Ordering::SeqCst) {
            drop(unfinished);
            wait_for_the_end();
        }
        clear_leftovers(&folder);
        // The error would name the temporary file, which means nothing to the user: its kind is
        // enough.
        let temporary = new_file_in(&folder)
            .map_err(|error| io::Error::from(error.kind()))
            .with_context(|| cannot_write(target))?;
        unfinished.insert(temporary.path().to_path_buf());
        Ok(temporary)
    }
}

fn folder_of(target: &Path) -> PathBuf {
    match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// Another run may take a file for left over before it is locked: then there is another try.
const TRIES: usize = 8;

/// A new file that is locked, where the file system can.
fn new_file_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    // Temporary files are private unless told otherwise; a model is not.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    for _ in 0..TRIES {
        let is_taken = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
        if !is_taken && file.path().exists() {
            break;
        }
        file = builder.tempfile_in(folder)?;
    }
    Ok(file)
}

/// Removes what killed runs have left in a folder, once, and only where no run is at work.
fn clear_leftovers(folder: &Path) {
    let mut cleared = CLEARED.lock().unwrap_or_else(PoisonError::into_inner);
    if !cleared.insert(folder.to_path_buf()) {
        return;
    }
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_temporary = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with(PREFIX);
    let leftovers: Vec<(PathBuf, File)> = entries
        .filter(|entry| is_temporary(&entry.file_name()))
        .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()))
        .filter_map(|entry| Some((entry.path(), File::open(entry.path()).ok()?)))
        .collect();
    if leftovers.iter().all(|(_, file)| file.try_lock().is_ok()) {
        for (path, _) in &leftovers {
            let _ = fs::remove_file(path);
        }
    }
}

impl Step {
    fn run(self) -> Result<()> {
        match self {
            Step::Rename { temporary, target } => rename(temporary, &target),
            Step::Sync(folder) => {
                // Only where folders can be opened as files; the names come to disk in time then.
                if let Ok(folder) = File::open(&folder) {
                    let _ = folder.sync_all();
                }
                Ok(())
            }
            Step::Remove(path) => {
                fs::remove_file(&path).with_context(|| format!("cannot remove {}", path.display()))
            }
        }
    }
}

fn rename(temporary: TempPath, path: &Path) -> Result<()> {
    // A file that is replaced keeps its permissions, and a link keeps pointing to it.
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if let Ok(existing) = fs::metadata(&target) {
        let _ = fs::set_permissions(&temporary, existing.permissions());
    }
    let renamed = temporary.persist(&target).map_err(|error| error.error);
    renamed.with_context(|| cannot_write(path))
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

    /// A .gltf with one buffer, and what is in it.
    fn model(folder: &Path, buffer: &str, text: &str) -> [OutputFile; 2] {
        let json = format!("{{\"asset\": \"{text}\", \"buffers\": [{{\"uri\": \"{buffer}\"}}]}}");
        [file(folder.join("a.gltf"), &json), file(folder.join(buffer), text)]
    }

    /// Whether the .gltf and the buffer that it names are of the same model.
    fn fit(folder: &Path) -> String {
        let json: serde_json::Value =
            serde_json::from_slice(&fs::read(folder.join("a.gltf")).unwrap()).unwrap();
        let buffer = json["buffers"][0]["uri"].as_str().unwrap();
        let text = fs::read_to_string(folder.join(buffer)).unwrap();
        assert_eq!(json["asset"], text.as_str());
        text
    }

    /// A kill may come after any step.
    #[test]
    fn a_gltf_fits_its_buffer_at_every_moment() {
        let count = {
            let folder = tempfile::tempdir().unwrap();
            together(&model(folder.path(), "a.bin", "old")).unwrap();
            steps(&model(folder.path(), "a.bin", "new"), &mut Stage::default()).unwrap().len()
        };
        assert!(count > 5);
        for done in 0..=count {
            let folder = tempfile::tempdir().unwrap();
            together(&model(folder.path(), "a.bin", "old")).unwrap();
            let new = model(folder.path(), "a.bin", "new");
            let mut stage = Stage::default();
            let steps = steps(&new, &mut stage).unwrap();
            steps.into_iter().take(done).for_each(|step| step.run().unwrap());
            let seen = fit(folder.path());
            assert_eq!(seen == "new", done > 2, "after {done} steps");
            // The next run ends where an undisturbed one does.
            drop(stage);
            together(&new).unwrap();
            assert_eq!(fit(folder.path()), "new");
            assert_eq!(names(folder.path()), ["a.bin", "a.gltf"], "after {done} steps");
        }
    }

    #[test]
    fn a_buffer_of_another_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        together(&model(folder.path(), "a.bin", "old")).unwrap();
        let other = folder.path().join("b.gltf");
        fs::write(&other, r#"{"buffers": [{"uri": "a.bin"}]}"#).unwrap();
        let write = || together(&model(folder.path(), "a.bin", "new"));
        let error = write().unwrap_err().to_string();
        assert!(error.contains("a.bin is there already with another content"), "{error}");
        assert!(error.contains("is a buffer of ") && error.contains("b.gltf too"), "{error}");
        assert_eq!(fit(folder.path()), "old");
        fs::remove_file(other).unwrap();
        write().unwrap();
        assert_eq!(fit(folder.path()), "new");
        fs::remove_file(folder.path().join("a.gltf")).unwrap();
        let error = together(&model(folder.path(), "a.bin", "newer")).unwrap_err().to_string();
        assert!(error.contains("is no buffer of "), "{error}");
        assert_eq!(names(folder.path()), ["a.bin"]);
    }

    #[test]
    fn leftovers_of_killed_runs_are_removed_unless_a_run_is_at_work() {
        for is_at_work in [false, true] {
            let folder = tempfile::tempdir().unwrap();
            let (left, other) =
                (folder.path().join(".chamfer-Ab12Cd"), folder.path().join(".chamfer-Ef34Gh"));
            fs::write(&left, "half").unwrap();
            fs::write(&other, "half").unwrap();
            let held = File::open(&other).unwrap();
            if is_at_work {
                held.lock().unwrap();
            }
            alone(&folder.path().join("a"), b"1".to_vec()).unwrap();
            assert_eq!((left.exists(), other.exists()), (is_at_work, is_at_work));
        }
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
