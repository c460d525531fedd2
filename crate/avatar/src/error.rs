//! Errors in a file, and diagnostics for its unsupported parts.

use raconteur_body::read::ReadError;

/// Error returned when a file cannot be imported as a humanoid avatar.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Neither a glTF binary nor glTF JSON.
    #[error("neither a glTF binary nor glTF JSON: {0}")]
    NotGltf(&'static str),
    /// A fault in the file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Unsupported compression.
    #[error("compressed with {extension}, which is not supported; {hint}")]
    Compressed {
        /// The extension's name.
        extension: &'static str,
        /// Hint for exporting the avatar in a supported way.
        hint: &'static str,
    },
    /// A part is in another file.
    #[error("the {what} is in another file, {uri}; export everything into one .glb")]
    ExternalFile {
        /// Description of the part.
        what: &'static str,
        /// URI of the external file, shortened.
        uri: String,
    },
    /// A data address that cannot be decoded.
    #[error("the data address of the {what} is not base64")]
    DataUri {
        /// Owner of the address.
        what: &'static str,
    },
    /// The skeleton is no human's.
    #[error("no humanoid: {0}")]
    NotHumanoid(String),
}

/// Diagnostic about content of the imported file that was changed or lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Stable code, for example `mouth-still`.
    pub code: &'static str,
    /// Description of the missing or changed content.
    pub message: String,
    /// Suggested fix; empty if there is none.
    pub hint: &'static str,
}

/// Collector of import diagnostics; keeps each code only once.
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
