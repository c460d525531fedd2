//! Speech synthesis in a page: text in, audio with words, phones and pitch contour out, by the
//! baker's own code. A page loads this crate separately from the player, when a text has no
//! recording.
//!
//! Scope: finding the texts of a script that its bundle lacks, planning them, speaking them by an
//! engine of the page, applying emotion and style, and writing the bundle.
//! Out of scope: fetching, playback and storage.

#[cfg(target_arch = "wasm32")]
pub mod bindings;
#[cfg(target_arch = "wasm32")]
mod hosts;

use anyhow::{Result, ensure};
use raconteur_speech::bundle::Bundle;
use raconteur_voice::bake::engine::Engine;
use raconteur_voice::bake::page::PageBake;
use raconteur_voice::bake::{BakeOptions, Cast, STORY_PACE};
use raconteur_voice::speech_requests;
use raconteur_voice::text::Lexicon;

/// Maximum length of a script spoken on demand, bytes.
pub const MAX_BYTES: usize = 1 << 20;

/// Speech synthesiser with one voice, for the texts of a script including the effects of its
/// markup.
///
/// # Examples
///
/// ```no_run
/// use raconteur_say::Speaker;
/// use raconteur_voice::bake::engine::Engine;
///
/// # fn example(engine: Box<dyn Engine>) -> anyhow::Result<()> {
/// let speaker = Speaker::new("flite", engine, "slt")?;
/// let script = "<eml><body><voice-text time='0'>Hello!</voice-text></body></eml>";
/// let mut pending = speaker.begin(script, false, None)?;
/// while speaker.step(&mut pending)? {}
/// println!("{}", pending.bundle());
/// # Ok(())
/// # }
/// ```
pub struct Speaker {
    options: BakeOptions,
}

impl Speaker {
    /// Creates a speaker with a voice of the engine called `name`.
    ///
    /// # Errors
    /// Returns an error if the engine is not available or has no such voice.
    pub fn new(name: &str, engine: Box<dyn Engine>, voice: &str) -> Result<Self> {
        Ok(Self {
            options: BakeOptions {
                cast: Cast::with_engine(name, engine, voice)?,
                pace: STORY_PACE,
                lexicon: Lexicon::default(),
                lexicon_text: String::new(),
                jobs: 1,
                check: false,
            },
        })
    }

    /// Begins to speak the parts of a script, or with `is_fragment` of a list of clauses, missing
    /// in `known`, the text of its bundle.
    ///
    /// # Errors
    /// Returns an error if the script is too long, or `known` is not a bundle.
    pub fn begin(&self, eml: &str, is_fragment: bool, known: Option<&str>) -> Result<PageBake> {
        ensure!(
            eml.len() <= MAX_BYTES,
            "a script of more than {MAX_BYTES} bytes is not spoken"
        );
        let known = known
            .map(|text| Bundle::from_json(text.as_bytes()))
            .transpose()?;
        let parsed = if is_fragment {
            raconteur_eml::parse_fragment(eml)
        } else {
            raconteur_eml::parse(eml)
        };
        Ok(PageBake::new(speech_requests(&parsed.document), known))
    }

    /// Synthesises the next utterance, see [`PageBake::step`].
    ///
    /// # Errors
    /// Returns the same errors as [`PageBake::step`].
    pub fn step(&self, saying: &mut PageBake) -> Result<bool> {
        saying.step(&self.options)
    }
}
