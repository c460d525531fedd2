//! WAV as written by various programs, converted to the one form that the decoder reads.
//!
//! Programs that write to a pipe do not know the length beforehand and leave 0 or the largest
//! number; chunks of odd length include their padding byte; the format chunk may follow the data;
//! samples of 64 bits exceed the decoder. Only the header is rewritten, so that only the decoder
//! converts samples to numbers; those of 64 bits become 32.

use anyhow::{Context as _, Result, ensure};

/// Length from which the length counts as unknown: no accepted file is so long. Programs write
/// 0xFFFFFFFF, 0x7FFFFFFF and numbers a header's length below.
const UNKNOWN: u64 = super::MAX_BYTES;
/// Format tag of integer samples; the next constants are those of floating-point samples and of the
/// extensible format.
const PCM: u16 = 1;
const FLOAT: u16 = 3;
const EXTENSIBLE: u16 = 0xfffe;
/// Bytes after the tag in a format identifier (KSDATAFORMAT_SUBTYPE).
const GUID: [u8; 14] = [0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71];

/// The description of samples (`fmt `).
struct Form {
    tag: u16,
    channels: u16,
    rate_hz: u32,
    /// Bytes of a sample of every channel.
    frame_bytes: u16,
    bits: u16,
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

impl Form {
    fn parse(chunk: &[u8]) -> Result<Self> {
        let read = || {
            let tag = match u16_at(chunk, 0)? {
                EXTENSIBLE => u16_at(chunk, 24)?,
                tag => tag,
            };
            Some(Self {
                tag,
                channels: u16_at(chunk, 2)?,
                rate_hz: u32_at(chunk, 4)?,
                frame_bytes: u16_at(chunk, 12)?,
                bits: u16_at(chunk, 14)?,
            })
        };
        let form = read().context("the chunk \"fmt \" is too short")?;
        ensure!(
            matches!(form.tag, PCM | FLOAT),
            "its samples have the format {:#06x}; only integers and floating-point numbers are supported (convert it: ffmpeg -i IN.wav -c:a pcm_s16le OUT.wav)",
            form.tag
        );
        ensure!(
            form.channels > 0 && form.frame_bytes > 0,
            "it has no channels"
        );
        Ok(form)
    }

    /// Returns true if samples are 64-bit floating-point numbers.
    fn is_double(&self) -> bool {
        self.tag == FLOAT && self.frame_bytes / self.channels == 8
    }
}

/// Returns the same WAV with a plain header, as the decoder requires.
///
/// # Errors
/// Returns an error if the bytes are not a WAV file, have no format or no data, are shorter than
/// declared, or are compressed.
pub(super) fn plain(bytes: &[u8]) -> Result<Vec<u8>> {
    let riff = bytes.starts_with(b"RIFF") || bytes.starts_with(b"RF64");
    ensure!(
        riff && bytes.get(8..12) == Some(b"WAVE"),
        "no WAV: it does not begin as one"
    );
    let (form, data) = chunks(bytes)?;
    let mut form = Form::parse(form.context("not a WAV: there is no chunk \"fmt \"")?)?;
    let data = data.context("not a WAV: there is no chunk \"data\"")?;
    let mut samples = match data {
        Data::Delimited(samples) => samples,
        // The last frame of a stream that was stopped may be a part.
        Data::ToTheEnd(rest) => &rest[..rest.len() - rest.len() % usize::from(form.frame_bytes)],
    };
    let narrowed: Vec<u8>;
    if form.is_double() {
        let doubles = samples.as_chunks::<8>().0.iter();
        let singles = doubles.flat_map(|b| (f64::from_le_bytes(*b) as f32).to_le_bytes());
        narrowed = singles.collect();
        samples = &narrowed;
        form.frame_bytes /= 2;
        form.bits = 32;
    }
    let (form, length) = (header(&form), u32::try_from(samples.len())?);
    let mut out = Vec::with_capacity(samples.len() + 68);
    out.extend(b"RIFF");
    out.extend((length + 60).to_le_bytes());
    out.extend(b"WAVEfmt ");
    out.extend((form.len() as u32).to_le_bytes());
    out.extend(form);
    out.extend(b"data");
    out.extend(length.to_le_bytes());
    out.extend(samples);
    Ok(out)
}

/// Samples, with or without a known end.
enum Data<'a> {
    Delimited(&'a [u8]),
    ToTheEnd(&'a [u8]),
}

/// Returns the format description and the samples, in any order; the first of each counts.
fn chunks(bytes: &[u8]) -> Result<(Option<&[u8]>, Option<Data<'_>>)> {
    let (mut form, mut data) = (None, None);
    // RF64 specifies the length in a separate chunk.
    let mut long = None;
    let mut at = 12;
    while let Some(length) = u32_at(bytes, at + 4) {
        let (name, begin) = (&bytes[at..at + 4], at + 8);
        let rest = &bytes[begin..];
        let mut length = u64::from(length);
        if name == b"data" {
            length = long
                .filter(|_| length == u64::from(u32::MAX))
                .unwrap_or(length);
            let unknown = length >= UNKNOWN || length == 0 && !is_chunk(rest);
            if unknown {
                data.get_or_insert(Data::ToTheEnd(rest));
                break;
            }
        }
        let own = usize::try_from(length).ok().and_then(|n| rest.get(..n));
        match name {
            b"data" if data.is_none() => {
                data = Some(Data::Delimited(own.context("it is cut off")?));
            }
            b"fmt " if form.is_none() => form = Some(own.context("it is cut off")?),
            b"ds64" => {
                let halves = u32_at(rest, 8).zip(u32_at(rest, 12));
                long = halves.map(|(low, high)| u64::from(high) << 32 | u64::from(low));
            }
            _ => {}
        }
        let Some(own) = own else { break };
        at = begin + own.len();
        // A byte fills chunks of odd length; some programs forget it.
        let filled = at + own.len() % 2;
        if is_chunk(&bytes[filled.min(bytes.len())..]) || !is_chunk(&bytes[at..]) {
            at = filled;
        }
    }
    Ok((form, data))
}

/// Returns true if a chunk may start here: an alphabetic name and a length within the file, or the
/// end.
fn is_chunk(rest: &[u8]) -> bool {
    let named = |name: &[u8]| name.iter().all(|c| matches!(c, b' '..=b'~'));
    rest.is_empty()
        || rest.get(..4).is_some_and(named)
            && u32_at(rest, 4)
                .is_some_and(|n| n as usize <= rest.len() - 8 || u64::from(n) >= UNKNOWN)
}

/// Returns a header in the extensible form, the only one that the decoder reads with every width.
fn header(form: &Form) -> Vec<u8> {
    let second = form.rate_hz.wrapping_mul(u32::from(form.frame_bytes));
    let mut out = Vec::with_capacity(40);
    out.extend(EXTENSIBLE.to_le_bytes());
    out.extend(form.channels.to_le_bytes());
    out.extend(form.rate_hz.to_le_bytes());
    out.extend(second.to_le_bytes());
    out.extend(form.frame_bytes.to_le_bytes());
    out.extend(form.bits.to_le_bytes());
    out.extend(22_u16.to_le_bytes());
    out.extend(form.bits.to_le_bytes());
    // No speaker positions: channels are averaged.
    out.extend([0; 4]);
    out.extend(form.tag.to_le_bytes());
    out.extend(GUID);
    out
}
