//! Signing Gesture Markup Language as EML scripts.

use raconteur_annotate::{Anchoring, Imported, import};
use raconteur_eml::{
    ClauseKind, Document, EstimatedDurations, GestureKey, Handedness, Phase, Severity, Timeline,
    parse, write,
};

/// Signs that use every element.
const EVERYTHING: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<sigml>
  <hns_sign gloss="ME"><sign_manual>
    <handconfig handshape="finger2" thumbpos="across"/><handconfig extfidir="il"/><handconfig palmor="r"/>
    <location_bodyarm location="chest" contact="touch"/>
  </sign_manual></hns_sign>
  <hamgestural_sign gloss="BIG" speed="1.25"><sign_manual both_hands="true" lr_symm="true">
    <handconfig handshape="flat" extfidir="o" palmor="l"/>
    <location_bodyarm location="stomach" side="right_at"/>
    <par_motion><directedmotion direction="r" size="big" curve="u"/><wristmotion motion="swinging"/></par_motion>
  </sign_manual></hamgestural_sign>
  <hamgestural_sign gloss="ROUND" timescale="1.5"><sign_manual>
    <handconfig handshape="finger2"/><handconfig extfidir="uo" palmor="d"/>
    <location_bodyarm location="shoulders" side="right_beside"/>
    <seq_motion><circularmotion axis="o" size="small"/><nomotion/></seq_motion>
    <rpt_motion repetition="fromstart_several"><directedmotion direction="d" size="small" fast="true"/></rpt_motion>
    <rpt_motion repetition="reverse"><directedmotion direction="l"/></rpt_motion>
    <rpt_motion repetition="continue"><directedmotion direction="u" zigzag_style="wavy"/></rpt_motion>
  </sign_manual></hamgestural_sign>
  <hns_sign gloss="TAKE"><sign_manual>
    <handconfig handshape="ceeall" extfidir="ol" palmor="l"/>
    <location_bodyarm location="shoulders" side="left_beside" contact="armextended"/>
    <tgt_motion><changeposture/><handconfig extfidir="l" palmor="l"/>
      <location_bodyarm location="chest" contact="close"/></tgt_motion>
  </sign_manual></hns_sign>
  <hns_sign gloss="SPLIT"><sign_manual both_hands="true">
    <split_handconfig><handconfig handshape="fist" extfidir="o" palmor="d"/>
      <handconfig handshape="flat" extfidir="or" palmor="u"/></split_handconfig>
    <split_location><location_bodyarm location="stomach" side="right_at"/>
      <location_bodyarm location="stomach" side="left_at"/></split_location>
    <split_motion><directedmotion direction="u"/><fingerplay/></split_motion>
  </sign_manual></hns_sign>
  <hamnosys_sign gloss="THANKS"><hamnosys_manual>
    <hamflathand/><hamextfingeru/><hampalmu/><hamchin/><hamtouch/><hammoveo/><hamarcd/>
  </hamnosys_manual></hamnosys_sign>
  <hns_sign gloss="PLAY"><hamnosys_manual>
    <hamsymmlr/><hamfinger2345/><hamthumboutmod/><hamextfingero/><hambetween/><hamextfingeru/><hampalmd/>
    <hamlrat/><hamstomach/>
    <hamparbegin/><hammover/><hamsmallmod/><hamtwisting/><hamparend/>
    <hamseqbegin/><hamcircleu/><hamfingerplay/><hamseqend/>
    <hamreplace/><hamfist/><hamthumbacrossmod/>
    <hamrepeatfromstart/>
  </hamnosys_manual></hns_sign>
</sigml>"#;

fn read(source: &str) -> Imported {
    import(source.as_bytes(), None, Anchoring::Words)
}

/// Reads one sign of gestural SiGML.
fn sign(attributes: &str, manual: &str) -> Imported {
    read(&format!(
        "<sigml><hns_sign gloss='G'><sign_manual {attributes}>{manual}</sign_manual></hns_sign></sigml>"
    ))
}

fn tokens(names: &str) -> Imported {
    let tokens: String = names.split(' ').map(|name| format!("<{name}/>")).collect();
    read(&format!(
        "<sigml><hns_sign gloss='G'><hamnosys_manual>{tokens}</hamnosys_manual></hns_sign></sigml>"
    ))
}

fn codes(imported: &Imported) -> Vec<&'static str> {
    imported.diagnostics.iter().map(|d| d.code).collect()
}

fn clean(imported: Imported) -> Document {
    assert_eq!(imported.diagnostics, [], "{}", imported.text);
    imported.document
}

fn check(document: &Document) -> (Document, Timeline) {
    let text = write(document);
    let parsed = parse(&text);
    let errors = parsed.diagnostics.iter();
    let errors: Vec<_> = errors.filter(|d| d.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "the script is valid: {errors:?}\n{text}");
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    assert_eq!(resolved.diagnostics, [], "all times resolve:\n{text}");
    (parsed.document, resolved.timeline)
}

fn keys(document: &Document) -> Vec<&GestureKey> {
    let keys = document.clauses.iter().filter_map(|c| match &c.kind {
        ClauseKind::GestureKey(key) => Some(key),
        _ => None,
    });
    keys.collect()
}

fn stroke(document: &Document) -> &GestureKey {
    let keys = keys(document);
    let stroke = keys.iter().find(|key| key.phase == Some(Phase::Stroke));
    stroke.expect("a stroke")
}

/// Returns the positions of a stroke, by track.
fn path(document: &Document) -> Vec<Vec<[f64; 3]>> {
    let tracks = stroke(document).motions.iter();
    let positions = tracks.map(|t| t.keys.iter().map(|key| key.value.position).collect());
    positions.collect()
}

#[test]
fn every_element_is_performed() {
    let imported = read(EVERYTHING);
    let lost: Vec<_> = imported
        .diagnostics
        .iter()
        .filter(|d| d.code != "sigml::nearest-shape")
        .collect();
    assert!(lost.is_empty(), "nothing is lost: {lost:?}");
    let (document, timeline) = check(&imported.document);
    let glosses = timeline.clauses.iter().filter_map(|timed| {
        let ClauseKind::Event { kind, payload } = &document.clause(timed.clause).kind else {
            return None;
        };
        assert_eq!(kind.as_deref(), Some("gloss"), "the type of the event");
        Some(payload.to_string())
    });
    let glosses: Vec<String> = glosses.collect();
    assert_eq!(
        glosses,
        ["ME", "BIG", "ROUND", "TAKE", "SPLIT", "THANKS", "PLAY"],
        "one sign after the other"
    );
    let strokes = keys(&document);
    let strokes = strokes.iter().filter(|k| k.phase == Some(Phase::Stroke));
    assert_eq!(strokes.count(), 7, "a stroke of each sign");
}

#[test]
fn phases_of_signs_follow_each_other() {
    let source = "<sigml>\
        <hns_sign><sign_manual><handconfig handshape='fist'/></sign_manual></hns_sign>\
        <hns_sign><sign_manual><handconfig handshape='flat'/></sign_manual></hns_sign></sigml>";
    let document = clean(read(source));
    let (document, timeline) = check(&document);
    let lead = timeline.lead_in_secs;
    let found = timeline.clauses.iter().filter_map(|timed| {
        let ClauseKind::GestureKey(key) = &document.clause(timed.clause).kind else {
            return None;
        };
        let secs = ((timed.start_secs - lead) * 1000.0).round() / 1000.0;
        Some((key.phase, secs))
    });
    let found: Vec<_> = found.collect();
    let wanted = [
        (Phase::Preparation, 0.0),
        (Phase::Stroke, 0.55),
        (Phase::PostStroke, 1.05),
        (Phase::Preparation, 1.3),
        (Phase::Stroke, 1.85),
        (Phase::PostStroke, 2.35),
        (Phase::Retraction, 2.6),
    ];
    let wanted = wanted.map(|(phase, secs)| (Some(phase), secs));
    assert_eq!(found, wanted, "preparation, stroke and hold of each sign");
}

#[test]
fn shapes_and_orientations_are_those_of_eml() {
    let document = clean(sign(
        "",
        "<handconfig handshape='finger2' extfidir='u' palmor='d'/>",
    ));
    let stroke = stroke(&document);
    assert_eq!(stroke.handedness, Handedness::Dominant, "one hand");
    assert_eq!(stroke.hand_shapes[0].keys[0].value.id, 19, "the index");
    let palm = stroke.palms[0].keys[0].value;
    assert_eq!(palm.axis, [0.0, 0.0, -1.0], "away from the signer");
    assert_eq!(palm.angle_deg.abs(), 180.0, "fingers up");
    let document = clean(sign(
        "nondominant='true'",
        "<handconfig handshape='flat' extfidir='o' palmor='r'/>",
    ));
    let left = self::stroke(&document);
    assert_eq!(left.handedness, Handedness::NonDominant, "the other hand");
    let palm = left.palms[0].keys[0].value;
    assert_eq!(
        (palm.axis, palm.angle_deg),
        ([-1.0, 0.0, 0.0], -90.0),
        "palm"
    );
}

#[test]
fn locations_are_where_they_are_named() {
    let at = |location: &str| {
        let body = "<handconfig handshape='flat' extfidir='u' palmor='u'/>";
        let document = clean(sign("", &format!("{body}{location}")));
        path(&document)[0][0]
    };
    let chin = at("<location_bodyarm location='chin' contact='touch'/>");
    let forehead = at("<location_bodyarm location='forehead' contact='touch'/>");
    let stomach = at("<location_bodyarm location='stomach' contact='touch'/>");
    assert!(
        forehead[1] > chin[1] + 5.0,
        "{forehead:?} is above {chin:?}"
    );
    assert!(chin[1] > stomach[1] + 10.0, "{chin:?} is above {stomach:?}");
    // The fingertips are at the chin, so the wrist is a hand below.
    assert!((chin[1] - 31.0 + 7.2).abs() < 0.1, "{chin:?}");
    let pointing = clean(sign(
        "",
        "<handconfig handshape='finger2' extfidir='i' palmor='d'/>\
         <location_bodyarm location='chest' contact='touch'/>",
    ));
    // The surface of the chest is at −5.5.
    assert!(
        (path(&pointing)[0][0][2] + 5.5 + 1.0 + 7.2).abs() < 0.1,
        "a finger that points at the chest touches it"
    );
    let left = at("<location_bodyarm location='shoulders' side='left_at'/>");
    let right = at("<location_bodyarm location='shoulders' side='right_beside'/>");
    assert!(left[0] > 5.0 && right[0] < -8.0, "{left:?}, {right:?}");
    let far = at("<location_bodyarm location='chest' contact='armextended'/>");
    let near = at("<location_bodyarm location='chest' contact='close'/>");
    assert!(far[2] < near[2] - 5.0, "{far:?} is in front of {near:?}");
}

#[test]
fn motions_are_paths() {
    let moved = |motion: &str| {
        let body = "<handconfig handshape='fist' extfidir='o' palmor='d'/>";
        let document = clean(sign("", &format!("{body}{motion}")));
        path(&document).remove(0)
    };
    let difference = |path: &[[f64; 3]]| {
        let (first, last) = (path[0], path[path.len() - 1]);
        [0, 1, 2].map(|i| ((last[i] - first[i]) * 100.0).round() / 100.0)
    };
    let line = moved("<directedmotion direction='r'/>");
    assert_eq!(difference(&line), [-8.0, 0.0, 0.0], "to the right");
    let small = moved("<directedmotion direction='u' size='small'/>");
    assert_eq!(difference(&small), [0.0, 4.0, 0.0], "a little up");
    let curve = moved("<directedmotion direction='r' curve='u'/>");
    assert_eq!(difference(&curve), [-8.0, 0.0, 0.0], "the same end");
    assert!(curve[2][1] > curve[0][1] + 2.0, "a bulge: {curve:?}");
    let circle = moved("<circularmotion axis='o'/>");
    assert_eq!(difference(&circle), [0.0, 0.0, 0.0], "closed");
    assert_eq!(circle.len(), 9, "keys around the circle");
    // Clockwise along the axis: from the top to the signer's right.
    assert!(
        (circle[2][0] - circle[0][0] + 4.0).abs() < 0.02,
        "a quarter: {circle:?}"
    );
    let both = moved(
        "<par_motion><directedmotion direction='r'/><directedmotion direction='u'/></par_motion>",
    );
    assert_eq!(difference(&both), [-8.0, 8.0, 0.0], "at the same time");
    let turns = moved(
        "<seq_motion><directedmotion direction='r'/><directedmotion direction='u'/></seq_motion>",
    );
    assert_eq!(turns.len(), 3, "one after another");
    assert_eq!(turns[1][1], turns[0][1], "first to the right");
    let line = "<directedmotion direction='r'/></rpt_motion>";
    let again = moved(&format!("<rpt_motion repetition='fromstart'>{line}"));
    assert_eq!(difference(&again), [-8.0, 0.0, 0.0], "from the start");
    let back = moved(&format!("<rpt_motion repetition='reverse'>{line}"));
    assert_eq!(difference(&back), [0.0, 0.0, 0.0], "and back");
    let on = moved(&format!("<rpt_motion repetition='continue_several'>{line}"));
    assert_eq!(difference(&on), [-24.0, 0.0, 0.0], "and on");
    let target = moved(
        "<tgt_motion><directedmotion direction='u'/>\
         <location_bodyarm location='neutralspace'/></tgt_motion>",
    );
    // The middle of the hand is 3.5 in front of the wrist.
    assert_eq!(
        target[target.len() - 1],
        [0.0, 15.0, -10.5],
        "at the target"
    );
}

#[test]
fn two_hands_are_mirrored_or_parallel() {
    let body = "<handconfig handshape='flat' extfidir='ol' palmor='l'/>\
        <location_bodyarm location='stomach' side='right_at'/><directedmotion direction='r'/>";
    let mirrored = clean(sign("both_hands='true' lr_symm='true'", body));
    let paths = path(&mirrored);
    for (right, left) in paths[0].iter().zip(&paths[1]) {
        let wanted = [-right[0], right[1], right[2]];
        let off = (0..3)
            .map(|i| (wanted[i] - left[i]).abs())
            .fold(0.0, f64::max);
        assert!(off < 0.02, "{right:?} mirrors {left:?}");
    }
    let palms = &stroke(&mirrored).palms;
    let (right, left) = (palms[0].keys[0].value, palms[1].keys[0].value);
    assert_eq!(right.angle_deg, -left.angle_deg, "mirrored palms");
    let parallel = clean(sign("both_hands='true'", body));
    let paths = path(&parallel);
    let moved = |path: &[[f64; 3]]| path[1][0] - path[0][0];
    assert_eq!(moved(&paths[0]), moved(&paths[1]), "the same direction");
    let alternating = clean(sign("both_hands='true' outofphase='true'", body));
    let paths = path(&alternating);
    let off = moved(&paths[0]) + moved(&paths[1]);
    assert!(off.abs() < 0.02, "against each other: {paths:?}");
}

#[test]
fn tokens_equal_the_elements() {
    for (names, attributes, manual) in [
        (
            "hamfinger2 hamextfingeru hampalmd hamnose hamtouch hammoveo hamsmallmod",
            "",
            "<handconfig handshape='finger2'/><handconfig extfidir='u'/><handconfig palmor='d'/>\
             <location_bodyarm location='nose' contact='touch'/>\
             <directedmotion direction='o' size='small'/>",
        ),
        (
            "hamsymmlr hamflathand hamthumboutmod hamextfingero hambetween hamextfingeru hampalml \
             hamshoulders hamlrat hamparbegin hammover hamcircleo hamparend hamrepeatreverse",
            "both_hands='true' lr_symm='true'",
            "<handconfig handshape='flat' thumbpos='out'/><handconfig extfidir='ou'/>\
             <handconfig palmor='l'/><location_bodyarm location='shoulders' side='right_at'/>\
             <rpt_motion repetition='reverse'><par_motion><directedmotion direction='r'/>\
             <circularmotion axis='o'/></par_motion></rpt_motion>",
        ),
        (
            "hamparbegin hamfist hamthumbacrossmod hamplus hamflathand hamparend hamparbegin hammoveu \
             hamplus hammoved hamparend hamreplace hamflathand hamextfingerl",
            "",
            "<split_handconfig><handconfig handshape='fist' thumbpos='across'/>\
             <handconfig handshape='flat'/></split_handconfig><split_motion>\
             <directedmotion direction='u'/><directedmotion direction='d'/></split_motion>\
             <tgt_motion><changeposture/><handconfig handshape='flat'/><handconfig extfidir='l'/>\
             </tgt_motion>",
        ),
    ] {
        let (a, b) = (clean(tokens(names)), clean(sign(attributes, manual)));
        assert_eq!(write(&a), write(&b), "{names}");
    }
}

#[test]
fn losses_are_told_where_they_stand() {
    for (manual, code, place) in [
        (
            "<handconfig handshape='foot'/>",
            "sigml::hand-shape",
            "foot",
        ),
        (
            "<handconfig thumbpos='gone' handshape='fist'/>",
            "sigml::hand-shape",
            "gone",
        ),
        (
            "<handconfig handshape='cee12' thumbpos='out'/>",
            "sigml::nearest-shape",
            "cee12",
        ),
        ("<handconfig extfidir='x'/>", "sigml::direction", "x"),
        ("<handconfig palmor='o'/>", "sigml::direction", "o"),
        ("<handconfig splay='true'/>", "sigml::unperformed", "true"),
        (
            "<location_bodyarm location='knee'/>",
            "sigml::location",
            "knee",
        ),
        (
            "<location_bodyarm location='nose' side='up'/>",
            "sigml::location",
            "up",
        ),
        (
            "<location_bodyarm location='nose' contact='glue'/>",
            "sigml::location",
            "glue",
        ),
        (
            "<location_hand contact='touch' location='palm'/>",
            "sigml::approximate",
            "palm",
        ),
        (
            "<handconstellation contact='touch'/>",
            "sigml::approximate",
            "touch",
        ),
        ("<directedmotion direction='q'/>", "sigml::direction", "q"),
        (
            "<directedmotion direction='u' size='huge'/>",
            "sigml::size",
            "huge",
        ),
        ("<wristmotion motion='shake'/>", "sigml::motion", "shake"),
        (
            "<rpt_motion repetition='ever'><nomotion/></rpt_motion>",
            "sigml::repetition",
            "ever",
        ),
        ("<dance/>", "sigml::unknown-element", "<dance/>"),
        ("<nonman_motion/>", "sigml::unperformed", "<nonman_motion/>"),
    ] {
        let imported = sign("", manual);
        assert_eq!(codes(&imported), [code], "{manual}: {imported:?}");
        let found = imported.diagnostics[0].span.slice(&imported.text);
        assert_eq!(found, place, "{manual}");
        check(&imported.document);
    }
}

#[test]
fn unknown_tokens_and_missing_parts_are_told() {
    let imported = tokens("hamflathand hamnoses hamextfingeru");
    assert_eq!(codes(&imported), ["sigml::unknown-token"], "a token");
    let problem = &imported.diagnostics[0];
    assert_eq!(
        problem.span.slice(&imported.text),
        "<hamnoses/>",
        "its place"
    );
    assert_eq!(problem.hints, ["did you mean `hamnose`?"], "its hint");
    let nonmanual =
        read("<sigml><hns_sign><sign_nonmanual><head_tier/></sign_nonmanual></hns_sign></sigml>");
    assert_eq!(
        codes(&nonmanual),
        ["sigml::no-manual", "sigml::nonmanual"],
        "nothing is performed"
    );
}

#[test]
fn nested_repetitions_are_limited() {
    let open = "<rpt_motion repetition='continue_several'>".repeat(40);
    let close = "</rpt_motion>".repeat(40);
    let deep = sign("", &format!("{open}<directedmotion direction='u'/>{close}"));
    assert_eq!(codes(&deep), ["sigml::too-large"], "told once");
    assert!(
        stroke(&deep.document).motions[0].keys.len() <= 100,
        "the number of keys is limited"
    );
    check(&deep.document);
    let many = "<directedmotion direction='u'/>".repeat(500);
    assert_eq!(codes(&sign("", &many)), ["sigml::too-large"], "told once");
    let brackets = "hamparbegin ".repeat(60) + "hammoveu";
    assert_eq!(codes(&tokens(&brackets)), ["sigml::too-large"], "brackets");
}

#[test]
fn malformed_files_are_reported_within_their_text() {
    let mut variants: Vec<String> = Vec::new();
    let characters: Vec<char> = EVERYTHING.chars().collect();
    for i in 1..=60 {
        let cut = characters.len() * i / 61;
        variants.push(characters[..cut].iter().collect());
    }
    for (i, wrong) in "<>&\"'=:x-é\u{0}9".chars().cycle().take(60).enumerate() {
        let mut changed = characters.clone();
        let at = 60 + (i * 7919) % (characters.len() - 60);
        changed[at] = wrong;
        variants.push(changed.iter().collect());
    }
    assert!(variants.len() >= 100, "enough variants");
    for variant in variants {
        let imported = read(&variant);
        let length = u32::try_from(imported.text.len()).expect("a short text");
        for problem in &imported.diagnostics {
            assert!(
                problem.span.start <= problem.span.end && problem.span.end <= length,
                "{problem:?} is outside of {variant}"
            );
        }
        check(&imported.document);
    }
}
