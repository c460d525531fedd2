use super::*;
use crate::files::disk::faulty::{AfterFailure, Faulty, Unsynced as Real};

fn utterance(key: u64, content: u64, audio: Vec<AudioFile>) -> Utterance {
    Utterance {
        key,
        content,
        audio,
        ..Utterance::default()
    }
}

fn bundle(utterances: Vec<Utterance>) -> Bundle {
    Bundle {
        voices: vec![Voice::default()],
        utterances: utterances.into_iter().map(Arc::new).collect(),
    }
}

/// Sounds of a bundle: key, content and the bytes of its two encodings.
type Sounds = Vec<(u64, u64, [Vec<u8>; 2])>;

/// Performs the folder operations of a bake.
fn publish(store: &Store<'_>, sounds: &Sounds) -> Result<()> {
    let mut utterances = Vec::new();
    for (key, content, encodings) in sounds {
        let mut audio = Vec::new();
        for (bytes, (ending, mime)) in encodings.iter().zip(encode::FORMATS) {
            audio.push(store.add(bytes, ending, mime)?);
        }
        utterances.push(utterance(*key, *content, audio));
    }
    let bundle = bundle(utterances);
    store.write(&bundle)?;
    store.remove_unused(&bundle)?;
    Ok(())
}

/// Returns true if the folder contains exactly this bundle, with the correct sounds.
fn is_whole(folder: &Path, sounds: &Sounds) -> bool {
    let store = Store::open(folder.to_owned(), &Real);
    let keys = sounds.iter().map(|(key, ..)| *key);
    let right = |(key, content, encodings): &(u64, u64, [Vec<u8>; 2])| {
        store.has(*key, *content)
            && store.get(*key).is_some_and(|u| {
                let read = |a: &AudioFile| fs::read(folder.join(&a.file)).unwrap_or_default();
                u.audio.iter().map(read).eq(encodings.iter().cloned())
            })
    };
    store.count_others(keys) == 0 && sounds.iter().all(right)
}

/// Returns a pseudo-random number generator.
fn numbers(seed: u64) -> impl FnMut(u64) -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move |below| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 20) % below
    }
}

/// Some utterances; those of other seeds share keys and some sounds with them.
fn some(next: &mut impl FnMut(u64) -> u64) -> Sounds {
    (0..6)
        .filter_map(|key| {
            let content = next(4);
            let bytes = |ending: u8| {
                let length = 3 + 5 * content as usize;
                vec![ending.wrapping_add(key as u8 * 16 + content as u8); length]
            };
            (content > 0).then(|| (key, content, [bytes(0), bytes(128)]))
        })
        .collect()
}

#[test]
fn wherever_a_bake_is_stopped_the_bundle_is_the_old_or_the_new_one() {
    let mut stops = 0;
    for seed in 0..6 {
        let mut next = numbers(seed);
        let (old, new) = (some(&mut next), some(&mut next));
        for then in [AfterFailure::Killed, AfterFailure::GoesOn] {
            for k in 0.. {
                let dir = tempfile::tempdir().unwrap();
                let open = || Store::open(dir.path().to_owned(), &Real);
                publish(&open(), &old).unwrap();
                assert!(is_whole(dir.path(), &old), "the first bundle is intact");
                let disk = Faulty::at_step(k, then);
                let result = publish(&Store::open(dir.path().to_owned(), &disk), &new);
                let (is_old, is_new) = (is_whole(dir.path(), &old), is_whole(dir.path(), &new));
                assert!(is_old || is_new, "seed {seed}, step {k}, {then:?}");
                if result.is_ok() {
                    assert!(is_new, "a successful bake leaves the new bundle");
                    break;
                }
                stops += 1;
                // The next bake corrects it and leaves nothing behind.
                publish(&open(), &new).unwrap();
                assert!(
                    is_whole(dir.path(), &new),
                    "the next bake completes the new bundle"
                );
                let files = fs::read_dir(dir.path()).unwrap().count();
                let names: BTreeSet<&Vec<u8>> = new.iter().flat_map(|(.., e)| e).collect();
                assert_eq!(files, names.len() + 1, "seed {seed}, step {k}");
            }
        }
    }
    assert!(stops > 100, "{stops}");
}

#[test]
fn a_full_disk_keeps_the_old_bundle() {
    let mut next = numbers(99);
    let (old, new) = (some(&mut next), some(&mut next));
    let mut full = 0;
    for room in (0..).step_by(3) {
        let dir = tempfile::tempdir().unwrap();
        publish(&Store::open(dir.path().to_owned(), &Real), &old).unwrap();
        let disk = Faulty::with_room(room);
        if publish(&Store::open(dir.path().to_owned(), &disk), &new).is_ok() {
            assert!(
                is_whole(dir.path(), &new),
                "the bundle is intact after the full disk"
            );
            break;
        }
        full += 1;
        assert!(is_whole(dir.path(), &old), "room for {room} bytes");
    }
    assert!(full > 40, "{full}");
}

#[test]
fn a_cut_file_under_the_right_name_is_written_again() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path().to_owned(), &Real);
    let audio = store.add(b"a sound", "opus", "a").unwrap();
    assert_eq!(audio.file.len(), 32 + 5);
    for cut in ["", "a so", "a sounD", "a sound and more"] {
        fs::write(dir.path().join(&audio.file), cut).unwrap();
        assert_eq!(store.add(b"a sound", "opus", "a").unwrap(), audio);
        assert_eq!(fs::read(dir.path().join(&audio.file)).unwrap(), b"a sound");
    }
}

#[test]
fn every_change_of_a_sound_is_seen() {
    let dir = tempfile::tempdir().unwrap();
    let open = || Store::open(dir.path().to_owned(), &Real);
    let store = open();
    let audio = store.add(b"a sound", "opus", "a").unwrap();
    let path = dir.path().join(&audio.file);
    store
        .write(&bundle(vec![utterance(1, 2, vec![audio])]))
        .unwrap();
    assert!(
        open().has(1, 2) && !open().has(1, 3) && !open().has(2, 2),
        "the store has only the audio of its key and text"
    );
    assert_eq!(open().count_others([1].into_iter()), 0);
    assert_eq!(open().count_others([2].into_iter()), 1);
    for other in [
        &b""[..],
        b"a soun",
        b"a sounds",
        b"A sound",
        b"another sound",
    ] {
        fs::write(&path, other).unwrap();
        assert!(!open().has(1, 2), "{other:?}");
        assert_eq!(open().sound(1), Some(Sound::Wrong));
    }
    fs::remove_file(&path).unwrap();
    assert_eq!(open().sound(1), Some(Sound::Wrong));
    fs::write(&path, b"a sound").unwrap();
    assert!(open().has(1, 2), "restored audio is in the store");
    fs::write(dir.path().join("speech.json"), "{").unwrap();
    assert!(
        !open().has(1, 2),
        "without a readable bundle, the store has no audio"
    );
}

/// A bundle as earlier bakes wrote it.
fn earlier(dir: &Path) {
    let mut audio = Vec::new();
    for (ending, mime) in encode::FORMATS {
        let file = format!("00000000000000aa.{ending}");
        fs::write(dir.join(&file), format!("sound {ending}")).unwrap();
        audio.push(AudioFile {
            file,
            mime: mime.to_owned(),
            digest: None,
        });
    }
    let store = Store::open(dir.to_owned(), &Real);
    store
        .write(&bundle(vec![utterance(0xaa, 7, audio)]))
        .unwrap();
}

#[test]
fn sounds_of_earlier_bakes_are_kept_when_they_are_what_is_said_of_them() {
    let dir = tempfile::tempdir().unwrap();
    earlier(dir.path());
    let mut store = Store::open(dir.path().to_owned(), &Real);
    assert!(
        !store.has(0xaa, 7) && store.get(0xaa).is_none(),
        "audio without a digest is not in the store"
    );
    assert_eq!(store.sound(0xaa), Some(Sound::Untold));
    store.adopt(0xaa, 8, &|_, _| true).unwrap();
    assert!(!store.has(0xaa, 8), "another content");
    let only_opus = |_: &Utterance, path: &Path| path.extension().unwrap() == "opus";
    store.adopt(0xaa, 7, &only_opus).unwrap();
    assert!(!store.has(0xaa, 7), "one of its sounds is another's");
    store.adopt(0xaa, 7, &|_, _| true).unwrap();
    assert!(store.has(0xaa, 7), "adopted audio is in the store");
    let bundle = bundle(vec![store.get(0xaa).unwrap()]);
    store.write(&bundle).unwrap();
    assert!(
        !store.is(&bundle).unwrap(),
        "a bundle with unused files is not up to date"
    );
    assert_eq!(store.remove_unused(&bundle).unwrap(), 2, "the old names");
    let store = Store::open(dir.path().to_owned(), &Real);
    assert!(
        store.has(0xaa, 7) && store.is(&bundle).unwrap(),
        "the bundle without unused files is up to date"
    );
    let sound = store.get(0xaa).unwrap().audio[0].file.clone();
    assert_eq!(fs::read(dir.path().join(sound)).unwrap(), b"sound opus");
}

#[test]
fn only_unused_files_that_a_bake_made_are_removed() {
    let dir = tempfile::tempdir().unwrap();
    let names = [
        "0123456789abcdef.opus",
        "0123456789abcdef0123456789abcdef.mp3",
        ".speech.12-0.part.json",
        "00000000000000aa.mp3",
        "00000000000000aa.wav",
        "0123456789abcdef0.mp3",
        "drum.mp3",
        "notes.txt",
        ".hidden",
    ];
    for name in names {
        fs::write(dir.path().join(name), "x").unwrap();
    }
    let audio = AudioFile {
        file: "00000000000000aa.mp3".to_owned(),
        ..AudioFile::default()
    };
    let bundle = bundle(vec![utterance(0xaa, 0, vec![audio])]);
    let store = Store::open(dir.path().to_owned(), &Real);
    assert_eq!(store.remove_unused(&bundle).unwrap(), 2);
    for (i, name) in names.iter().enumerate() {
        assert_eq!(dir.path().join(name).exists(), i >= 3, "{name}");
    }
    store.write(&bundle).unwrap();
    assert_eq!(store.clear().unwrap(), 1);
    assert!(
        !dir.path().join("speech.json").exists(),
        "the unused bundle file is removed"
    );
    assert!(
        dir.path().join("drum.mp3").exists(),
        "the file of the author stays"
    );
}

#[cfg(unix)]
#[test]
fn sounds_that_are_links_out_of_the_folder_are_none() {
    let dir = tempfile::tempdir().unwrap();
    let (voice, secret) = (dir.path().join("voice"), dir.path().join("secret"));
    fs::create_dir(&voice).unwrap();
    fs::write(&secret, "a sound").unwrap();
    let store = Store::open(voice.clone(), &Real);
    let audio = store.add(b"a sound", "opus", "a").unwrap();
    let path = voice.join(&audio.file);
    store
        .write(&bundle(vec![utterance(1, 2, vec![audio])]))
        .unwrap();
    fs::remove_file(&path).unwrap();
    std::os::unix::fs::symlink(&secret, &path).unwrap();
    let store = Store::open(voice.clone(), &Real);
    assert!(
        !store.has(1, 2),
        "a link out of the folder is not in the store"
    );
    // The link is replaced, and its target is unchanged.
    store.add(b"a sound", "opus", "a").unwrap();
    assert!(
        !fs::symlink_metadata(&path).unwrap().is_symlink(),
        "the link is replaced with a regular file"
    );
    assert_eq!(fs::read(&secret).unwrap(), b"a sound");
}

#[test]
fn a_bundle_is_compared_and_not_believed() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    // A sparse file that takes no disk space and would fill any memory.
    let huge = 1_u64 << 42;
    fs::File::create(folder.join("huge.opus"))
        .and_then(|file| file.set_len(huge))
        .unwrap();
    fs::write(folder.join("small.opus"), b"a sound").unwrap();
    let told = |file: &str, bytes: u64| AudioFile {
        file: file.to_owned(),
        mime: "a".to_owned(),
        digest: Some(FileDigest {
            bytes,
            sha256: "0".repeat(64),
        }),
    };
    let claims = [
        told("huge.opus", huge),
        told("huge.opus", u64::MAX),
        told("small.opus", u64::MAX),
        told("small.opus", 0),
        told("small.opus", 7),
    ];
    let utterances = (0..)
        .zip(&claims)
        .map(|(key, audio)| utterance(key, 1, vec![audio.clone()]));
    let store = Store::open(folder.to_owned(), &Real);
    store.write(&bundle(utterances.collect())).unwrap();
    let store = Store::open(folder.to_owned(), &Real);
    for key in 0..claims.len() as u64 {
        assert_eq!(store.sound(key), Some(Sound::Wrong), "{key}");
    }
}

#[test]
fn a_sound_is_read_once_however_often_it_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    fs::write(folder.join("a.opus"), b"a sound").unwrap();
    let audio = |bytes: &[u8]| AudioFile {
        file: "a.opus".to_owned(),
        mime: "a".to_owned(),
        digest: Some(digest(bytes)),
    };
    let mut sounds = super::Sounds::from_folder(folder);
    assert_eq!(sounds.inspect(&audio(b"a sound")), Sound::Whole);
    // Audio that was read stays available, also after its file is removed.
    fs::write(folder.join("a.opus"), b"changed").unwrap();
    assert_eq!(sounds.inspect(&audio(b"a sound")), Sound::Whole);
    assert_eq!(sounds.inspect(&audio(b"a soun!")), Sound::Wrong);
    assert_eq!(
        super::Sounds::from_folder(folder).inspect(&audio(b"changed")),
        Sound::Whole
    );
    // No more is read than all sounds together may have.
    let mut sounds = super::Sounds {
        left: 6,
        ..super::Sounds::from_folder(folder)
    };
    assert_eq!(sounds.inspect(&audio(b"changed")), Sound::Wrong);
}
