//! What the tests of the command share.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The command.
pub(crate) fn pocketry() -> Command {
    Command::new(env!("CARGO_BIN_EXE_pocketry"))
}

/// The example drawing.
pub(crate) fn bracket() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/bracket.dxf").display().to_string()
}

/// What a run said.
pub(crate) fn stderr(run: &Output) -> String {
    String::from_utf8_lossy(&run.stderr).into_owned()
}

/// A folder that goes away.
pub(crate) struct Sandbox(tempfile::TempDir);

impl Sandbox {
    /// A new one.
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// The path of a file in it.
    pub(crate) fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    /// Writes a file.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.0.path().join(name), content).unwrap();
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    /// The files in it, hidden ones too, by name.
    pub(crate) fn files(&self) -> Vec<String> {
        let paths = std::fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().path());
        let mut names: Vec<String> =
            paths.map(|p: PathBuf| p.file_name().unwrap().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}
