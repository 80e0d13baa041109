//! Files that appear whole or not at all.

use crate::failure::Failure;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Files to be written together: each is complete in its folder under a temporary name before the first gets its own.
#[derive(Default)]
pub(crate) struct Outputs {
    waiting: Vec<(PathBuf, NamedTempFile)>,
}

impl Outputs {
    /// Prepares a file.
    pub(crate) fn add(&mut self, path: &Path, text: &str) -> Result<(), Failure> {
        if path.is_dir() {
            return Err(Failure::write(path, "it is a folder"));
        }
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut file = temporary(folder).map_err(|e| Failure::write(path, e))?;
        file.write_all(text.as_bytes()).map_err(|e| Failure::write(path, e))?;
        self.waiting.push((path.to_owned(), file));
        Ok(())
    }

    /// Gives the files their names.
    pub(crate) fn commit(self) -> Result<(), Failure> {
        for (path, file) in self.waiting {
            file.persist(&path).map_err(|e| Failure::write(&path, e.error))?;
        }
        Ok(())
    }
}

/// The form that a file's ending asks for, of those that there are; `otherwise` for standard output.
pub(crate) fn form_of<F: Copy>(path: Option<&Path>, forms: &[(&str, F)], otherwise: F) -> Result<F, Failure> {
    let Some(path) = path else { return Ok(otherwise) };
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    forms.iter().find(|f| f.0 == ending).map(|f| f.1).ok_or_else(|| {
        let names: Vec<String> = forms.iter().map(|f| format!(".{}", f.0)).collect();
        let (last, others) = names.split_last().map_or(("", String::new()), |(l, o)| (l.as_str(), o.join(", ")));
        Failure::arguments(format!("{}: name a file that ends with {others} or {last}", path.display()))
    })
}

/// Refuses a file that is named twice.
pub(crate) fn distinct(files: &[&Path]) -> Result<(), Failure> {
    let resolved: Vec<PathBuf> = files.iter().map(|f| f.canonicalize().unwrap_or_else(|_| f.to_path_buf())).collect();
    for (k, file) in resolved.iter().enumerate() {
        if resolved[..k].contains(file) {
            let message = format!("{} is named twice; each file needs a name of its own", file.display());
            return Err(Failure::arguments(message));
        }
    }
    Ok(())
}

/// Writes one file.
pub(crate) fn write_file(path: &Path, text: &str) -> Result<(), Failure> {
    let mut outputs = Outputs::default();
    outputs.add(path, text)?;
    outputs.commit()
}

/// Writes to a file, or to standard output where none is named.
pub(crate) fn write_or_print(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    path.map_or_else(|| print(text), |path| write_file(path, text))
}

/// Writes to standard output; a reader that has gone away is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::write(Path::new("standard output"), e)),
        _ => Ok(()),
    }
}

fn temporary(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pocketry-").suffix(".tmp");
    #[cfg(unix)]
    {
        // Temporary files are private by default; this one becomes an ordinary file (less the umask).
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
