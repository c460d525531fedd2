//! MBROLA's phonetic files: each line has a phone, its milliseconds, and pitch points as per cent
//! of the phone and hertz. `;` begins a comment.

use super::draft::Draft;
use super::text::{TextError, fields, lines, number};

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let mut now = 0.0;
    for (at, line) in lines(text) {
        let told = line.split(';').next().unwrap_or_default();
        let mut fields = fields(at, told);
        let Some((phone_at, phone)) = fields.next() else {
            continue;
        };
        // `#` alone makes the synthesiser speak its input so far.
        let Some((length_at, length)) = fields.next() else {
            if phone == "#" {
                continue;
            }
            return Err(TextError::new(
                phone_at + phone.len(),
                "milliseconds should follow",
            ));
        };
        let secs = number(length_at, length)? / 1000.0;
        if secs < 0.0 {
            return Err(TextError::new(length_at, "a negative duration"));
        }
        draft.segment(now, now + secs, phone, at)?;
        while let Some((percent_at, percent)) = fields.next() {
            let percent = number(percent_at, percent)?;
            let Some((hz_at, hz)) = fields.next() else {
                return Err(TextError::new(
                    at + told.len(),
                    "hertz should follow the percent",
                ));
            };
            draft.count(hz_at)?;
            let hz = number(hz_at, hz)?;
            draft
                .f0
                .push((now + secs * percent / 100.0, hz, percent_at));
        }
        now += secs;
    }
    if draft.segments.is_empty() {
        return Err(TextError::new(text.len(), "no phones"));
    }
    Ok(())
}
