use std::fs;
use std::path::Path;

use raconteur_base::noise;
use raconteur_speech::phones::{Class, PhoneTargets, find};
use raconteur_speech::{Bundle, Phone};

use super::*;

const ENGLISH: &str = "welcome w eh l k ax m|to t ax|my m ay|garden g aa r d ax n|mother m ah dh axr|baby b ey b iy
apple ae p ax l|five f ay v|very v eh r iy|shoe sh uw|moon m uw n|boat b ow t|window w ih n d ow|thought th ao t
knight n ay t|through th r uw|phone f ow n|queen k w iy n|chicken ch ih k ax n|rain r ey n|nation n ey sh ax n
hoping hh ow p ih ng|judge jh ah jh|wrong r ao ng|people p iy p ax l|laughed l ae f t|singing s ih ng ih ng
bottle b aa t ax l|happy hh ae p iy|lamb l ae m|don’t d ow n t|well-known w eh l n ow n|42 f ao r t uw|café k ae f ey";

const GERMAN: &str = "willkommen v ih l k ao m ax n|meinem m ay n ax m|Garten g aa k t ax n|Mutter m uh t ah
Vater f aa t ah|Wasser v aa z ah|schön sh uw n|Haus hh aw s|Häuser hh oy z ah|Freund f k oy n d|Stein sh t ay n
sprechen sh p k eh y ax n|Buch b uh k|ich ih y|acht aa k t|sechs z eh k s|Zeit s ay t|Zwiebel s v iy b ax l
Apfel aa p ax l|Straße sh t k aa s ax|Bühne b uw n ax|Vögel f uw g ax l|Liebe l iy b ax|Junge y uh ng ax
danke d aa ng k ax|Quelle k v eh l ax|geben g ih b ax n|gesehen g ax z ih ax n|Philosophie f ih l uw z ao f iy
Mond m uw n t|3 d k ay|u\u{308}ber uw b ah";

const PORTUGUESE: &str = "bem b ey ng|vindo v iy ng d uh|meu m eh w|jardim zh aa dx ax d iy|mãe m ay
irmão iy dx ax m aw|também t aa m b ey ng|filha f iy l aa|vinho v iy n uh|chuva sh uw v aa|peixe p ey sh ix
exame iy z aa m ix|carro k aa k uh|rua k uw aa|quando k w aa ng d uh|quatro k w aa t dx uh|gente zh eh ng t ix
guitarra g iy t aa k aa|palavra p aa l aa v dx aa|mundo m uw ng d uh|sempre s eh m p dx ix|tempo t eh m p uh
coração k uh dx aa s aw|corac\u{327}a\u{303}o k uh dx aa s aw|limões l iy m oy sh|obrigado uh b dx iy g aa d uh
história iy sh t ao dx y aa|e iy|muito m uw iy t uh|7 s eh t ix|casa k aa z aa|verde v eh dx ax d ix";

/// Words of several languages, and text without any word.
const OTHERS: [(&str, &str); 7] = [
    (
        "pt-BR",
        "leite l ey ch iy|dia jh iy aa|sol s ao w|flores f l ao dx iy s",
    ),
    ("fr", "bonjour b ao n y uw r|été eh t eh"),
    ("ru", "привет p r iy v y eh t"),
    ("el-GR", "καλημέρα k aa l iy m eh r aa"),
    ("ja", "日本 ax ax"),
    ("", "map m aa p"),
    ("en_US", "Москва m ao s k v aa|… ax|'s s"),
];

#[test]
fn words_have_the_phones_of_their_language() {
    let tables = [("en", ENGLISH), ("de", GERMAN), ("pt", PORTUGUESE)];
    for (tag, table) in tables.into_iter().chain(OTHERS) {
        let speller = Speller::from_language_tag(Some(tag));
        for entry in entries(table) {
            let (word, phones) = entry.split_once(' ').expect(entry);
            assert_eq!(speller.spell(word).join(" "), phones, "{tag}: {word}");
        }
    }
    assert_eq!(Speller::from_language_tag(None).spell("knee"), ["n", "iy"]);
}

#[test]
fn every_rule_can_be_read_and_has_phones_that_exist() {
    let tables = [
        english::RULES,
        german::RULES,
        portuguese::RULES,
        portuguese::BRAZIL,
        letters::RULES,
    ];
    let rules = tables.into_iter().flat_map(entries).map(|e| (e, rule(e)));
    let words = [english::WORDS, german::WORDS, portuguese::WORDS];
    let words = words.into_iter().flat_map(entries).map(|e| (e, word(e)));
    for (entry, rule) in rules.chain(words) {
        let rule = rule.expect(entry);
        assert!(!rule.letters.is_empty(), "{entry}");
        for phone in rule.phones.split(' ').filter(|p| !p.is_empty()) {
            assert!(find("radio", phone).is_some(), "{entry}: {phone}");
        }
    }
}

#[test]
fn any_text_has_some_phones_and_not_too_many() {
    // Letters that rules have, other scripts, signs and marks.
    const SOME: [char; 24] = [
        'a',
        'E',
        'h',
        'g',
        's',
        't',
        'm',
        'y',
        '\'',
        '’',
        '-',
        '7',
        '%',
        'ß',
        'İ',
        'ã',
        '\u{308}',
        '\u{327}',
        '日',
        'ऀ',
        '\u{200d}',
        '😀',
        'ﬃ',
        '\u{10ffff}',
    ];
    for tag in ["en", "de", "pt", "pt-BR", "xx", "-", "日"] {
        let speller = Speller::from_language_tag(Some(tag));
        for seed in 0..600 {
            let unit = |k| noise::unit(seed, k, 0);
            let length = (unit(1) * if seed % 100 == 0 { 2000.0 } else { 9.0 }) as u64;
            let word: String = (2..2 + length)
                .map(|k| match seed % 3 {
                    0 => char::from_u32((unit(k) * 1_114_111.0) as u32).unwrap_or('q'),
                    _ => SOME[(unit(k) * SOME.len() as f64) as usize],
                })
                .collect();
            let phones = speller.spell(&word);
            assert!((1..=MAX_PHONES).contains(&phones.len()), "{tag}: {word}");
            assert!(phones.iter().all(|p| find("radio", p).is_some()), "{word}");
        }
    }
}

/// The most shapes that two mouths make in the same order.
fn in_common(ours: &[&str], theirs: &[&str]) -> usize {
    let mut row = vec![0; theirs.len() + 1];
    for shape in ours {
        let mut diagonal = 0;
        for (j, other) in theirs.iter().enumerate() {
            let above = row[j + 1];
            row[j + 1] = match shape == other {
                true => diagonal + 1,
                false => above.max(row[j]),
            };
            diagonal = above;
        }
    }
    row[theirs.len()]
}

/// The closures of the lips in order.
fn closures<'a>(phones: impl Iterator<Item = &'a PhoneTargets>) -> Vec<Class> {
    let closes = |class: &Class| matches!(class, Class::BilabialStop | Class::BilabialNasal);
    phones.map(|phone| phone.class).filter(closes).collect()
}

/// Of the words of a story: the share of shapes that are as baked, and that of words whose
/// lips close as baked.
fn agreement(story: &str) -> [f64; 2] {
    let path = format!("../../assets/stories/{story}/voice/speech.json");
    let json = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a bundle");
    let bundle = Bundle::from_json(&json).expect("a bundle");
    let speller = Speller::from_language_tag(Some(&bundle.voices[0].language));
    let (mut shapes, mut same, mut words, mut closed) = (0, 0, 0, 0);
    for utterance in &bundle.utterances {
        for (index, word) in utterance.words.iter().enumerate() {
            let is_of_word = |p: &&Phone| p.word == Some(index);
            let phones = utterance.phones.iter().filter(is_of_word);
            let baked: Vec<_> = phones.map(|p| p.row.targets()).collect();
            let spelled = speller.spell(&word.text).into_iter();
            let spelled: Vec<_> = spelled.filter_map(|p| find("radio", p)).collect();
            let [ours, theirs] =
                [&spelled, &baked].map(|phones| phones.iter().map(|p| p.viseme).collect());
            let [ours, theirs]: [Vec<&str>; 2] = [ours, theirs];
            shapes += ours.len().max(theirs.len());
            same += in_common(&ours, &theirs);
            words += 1;
            let [ours, theirs] = [&spelled, &baked].map(|phones| closures(phones.iter().copied()));
            closed += usize::from(ours == theirs);
        }
    }
    [
        same as f64 / shapes as f64,
        f64::from(closed as u32) / f64::from(words),
    ]
}

#[test]
fn lips_move_much_as_those_of_baked_voices() {
    for (story, least) in [
        ("white-rabbit", 0.97),
        ("step-lesson", 0.97),
        ("virtual-poets/jabberwocky", 0.9),
        ("virtual-poets/zwei-parallelen", 0.9),
        ("virtual-poets/os-lusiadas", 0.88),
    ] {
        let [shapes, closures] = agreement(story);
        assert!(shapes > least, "{story}: {shapes}");
        assert!(closures > 0.99, "{story}: {closures}");
    }
}
