//! Audio read by ffmpeg. The first bytes alone determine the format of a file, and ffmpeg must read
//! it as that format: by default it accepts a playlist as audio and reads all files and addresses
//! in it.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};

/// Maximum size of a story's audio file, bytes.
pub const MAX_BYTES: u64 = 512 << 20;

/// Begins of files that name other files or addresses: playlists and descriptions of streams.
const PLAYLISTS: [&str; 8] = [
    "#EXTM3U",
    "ffconcat",
    "[playlist]",
    "v=0",
    "[Reference]",
    "[InternetShortcut]",
    "<?xml",
    "<MPD",
];

/// Returns ffmpeg's name of the format of a file with this start; `None` for unsupported formats.
fn format_of(begin: &[u8]) -> Option<&'static str> {
    let at = |offset: usize, mark: &[u8]| {
        begin
            .get(offset..)
            .is_some_and(|rest| rest.starts_with(mark))
    };
    // Frames of MPEG audio begin with eleven ones; the two layer bits are 0 in AAC.
    let frame = begin.len() >= 2 && begin[0] == 0xff && begin[1] & 0xe0 == 0xe0;
    let layer = begin.get(1).map_or(0, |b| b & 0x06);
    match () {
        () if (at(0, b"RIFF") || at(0, b"RF64")) && at(8, b"WAVE") => Some("wav"),
        () if at(0, b"FORM") && (at(8, b"AIFF") || at(8, b"AIFC")) => Some("aiff"),
        () if at(0, b"OggS") => Some("ogg"),
        () if at(0, b"fLaC") => Some("flac"),
        () if at(0, b"ID3") || frame && layer != 0 => Some("mp3"),
        () if frame => Some("aac"),
        () if at(4, b"ftyp") => Some("mp4"),
        () if at(0, &[0x1a, 0x45, 0xdf, 0xa3]) => Some("matroska"),
        () => None,
    }
}

/// Audio file whose format is safe to pass to ffmpeg: no playlist that names other files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sound {
    path: PathBuf,
    format: &'static str,
}

impl Sound {
    /// Opens an audio file whose path was already checked, and detects its format.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, is too long, or is not audio of a known format.
    pub fn open(path: &Path) -> Result<Self> {
        let told = || format!("reading the sound {}", path.display());
        let path = path.canonicalize().with_context(told)?;
        super::opened(&path);
        let file = File::open(&path).with_context(told)?;
        let about = file.metadata().with_context(told)?;
        ensure!(about.is_file(), "{} is not a plain file", path.display());
        ensure!(
            about.len() <= MAX_BYTES,
            "the sound {} has {} bytes; at most {MAX_BYTES} are read",
            path.display(),
            about.len()
        );
        let mut begin = Vec::new();
        file.take(64).read_to_end(&mut begin).with_context(told)?;
        if let Some(format) = format_of(&begin) {
            return Ok(Self { path, format });
        }
        let text = begin.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&begin);
        let text = text.trim_ascii_start();
        let is = |mark: &&str| {
            text.get(..mark.len())
                .is_some_and(|t| t.eq_ignore_ascii_case(mark.as_bytes()))
        };
        if PLAYLISTS.iter().any(is) {
            bail!(
                "{} is a playlist, which names other files, and no sound; put the sound itself there",
                path.display()
            );
        }
        bail!(
            "{} is not an audio file of a known format: WAV, AIFF, FLAC, Ogg, MP3, AAC, MP4 or Matroska",
            path.display()
        )
    }

    /// Adds the file to the inputs of ffmpeg: with a fixed format, from a file only. Options for
    /// this input must precede it.
    pub fn input(&self, command: &mut Command) {
        let mut path = std::ffi::OsString::from("file:");
        path.push(&self.path);
        command
            .args(["-protocol_whitelist", "file,pipe", "-f", self.format, "-i"])
            .arg(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn formats_are_known_by_their_first_bytes() {
        for (begin, format) in [
            (&b"RIFF\x24\0\0\0WAVEfmt "[..], "wav"),
            (b"RF64\xff\xff\xff\xffWAVE", "wav"),
            (b"FORM\0\0\0\x10AIFF", "aiff"),
            (b"FORM\0\0\0\x10AIFC", "aiff"),
            (b"OggS\0\x02", "ogg"),
            (b"fLaC\0", "flac"),
            (b"ID3\x04", "mp3"),
            (b"\xff\xfb\x90\x64", "mp3"),
            (b"\xff\xf3\x90\x64", "mp3"),
            (b"\xff\xf1\x50\x80", "aac"),
            (b"\0\0\0\x20ftypM4A ", "mp4"),
            (b"\x1a\x45\xdf\xa3", "matroska"),
        ] {
            assert_eq!(format_of(begin), Some(format), "{begin:?}");
        }
        for none in [&b""[..], b"RIFF", b"RIFF\0\0\0\0AVI ", b"\xff", b"#EXTM3U"] {
            assert_eq!(format_of(none), None, "{none:?}");
        }
    }

    #[test]
    fn what_names_other_files_is_refused_whatever_its_ending() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("secret.wav"), "x").unwrap();
        for (text, told) in [
            ("#EXTM3U\n#EXTINF:1,\nsecret.wav\n", "playlist"),
            ("\u{feff}#extm3u\nsecret.wav\n", "playlist"),
            ("ffconcat version 1.0\nfile secret.wav\n", "playlist"),
            ("  \n[playlist]\nFile1=secret.wav\n", "playlist"),
            ("v=0\no=- 0 0 IN IP4 127.0.0.1\n", "playlist"),
            ("<?xml version=\"1.0\"?><MPD/>", "playlist"),
            ("file 'secret.wav'\n", "not an audio file"),
            ("secret.wav\n", "not an audio file"),
            ("", "not an audio file"),
        ] {
            for name in ["a.wav", "a.mp3", "a.m3u8", "a"] {
                let path = folder.path().join(name);
                fs::write(&path, text).unwrap();
                let error = Sound::open(&path).unwrap_err().to_string();
                assert!(error.contains(told), "{text:?}: {error}");
            }
        }
        assert!(
            Sound::open(folder.path()).is_err(),
            "a folder is rejected as audio"
        );
    }

    #[test]
    fn ffmpeg_is_told_the_format_and_reads_files_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.m3u8");
        fs::write(&path, b"OggS\0\x02").unwrap();
        let mut command = Command::new("ffmpeg");
        Sound::open(&path).unwrap().input(&mut command);
        let told: Vec<&str> = command.get_args().map(|a| a.to_str().unwrap()).collect();
        assert_eq!(
            told[..5],
            ["-protocol_whitelist", "file,pipe", "-f", "ogg", "-i"]
        );
        assert!(
            told[5].starts_with("file:/"),
            "ffmpeg reads a file URL only"
        );
    }
}
