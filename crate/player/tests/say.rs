//! `voice-say` with its six operations, and a live clause that uses prepared speech.

mod common;

use common::{figure, perform};
use raconteur_player::{Event, Options, Player};

/// FNV-1a, 64 bits, as keys of utterances are made, of a text that ends.
fn key(of: &[u8]) -> u64 {
    // No voice is named.
    [b"\x01\xff", of]
        .concat()
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
        })
}

/// The key of a file of the library.
fn file(kind: &str, path: &str) -> u64 {
    key(&[
        kind.as_bytes(),
        b"\xff\xfc\x01\x01",
        path.as_bytes(),
        b"\xff",
    ]
    .concat())
}

/// Returns one second of speech with words of equal length.
fn utterance(key: u64, name: &str, text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let msec = 1_000 / words.len();
    let mut start = 0;
    let mut rows = Vec::new();
    for (i, word) in words.iter().enumerate() {
        rows.push(format!("[{start}, {}, {i}, 1]", word.len()));
        start += word.len() + 1;
    }
    format!(
        r#"{{"key": "{key:016x}", "content": "{key:016x}", "voice": 0, "text": "{text}",
            "audio": [{{"file": "{name}.opus", "mime": "audio/ogg"}}], "words": [{}],
            "phones": "{}", "msecs": [{}]}}"#,
        rows.join(", "),
        vec!["aa"; words.len()].join(" "),
        vec![msec.to_string(); words.len()].join(", "),
    )
}

fn bundle() -> String {
    let utterances = [
        utterance(key(b"One two"), "text", "One two"),
        utterance(key(b"Aside"), "aside", "Aside"),
        utterance(key(b"Made ready"), "ready", "Made ready"),
        utterance(file("text", "tale.txt"), "tale", "A tale told"),
        utterance(file("sable", "song.sable"), "song", "A song"),
        utterance(file("text", "later.txt"), "later", "For later"),
    ];
    format!(
        r#"{{"format": "raconteur-speech", "version": 2,
            "voices": [{{"engine": "test 1", "voice": "v", "language": "en-GB", "phone_set": "mrpa"}}],
            "utterances": [{}]}}"#,
        utterances.join(",")
    )
}

const STORY: &str = "<eml><body><seq time='0'>\
    <voice-say time='0' voiceOperation='text'>One two</voice-say>\
    <voice-say time='0' voiceOperation='asynchronousText'>Aside</voice-say>\
    <voice-say time='0' voiceOperation='preprocessText'>Made ready</voice-say>\
    <voice-say time='0' voiceOperation='preprocessFile'>later.txt</voice-say>\
    <voice-say time='0' voiceOperation='file'>tale.txt</voice-say>\
    <voice-say time='0' voiceOperation='asynchronousFile' type='sable'>song.sable</voice-say>\
    <null time='0' timeId='after'/>\
    </seq></body></eml>";

/// An utterance: its sound, when it begins and its words.
fn spoken_words(player: &Player) -> Vec<(String, f64, Vec<String>)> {
    let all = player.utterances().iter().map(|u| {
        let said = &u.timed.utterance;
        let words = said.words.iter().map(|w| w.text.clone()).collect();
        let sound = said.audio.first().map(|a| a.file.clone());
        (sound.unwrap_or_default(), u.timed.start_secs, words)
    });
    all.collect()
}

#[test]
fn each_operation_does_what_it_is_called() {
    let loaded = perform(
        STORY,
        Some(bundle().as_bytes()),
        figure(),
        Options::default(),
    );
    let codes: Vec<_> = loaded.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, [""; 0]);
    let player = loaded.player;
    let words = |text: &str| -> Vec<String> { text.split(' ').map(str::to_owned).collect() };
    // Text and file block, asynchronous ones do not, and prepared speech is not audible. The words
    // of files are those of the bundle.
    let mut heard = spoken_words(&player);
    heard.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    assert_eq!(
        heard,
        [
            ("text.opus".to_owned(), 0.0, words("One two")),
            ("aside.opus".to_owned(), 1.0, words("Aside")),
            ("tale.opus".to_owned(), 1.0, words("A tale told")),
            ("song.opus".to_owned(), 1.999, words("A song")),
        ]
    );
    assert_eq!(player.timeline().marks.get("after"), Some(&1.999));
    assert!(
        player.utterances().iter().all(|u| !u.estimated),
        "every utterance is baked"
    );
    // The story lasts until asynchronous clauses are over.
    assert!(
        (player.duration_secs() - 2.999).abs() < 1e-9,
        "the duration of the story"
    );
}

#[test]
fn utterances_are_told_around_their_words_and_phones() {
    let mut player = perform(
        STORY,
        Some(bundle().as_bytes()),
        figure(),
        Options::default(),
    )
    .player;
    player.seek(0.0);
    player.advance(0.999);
    let told: Vec<String> = player
        .drain_events()
        .iter()
        .filter_map(|event| match event {
            Event::Utterance {
                phase,
                text,
                start_secs,
                end_secs,
                ..
            } => Some(format!("{phase} {text} {start_secs}-{end_secs}")),
            Event::Word { text, end_secs, .. } => Some(format!("word {text} -{end_secs}")),
            Event::Phone {
                symbol,
                phone_set,
                time_secs,
                end_secs,
                ..
            } => Some(format!("{phone_set} {symbol} {time_secs}-{end_secs}")),
            _ => None,
        })
        .collect();
    assert_eq!(
        told,
        [
            "start One two 0-1",
            "word One -0.5",
            "mrpa aa 0-0.5",
            "word two -1",
            "mrpa aa 0.5-1",
        ]
    );
    player.advance(1.0);
    let ends = player.drain_events();
    let ended = ends.iter().position(|e| {
        matches!(
            e,
            Event::Utterance {
                phase: "end",
                utterance: 0,
                ..
            }
        )
    });
    let next = ends
        .iter()
        .position(|e| matches!(e, Event::Utterance { phase: "start", .. }));
    assert!(ended.is_some() && ended < next, "{ends:?}");
}

#[test]
fn what_was_made_ready_is_heard_when_a_fragment_says_it() {
    let mut player = perform(
        STORY,
        Some(bundle().as_bytes()),
        figure(),
        Options::default(),
    )
    .player;
    player.set_open_ended(true);
    let performed = player.perform(
        1,
        "<voice-text time='0'>Made ready</voice-text>\
         <voice-say time='2' voiceOperation='file'>later.txt</voice-say>",
        10.0,
    );
    assert!(
        performed.diagnostics.is_empty(),
        "{:?}",
        performed.diagnostics
    );
    let sounds: Vec<&str> = performed
        .utterances
        .iter()
        .map(|u| u.timed.utterance.audio[0].file.as_str())
        .collect();
    assert_eq!(sounds, ["ready.opus", "later.opus"]);
    let words: Vec<&str> = performed.utterances[1]
        .timed
        .utterance
        .words
        .iter()
        .map(|w| &*w.text)
        .collect();
    assert_eq!(words, ["For", "later"]);
    assert_eq!(performed.utterances[0].language.as_deref(), Some("en-GB"));
    // Text missing from all bundles is captioned, and a diagnostic reports that it is not audible.
    let unknown = player.perform(
        1,
        "<voice-text time='0'>Nobody baked this</voice-text>",
        20.0,
    );
    assert_eq!(unknown.diagnostics[0].code, "player::not-baked");
    let said = &unknown.utterances[0];
    assert!(
        said.timed.utterance.audio.is_empty() && said.estimated,
        "the prepared line is estimated and silent"
    );
}
