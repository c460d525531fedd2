//! Reading of user-specified files: regular ones, up to a size, as UTF-8 where they are text.
//!
//! With untrusted files, `raconteur` must not read `/dev/zero` until memory is full, nor block
//! forever on a pipe.

use std::fs::{self, File, FileType};
use std::io::{Read as _, Take};
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};
use raconteur_base::encoding;

/// Default maximum length of a text file, bytes.
pub const MAX_TEXT_BYTES: u64 = 16 << 20;

/// Reads the bytes of a regular file of at most `most` bytes.
///
/// # Errors
/// Returns an error if the file cannot be read, is not a regular file, or contains more than `most`
/// bytes.
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>> {
    // The size in the metadata is not used, because the kernel's virtual files have none.
    let mut bytes = Vec::new();
    let named = || format!("cannot read {}", path.display());
    let mut file = open(path, most)?;
    file.read_to_end(&mut bytes).with_context(named)?;
    if bytes.len() as u64 > most {
        bail!(
            "cannot read {}: it has more than {most} bytes, the most that are read",
            path.display()
        );
    }
    Ok(bytes)
}

/// Opens a file for reading in pieces: at most one byte more than `most`.
///
/// # Errors
/// Returns an error if the file cannot be opened or is not a regular file.
pub fn open(path: &Path, most: u64) -> Result<Take<File>> {
    let named = || format!("cannot read {}", path.display());
    let kind = fs::metadata(path).with_context(named)?.file_type();
    ensure!(
        kind.is_file(),
        "cannot read {}: it is {}, and only regular files are read",
        path.display(),
        name(kind)
    );
    super::opened(path);
    let file = File::open(path).with_context(named)?;
    Ok(file.take(most.saturating_add(1)))
}

/// Reads a UTF-8 text file of at most `most` bytes.
///
/// # Errors
/// Returns the same errors as [`bytes`], and an error with the position if the text is not UTF-8.
pub fn text(path: &Path, most: u64) -> Result<String> {
    let bytes = bytes(path, most)?;
    let text = encoding::utf8(&bytes);
    let text = text.with_context(|| format!("cannot read {}", path.display()))?;
    Ok(text.to_owned())
}

#[cfg(unix)]
fn name(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt as _;
    if kind.is_dir() {
        "a folder"
    } else if kind.is_fifo() {
        "a pipe"
    } else if kind.is_socket() {
        "a socket"
    } else if kind.is_char_device() || kind.is_block_device() {
        "a device"
    } else {
        "none"
    }
}

#[cfg(not(unix))]
fn name(kind: FileType) -> &'static str {
    if kind.is_dir() { "a folder" } else { "none" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_of_bounded_size_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x");
        for (length, fits) in [(0, true), (10, true), (11, false), (1000, false)] {
            fs::write(&file, vec![b'x'; length]).unwrap();
            let read = bytes(&file, 10);
            assert_eq!(read.is_ok(), fits, "{length}: {read:?}");
        }
        assert!(
            bytes(folder.path(), 10)
                .unwrap_err()
                .to_string()
                .contains("a folder"),
            "the error names a folder"
        );
        #[cfg(unix)]
        {
            let told = bytes(Path::new("/dev/zero"), 10).unwrap_err().to_string();
            assert!(
                told.contains("/dev/zero") && told.contains("a device"),
                "{told}"
            );
            // Its metadata specifies no size.
            if Path::new("/proc/self/maps").exists() {
                assert!(
                    bytes(Path::new("/proc/self/maps"), 10).is_err(),
                    "a file without a known size is rejected"
                );
            }
        }
    }

    #[test]
    fn text_in_another_encoding_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("lexicon.txt");
        let cases = [
            (
                b"a = b\nf\xfcr = x".as_slice(),
                "byte 7 is 0xfc, line 2 column 2",
            ),
            (b"\xff\xfea\0=\0b\0", "UTF-16"),
            (b"a\0=\0b\0\n\0", "UTF-16"),
        ];
        for (bytes, named) in cases {
            fs::write(&file, bytes).unwrap();
            let told = format!("{:#}", text(&file, 100).unwrap_err());
            assert!(
                told.contains(named) && told.contains("lexicon.txt"),
                "{told}"
            );
        }
    }
}
