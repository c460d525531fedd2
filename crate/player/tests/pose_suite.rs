//! Runs `tests/suite/pose`: effects of the language on the body, one concept per case.
//!
//! A case is a script, `NAME.eml`, and next to it `NAME.pose` with the required results of its
//! performance, one per line; `#` begins a comment. Times are seconds, bones have the names of GEVH
//! appendix A without `bone_`, and ± gives the tolerance.
//!
//! | line | holds when |
//! |---|---|
//! | `figure NAME` | (first lines) performed by this figure of `assets/figures`; else by the example of GEVH table A.1, whose unit is 25.4 mm |
//! | `motion AMOUNT` | (first lines) performed with this much idle life; else with none |
//! | `at TIME BONE X Y Z ±M` | the bone's joint is there, world, metres (x left, y up, z front) |
//! | `speaker TIME BONE X Y Z ±U` | the same in the script's coordinates: units from the speaker's origin, x left, y up, z back |
//! | `axis TIME BONE x\|y\|z X Y Z ±DEG` | this axis of the bone's frame points that way, world |
//! | `still FROM TO BONE ±M` | between the times it stays where it is at the first |
//! | `moves FROM TO BONE M` | its places at the two times are at least this far apart, metres |
//! | `speed FROM TO BONE V` | between the times it is nowhere faster than this, m/s |
//! | `turns FROM TO BONE V` | between the times its frame turns nowhere faster than this, rad/s |
//! | `same TIME BONE OTHER ±M` | the joint is where it is in the case `OTHER` at that time |
//! | `morph TIME NAME VALUE ±W` | a weight of the face |
//! | `diagnostic CODE LINE` | the script's diagnostics are exactly these, in order |
//!
//! Every case is played forwards and sought backwards, which must agree to the last bit, and no
//! bone may change its length.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use raconteur_player::base::{DAffine3, DVec3, ops};
use raconteur_player::body::read::read_figure;
use raconteur_player::body::{Bone, Figure, Skeleton};
use raconteur_player::eml::LineIndex;
use raconteur_player::eml::schema::ELEMENTS;
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput, Units};

/// Elements of which every attribute must occur in a case.
const SHOWN: &[&str] = &[
    "vh-move",
    "body-configure-manipulator",
    "body-non-deterministic-fk",
    "body-non-deterministic-joint-interpolation",
    "body-non-deterministic-frame-interpolation",
    "body-non-deterministic-function",
    "body-non-deterministic-jacobian",
    "body-non-deterministic-stop",
    "body-non-deterministic-lock",
    "set",
    "it",
    "ref",
    "bg",
    "ly",
    "bone",
    "bones",
    "tracks",
    "body-configure-deterministic-animation",
    "body-configure-deterministic-track-property",
    "body-player-add",
    "body-player-set-exclusive",
    "body-player-change-priority",
    "body-player-remove",
    "body-player-clear",
    "body-deterministic-primitive",
    "animation-style",
    "gesture-is-on",
    "gesture-key",
    "hand-shapes",
    "palms",
    "motion",
    "key",
];

/// Sampling rate of intervals, hertz.
const RATE: f64 = 120.0;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/suite/pose")
}

/// The names of the cases, in order.
fn cases() -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder())
        .expect("the folder of the suite")
        .map(|entry| entry.expect("an entry of the suite").path())
        .filter(|path| path.extension().is_some_and(|e| e == "eml"))
        .map(|path| {
            path.file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

/// A figure of the assets, or the example, which has a skeleton only.
fn figure(name: &str) -> Arc<Figure> {
    if name == "example" {
        return Arc::new(Figure {
            name: name.to_owned(),
            skeleton: Skeleton::example(),
            inverse_bind: Vec::new(),
            meshes: Vec::new(),
            morph_names: Vec::new(),
            lid_closure_rad: [0.0; 2],
            sex: None,
            dominant_hand: raconteur_player::base::Side::Right,
            images: Vec::new(),
            tissue: None,
            springs: raconteur_body::Springs::default(),
        });
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../assets/figures")
        .join(format!("{name}.glb"));
    let bytes = fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    Arc::new(read_figure(name, &bytes).expect("a figure"))
}

/// A case that is being checked.
struct Case {
    name: String,
    eml: String,
    lines: Vec<Vec<String>>,
    options: Options,
    figure: Arc<Figure>,
    player: Player,
    diagnostics: Vec<String>,
}

impl Case {
    fn read(name: &str) -> Self {
        let read = |extension: &str| {
            let path = folder().join(name).with_extension(extension);
            fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
        };
        let eml = read("eml");
        let lines: Vec<Vec<String>> = read("pose")
            .lines()
            .map(|line| line.split('#').next().unwrap_or("").trim())
            .filter(|line| !line.is_empty())
            .map(|line| line.split_whitespace().map(str::to_owned).collect())
            .collect();
        let said = |word: &str| lines.iter().find(|l| l[0] == word).map(|l| l[1].clone());
        let figure = figure(&said("figure").unwrap_or_else(|| "example".to_owned()));
        let options = Options {
            motion_amount: said("motion").map_or(0.0, |m| number(&m)),
            ..Options::default()
        };
        let LoadedPlayer {
            player,
            diagnostics,
        } = load(&eml, &figure, options);
        let index = LineIndex::new(&eml);
        let diagnostics = diagnostics
            .iter()
            .map(|d| format!("{} {}", d.code, index.position(d.span.start).line))
            .collect();
        Self {
            name: name.to_owned(),
            eml,
            lines,
            options,
            figure,
            player,
            diagnostics,
        }
    }

    fn joint(&mut self, time_secs: f64, bone: Bone) -> DAffine3 {
        self.player.frame(time_secs, 1.6).world_from_joint[bone.index()]
    }

    fn place(&mut self, time_secs: f64, bone: Bone) -> DVec3 {
        self.joint(time_secs, bone).translation
    }

    /// Returns the frames of a bone from one time to another.
    fn places(&mut self, from: f64, to: f64, bone: Bone) -> Vec<DAffine3> {
        assert!(to > from, "{}: nothing between {from} and {to}", self.name);
        let steps = ((to - from) * RATE).ceil() as u32;
        (0..=steps)
            .map(|i| from + (to - from) * f64::from(i) / f64::from(steps))
            .map(|t| self.joint(t, bone))
            .collect()
    }

    /// Returns the failure of one line; `None` if it holds.
    fn check(&mut self, words: &[&str]) -> Option<String> {
        match words[0] {
            "figure" | "motion" | "diagnostic" => None,
            "at" | "speaker" | "axis" | "same" => self.check_joint(words),
            "still" | "moves" => self.check_distance(words),
            "speed" | "turns" => self.check_speed(words),
            "morph" => self.check_morph(words),
            other => panic!("{}: there is no line `{other}`", self.name),
        }
    }

    /// Lines about where a joint is at a time, or how it is turned.
    fn check_joint(&mut self, words: &[&str]) -> Option<String> {
        let (time_secs, joint) = (number(words[1]), bone(words[2]));
        let found = self.place(time_secs, joint);
        match words[0] {
            "at" => off(
                found.distance(vector(words, 3)),
                within(words[6]),
                &show(found),
            ),
            "speaker" => {
                let units = Units::from_skeleton(&self.figure.skeleton);
                let wanted = units.speaker_point(vector(words, 3).to_array());
                let scale = self.figure.skeleton.metres_per_eml_unit();
                let origin = units.speaker_point([0.0; 3]);
                let shown = (found - origin) / scale * DVec3::new(1.0, 1.0, -1.0);
                let distance = found.distance(wanted) / scale;
                off(distance, within(words[6]), &show(shown))
            }
            "axis" => {
                let axes = self.joint(time_secs, joint).matrix3;
                let axis = match words[3] {
                    "x" => axes.x_axis,
                    "y" => axes.y_axis,
                    "z" => axes.z_axis,
                    other => panic!("there is no axis {other}"),
                };
                let degrees = axis.angle_between(vector(words, 4)).to_degrees();
                off(degrees, within(words[7]), &show(axis))
            }
            _ => {
                let other = Self::read(words[3]).place(time_secs, joint);
                off(found.distance(other), within(words[4]), &show(found))
            }
        }
    }

    /// Checks lines about the displacement of a joint from one time to another.
    fn check_distance(&mut self, words: &[&str]) -> Option<String> {
        let [from_secs, to_secs] = [number(words[1]), number(words[2])];
        let joint = bone(words[3]);
        if words[0] == "moves" {
            let from = self.place(from_secs, joint);
            let far = from.distance(self.place(to_secs, joint));
            return off(number(words[4]) - far, 0.0, &format!("{far:.5} m"));
        }
        let places = self.places(from_secs, to_secs, joint);
        let first = places[0].translation;
        let far = places.iter().map(|p| p.translation.distance(first));
        let farthest = far.fold(0.0, f64::max);
        off(farthest, within(words[4]), &format!("{farthest:.5} m"))
    }

    /// Lines about how fast a joint moves or turns at most from one time to another.
    fn check_speed(&mut self, words: &[&str]) -> Option<String> {
        let [from_secs, to_secs] = [number(words[1]), number(words[2])];
        let places = self.places(from_secs, to_secs, bone(words[3]));
        let rate = (places.len() - 1) as f64 / (to_secs - from_secs);
        let is_turn = words[0] == "turns";
        let step = |w: &[DAffine3]| {
            if !is_turn {
                return w[0].translation.distance(w[1].translation) * rate;
            }
            let difference = w[0].matrix3 - w[1].matrix3;
            // Frobenius norm of a difference of rotations: 2√2 sin(angle / 2).
            let squares = difference.to_cols_array().map(|x| x * x);
            let sine = squares.iter().sum::<f64>().sqrt() / 8f64.sqrt();
            2.0 * ops::asin_clamped(sine) * rate
        };
        let fastest = places.windows(2).map(step).fold(0.0, f64::max);
        let unit = if is_turn { "rad/s" } else { "m/s" };
        let found = format!("{fastest:.3} {unit}");
        off(fastest - number(words[4]), 0.0, &found)
    }

    /// A line about a morph weight.
    fn check_morph(&mut self, words: &[&str]) -> Option<String> {
        let index = self.figure.morph_index(words[2]).expect("a morph");
        let weights = &self.player.frame(number(words[1]), 1.6).morph_weights;
        let found = f64::from(weights[index]);
        let distance = (found - number(words[3])).abs();
        off(distance, within(words[4]), &format!("{found:.4}"))
    }

    /// Returns the lines that do not hold, and other failures.
    fn wrong(mut self) -> Vec<String> {
        let mut wrong = Vec::new();
        let lines = std::mem::take(&mut self.lines);
        assert!(!lines.is_empty(), "{} checks nothing", self.name);
        for line in &lines {
            let words: Vec<&str> = line.iter().map(String::as_str).collect();
            if let Some(what) = self.check(&words) {
                wrong.push(format!("{}: {}: {what}", self.name, words.join(" ")));
            }
        }
        let expected: Vec<String> = lines
            .iter()
            .filter(|l| l[0] == "diagnostic")
            .map(|l| l[1..].join(" "))
            .collect();
        if self.diagnostics != expected {
            wrong.push(format!("{}: diagnostics {:?}", self.name, self.diagnostics));
        }
        self.sweep(&mut wrong);
        wrong
    }

    /// Checks that forward playback and backward seeking agree, and that bones keep their lengths.
    fn sweep(&mut self, wrong: &mut Vec<String>) {
        let steps = (self.player.end_secs() * 15.0).ceil().min(300.0) as u32;
        let time = |i: u32| f64::from(i) / 15.0;
        let played: Vec<u64> = (0..=steps).map(|i| self.player.digest(time(i))).collect();
        let mut sought = load(&self.eml, &self.figure, self.options).player;
        for i in (0..=steps).rev() {
            if sought.digest(time(i)) != played[i as usize] {
                wrong.push(format!(
                    "{}: another pose when sought at {}",
                    self.name,
                    time(i)
                ));
            }
            let frame = sought.frame(time(i), 1.6);
            for b in Bone::ALL {
                let Some(parent) = b.parent() else { continue };
                let [at, from] = [b, parent].map(|b| frame.world_from_joint[b.index()].translation);
                let stretched = self.figure.skeleton.stretched_m(b, at.distance(from));
                if stretched.is_nan() || stretched > 1e-9 {
                    wrong.push(format!(
                        "{}: {} is stretched at {}",
                        self.name,
                        b.name(),
                        time(i)
                    ));
                }
            }
        }
    }
}

/// Returns the failure of a value at a distance from its expectation; `None` within the bound.
fn off(distance: f64, bound: f64, found: &str) -> Option<String> {
    let inside = distance <= bound;
    (!inside).then(|| format!("found {found}, {distance:.5} off"))
}

/// The three numbers of a line from this word on.
fn vector(words: &[&str], at: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|i| number(words[at + i])))
}

/// Returns a player with the animations that it needs: paths are relative to the cases, names are
/// in the library.
fn load(eml: &str, figure: &Arc<Figure>, options: Options) -> LoadedPlayer {
    let mut loaded = Player::load(StoryInput {
        eml,
        bundle: None,
        figure: Arc::clone(figure),
        options,
    });
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/animations");
    let texts: Vec<(String, Option<String>)> = loaded
        .player
        .needed_animations()
        .into_iter()
        .map(|name| {
            let path = if name.contains('/') {
                folder().join(&name)
            } else {
                library.join(format!("{name}.json"))
            };
            (name, fs::read_to_string(path).ok())
        })
        .collect();
    if !texts.is_empty() {
        let clips: Vec<(&str, Option<&str>)> = texts
            .iter()
            .map(|(name, text)| (name.as_str(), text.as_deref()))
            .collect();
        let told = loaded.player.provide_animations(&clips);
        loaded.diagnostics.extend(told);
    }
    loaded
}

fn number(word: &str) -> f64 {
    word.parse()
        .unwrap_or_else(|_| panic!("`{word}` is no number"))
}

/// The tolerance after a ±.
fn within(word: &str) -> f64 {
    number(word.strip_prefix('±').expect("a tolerance begins with ±"))
}

fn bone(name: &str) -> Bone {
    Bone::from_name(name).unwrap_or_else(|| panic!("there is no bone {name}"))
}

fn show(v: DVec3) -> String {
    format!("{:.4} {:.4} {:.4}", v.x, v.y, v.z)
}

#[test]
fn every_case_shows_what_it_says() {
    let cases = cases();
    assert!(!cases.is_empty(), "there is no case");
    let wrong: Vec<String> = cases
        .iter()
        .flat_map(|name| Case::read(name).wrong())
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_attribute_of_the_shown_elements_has_a_case() {
    let mut written: BTreeSet<(String, String)> = BTreeSet::new();
    for name in cases() {
        let text = fs::read_to_string(folder().join(name).with_extension("eml")).expect("a case");
        for tag in text.split('<').skip(1) {
            let tag = tag.split('>').next().unwrap_or("");
            let mut words = tag.split(|c: char| c.is_whitespace() || c == '/');
            let local = |name: &str| name.rsplit(':').next().unwrap_or(name).to_owned();
            let element = local(words.next().unwrap_or(""));
            let attributes = words.filter_map(|w| w.split_once('=').map(|(a, _)| a));
            for attribute in attributes {
                written.insert((element.clone(), local(attribute)));
            }
            written.insert((element, String::new()));
        }
    }
    let mut missing = Vec::new();
    for name in SHOWN {
        // Those of the extensions are no more than like them in name.
        let named = ELEMENTS.iter().filter(|e| e.name == *name && !e.extension);
        let mut variants = named.peekable();
        assert!(variants.peek().is_some(), "there is no element {name}");
        for element in variants {
            let attributes = element.all_attributes().map(|a| a.name);
            for attribute in attributes
                .filter(|a| !["time", "timeId"].contains(a))
                .chain([""])
            {
                if !written.contains(&((*name).to_owned(), attribute.to_owned())) {
                    missing.push(format!("<{name} {attribute}>"));
                }
            }
        }
    }
    assert!(missing.is_empty(), "no case has {missing:#?}");
}
