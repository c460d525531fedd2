//! What can be wrong with a file, and what of it could not be kept.

use raconteur_body::read::ReadError;

/// Why a file cannot perform.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Neither a glTF binary nor glTF JSON.
    #[error("neither a glTF binary nor glTF JSON: {0}")]
    NotGltf(&'static str),
    /// A fault in the file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Compressed in a way that is not read.
    #[error("compressed with {extension}, which is not read; {hint}")]
    Compressed {
        /// The extension's name.
        extension: &'static str,
        /// How to export the avatar so that it is read.
        hint: &'static str,
    },
    /// A part lies in another file.
    #[error("the {what} lies in another file, {uri}; export everything into one .glb")]
    ExternalFile {
        /// What lies there.
        what: &'static str,
        /// Its address, shortened.
        uri: String,
    },
    /// A data address that cannot be decoded.
    #[error("the data address of the {what} is not base64")]
    DataUri {
        /// Whose address.
        what: &'static str,
    },
    /// The skeleton is no human's.
    #[error("no humanoid: {0}")]
    NotHumanoid(String),
}

/// Something of the file that is not as its maker meant it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Short name that does not change, for example `mouth-still`.
    pub code: &'static str,
    /// What is missing or changed.
    pub message: String,
    /// What to do about it; empty where there is nothing to do.
    pub hint: &'static str,
}

/// Collects diagnostics; each code once.
#[derive(Default)]
pub(super) struct DiagnosticSink(Vec<Diagnostic>);

impl DiagnosticSink {
    pub(super) fn add(
        &mut self,
        code: &'static str,
        message: impl Into<String>,
        hint: &'static str,
    ) {
        if self.0.iter().all(|d| d.code != code) {
            self.0.push(Diagnostic {
                code,
                message: message.into(),
                hint,
            });
        }
    }

    pub(super) fn into_list(self) -> Vec<Diagnostic> {
        self.0
    }
}
